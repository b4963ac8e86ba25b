// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/core/types.h>

#include <algorithm>
#include <array>
#include <map>
#include <span>
#include <vector>

namespace lacuna::geometry {

/// Harmonic interpolation on a triangulation, from points with known values (fixed points) to all other
/// points (free points).
///
/// The value at a free point is a weighted mean of the values at its neighbours, with the mean value weights
/// of Floater (2003). These weights are positive for all triangle shapes, so all values stay in the range of
/// the fixed values. A disc whose rim is mapped in order to a convex outline is mapped one-to-one (Tutte). On
/// planar triangles, linear functions are reproduced.
///
/// Free points on a border have cotangent weights instead, limited to >= 0. These weights approximate the
/// natural (Neumann) boundary condition, whatever the directions of the facets' diagonals.
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

    /// For values that are unique only up to multiples of a period, such as the angle around a cylinder. The
    /// surface is then cut, and values jump by a period at the cut. For each corner of each triangle: the
    /// number of periods to add to the value at the corner's point, so that the values at the three corners
    /// are continuous on the triangle. Triangles that do not touch the cut may have 0. Empty: all are 0.
    std::vector<std::array<int, 3>> corner_turns;
    Eigen::RowVectorXd period; ///< period of each of the k values; only used with corner_turns

    /// Use cotangent weights of either sign everywhere, which minimises the Dirichlet energy. Unlike mean
    /// value weights, they are not biased where all diagonals have the same direction. Values may leave the
    /// range of the fixed values.
    bool least_energy = false;

    /// Whether nine correct digits suffice. If so:
    /// 1. An affine function of position that has the fixed values is returned without solving a system, if
    ///    at every free point it equals the weighted mean of its values at the neighbours.
    /// 2. Otherwise, multigrid is used from 2,000 free points on, in a third of the time of a factorisation.
    bool nine_digits = false;
};

/// Values at the points that the triangles of a problem use, and at its fixed points.
struct HarmonicValues {
    std::vector<Index> points; ///< ascending
    Eigen::MatrixXd values;    ///< a row for each of the points

    /// @pre  the point is one of `points`. O(log points)
    [[nodiscard]] auto at(Index point) const
    {
        return values.row(std::ranges::lower_bound(points, point) - points.begin());
    }
};

/// As `solve_harmonic()`, in time that does not depend on the number of points that no triangle uses.
HarmonicValues solve_on_facets(const HarmonicProblem& problem, const RunContext& context = {});

/// Compute the k values at all points.
///
/// @return points.size() × k, without the periods of `corner_turns`. Rows of fixed points are bit-identical
///         to the given ones; rows of points that no triangle uses are 0.
/// @throw  InvalidInput "geometry.harmonic_input"  sizes do not match, or an index is out of range.
/// @throw  BackendError "geometry.singular"  a free point is not connected to a fixed point; names it.
/// @throw  Cancelled  between the steps; not during the factorisation.
/// @note   Degenerate triangles are allowed: weights are limited against rounding. Up to 20,000 free points
///         (2,000 if nine digits suffice): one sparse factorisation and k solves. Beyond that: multigrid,
///         linear in the number of points; if it does not converge, the factorisation. Deterministic.
Eigen::MatrixXd solve_harmonic(const HarmonicProblem& problem, const RunContext& context = {});

} // namespace lacuna::geometry
