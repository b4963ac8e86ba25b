// SPDX-License-Identifier: MIT
#include <lacuna/core/shared/nearest_word.h>

#include <algorithm>
#include <array>
#include <cstring>

namespace lacuna {

std::size_t edit_distance(const char* a, const char* b)
{
    // Letters beyond this length are not compared. Only the difference between the lengths of the two words
    // counts.
    constexpr std::size_t kLongest = 63;
    const std::size_t m = std::min(std::strlen(a), kLongest), n = std::min(std::strlen(b), kLongest);
    std::array<std::size_t, kLongest + 1> row{};
    for (std::size_t j = 0; j <= n; ++j) row[j] = j;
    for (std::size_t i = 1; i <= m; ++i) {
        std::size_t diagonal = row[0];
        row[0] = i;
        for (std::size_t j = 1; j <= n; ++j) {
            const std::size_t change = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
            diagonal = row[j];
            row[j] = std::min({row[j] + 1, row[j - 1] + 1, change});
        }
    }
    const std::size_t rest_a = std::strlen(a) - m, rest_b = std::strlen(b) - n;
    return row[n] + std::max(rest_a, rest_b) - std::min(rest_a, rest_b);
}

std::size_t nearest_word(const char* word, std::span<const char* const> keys)
{
    std::size_t best = 0;
    for (std::size_t i = 1; i < keys.size(); ++i)
        if (edit_distance(word, keys[i]) < edit_distance(word, keys[best])) best = i;
    return best;
}

} // namespace lacuna
