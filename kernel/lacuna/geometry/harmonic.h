// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/core/types.h>

#include <array>
#include <span>
#include <vector>

namespace lacuna::geometry {

/// Values wanted at the points of a triangulation, smooth between points where they are known.
///
/// Each free point is to be a weighted mean of its neighbours, with the mean value weights of Floater (2003):
/// positive whatever the triangles' shapes. So no value leaves the range of the fixed ones, and a disc whose
/// rim is fixed round a convex outline in order is mapped one to one (Tutte). Where the triangles lie in a
/// plane, linear functions are reproduced.
///
/// Free points of a border have cotangent weights, none below zero: values leave it square (Neumann's natural
/// condition), whichever way the diagonals of the triangles run.
struct HarmonicProblem {
    std::span<const Vec3> points; ///< the whole model's may be given: those no triangle uses take no part
    std::span<const Triangle> triangles; ///< either way round
    std::vector<Index> fixed;            ///< points whose values are known, each once
    Eigen::MatrixXd fixed_values;        ///< fixed.size() × k, a row a point

    /// For values known up to a period only (an angle round a cylinder): what to add to the value of each
    /// corner, as a multiple of `period`, for the corners of a triangle to be seen on one branch. Corners of
    /// a triangle that straddles the cut have different turns; all others may stay 0. Empty: all zero.
    std::vector<std::array<int, 3>> corner_turns;
    Eigen::RowVectorXd period; ///< k numbers; read only where there are corner_turns

    /// Cotangent weights everywhere, of either sign: least Dirichlet energy. Mean value weights lean as
    /// diagonals do that all run one way, however fine the triangles; these do not, but values may leave the
    /// range of the fixed ones.
    bool least_energy = false;

    /// Nine digits are enough: multigrid already from 2,000 free points on, a third of the time there, and
    /// nothing is solved where an affine function of place has the fixed values and the means.
    bool nine_digits = false;
};

/// Solve for all points, k values each.
///
/// @return points.size() × k, on the branch of turn 0. The rows of fixed points are the given ones bit for
///         bit, those of points no triangle uses are 0.
/// @throw  InvalidInput "geometry.harmonic_input"  sizes that do not fit, an index that is out of range.
/// @throw  BackendError "geometry.singular"  points that are joined to no fixed point; names one of them.
/// @throw  Cancelled  between the steps; not within the factorisation.
/// @note   Triangles of no area do no harm: weights are kept within what rounding can bear. Up to 20,000 free
///         points (2,000 where nine digits are enough) one sparse factorisation and k solves; beyond that
///         multigrid, linear in the points, and the factorisation where that does not settle. Deterministic.
Eigen::MatrixXd solve_harmonic(const HarmonicProblem& problem, const RunContext& context = {});

} // namespace lacuna::geometry
