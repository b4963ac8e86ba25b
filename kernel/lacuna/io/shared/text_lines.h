// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/io/deck.h>

#include <array>
#include <string>
#include <vector>

namespace lacuna::io {

/// A line element that a deck keeps as text.
struct TextLine {
    DeckTag tag;
    std::array<DeckTag, 2> ends;
    std::string region; ///< "pid:7" in Nastran; otherwise empty, and sets of the deck contain the element
};

/// The trusses and beams in the text of an Abaqus or Nastran deck.
std::vector<TextLine> lines_in_text(const Deck& deck);

} // namespace lacuna::io
