// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/io/deck.h>

#include <span>
#include <string>
#include <string_view>

/// Which endings are read. Internal to this folder.
namespace lacuna::io {

class Cursor;
class DeckBuilder;

struct DeckFileFormat {
    std::string_view ending, name;
    DeckFormat format;
    void (*read)(Cursor&, DeckBuilder&);
};
std::span<const DeckFileFormat> deck_file_formats();
/// Null where the ending is none of theirs. @param ending  in lower case, with its dot.
const DeckFileFormat* deck_file_format(std::string_view ending);
/// @param others  endings that somebody else reads, for the message.
/// @throw InvalidInput "io.unknown_ending"
const DeckFileFormat& needed_deck_format(const std::string& path, std::string_view others);

} // namespace lacuna::io
