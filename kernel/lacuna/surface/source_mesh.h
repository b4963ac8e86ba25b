// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/mesh/quad_mesh.h>
#include <lacuna/quads/region.h>
#include <lacuna/surface/seeds.h>
#include <lacuna/surface/walls.h>

#include <map>
#include <span>
#include <string>
#include <vector>

namespace lacuna::surface {

/// Quads on all source faces together, then triangles where such are kept or made.
struct SourceMesh {
    /// Normals into the volume. The rim nodes come first, one linking surface after the other. `face` is the
    /// FaceId's index.
    mesh::QuadMesh quads;
    /// Rim nodes of each linking surface: node i of surface b is quad node first[b] + i.
    std::vector<LinkingNodes> links;
    std::vector<Index> first;                     ///< first quad node of each linking surface
    std::map<EdgeId, std::vector<Index>> on_edge; ///< quad nodes of each source edge, as it runs
    /// Where nodes of `on_edge` stand, as fractions of the edge's length, if not where the seeds put them.
    std::map<EdgeId, std::vector<double>> moved_on_edge;
    std::vector<std::string> notes; ///< a line a face: how it was meshed
};

/// Mesh the source faces with quads by their seeds.
///
/// Kept faces have their own quads, every node bit for bit. Mapped faces are meshed transfinitely in arc
/// length and projected onto the face. Free faces are laid flat, filled by `mesher` and lifted back onto the
/// exact surface. Nodes of edges and vertices are shared between faces. Then poor quads are made better as
/// one mesh in space; nodes on edges between source faces may slide there, but for given ones.
/// @throw NotSweepable  a face that needs `mesher` and there is none, or that cannot be laid flat; names it.
SourceMesh mesh_source(const topology::OpenVolume& volume, std::span<const LinkingSurface> links,
                       const Seeds& seeds, const SizeFields& sizes, const quads::PlanarQuadMesher& mesher,
                       const RunContext& context = {});

} // namespace lacuna::surface
