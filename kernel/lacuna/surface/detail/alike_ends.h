// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/surface/shared/linking_surface.h>

#include <map>
#include <optional>
#include <span>
#include <vector>

namespace lacuna::surface {

/// vertices of the rims at which inner edges end, in pairs
struct AlikeEnds {
    std::vector<RimPair> pairs; ///< vertices of the rims at which inner edges end
    std::map<topology::EdgeUse, topology::EdgeUse>
        /// For each use of an inner edge by a source face, the use of the target's edge in the same
        /// direction.
        edges;
    std::map<FaceId, FaceId> faces; ///< target face of each source face
};

/// Match the faces of both ends as graphs, from the rims inwards. Empty if the ends are split differently.
/// O(edges of the ends).
std::optional<AlikeEnds> alike_ends(const topology::OpenVolume& volume,
                                    std::span<const LinkingSurface> links);

} // namespace lacuna::surface
