// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/geometry/shared/affine.h>
#include <lacuna/mesh/quad_mesh.h>
#include <lacuna/sweep/shared/rim_columns.h>

#include <span>
#include <vector>

namespace lacuna::sweep {

/// @throw InvalidInput  the columns do not fit the source: sizes or node numbers are wrong, a boundary node
///         has no column, a number is not finite, the first row is not at the source's nodes, or the last row
///         is not at the target's nodes.
void check_columns(const mesh::QuadMesh& source, const RimColumns& columns,
                   std::span<const Vec3> target = {});

/// Boundary sides of the source as pairs of column numbers.
std::vector<Segment> rim_sides(const mesh::QuadMesh& source, const RimColumns& columns);

/// Newell area vector enclosed by the rim's sides, all loops summed.
Vec3 rim_area(std::span<const Vec3> rim, std::span<const Segment> sides);

/// Length of the shortest side of a quad [model length]; 0 for no quads.
double shortest_side(std::span<const Quad> quads, std::span<const Vec3> nodes);

/// One end of the sweep with the data to map it onto other rims. The map is fitted to the rim's points alone
/// under three conditions:
/// - The points are not nearly planar, and no node of the end is much farther out than the rim.
/// - The fitted map is exact.
/// - The fitted map is right-handed.
///
/// An example is a skin between two circles. For other rims, the fit also includes the pseudo-normals.
/// Without them, small waves of the rim would tilt the map far off the rim's plane.
class RimFitter {
public:
    /// @param rim    the end's rim, in the order of the columns; must outlive the fitter.
    /// @param nodes  all nodes of the end's mesh.
    RimFitter(std::span<const Vec3> rim, std::span<const Segment> sides, std::span<const Vec3> nodes);

    /// @param negligible  a map counts as exact if its residual is below this [model length].
    [[nodiscard]] geometry::AffineFit fit(std::span<const Vec3> to, const Vec3& to_area,
                                          double negligible) const;

private:
    geometry::AffineFitter points_;
    geometry::AffineFitter paired_; ///< fit that includes the pseudo-normal
    bool spans_inside_ = false;
};

/// Root mean square distance of the points from their centre.
double radius(std::span<const Vec3> points);

} // namespace lacuna::sweep
