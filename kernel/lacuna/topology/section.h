// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/geometry/newell.h>
#include <lacuna/topology/model.h>

#include <compare>
#include <span>
#include <vector>

namespace lacuna::topology {

/// A place on the sides of facets: a point of the model, or one within a side.
struct SectionPlace {
    Index a = -1;
    Index b = -1; ///< -1: the point `a` itself; else the side from `a` to `b`, a < b
    friend constexpr auto operator<=>(const SectionPlace&, const SectionPlace&) = default;
};

/// A walk over the facets along which a plane crosses them. It runs as the facets behind the plane would be
/// bounded by it: they are on its left, seen from where the facets face.
struct SectionWalk {
    std::vector<SectionPlace> places; ///< the first not repeated where it is closed
    bool closed = false;
};

/// Where a plane crosses the facets of some faces.
///
/// Points within the tolerance count as on the plane and stay where they are. Facets in the plane lie behind
/// it where they face along its normal, before it where they face against it: then the walks bound what of
/// the plane is within the skin. Faces the plane only touches have no walk.
/// @param tolerance  [model length], > 0.
/// @note  O(facets).
std::vector<SectionWalk> section_walks(const Model& model, const std::vector<FaceId>& faces,
                                       const geometry::Plane& plane, double tolerance);

/// What `imprint_walks()` made of a model.
struct WalkImprint {
    std::vector<std::vector<EdgeUse>> lines; ///< the edges of each walk, as it runs
    std::vector<FaceId> parent; ///< of each face: the one it was part of, itself where it was not split
};

/// Split the faces and edges of a model along walks of `section_walks()`.
///
/// Facets and edges are cut where the walks cross them, edges get vertices there, and faces that fall apart
/// become several with the same tag and name. New points lie on the plane, and on the exact surface or curve
/// where there is one; new edges have a curve there. Given quads go with the part they are of.
/// @throw InvalidInput "topology.splits_mesh"  a walk through quads that a face came with; names the face.
/// @note  O(facets).
WalkImprint imprint_walks(Model& model, std::span<const SectionWalk> walks, const geometry::Plane& plane,
                          double tolerance, const RunContext& context = {});

} // namespace lacuna::topology
