// SPDX-License-Identifier: MIT
#include <lacuna/core/shared/nearest_word.h>

#include <algorithm>
#include <cstring>
#include <numeric>
#include <vector>

namespace lacuna {

std::size_t edit_distance(const char* a, const char* b)
{
    const std::size_t m = std::strlen(a), n = std::strlen(b);
    std::vector<std::size_t> row(n + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 1; i <= m; ++i) {
        std::size_t diagonal = row[0];
        row[0] = i;
        for (std::size_t j = 1; j <= n; ++j) {
            const std::size_t change = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
            diagonal = row[j];
            row[j] = std::min({row[j] + 1, row[j - 1] + 1, change});
        }
    }
    return row[n];
}

std::size_t nearest_word(const char* word, std::span<const char* const> keys)
{
    std::size_t best = 0;
    for (std::size_t i = 1; i < keys.size(); ++i)
        if (edit_distance(word, keys[i]) < edit_distance(word, keys[best])) best = i;
    return best;
}

} // namespace lacuna
