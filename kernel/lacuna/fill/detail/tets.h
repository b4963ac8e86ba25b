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
    bool alone = false;                           ///< it is the only volume, or a piece of that
    Message why;                                  ///< why it is not swept
    std::vector<surface::FixedFace> fixed;        ///< the meshes of its neighbours on shared faces
    const sweep::SharedMiddles& middles;          ///< at order 2: middle nodes of the meshes made before
};

/// The cells that a mesh has on its face `there`, as seen from the neighbour, whose face `own` is the same.
/// @param faces  face of each patch of the mesh
surface::FixedFace cells_on(const mesh::HexMesh& mesh, const std::vector<FaceId>& faces, FaceId there,
                            FaceId own);
surface::FixedFace cells_on(const FilledTets& mesh, FaceId there, FaceId own);

/// Fill a sealed volume with tetrahedra, and with pyramids on quads that are given.
///
/// Fixed faces, and faces that were given as meshes, keep their quads, triangles and nodes; the others are
/// triangulated at the size. The result is proved: conforming, every cell certified, its skin on the sealed
/// skin. Middle nodes of order 2 are added to a proved mesh of order 1, as `elevate()` of `tet_middles.h`.
/// @return  without `number`.
/// @throw InvalidInput "fill.no_tets"  the options have no mesher for tetrahedra. Or the errors of
///         `surface::triangulate_skin()`.
/// @throw NotSweepable "sweep.deviation"  the skin or the volume deviates. Or the proof fails, or the errors
///         of the mesher and of `elevate()`.
/// @throw Cancelled
FilledTets fill_with_tets(const ToFill& what, const sweep::SweepOptions& options, const RunContext& context);

/// Number the nodes of tetrahedra after those of the meshes before. A skin node at the same place as a skin
/// node of one of these meshes gets the number of that node.
/// @throw NotSweepable "fill.not_shared"  sides of skins that should be shared are not.
void number_nodes(FilledParts& mesh);

} // namespace lacuna::fill
