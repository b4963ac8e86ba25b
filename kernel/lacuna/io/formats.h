// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/io/deck.h>

#include <string>
#include <string_view>

namespace lacuna::io {

/// Whether a word is in a list of words with blanks between them.
inline bool has_word(std::string_view words, std::string_view word)
{
    return !word.empty() &&
           (" " + std::string(words) + " ").find(" " + std::string(word) + " ") != std::string::npos;
}

/// A file format and its capabilities, one row of the table of formats. To add a format, write its reader or
/// writer, its row in formats.cpp and its row in docs/reference.md.
struct Format {
    std::string_view ending; ///< file extension in lower case with its dot; for a folder its name: "polyMesh"
    std::string_view name;   ///< "an Abaqus deck"
    std::string_view word;   ///< "Abaqus": used in messages about features that the format lacks
    DeckFormat deck;         ///< type of the deck that is read; for writing, a mesh is converted to it
    bool is_read = false, is_written = false;
    bool is_mesh = true;    ///< holds cells, not only facets
    bool is_folder = false; ///< a folder of files

    /// The options of `mesh:write` that it supports, separated by blanks. If "with" is among them, meshes can
    /// be joined to decks.
    std::string_view options{};
    bool is_numbered = false;    ///< it is a deck: nodes and cells have numbers, and there are no fields
    bool streamed = false;       ///< layers can be written while they are created
    bool streamed_parts = false; ///< the same for several meshes with shared nodes

    /// How the format stores a group of the skin.
    enum class Skin { quads, nodes, nodes_and_sides };
    Skin skin = Skin::quads;
    bool has_lines = false, has_hex27 = false;
    /// Whether the format can hold cells of order 2 without thickness. This is so if the solver of the format
    /// accepts such cells, or if the format belongs to no solver.
    bool has_thin_order2 = true;
    bool numbers_regions = false; ///< users identify regions by property number
    /// Which kinds of sets of a deck it cannot store, and why; empty: it stores all.
    std::string_view unwritten_sets{};
    bool has_contacts = false; ///< pairs of `MeshDeckOptions::contacts` are written
    bool has_node_sets = true; ///< if false, sets contain sides only

    [[nodiscard]] bool has_option(std::string_view option) const { return has_word(options, option); }
};

/// The format of a path, by its file extension or the name of the folder; null: unknown.
const Format* find_format(const std::string& path);
/// The mesh format of a path. With `decks`, it must be a format in which decks can be written too.
/// @param call  name of the calling function, for the message.
/// @throw InvalidInput "lua.unknown_ending"  no such format; the message lists the known ones.
const Format& needed_mesh_format(const std::string& call, const std::string& path, bool decks = false);
/// The first format with this type of deck.
const Format& format_of(DeckFormat deck);
/// The file extensions of all formats for which `which` holds, separated by blanks.
std::string endings_of(bool (*which)(const Format&));

} // namespace lacuna::io
