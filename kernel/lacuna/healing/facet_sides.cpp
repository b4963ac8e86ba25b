// SPDX-License-Identifier: MIT
#include <lacuna/healing/detail/facet_sides.h>

#include <lacuna/core/shared/incidence.h>

#include <algorithm>
#include <utility>

namespace lacuna::healing {

FacetSides::FacetSides(std::span<const Triangle> facets, std::size_t points)
    : facets_(facets), segment_(3 * facets.size())
{
    // Group the sides by their lower point, then sort each group by the other point. Groups are small, so the
    // time is linear in the number of facets.
    const auto count = static_cast<Index>(segment_.size());
    Incidence lower = incidence(points, [&](const auto& visit) {
        for (Index s = 0; s < count; ++s) visit(index(std::min(from(s), to(s))), s);
    });
    sides_ = std::move(lower.items);
    for (std::size_t p = 0; p < points; ++p) {
        const auto begin = sides_.begin() + lower.begin[p], end = sides_.begin() + lower.begin[p + 1];
        const auto key = [&](Index s) { return std::pair(std::max(from(s), to(s)), s); };
        std::sort(begin, end, [&](Index a, Index b) { return key(a) < key(b); });
        Index last = -1;
        for (auto it = begin; it != end; ++it) {
            const Index other = std::max(from(*it), to(*it));
            if (other != last) first_.push_back(static_cast<Index>(it - sides_.begin()));
            last = other;
            segment_[index(*it)] = static_cast<Index>(first_.size()) - 1;
        }
    }
    first_.push_back(count);
}

} // namespace lacuna::healing
