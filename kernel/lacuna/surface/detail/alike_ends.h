// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/surface/shared/linking_surface.h>

#include <map>
#include <optional>
#include <span>
#include <vector>

namespace lacuna::surface {

/// The correspondence of two ends whose faces are split in the same way.
struct AlikeEnds {
    std::vector<RimPair> pairs; ///< vertices of both rims at which inner edges end
    std::map<topology::EdgeUse, topology::EdgeUse>
        /// For each use of an inner edge by a source face: the corresponding target edge, with the direction
        /// that corresponds to the direction of this use.
        edges;
    std::map<FaceId, FaceId> faces; ///< target face of each source face
};

/// Match the faces, edges and vertices of both ends by their connectivity, starting from the rims. Empty if
/// the ends are split differently. O(edges of the ends).
std::optional<AlikeEnds> alike_ends(const topology::OpenVolume& volume,
                                    std::span<const LinkingSurface> links);

} // namespace lacuna::surface
