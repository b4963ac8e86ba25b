// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/geometry/newell.h>
#include <lacuna/topology/model.h>

#include <compare>
#include <cstdint>
#include <span>
#include <unordered_set>
#include <vector>

namespace lacuna::topology {

/// A place where a plane meets a facet side: the point `a` of the model, or a point inside the side.
struct SectionPlace {
    Index a = -1;
    Index b = -1; ///< -1: the place is the point `a`; otherwise it is inside the side from `a` to `b`, a < b
    friend constexpr auto operator<=>(const SectionPlace&, const SectionPlace&) = default;
};

/// Coordinates of a place on a facet side. @pre  the plane crosses the side
Vec3 place_at(const Model& model, const SectionPlace& place, const geometry::Plane& plane);

/// A chain of places along which a plane crosses facets. The facets behind the plane (on the side opposite to
/// its normal) are on the left of the chain, seen from outside.
struct SectionWalk {
    std::vector<SectionPlace> places; ///< the first is not repeated in a closed walk
    bool closed = false;
};

/// Intersection of a plane with the facets of some faces.
///
/// Points within the tolerance count as on the plane and are not moved. A facet in the plane counts as behind
/// the plane if its normal has the direction of the plane's normal, otherwise as in front of it. The walks
/// then bound the part of the plane inside the skin. Faces that the plane only touches have no walk.
/// @param tolerance  [model length], > 0.
/// @note  O(facets).
std::vector<SectionWalk> section_walks(const Model& model, const std::vector<FaceId>& faces,
                                       const geometry::Plane& plane, double tolerance);

/// The parts into which a face falls along some sides of its facets (`edge_key()`), with their given quads.
/// @param points  number of points of the model
std::vector<Face> parts_along(const Face& whole, const std::unordered_set<std::uint64_t>& lines,
                              std::size_t points);

/// Result of `imprint_walks()`.
struct WalkImprint {
    std::vector<std::vector<EdgeUse>> lines; ///< the edges of each walk, in its direction
    std::vector<FaceId> parent;              ///< for each face, the face that it was part of, or itself
};

/// Split the faces and edges of a model along walks of `section_walks()`.
///
/// Facets and edges are split where the walks cross them, and edges get vertices there. A face that falls
/// apart becomes several faces with the same tag and name; each keeps its given quads. New points lie on the
/// plane and, if there is one, on the exact surface or curve. New edges on an exact surface get an exact
/// curve.
/// @throw InvalidInput "topology.splits_mesh"  a walk crosses the given quads of a face; names the face.
/// @note  O(facets).
WalkImprint imprint_walks(ModelBuilder& model, std::span<const SectionWalk> walks,
                          const geometry::Plane& plane, double tolerance, const RunContext& context = {});

} // namespace lacuna::topology
