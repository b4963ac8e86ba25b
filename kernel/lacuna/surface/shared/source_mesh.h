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
    /// Quads with normals into the volume. The rim nodes come first, one linking surface after the other. The
    /// labels `face` are the indices of the source faces.
    mesh::QuadMesh quads;
    /// Rim nodes of each linking surface: node i of surface b is quad node first[b] + i.
    std::vector<LinkingNodes> links;
    std::vector<Index> first; ///< first quad node of each linking surface
    /// For each source edge, its quad nodes in the direction of the edge.
    std::map<EdgeId, std::vector<Index>> on_edge;
    std::vector<std::string> notes; ///< for each face, a line that states the method
};

/// Mesh the source faces with quads, with the numbers of sides of the seeds.
///
/// - Kept faces have their given quads, every node bit for bit.
/// - Mapped faces get a grid by transfinite interpolation in arc length, projected onto the face.
/// - Free and submapped faces are flattened, filled by `mesher`, and mapped back to the exact surface.
///
/// Faces share nodes on common edges and vertices.
/// @throw NotSweepable  a face needs `mesher` but there is none, or a face cannot be flattened; names it.
SourceMesh mesh_source(const topology::OpenVolume& volume, std::span<const LinkingSurface> links,
                       const Seeds& seeds, const SizeFields& sizes, const quads::PlanarQuadMesher& mesher,
                       const RunContext& context = {});

} // namespace lacuna::surface
