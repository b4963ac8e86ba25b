// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/message.h>
#include <lacuna/core/run_context.h>
#include <lacuna/fill/filled.h>
#include <lacuna/surface/shared/skin_triangles.h>
#include <lacuna/sweep/shared/shared_middles.h>
#include <lacuna/sweep/sweep.h>

#include <string>
#include <vector>

namespace lacuna::fill {

/// A sealed volume to be filled with tetrahedra.
struct ToFill {
    const topology::OpenVolume* volume = nullptr; ///< its roles do not matter
    std::string region;                           ///< its name
    std::string whole;                            ///< volume that it is a piece of; empty: none
    bool alone = false;                    ///< whether it is the only volume, or a piece of the only volume
    Message why;                           ///< why it is not swept
    std::vector<surface::FixedFace> fixed; ///< the meshes of its neighbours on shared faces
    const sweep::SharedMiddles& middles;   ///< at order 2: middle nodes of the meshes made before
};

/// The quads and triangles of a mesh on its face `there`, oriented for the neighbour, whose face `own` is the
/// same face.
/// @param faces  face of each patch of the mesh
surface::FixedFace cells_on(const mesh::HexMesh& mesh, const std::vector<FaceId>& faces, FaceId there,
                            FaceId own);
surface::FixedFace cells_on(const FilledTets& mesh, FaceId there, FaceId own);

/// Fill a sealed volume with tetrahedra, and with pyramids on quads that are given.
///
/// Fixed faces, and faces that were given as meshes, keep their quads, triangles and nodes; the other faces
/// are triangulated at the requested size. The result is proved: it is conforming, every cell is certified
/// valid, and its skin lies on the sealed skin. At order 2, `elevate()` adds middle nodes to the proved mesh
/// of order 1.
/// @return  the mesh; its `number` is still empty.
/// @throw InvalidInput "fill.no_tets"  the options have no mesher for tetrahedra. Or the errors of
///         `surface::triangulate_skin()`.
/// @throw NotSweepable "sweep.deviation"  the skin deviates from the sealed skin; "sweep.volume"  the volume
///         deviates; the finding of the proof; or the errors of the mesher and of `elevate()`.
/// @throw Cancelled
FilledTets fill_with_tets(const ToFill& what, const sweep::SweepOptions& options, const RunContext& context);

/// Number the nodes of tetrahedra after the nodes of the meshes before them. A skin node at the same place as
/// a skin node of one of these meshes gets the number of that node.
/// @throw NotSweepable "fill.not_shared"  two meshes do not have the same sides on a face that they share.
void number_nodes(FilledParts& mesh);

} // namespace lacuna::fill
