// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/core/types.h>

#include <array>
#include <map>
#include <span>
#include <vector>

namespace lacuna::geometry {

/// Harmonic interpolation on a triangulation, from points with known values.
///
/// Each free point is a weighted mean of its neighbours, with the mean value weights of Floater (2003). These
/// are positive for all triangle shapes, so values stay in the range of the fixed ones. A disc whose rim is
/// mapped in order to a convex outline is mapped one-to-one (Tutte). On planar triangles, linear functions
/// are reproduced.
///
/// Free points on a border have cotangent weights, limited to >= 0. They approximate the natural (Neumann)
/// condition, independent of the directions of the diagonals.
struct HarmonicProblem {
    std::span<const Vec3> points;        ///< may be all points of a model; unused points are ignored
    std::span<const Triangle> triangles; ///< in either orientation
    std::vector<Index> fixed;            ///< points with known values, without duplicates
    Eigen::MatrixXd fixed_values;        ///< fixed.size() × k, one row for each point

    /// Add points with known values, which are numbers or vectors. @pre  no point is fixed yet
    template <class Value>
    void fix(const std::map<Index, Value>& values)
    {
        fixed_values.resize(static_cast<Eigen::Index>(values.size()), sizeof(Value) / sizeof(double));
        for (const auto& [point, value] : values) {
            fixed_values.row(static_cast<Eigen::Index>(fixed.size())).transpose() << value;
            fixed.push_back(point);
        }
    }

    /// Used for values that are known only up to a period, such as the angle around a cylinder. For each
    /// triangle corner: the number of periods to add to the value of its point to get its value on the branch
    /// of the triangle. The corners of a triangle across the cut have different numbers; all other triangles
    /// may have 0. Empty: all are 0.
    std::vector<std::array<int, 3>> corner_turns;
    Eigen::RowVectorXd period; ///< k numbers; only used with corner_turns

    /// Use cotangent weights of either sign everywhere, which minimises the Dirichlet energy. Unlike mean
    /// value weights, they are not biased where all diagonals have the same direction. Values may leave the
    /// range of the fixed values.
    bool least_energy = false;

    /// Whether nine digits suffice. If so, multigrid is used from 2,000 free points on, where it takes a
    /// third of the time of a factorisation. If an affine function of position has the fixed values and
    /// satisfies all means, it is the result, and no system is solved.
    bool nine_digits = false;
};

/// Solve for all points, k values each.
///
/// @return points.size() × k, on the branch of turn 0. Rows of fixed points are bit-identical to the given
///         ones; rows of unused points are 0.
/// @throw  InvalidInput "geometry.harmonic_input"  sizes do not match, or an index is out of range.
/// @throw  BackendError "geometry.singular"  a free point is not connected to a fixed point; names it.
/// @throw  Cancelled  between the steps; not during the factorisation.
/// @note   Degenerate triangles are allowed: weights are limited against rounding. Up to 20,000 free points
///         (2,000 if nine digits suffice): one sparse factorisation and k solves. Beyond that: multigrid,
///         linear in the number of points; if it does not converge, the factorisation. Deterministic.
Eigen::MatrixXd solve_harmonic(const HarmonicProblem& problem, const RunContext& context = {});

} // namespace lacuna::geometry
