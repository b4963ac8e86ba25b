// SPDX-License-Identifier: MIT
#pragma once

// In: a sealed volume, its matched loops and sizes; out: quads on source and walls, or triangles on a skin.
//
// Where to change things:
//   quads on all source faces             source_mesh.cpp; inside one face: fill_face.cpp
//   numbers of sides: order of steps      seeds.cpp
//   numbers of sides: size and curvature  seed_edges.cpp; requests: sides_asked.cpp, intervals.cpp
//   numbers of sides: integer program     seed_program.cpp, over interval_program.cpp
//   numbers of sides: grids, parity       fit_grids.cpp, even_sides.cpp
//   which faces are mapped                face_grids.cpp; spacing on their sides: square_lines.cpp
//   size by default; reduced by shape     default_size.cpp, shape_size.cpp
//   walls between two loops               linking_surface.cpp; their map: linking_map.cpp
//   nodes and quads on walls              walls.cpp, strip_grid.cpp
//   edges inside walls                    wall_net.cpp, wall_breaks.cpp
//   rim nodes on coarse facets            rim_breaks.cpp
//   given meshes of walls and target      given_columns.cpp, given_wall.cpp, given_target.cpp
//   boundary layers                       boundary_layers.cpp
//   inner edges of the target             imprint.cpp, flat_ends.cpp, alike_ends.cpp
//   projection onto a face                projector.cpp
//   triangles of a skin                   skin_triangles.cpp, skin_remesher.cpp; their size: skin_size.cpp

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
    /// If a tube is the only source face: its rows of nodes from rim to rim, equally many in each row. Nodes
    /// with one index are on one grid line.
    std::vector<std::vector<Index>> rows;
    std::vector<std::string> notes; ///< for each face, a line that states the method
};

/// Mesh the source faces with quads, with the numbers of sides of the seeds.
///
/// - Kept faces have their given quads, every node bit for bit.
/// - Mapped faces get a grid by transfinite interpolation in arc length, projected onto the face.
/// - Tubes of facets have a grid by the harmonic map of a wall between their two loops (`mesh_walls()`).
/// - Free and submapped faces are flattened, filled by `mesher`, and mapped back to the exact surface.
///
/// Faces share nodes on common edges and vertices.
/// @throw NotSweepable  a face needs `mesher` but there is none, or a face cannot be flattened; names it.
SourceMesh mesh_source(const topology::OpenVolume& volume, std::span<const LinkingSurface> links,
                       const Seeds& seeds, const SizeFields& sizes, const quads::PlanarQuadMesher& mesher,
                       const RunContext& context = {});

} // namespace lacuna::surface
