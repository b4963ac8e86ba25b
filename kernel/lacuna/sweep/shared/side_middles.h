// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/topology/model.h>

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace lacuna::sweep {

/// A side of a mesh's skin whose middle node is to be placed on geometry.
struct SideOfSkin {
    Vec3 from, to;
    Vec3 near;          ///< where the middle is expected
    FaceId face, other; ///< faces of the model on the two sides of it
};

/// Numbers of middle nodes of the skin, by their origin: given, on exact geometry, or on facets.
struct SkinCounts {
    std::size_t given = 0, exact = 0, facets = 0;
};

/// Place the middles of sides that lie on edges of a model, halfway along the edge; other entries are empty.
/// If a side is straight up to rounding, its middle is exactly the mean of its ends. This also holds for
/// `middles_on_faces()`.
std::vector<std::optional<Vec3>> middles_on_edges(const topology::Model& model,
                                                  std::span<const SideOfSkin> sides, SkinCounts& counts,
                                                  const RunContext& context = {});

/// Move the middles of sides onto the exact surface of their face or, if both ends of a side lie on the
/// face's facets, onto the facets. Other entries are empty.
std::vector<std::optional<Vec3>> middles_on_faces(const topology::Model& model,
                                                  std::span<const SideOfSkin> sides, SkinCounts& counts,
                                                  const RunContext& context = {});

} // namespace lacuna::sweep
