// SPDX-License-Identifier: MIT
#include <lacuna/core/shared/constants.h>
#include <lacuna/surface/detail/paired_breaks.h>

#include <algorithm>
#include <cmath>

namespace lacuna::surface {

namespace {

/// @param alone  cost of an unpaired break, as a share of the length.
BreakPairs paired(const std::vector<double>& a, const std::vector<double>& b, double alone, bool in_order)
{
    const std::size_t n = a.size(), m = b.size();
    std::vector<std::vector<double>> cost(n + 1, std::vector<double>(m + 1, 0));
    // With `in_order`, the distance between the two breaks of a pair costs nothing.
    const auto cost_paired = [&](std::size_t i, std::size_t j) {
        return cost[i - 1][j - 1] + (in_order ? 0.0 : 1.0) * std::abs(a[i - 1] - b[j - 1]);
    };
    for (std::size_t i = 0; i <= n; ++i) {
        for (std::size_t j = 0; j <= m; ++j) {
            if (i == 0 && j == 0) continue;
            double best = kInfinity;
            if (i > 0) best = std::min(best, cost[i - 1][j] + alone);
            if (j > 0) best = std::min(best, cost[i][j - 1] + alone);
            if (i > 0 && j > 0) best = std::min(best, cost_paired(i, j));
            cost[i][j] = best;
        }
    }
    BreakPairs result;
    for (std::size_t i = n, j = m; i > 0 || j > 0;) {
        if (i > 0 && j > 0 && cost[i][j] == cost_paired(i, j)) {
            result.emplace_back(a[--i], b[--j]);
        } else if (i > 0 && cost[i][j] == cost[i - 1][j] + alone) {
            result.emplace_back(a[--i], -1);
        } else {
            result.emplace_back(-1, b[--j]);
        }
    }
    std::ranges::reverse(result);
    return result;
}

} // namespace

BreakPairs paired_breaks(const std::vector<double>& a, const std::vector<double>& b, Pairing pairing)
{
    // Cost of an unpaired break. Two breaks are paired if they are closer to each other than twice this, as a
    // share of the segment's length. Heuristic.
    const double alone = pairing == Pairing::in_order ? 0.1 : 0.02;
    return paired(a, b, alone, a.size() == b.size() && pairing == Pairing::in_order);
}

BreakPairs paired_breaks(const std::vector<double>& a, const std::vector<double>& b, double apart)
{
    return paired(a, b, apart / 2, false);
}

void complete(BreakPairs& breaks)
{
    BreakPairs anchors{{0, 0}};
    for (const auto& pair : breaks) {
        if (pair.first >= 0 && pair.second >= 0) anchors.push_back(pair);
    }
    anchors.emplace_back(1, 1);
    std::size_t k = 0;
    for (auto& [a, b] : breaks) {
        if (a >= 0 && b >= 0) {
            ++k;
            continue;
        }
        const auto& [a0, b0] = anchors[k];
        const auto& [a1, b1] = anchors[k + 1];
        if (a < 0)
            a = a0 + (a1 - a0) * (b - b0) / (b1 - b0);
        else
            b = b0 + (b1 - b0) * (a - a0) / (a1 - a0);
    }
    std::ranges::sort(breaks);
}

} // namespace lacuna::surface
