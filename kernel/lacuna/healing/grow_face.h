// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/topology/model.h>

#include <span>
#include <vector>

namespace lacuna::healing {

struct GrowOptions {
    double angle = 20;         ///< facets that meet at a sharper turn are not grown over [degrees]
    double feature_angle = 40; ///< where the new edges have vertices [degrees]
};

struct GrownFace {
    topology::Model model;
    FaceId face;             ///< the one that was grown, in `model`
    std::vector<FaceId> now; ///< of each face there was before the one it is; not valid: all of it was grown
};

/// Make a face of the facets that hang together with the one closest to a place, over sides at which no more
/// than two facets meet and turn by no more than the angle; a given quad is one facet.
///
/// Facets of other faces are taken along. What is left of a face keeps its tag and its place among the faces,
/// in several parts the one of most facets does; the other parts and the grown face get tags above all and
/// follow the rest. A face grown whole is no more. The grown face has name, groups and regions of the face it
/// begins in. Where what was grown is a face as it is, nothing changes but that face is told. Edges and
/// vertices are numbered anew.
/// @param among  faces that may be grown over.
/// @throw InvalidInput "topology.bad_angle"   an angle outside (0, 180].
///                     "healing.exact_faces"  a face has exact geometry, which parts of it would not have.
///                     "healing.nothing_to_grow"  `among` is empty.
/// @note  O(n log n) in the facets.
GrownFace grow_face(const topology::Model& model, const Vec3& near, std::span<const FaceId> among,
                    const GrowOptions& options = {}, const RunContext& context = {});

} // namespace lacuna::healing
