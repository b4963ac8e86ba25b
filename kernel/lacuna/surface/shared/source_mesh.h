// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/mesh/quad_mesh.h>
#include <lacuna/quads/region.h>
#include <lacuna/surface/shared/seeds.h>
#include <lacuna/surface/shared/walls.h>

#include <map>
#include <span>
#include <string>
#include <vector>

namespace lacuna::surface {

/// Quads on all source faces together, followed by kept or generated triangles.
struct SourceMesh {
    /// Normals into the volume. The rim nodes come first, one linking surface after the other. `face` is the
    /// FaceId's index.
    mesh::QuadMesh quads;
    /// Rim nodes of each linking surface: node i of surface b is quad node first[b] + i.
    std::vector<LinkingNodes> links;
    std::vector<Index> first;                     ///< first quad node of each linking surface
    std::map<EdgeId, std::vector<Index>> on_edge; ///< quad nodes of each source edge, in its direction
    /// Positions of nodes of `on_edge` that differ from the seeds, as fractions of the edge's length.
    std::map<EdgeId, std::vector<double>> moved_on_edge;
    std::vector<std::string> notes; ///< a line per face: its method
};

/// Mesh the source faces with quads by their seeds.
///
/// Kept faces have their own quads, every node bit for bit. Mapped faces are meshed transfinitely in arc
/// length and projected onto the face. Free faces are flattened, filled by `mesher` and lifted back to the
/// exact surface. Nodes of edges and vertices are shared between faces. Finally poor quads are improved as
/// one mesh in space; nodes on edges between source faces may slide there, unless they are given.
/// @throw NotSweepable  a face that needs `mesher` if there is none, or that cannot be flattened; names it.
SourceMesh mesh_source(const topology::OpenVolume& volume, std::span<const LinkingSurface> links,
                       const Seeds& seeds, const SizeFields& sizes, const quads::PlanarQuadMesher& mesher,
                       const RunContext& context = {});

} // namespace lacuna::surface
