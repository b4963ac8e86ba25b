// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>

namespace lacuna {

/// Number of letters to change, add or remove to turn one word into the other (Levenshtein).
std::size_t edit_distance(const char* a, const char* b);

/// Index of the key with the smallest edit distance to `word`; of equal ones, the first. @pre there are keys
std::size_t nearest_word(const char* word, std::span<const char* const> keys);

} // namespace lacuna
