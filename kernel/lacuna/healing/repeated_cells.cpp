// SPDX-License-Identifier: MIT
#include <lacuna/healing/detail/repeated_cells.h>

#include <algorithm>
#include <array>
#include <numeric>

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
    std::vector<Index> start(index(most) + 2, 0);
    for (const auto& cell : sorted) ++start[index(cell.front()) + 1];
    std::partial_sum(start.begin(), start.end(), start.begin());
    std::vector<Index> order(cells.size());
    std::vector<Index> fill(start.begin(), start.end() - 1);
    for (std::size_t c = 0; c < sorted.size(); ++c)
        order[index(fill[index(sorted[c].front())]++)] = static_cast<Index>(c);
    const auto alike = [&](Index a, Index b) {
        return sorted[index(a)] == sorted[index(b)] &&
               (labels.empty() || labels[index(a)] == labels[index(b)]);
    };
    const auto before = [&](Index a, Index b) {
        if (sorted[index(a)] != sorted[index(b)]) return sorted[index(a)] < sorted[index(b)];
        if (!labels.empty() && labels[index(a)] != labels[index(b)])
            return labels[index(a)] < labels[index(b)];
        return a < b;
    };
    std::vector<bool> result(cells.size(), false);
    for (std::size_t p = 0; p + 1 < start.size(); ++p) {
        const auto heap = std::span(order).subspan(index(start[p]), index(start[p + 1] - start[p]));
        std::sort(heap.begin(), heap.end(), before);
        for (std::size_t i = 1; i < heap.size(); ++i) result[index(heap[i])] = alike(heap[i], heap[i - 1]);
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
