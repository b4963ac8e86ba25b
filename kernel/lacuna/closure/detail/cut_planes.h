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
    /// For an edge: the length of the edge [model length]. For a cylinder: the length of the cylinder times
    /// the number of right angles by which it turns [model length]. If this number exceeds one, the product
    /// is multiplied by a factor between 0 (one right angle) and 1 (a full turn).
    double length = 0;
    /// Direction of the edge, or of the cylinder's axis. A sweep in this direction follows the bend, or has
    /// the bend in an end. Empty for other curved edges.
    std::optional<Vec3> axis;
};

/// All bends of a sealed skin. O(facets).
std::vector<Bend> bends_of(const topology::Model& model, const SkinTurns& turns);

/// How much of a volume is left to cut [model length]: the total length of its bends, plus the length of the
/// bends that are not parallel to the best sweep direction. The best direction is the axis to which the
/// greatest length of bends is parallel.
double length_to_cut(const std::vector<Bend>& bends);

/// Whether a face turns by more than a right angle, as a bore does and a fillet does not.
bool turns_as_bore(const topology::Model& model, FaceId face);

/// A plane that may cut a volume into pieces that are easier to sweep.
struct CutPlane {
    geometry::Plane plane;
    std::vector<EdgeId> edges; ///< only those regions of the plane that adjoin these edges are cut; empty:
                               ///< all regions
};

/// Planes to cut a volume by, in this order:
/// 1. the planes of flat faces beside concave edges; only regions of the plane that adjoin these edges are
///    cut;
/// 2. the planes of flat rims of concave cylinders beyond which another bent face follows; only regions that
///    adjoin the rim are cut;
/// 3. planes through the axis of a concave cylinder and a straight edge between the cylinder and a flat face,
///    such as an edge of a fillet; only regions that adjoin this edge are cut;
/// 4. planes midway between two features that reduce `length_to_cut()`, the best first (feature: bends whose
///    faces are the same or share edges). The normals of these planes are those of flat faces and the common
///    normals of two axes;
/// 5. planes through the axes of cylinders that cross each other, and of bores that leave through a bent
///    face or over an edge between flat faces. Such a plane divides a bore into two grooves;
/// 6. planes of concave edges that bend, such as those where pipes meet, and planes that bisect the angles at
///    two or more concave edges between flat faces, such as the plane through opposite edges of a square
///    window; only regions that adjoin these edges are cut.
/// @param most  largest number of planes between features.
std::vector<CutPlane> cut_planes(const topology::OpenVolume& volume, const std::vector<Bend>& bends,
                                 std::size_t most);

} // namespace lacuna::closure
