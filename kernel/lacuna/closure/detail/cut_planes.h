// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/geometry/newell.h>
#include <lacuna/topology/open_volume.h>

#include <cstddef>
#include <optional>
#include <vector>

namespace lacuna::closure {

/// A concave edge of a volume, or a concave cylinder that turns by more than a right angle, such as a bore.
struct Bend {
    EdgeId edge; ///< invalid: a cylinder
    FaceId face; ///< of a cylinder
    /// Length of the edge; of a cylinder, its length for each right angle by which it turns, none of them for
    /// a quarter turn [model length].
    double length = 0;
    std::optional<Vec3> axis; ///< a sweep in this direction follows the bend; empty: a curved edge
};

/// All bends of a sealed volume. O(facets).
std::vector<Bend> bends_of(const topology::OpenVolume& volume, const RunContext& context);

/// How far bends are from those of one sweep: the length of all of them, and that of those which no sweep in
/// one direction follows, for the best direction [model length].
double length_to_cut(const std::vector<Bend>& bends);

/// A plane that may cut a volume into pieces that are easier to sweep.
struct CutPlane {
    geometry::Plane plane;
    std::vector<EdgeId> edges; ///< cut only as far as the plane reaches from these; empty: cut all through
};

/// Planes to cut a volume by, in this order:
/// 1. of flat faces beside concave edges, as far as they reach from these;
/// 2. midway between features, which are connected groups of bends, across the normals of flat faces and of
///    pairs of axes, if the bends on either side are then closer to those of one sweep; the closest first;
/// 3. through the axes of cylinders that cross each other: halves of bores are grooves.
/// @param most  number of planes between features.
std::vector<CutPlane> cut_planes(const topology::OpenVolume& volume, const std::vector<Bend>& bends,
                                 std::size_t most);

} // namespace lacuna::closure
