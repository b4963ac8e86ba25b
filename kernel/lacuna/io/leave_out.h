// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/io/deck.h>

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace lacuna::io {

/// A deck in two: what stays, and what was left out of it.
struct LeftOut {
    Deck kept; ///< its last notes say what was left out, counted, and which cards name some of it
    /// The elements left out, on all nodes of the deck, and the sets, as they were, that held some of them or
    /// of their nodes; without text. It is the last of `kept.gap.gone` too.
    std::shared_ptr<const Deck> gone;
};

/// Whether leave_out() finds a part of this name.
bool has_part(const Deck& deck, std::string_view name);
/// Numbers of a part's elements, rising; members of a set as it has them, some of which may not be there.
std::vector<DeckTag> cells_of_part(const Deck& deck, std::string_view name);
/// @throw InvalidInput "io.no_such_part" always; lists the parts that there are
[[noreturn]] void refuse_part(std::span<const Deck> decks, const std::string& name);

/// A deck without some of its parts: their elements, and the nodes that nothing else uses. All else stays,
/// numbers, order and text.
///
/// A part is a region, an element set, an instance or part of an Abaqus deck, in any capitals, or the number
/// of a property where the format has them. Elements that are text, and constraints and frames among the
/// cards, keep their nodes too. Sets lose the members that are left out. Regions and sets that lose all stay
/// without any in `Deck::gap`, so that a mesh called as they are can take their place.
/// @throw InvalidInput "io.no_such_part"  none is called so; lists those there are.
///                     "io.nothing_left"  they are all elements of the deck.
/// @note  O(n) but for finding sparse tags; a copy of the deck is made.
LeftOut leave_out(const Deck& deck, std::span<const std::string> parts);

/// Drop the sets that leave_out() emptied and that nothing has filled, with their sections in Abaqus decks. A
/// line `note: …` of the log names the sets that lost what no mesh has replaced.
void close_gap(Deck& deck, const RunContext& context = {});

} // namespace lacuna::io
