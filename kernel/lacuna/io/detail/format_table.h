// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/io/detail/deck_writer.h>
#include <lacuna/io/formats.h>
#include <lacuna/io/mesh_file.h>
#include <lacuna/mesh/shared/mesh_view.h>

#include <span>
#include <string>
#include <string_view>

/// The formats with their readers and writers. Internal to this folder.
namespace lacuna::io {

class Cursor;
class DeckBuilder;

/// The writer of a file, one for each format. It writes a view, which may show a swept mesh, a deck, or a
/// mesh that is created during writing. @param parts  for .msh 4.1; null: the mesh is not divided
using WriteView = DeckFile(const View& view, const MeshFileOptions& options, const mesh::ViewParts* parts);
WriteView abaqus_file, dyna_file, exodus_file, febio_file, med_file, msh_file, nastran_file, unv_file,
    vtk_file, vtu_file;

struct FormatRow : Format {
    void (*read)(Cursor&, DeckBuilder&) = nullptr;
    WriteView* write = nullptr;
    void (*write_folder)(const mesh::MeshView& view, const OutputPath& path,
                         const RunContext& context) = nullptr; ///< writer of a folder
    bool omits_middles = false; ///< elements may lack some of their middle nodes
};
std::span<const FormatRow> format_table();
inline const FormatRow& row_of(const Format& format) { return static_cast<const FormatRow&>(format); }

/// The format for reading a file.
/// @param others  file extensions of other readers, for the message.
/// @throw InvalidInput "io.unknown_ending"
const FormatRow& needed_reader(const std::string& path, std::string_view others);

/// Write the parts as pieces "mesh_0.vtu", "mesh_1.vtu" …, and the file "mesh.pvtu", which refers to them.
/// The view of a piece is made when that piece is written.
/// @param ghosts  number of rows of ghosts around each piece; 0: no ghosts are marked.
void write_pieces(const View& view, const mesh::ViewParts& parts, int ghosts, const OutputPath& path,
                  const RunContext& context, const Team* team = nullptr);

} // namespace lacuna::io
