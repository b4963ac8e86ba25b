// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/geometry/newell.h>
#include <lacuna/topology/model.h>

#include <compare>
#include <span>
#include <vector>

namespace lacuna::topology {

/// A place on a facet side: a point of the model, or one inside the side.
struct SectionPlace {
    Index a = -1;
    Index b = -1; ///< -1: the point `a` itself; otherwise on the side from `a` to `b`, a < b
    friend constexpr auto operator<=>(const SectionPlace&, const SectionPlace&) = default;
};

/// Coordinates of a place on a facet side. @pre  the plane crosses the side
Vec3 place_at(const Model& model, const SectionPlace& place, const geometry::Plane& plane);

/// A chain of places where a plane crosses facets. It is oriented as the boundary of the facets behind the
/// plane: these facets are on the left of the chain, seen from the side that they face.
struct SectionWalk {
    std::vector<SectionPlace> places; ///< the first is not repeated in a closed walk
    bool closed = false;
};

/// Intersection of a plane with the facets of some faces.
///
/// Points within the tolerance count as on the plane and are not moved. Facets in the plane count as behind
/// it if their normal agrees with the plane's, otherwise as in front: the walks then bound the part of the
/// plane inside the skin. Faces that the plane only touches have no walk.
/// @param tolerance  [model length], > 0.
/// @note  O(facets).
std::vector<SectionWalk> section_walks(const Model& model, const std::vector<FaceId>& faces,
                                       const geometry::Plane& plane, double tolerance);

/// Result of `imprint_walks()`.
struct WalkImprint {
    std::vector<std::vector<EdgeUse>> lines; ///< the edges of each walk, in its direction
    std::vector<FaceId> parent;              ///< for each face, the face that it was part of, or itself
};

/// Split the faces and edges of a model along walks of `section_walks()`.
///
/// Facets and edges are split where the walks cross them, edges get vertices there, and a face that falls
/// apart becomes several faces with the same tag and name. New points lie on the plane and on the exact
/// surface or curve, if there is one; new edges then have an exact curve. Given quads stay with their part.
/// @throw InvalidInput "topology.splits_mesh"  a walk crosses the given quads of a face; names the face.
/// @note  O(facets).
WalkImprint imprint_walks(ModelBuilder& model, std::span<const SectionWalk> walks,
                          const geometry::Plane& plane, double tolerance, const RunContext& context = {});

} // namespace lacuna::topology
