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

/// A deck split in two: what remains, and what was left out.
struct LeftOut {
    Deck kept; ///< its last notes count the elements and nodes left out, and cards that name them
    /// The elements left out, with all nodes of the deck but without text. Sets that contained some of these
    /// elements or of their nodes are as they were before. The same object as the last of `kept.gap.gone`.
    std::shared_ptr<const Deck> gone;
};

/// Whether leave_out() would find a part of this name in the deck.
bool has_part(const Deck& deck, std::string_view name);
/// Element numbers of a part, increasing. For a set these are its members as given, some of which may not
/// exist.
std::vector<DeckTag> cells_of_part(const Deck& deck, std::string_view name);
/// @throw InvalidInput "io.no_such_part" always; lists the existing parts
[[noreturn]] void refuse_part(std::span<const Deck> decks, const std::string& name);

/// Remove parts from a deck: their elements, and the nodes that nothing else uses. Everything else is
/// unchanged, including numbers, order and text.
///
/// A part is a region, an element set, or an instance or part of an Abaqus deck, named in upper or lower
/// case. In formats with properties, a part may also be the number of a property. Nodes also stay if they are
/// used by elements that are kept as text, or by cards of constraints or coordinate systems. Sets lose the
/// removed members. `Deck::gap` records regions and sets that become empty, so that a mesh of the same name
/// can replace them.
/// @throw InvalidInput "io.no_such_part"  no part has this name; lists the existing ones.
///                     "io.nothing_left"  the parts contain all elements of the deck.
/// @note  O(n); O(n log n) if tags have large gaps. A copy of the deck is made.
LeftOut leave_out(const Deck& deck, std::span<const std::string> parts);

/// Drop the sets that leave_out() emptied and that no mesh has refilled, and their sections in Abaqus decks.
/// A line `note: …` of the log names the sets with members that were not replaced.
Deck close_gap(Deck deck, const RunContext& context = {});

} // namespace lacuna::io
