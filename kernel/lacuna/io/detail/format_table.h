// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/io/deck_file.h>
#include <lacuna/io/detail/deck_writer.h>
#include <lacuna/io/formats.h>
#include <lacuna/mesh/shared/mesh_view.h>

#include <memory>
#include <span>
#include <string>
#include <string_view>

/// The formats with their readers and writers. Internal to this folder.
namespace lacuna::io {

class Cursor;
class DeckBuilder;

struct FormatRow : Format {
    void (*read)(Cursor&, DeckBuilder&) = nullptr;
    // At most one writer is set.
    DeckFile (*deck_file)(const Deck& deck, const LayeredBulk* layered) = nullptr;
    DeckFile (*view_file)(const std::shared_ptr<const mesh::MeshView>& view, const DeckFileOptions& options,
                          const mesh::ViewParts* parts) = nullptr;
    void (*view_folder)(const mesh::MeshView& view, const OutputPath& path,
                        const RunContext& context) = nullptr;
};
std::span<const FormatRow> format_table();
inline const FormatRow& row_of(const Format& format) { return static_cast<const FormatRow&>(format); }

/// The format for reading a file.
/// @param others  file extensions that other readers handle, for the message.
/// @throw InvalidInput "io.unknown_ending"
const FormatRow& needed_reader(const std::string& path, std::string_view others);

} // namespace lacuna::io
