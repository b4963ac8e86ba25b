// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/io/deck.h>

#include <string>

namespace lacuna::io {

/// Whether the cards of a deck define a material, by its name or number.
bool has_material(const Deck& deck, const std::string& material);

/// "the materials STEEL, FOAM", or "no materials": those that the cards of a deck define.
std::string materials_in_words(const Deck& deck);

} // namespace lacuna::io
