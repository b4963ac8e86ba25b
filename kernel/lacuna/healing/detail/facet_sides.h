// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/types.h>

#include <cstddef>
#include <span>
#include <vector>

namespace lacuna::healing {

/// The sides of facets, grouped by segment. Side k of facet f runs from corner k to the next corner and has
/// the number 3·f + k. Segment: an undirected side, which several facets may share; segments are numbered in
/// the order of their points. Construction takes time linear in the number of facets.
class FacetSides {
public:
    /// @param facets  not copied; must outlive this object.
    /// @param points  number of points; every corner is in [0, points).
    FacetSides(std::span<const Triangle> facets, std::size_t points);

    [[nodiscard]] Index from(Index side) const { return facets_[index(side) / 3][index(side) % 3]; }
    [[nodiscard]] Index to(Index side) const { return facets_[index(side) / 3][(index(side) + 1) % 3]; }
    /// The point at the other end of a segment.
    [[nodiscard]] Index other_end(Index segment, Index point) const
    {
        const Index side = on(segment).front();
        return from(side) == point ? to(side) : from(side);
    }
    [[nodiscard]] Index segment(Index side) const { return segment_[index(side)]; }
    [[nodiscard]] std::size_t segment_count() const { return first_.size() - 1; }
    /// The sides on a segment, in the order of the facets.
    [[nodiscard]] std::span<const Index> on(Index segment) const
    {
        const auto begin = index(first_[index(segment)]);
        return std::span(sides_).subspan(begin, index(first_[index(segment) + 1]) - begin);
    }

private:
    std::span<const Triangle> facets_;
    std::vector<Index> segment_; ///< segment of each side
    std::vector<Index> sides_;   ///< all sides, grouped by segment
    std::vector<Index> first_;   ///< start of each segment's group in `sides_`, then the number of sides
};

} // namespace lacuna::healing
