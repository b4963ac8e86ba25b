// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/mesh/quad_mesh.h>
#include <lacuna/quads/region.h>
#include <lacuna/surface/seeds.h>
#include <lacuna/surface/walls.h>

#include <span>
#include <string>
#include <vector>

namespace lacuna::surface {

/// Quads on all source faces together.
struct SourceMesh {
    mesh::QuadMesh
        quads; ///< normals into the volume; the rim nodes come first, linking surface by linking surface; `face` is the FaceId's index
    std::vector<LinkingNodes>
        links; ///< of each linking surface; node i of linking surface b is quad node first[b] + i
    std::vector<Index> first;       ///< first quad node of each linking surface
    std::vector<std::string> notes; ///< a line a face: how it was meshed
};

/// Mesh the source faces with quads by their seeds.
///
/// Kept faces: their own quads, every node bit for bit. Mapped faces: transfinite in arc length, then onto the face. Free ones: the face is laid flat, filled by `mesher` and lifted back onto
/// its exact surface. Nodes of edges and vertices are shared between faces.
/// @throw NotSweepable  a face that needs `mesher` and there is none, or that cannot be laid flat; names it.
SourceMesh mesh_source(const topology::OpenVolume& volume, std::span<const LinkingSurface> links,
                       const Seeds& seeds, const SizeFields& sizes, const quads::PlanarQuadMesher& mesher,
                       const RunContext& context = {});

} // namespace lacuna::surface
