// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/closure/detail/turns.h>
#include <lacuna/geometry/newell.h>
#include <lacuna/topology/open_volume.h>

#include <cstddef>
#include <optional>
#include <vector>

namespace lacuna::closure {

/// A concave edge of a volume, or a concave cylinder: a bore, or a fillet that replaces such an edge.
struct Bend {
    EdgeId edge; ///< invalid if the bend is a cylinder
    FaceId face; ///< the cylinder; invalid if the bend is an edge
    /// Length of the edge. For a cylinder: its length times the number of right angles by which it turns. If
    /// it turns by more than one, this is multiplied by a factor that rises from 0 at a right angle to 1 at a
    /// full turn [model length].
    double length = 0;
    /// A sweep in this direction follows the bend, or has it in an end. Empty for other curved edges.
    std::optional<Vec3> axis;
};

/// All bends of a sealed skin. O(facets).
std::vector<Bend> bends_of(const topology::Model& model, const SkinTurns& turns);

/// How much of a volume is left to cut: the total length of its bends, plus the length of those bends that a
/// sweep in the best direction does not follow [model length].
double length_to_cut(const std::vector<Bend>& bends);

/// A plane that may cut a volume into pieces that are easier to sweep.
struct CutPlane {
    geometry::Plane plane;
    std::vector<EdgeId> edges; ///< cut only regions of the plane that adjoin these edges; empty: all
};

/// Planes to cut a volume by, in this order:
/// 1. the planes of flat faces beside concave edges, only in the regions that adjoin these edges;
/// 2. the planes of flat rims of concave cylinders that go on in another bent face, in the regions that
/// adjoin the rim;
/// 3. planes through the axis of a concave cylinder and an edge where a flat face continues it, as beside a
/// fillet, only in the regions that adjoin this edge;
/// 4. planes midway between features (connected groups of bends) that reduce `length_to_cut()`, the best
/// first; their normals are those of flat faces and the common normals of two axes;
/// 5. planes through the axes of cylinders that cross each other, and of bores that leave through a bent
/// face, which divide a bore into two grooves.
/// @param most  largest number of planes between features.
std::vector<CutPlane> cut_planes(const topology::OpenVolume& volume, const std::vector<Bend>& bends,
                                 std::size_t most);

} // namespace lacuna::closure
