// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/io/detail/deck_writer.h>
#include <lacuna/mesh/shared/mesh_view.h>

#include <memory>

/// The writer of MSH files. Internal to this folder.
namespace lacuna::io {

/// @param options  without a partition.
/// @param parts    for version 4.1; null: the mesh is not divided.
/// @throw InvalidInput "io.number_taken"  a node or an element has the number 0.
DeckFile msh_file(const std::shared_ptr<const mesh::MeshView>& view, const DeckFileOptions& options,
                  const mesh::ViewParts* parts = nullptr);

} // namespace lacuna::io
