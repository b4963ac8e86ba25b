// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/io/detail/deck_writer.h>
#include <lacuna/io/detail/swept_view.h>
#include <lacuna/mesh/shared/mesh_view.h>

#include <functional>
#include <memory>

/// The writers of VTK files: XML, partitioned XML, and legacy. Internal to this folder.
namespace lacuna::io {

DeckFile vtu_file(const std::shared_ptr<const mesh::MeshView>& view);
DeckFile vtk_file(const std::shared_ptr<const mesh::MeshView>& view, bool binary);

/// Write the pieces "mesh_0.vtu", "mesh_1.vtu" … and "mesh.pvtu", which refers to them.
/// @param piece   makes the view of a piece, when that piece is written.
/// @param ghosts  rows of ghosts round each piece; 0: no ghosts are marked.
void write_pieces(std::size_t count, const std::function<PieceView(std::size_t)>& piece, int ghosts,
                  const OutputPath& path, const RunContext& context, const Team* team = nullptr);

} // namespace lacuna::io
