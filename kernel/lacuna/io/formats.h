// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/io/deck.h>

#include <functional>
#include <span>
#include <string>
#include <string_view>

namespace lacuna::io {

/// What files of an ending are and can hold: a row of the one table of formats. To add a format, write its
/// reader or writer, its row in formats.cpp and its row in docs/reference.md.
struct Format {
    std::string_view ending; ///< in lower case with its dot; of a folder its name: "polyMesh"
    std::string_view name;   ///< "an Abaqus deck"
    std::string_view word;   ///< "Abaqus", for messages about what the format has not
    DeckFormat deck;         ///< what is read from it, and what meshes are made into to be written
    bool is_read = false, is_written = false;
    bool is_mesh = true;    ///< cells and not facets alone
    bool is_folder = false; ///< of files

    /// Of `mesh:write`, a blank between; "with": the mesh may be joined to decks.
    std::string_view options{};
    bool is_numbered = false;    ///< as decks: nodes and cells have numbers, there are no fields
    bool streamed = false;       ///< layers are written as they are made
    bool streamed_parts = false; ///< likewise of several meshes that have nodes in common

    /// What a group of the skin is.
    enum class Skin { quads, nodes, nodes_and_sides };
    Skin skin = Skin::quads;
    bool has_lines = false, has_hex20 = true, has_hex27 = false;
    bool numbers_regions = false;      ///< regions are properties that people know by their numbers
    std::string_view unwritten_sets{}; ///< sets of a deck that it has not, and why; empty: it has all
    bool has_node_sets = true;         ///< then these are of sides alone

    [[nodiscard]] bool has_option(std::string_view option) const
    {
        return (" " + std::string(options) + " ").find(" " + std::string(option) + " ") != std::string::npos;
    }
};

/// The format that the ending of a path, or the name of a folder, says; null: none.
const Format* find_format(const std::string& path);
/// The format of meshes that the path says; with `decks` one in which decks are written too.
/// @param call  for the message.
/// @throw InvalidInput "lua.unknown_ending"  none; lists them.
const Format& needed_mesh_format(const std::string& call, const std::string& path, bool decks = false);
/// The first format with these decks.
const Format& format_of(DeckFormat deck);
/// Endings of the formats for which `which` holds, a blank between.
std::string endings_of(bool (*which)(const Format&));

} // namespace lacuna::io
