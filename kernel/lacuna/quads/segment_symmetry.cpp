// SPDX-License-Identifier: MIT
#include <lacuna/quads/detail/segment_symmetry.h>

#include <lacuna/core/shared/constants.h>

#include <algorithm>
#include <optional>
#include <utility>

namespace lacuna::quads {
namespace {

/// For each segment, its image; a segment without sides is its own image. Empty if a segment has several
/// images.
std::optional<std::vector<std::size_t>> images_of(const PlanarRegion& region, std::span<const int> segment,
                                                  std::size_t count, const Symmetry& symmetry)
{
    const auto of = [&](Index p) { return index(segment[index(p)]); };
    std::vector<std::size_t> onto(count, kNoIndex), from(count, kNoIndex);
    for (const auto& loop : region.loops) {
        for (std::size_t i = 0, n = loop.size(); i < n; ++i) {
            // A reflection reverses the direction, so it maps the end of the side to the start of the image.
            const Index start = symmetry.map.mirrors ? loop[(i + 1) % n] : loop[i];
            const std::size_t own = of(loop[i]), image = of(symmetry.to[index(start)]);
            if ((onto[own] != kNoIndex && onto[own] != image) ||
                (from[image] != kNoIndex && from[image] != own))
                return std::nullopt;
            onto[own] = image;
            from[image] = own;
        }
    }
    for (std::size_t s = 0; s < count; ++s) {
        if (onto[s] == kNoIndex) onto[s] = s;
    }
    return onto;
}

/// The first node of each loop that consists of one segment.
std::vector<Index> starts_of_whole_loops(const PlanarRegion& region, std::span<const int> segment)
{
    std::vector<Index> starts;
    for (const auto& loop : region.loops) {
        const int own = segment[index(loop.front())];
        if (std::ranges::all_of(loop, [&](Index p) { return segment[index(p)] == own; }))
            starts.push_back(loop.front());
    }
    return starts;
}

} // namespace

std::size_t segment_count(std::span<const int> segment)
{
    return segment.empty() ? 0 : static_cast<std::size_t>(std::ranges::max(segment)) + 1;
}

std::vector<SegmentSymmetry> segment_symmetries(const PlanarRegion& region, std::span<const int> segment)
{
    const std::size_t count = segment_count(segment);
    std::vector<SegmentSymmetry> symmetries;
    for (Symmetry& symmetry : outline_symmetries(region)) {
        if (auto onto = images_of(region, segment, count, symmetry))
            symmetries.push_back({std::move(symmetry), std::move(*onto)});
    }
    return symmetries;
}

std::vector<SegmentSymmetry> end_symmetries(const PlanarRegion& region, std::span<const int> segment)
{
    std::vector<SegmentSymmetry> symmetries = segment_symmetries(region, segment);
    const std::vector<Index> starts = starts_of_whole_loops(region, segment);
    std::erase_if(symmetries, [&](const SegmentSymmetry& symmetry) {
        return std::ranges::any_of(starts, [&](Index start) {
            return std::ranges::find(starts, symmetry.nodes.to[index(start)]) == starts.end();
        });
    });
    return symmetries;
}

std::vector<SegmentPair> mirrored_segments(const PlanarRegion& region, std::span<const int> segment)
{
    std::vector<SegmentPair> pairs;
    for (const SegmentSymmetry& symmetry : end_symmetries(region, segment)) {
        if (!symmetry.nodes.map.mirrors) continue;
        for (const auto& loop : region.loops) {
            for (const Index p : loop) {
                const auto own = index(segment[index(p)]);
                const SegmentPair pair{own, symmetry.onto[own]};
                if (pair[0] <= pair[1] && (pairs.empty() || pairs.back() != pair)) pairs.push_back(pair);
            }
        }
    }
    return pairs;
}

bool are_alike(std::span<const int> counts, std::span<const SegmentPair> pairs)
{
    return std::ranges::all_of(pairs,
                               [&](const SegmentPair& pair) { return counts[pair[0]] == counts[pair[1]]; });
}

int unlike(std::span<const int> counts, std::span<const SegmentPair> pairs)
{
    return static_cast<int>(std::ranges::count_if(pairs, [&](const SegmentPair& pair) {
        return counts[pair[0]] != counts[pair[1]] || (pair[0] == pair[1] && counts[pair[0]] % 2 != 0);
    }));
}

} // namespace lacuna::quads
