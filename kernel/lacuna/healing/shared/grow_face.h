// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/topology/model.h>

#include <span>
#include <vector>

namespace lacuna::healing {

struct GrowOptions {
    double angle = 20;         ///< growth does not cross sides that turn by more than this [degrees]
    double feature_angle = 40; ///< the edges of the grown face get vertices where they turn by more than this
                               ///< [degrees]
};

struct GrownFace {
    topology::Model model;
    FaceId face;             ///< the grown face, in `model`
    std::vector<FaceId> now; ///< for each face of the input, its index in `model`; invalid if growth took the
                             ///< whole face
};

/// Make one face of facets that are connected to the facet closest to `near`. Growth goes from facet to
/// facet, across sides that have exactly two facets and turn by at most `angle`. A given quad counts as one
/// facet.
///
/// Growth may take facets from other faces. The rest of such a face keeps the face's tag and its place in the
/// list of faces. If the rest has several parts, the part with the most facets keeps tag and place. The other
/// parts and the grown face come last, with new tags above all others. A face of which nothing is left is
/// removed. The grown face takes its name, groups and regions from the face of the first facet. If growth
/// takes exactly one existing face, the model is unchanged and that face is returned. Otherwise edges and
/// vertices are renumbered.
/// @param among  faces from which growth may take facets.
/// @throw InvalidInput "topology.bad_angle"   an angle outside (0, 180]. "healing.exact_faces"  a face has
///                     exact geometry, which cannot be cut into parts. "healing.nothing_to_grow"  `among` is
///                     empty.
/// @note  O(n log n) in the facets.
GrownFace grow_face(const topology::Model& model, const Vec3& near, std::span<const FaceId> among,
                    const GrowOptions& options = {}, const RunContext& context = {});

} // namespace lacuna::healing
