// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/types.h>

#include <algorithm>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

namespace lacuna {

/// The corners of a cell in increasing order, as a key for cells with the same corners.
template <std::size_t N>
std::array<Index, N> rising(std::array<Index, N> corners)
{
    std::ranges::sort(corners);
    return corners;
}

/// Key of a quad or of a triangle {a, b, c, c}: its corners in increasing order. For a triangle, -1 stands
/// for the missing corner.
inline Quad face_key(Quad face)
{
    if (face[2] == face[3]) face[3] = -1;
    return rising(face);
}

/// A cell in a group of cells that have the same lowest corner.
struct NumberedCell {
    std::array<Index, 3> others; ///< the other corners, ascending; -1 for missing ones
    std::uint64_t number;
    friend auto operator<=>(const NumberedCell&, const NumberedCell&) = default;
};

/// Group the cells that have the same corners in any order. Call `take(cells)` for each group; the numbers of
/// its cells increase. Groups are visited in the order of their lowest corners. The cost is linear in the
/// cells, except for sorting the cells that share a lowest corner.
/// @param points  corners are in [0, points).
/// @param each    `each(visit)` calls `visit(corners, number)` for every cell, where -1 stands for a missing
///                corner. It is called twice and must visit the same cells both times.
template <class Each, class Take>
void each_with_same_corners(std::size_t points, const Each& each, const Take& take)
{
    const auto lowest_first = [](Quad corners) {
        std::sort(corners.begin(), corners.end());
        for (std::size_t k = 0; corners[0] < 0; ++k) std::swap(corners[0], corners[k]);
        return corners;
    };
    std::vector<std::uint64_t> start(points + 1, 0);
    each([&](const Quad& corners, std::uint64_t) { ++start[index(lowest_first(corners)[0]) + 1]; });
    std::partial_sum(start.begin(), start.end(), start.begin());
    std::vector<NumberedCell> all(start.back());
    std::vector<std::uint64_t> next(start.begin(), start.end() - 1);
    each([&](const Quad& corners, std::uint64_t number) {
        const auto [lowest, a, b, c] = lowest_first(corners);
        all[next[index(lowest)]++] = {{a, b, c}, number};
    });
    for (std::size_t p = 0; p < points; ++p) {
        const auto here = std::span(all).subspan(start[p], start[p + 1] - start[p]);
        std::sort(here.begin(), here.end());
        for (std::size_t begin = 0, end = 0; begin < here.size(); begin = end) {
            while (end < here.size() && here[end].others == here[begin].others) ++end;
            take(std::span<const NumberedCell>(here.subspan(begin, end - begin)));
        }
    }
}

} // namespace lacuna
