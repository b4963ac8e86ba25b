// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/io/detail/deck_writer.h>
#include <lacuna/mesh/shared/mesh_view.h>

#include <memory>

/// The writers of VTK files: XML, partitioned XML, and legacy. Internal to this folder.
namespace lacuna::io {

DeckFile vtu_file(const std::shared_ptr<const mesh::MeshView>& view);
DeckFile vtk_file(const std::shared_ptr<const mesh::MeshView>& view, bool binary);

/// Write the parts as pieces "mesh_0.vtu", "mesh_1.vtu" … and "mesh.pvtu", which refers to them. The view of
/// a piece is made when that piece is written.
/// @param ghosts  rows of ghosts round each piece; 0: no ghosts are marked.
void write_pieces(const std::shared_ptr<const mesh::MeshView>& view, const mesh::ViewParts& parts, int ghosts,
                  const OutputPath& path, const RunContext& context, const Team* team = nullptr);

} // namespace lacuna::io
