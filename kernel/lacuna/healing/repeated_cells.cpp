// SPDX-License-Identifier: MIT
#include <lacuna/healing/detail/repeated_cells.h>

#include <lacuna/core/shared/incidence.h>

#include <algorithm>
#include <array>
#include <tuple>
#include <utility>

namespace lacuna::healing {

namespace {

template <std::size_t N>
std::vector<bool> repeated(std::span<const std::array<Index, N>> cells, std::span<const int> labels)
{
    if (cells.empty()) return {};
    // Bucket cells by their lowest corner, then sort each small bucket by the others.
    std::vector<std::array<Index, N>> sorted(cells.begin(), cells.end());
    Index most = -1;
    for (std::array<Index, N>& cell : sorted) {
        std::sort(cell.begin(), cell.end());
        most = std::max(most, cell.front());
    }
    Incidence at_lowest = incidence(index(most) + 1, [&](const auto& visit) {
        for (std::size_t c = 0; c < sorted.size(); ++c)
            visit(index(sorted[c].front()), static_cast<Index>(c));
    });
    const auto key = [&](Index c) {
        return std::tuple(sorted[index(c)], labels.empty() ? 0 : labels[index(c)]);
    };
    std::vector<bool> result(cells.size(), false);
    for (std::size_t p = 0; p < at_lowest.size(); ++p) {
        const auto heap =
            std::span(at_lowest.items).subspan(index(at_lowest.begin[p]), at_lowest.of(p).size());
        std::ranges::sort(heap, {}, [&](Index c) { return std::pair(key(c), c); });
        for (std::size_t i = 1; i < heap.size(); ++i)
            result[index(heap[i])] = key(heap[i]) == key(heap[i - 1]);
    }
    return result;
}

} // namespace

std::vector<bool> repeated_cells(std::span<const Triangle> cells, std::span<const int> labels)
{
    return repeated(cells, labels);
}

std::vector<bool> repeated_cells(std::span<const Quad> cells, std::span<const int> labels)
{
    return repeated(cells, labels);
}

} // namespace lacuna::healing
