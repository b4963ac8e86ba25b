// SPDX-License-Identifier: MIT
#include <lacuna/quads/pattern_counts.h>

#include <lacuna/quads/detail/mirror_counts.h>
#include <lacuna/quads/detail/ring_counts.h>
#include <lacuna/quads/detail/segment_symmetry.h>
#include <lacuna/quads/detail/star_counts.h>
#include <lacuna/quads/detail/straight_counts.h>

namespace lacuna::quads {

std::optional<std::vector<int>> pattern_counts(const PlanarRegion& region, std::span<const int> segment,
                                               std::span<const BoundarySegment> segments)
{
    const CountTask task(region, segment, segments);
    auto ring = ring_counts(task);
    if (ring && are_alike(*ring, mirrored_segments(region, segment))) return ring;
    auto mirrored = mirror_counts(task);
    if (mirrored && mirrored->is_grid) return std::move(mirrored->sides);
    if (auto star = star_counts(task)) return star;
    if (mirrored) return std::move(mirrored->sides);
    if (ring) return ring;
    auto counts = straight_counts(task);
    if (!counts) return std::nullopt;
    return std::move(counts->sides);
}

} // namespace lacuna::quads
