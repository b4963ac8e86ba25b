// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/mesh/shared/mesh_view.h>

#include <memory>
#include <vector>

/// Pieces of partitioned meshes. Internal to this folder.
namespace lacuna::io {

/// A piece of a mesh as a view of its own. The marks are 1 for points and cells that belong to other pieces,
/// else 0.
struct PieceView {
    std::shared_ptr<const mesh::MeshView> view;
    mesh::Runs ghost_points;
    std::vector<mesh::Runs> ghost_cells; ///< for each block, the mark of each cell
};

/// View one part with its ghosts. The ghosts are among the part's own cells, in the original order. Points
/// and cells keep their numbers of the whole view. Memory grows with the ranges of points and cells, not with
/// their number.
PieceView piece_of(const std::shared_ptr<const mesh::MeshView>& whole, const mesh::ViewParts& parts,
                   Index part);

} // namespace lacuna::io
