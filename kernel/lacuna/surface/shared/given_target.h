// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/surface/shared/given_nodes.h>
#include <lacuna/surface/shared/source_mesh.h>

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace lacuna::surface {

/// The given mesh of the target, in the node order of the source's mesh.
struct GivenTarget {
    /// The reason why the target's given quads are not kept; `nodes` and `face` are then empty. Empty if the
    /// quads are kept, or if the target has none.
    std::string why{};
    std::vector<Vec3> nodes{};  ///< target position of each source node, bit for bit as given
    std::vector<FaceId> face{}; ///< target face of each source quad
};

/// The given quads of the target, if they have the same connectivity as the source's quads. The linking
/// surfaces pair the rim nodes. Starting from the rims, each quad of the source is paired with the quad of
/// the target beyond the corresponding side.
/// @param wedges  whether triangles of the target are paired with triangles of the source.
/// @return  empty if the target has no given quads.
/// @note  O(quads).
GivenTarget given_target(const topology::OpenVolume& volume, std::span<const LinkingSurface> links,
                         const SourceMesh& source, bool wedges = false);

/// As `given_target()`, for one face of the target and the part of the source that is swept to this face.
/// @param quads   the part of the source
/// @param places  for each node of the part: its position on the target if it is on the rim of the part
/// @return  the position of each node. Empty if the face has no given quads, if these are connected
///          differently, or if a node of the rim is not a given one.
std::vector<Vec3> given_part(const topology::Model& model, FaceId face, const std::vector<Quad>& quads,
                             std::span<const std::optional<Vec3>> places);

/// Rotate loops so that the given quads of both ends correspond. A loop is rotated if its walls have neither
/// given columns nor side lines, so that they do not determine its rotation. Nothing is done unless both ends
/// have given quads with the same connectivity. Quads are paired starting from a loop whose rotation is
/// determined; without such a loop, nothing is done.
/// @param columns  given columns of each linking surface.
/// @note  O(quads of the ends); nothing is done if the walls fix the rotation of every loop.
std::vector<LinkingSurface> align_alike_ends(const topology::OpenVolume& volume,
                                             std::span<const GivenColumns> columns,
                                             std::vector<LinkingSurface> links, bool wedges = false);

} // namespace lacuna::surface
