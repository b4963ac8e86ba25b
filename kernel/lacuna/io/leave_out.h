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

/// A deck split in two: the rest, and the parts left out of it.
struct LeftOut {
    Deck kept; ///< its last notes count the omitted entities, and the cards that name some of them
    /// The elements left out, with all nodes of the deck, and the sets that held some of them or of their
    /// nodes, in their original state; without text. Also the last of `kept.gap.gone`.
    std::shared_ptr<const Deck> gone;
};

/// Whether the deck has a part of this name, as leave_out() finds them.
bool has_part(const Deck& deck, std::string_view name);
/// Element numbers of a part, increasing; for a set its members as given, some of which may not exist.
std::vector<DeckTag> cells_of_part(const Deck& deck, std::string_view name);
/// @throw InvalidInput "io.no_such_part" always; lists the existing parts
[[noreturn]] void refuse_part(std::span<const Deck> decks, const std::string& name);

/// Remove parts from a deck: their elements, and the nodes that nothing else uses. Everything else is
/// unchanged, including numbers, order and text.
///
/// A part is a region, an element set, an instance or part of an Abaqus deck, in any case, or the number of a
/// property if the format has them. Nodes also stay if they are used by elements that are kept as text, or by
/// cards of constraints or coordinate systems. Sets lose the removed members. Regions and sets that become
/// empty are recorded in `Deck::gap`, so that a mesh of the same name can replace them.
/// @throw InvalidInput "io.no_such_part"  no part has this name; lists the existing ones.
///                     "io.nothing_left"  the parts are all elements of the deck.
/// @note  O(n); O(n log n) if tags have large gaps. A copy of the deck is made.
LeftOut leave_out(const Deck& deck, std::span<const std::string> parts);

/// Drop the sets that leave_out() emptied and that were not refilled, with their sections in Abaqus decks. A
/// line `note: …` of the log names the sets with members that no mesh has replaced.
Deck close_gap(Deck deck, const RunContext& context = {});

} // namespace lacuna::io
