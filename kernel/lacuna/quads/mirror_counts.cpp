// SPDX-License-Identifier: MIT
#include <lacuna/quads/detail/mirror_counts.h>

#include <lacuna/core/shared/criteria.h>
#include <lacuna/quads/detail/partial_mesh.h>
#include <lacuna/quads/detail/pave_size.h>
#include <lacuna/quads/detail/ring_counts.h>
#include <lacuna/quads/detail/segment_symmetry.h>
#include <lacuna/quads/detail/straight_counts.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace lacuna::quads {
namespace {

/// Numbers of sides for a part of a region between mirror axes. A ring is tried first, and then a straight
/// grid within the range of segments. If there are few quads and this range has no solution, the wider range
/// of a ring's segments is tried.
std::optional<Counts> counts_of_part(const PlanarRegion& part, std::span<const int> segment,
                                     std::span<const BoundarySegment> segments, bool few,
                                     const RunContext& context)
{
    const CountTask task(part, segment, segments, context);
    if (auto ring = ring_counts(task)) return Counts{std::move(*ring)};
    auto counts = straight_counts(task, {kSegment, true, few});
    return counts || !few ? counts : straight_counts(task, {kRingSegment, true, few});
}

/// A region with an additional node wherever a mirror axis crosses a side of a segment whose number of sides
/// is not fixed.
struct Halved {
    PlanarRegion region;
    std::vector<int> segment;   ///< segment of the side from each node to the next
    std::vector<Index> next;    ///< successor of each node in its loop
    std::vector<double> weight; ///< 1 for a side of the region, ½ for half a side
    [[nodiscard]] int segment_at(Index p) const { return segment[index(p)]; }
};

Halved halve_crossed(const CountTask& task)
{
    const PlanarRegion& region = task.region;
    std::vector<char> crossed(region.points.size(), 0);
    for (const SegmentSymmetry& symmetry : end_symmetries(region, task.segment)) {
        const std::vector<Index>& to = symmetry.nodes.to;
        if (!symmetry.nodes.map.mirrors) continue;
        for_sides_of(region.loops, [&](Index a, Index b) {
            if (to[index(a)] == b && to[index(b)] == a && !task.segments[task.segment_of(a)].fixed)
                crossed[index(a)] = 1;
        });
    }
    Halved halved;
    halved.region.size = region.size;
    const auto push = [&](const Vec2& p, int segment, double weight) {
        halved.region.loops.back().push_back(static_cast<Index>(halved.region.points.size()));
        halved.region.points.push_back(p);
        halved.segment.push_back(segment);
        halved.weight.push_back(weight);
        halved.next.push_back(static_cast<Index>(halved.region.points.size()));
    };
    for (const auto& loop : region.loops) {
        halved.region.loops.emplace_back();
        const auto first = static_cast<Index>(halved.region.points.size());
        for (std::size_t i = 0; i < loop.size(); ++i) {
            const std::size_t a = index(loop[i]);
            const int own = task.segment[a];
            push(region.points[a], own, crossed[a] ? 0.5 : 1);
            if (crossed[a]) push((region.points[a] + point_of(region.points, loop, i + 1)) / 2, own, 0.5);
        }
        halved.next.back() = first;
    }
    return halved;
}

/// The segment that contains the image of the side after a node of a part.
std::size_t image_of(const Halved& halved, const MirrorPart& part, const Symmetry& image, Index p)
{
    Index a = part.whole[index(p)];
    if (image.map.mirrors) a = halved.next[index(a)];
    return index(halved.segment_at(image.to[index(a)]));
}

/// The segments of a part: pieces of axes and of the segments of the whole region.
struct PartSegments {
    std::vector<int> own; ///< segment of the side from each node of the part to the next
    std::vector<BoundarySegment> all;
    /// Node of the whole region at which each segment starts; -1: the segment is on an axis.
    std::vector<Index> starts;
};

PartSegments segments_of(const CountTask& task, const Halved& halved, const MirrorPart& part)
{
    PartSegments made;
    made.own.resize(part.region.points.size());
    for (const auto& loop : part.region.loops) {
        int last = -1;
        for (const Index p : loop) {
            const auto at = index(p);
            const int axis = part.axis[at];
            const int key = axis >= 0 ? -2 - axis : halved.segment_at(part.whole[at]);
            if (p == loop.front() || key != last) {
                made.all.push_back({0, 1, false});
                made.starts.push_back(axis >= 0 ? -1 : part.whole[at]);
            }
            last = key;
            made.own[at] = static_cast<int>(made.all.size()) - 1;
            BoundarySegment& segment = made.all.back();
            if (axis >= 0) {
                segment.wanted = part.wanted[index(axis)];
                continue;
            }
            const auto s = index(key);
            const double share = halved.weight[index(part.whole[at])] / task.own[s];
            segment.wanted += share * task.segments[s].wanted;
            for (const Symmetry& image : part.images)
                segment.fixed = segment.fixed || task.segments[image_of(halved, part, image, p)].fixed;
        }
    }
    for (std::size_t t = 0; t < made.all.size(); ++t) {
        if (made.starts[t] < 0) continue;
        BoundarySegment& own = made.all[t];
        const auto s = index(halved.segment_at(made.starts[t]));
        const BoundarySegment& whole = task.segments[s];
        own.least = std::max(
            1, static_cast<int>(std::ceil(whole.least * own.wanted / whole.wanted - kFileAccuracy)));
    }
    return made;
}

/// The wanted number of sides of each segment, rounded. If a segment is its own mirror image, rounded to an
/// even number.
std::vector<int> rounded(const std::vector<BoundarySegment>& segments, const std::vector<SegmentPair>& pairs)
{
    std::vector<int> counts;
    for (const BoundarySegment& segment : segments)
        counts.push_back(std::max(segment.least, static_cast<int>(std::lround(segment.wanted))));
    for (const auto& [a, b] : pairs) {
        if (a == b && !segments[a].fixed) counts[a] = even_sides(segments[a].wanted, segments[a].least);
        if (!segments[b].fixed) counts[b] = counts[a];
    }
    return counts;
}

/// Numbers of sides for all images of one part. The cost is infinite if no grid fills the part.
Counts counts_by_part(const CountTask& task, const Halved& halved, const MirrorPart& part, bool few)
{
    const PartSegments segments = segments_of(task, halved, part);
    std::optional<Counts> counts = counts_of_part(part.region, segments.own, segments.all, few, task.context);
    const std::vector<SegmentPair> pairs = mirrored_segments(part.region, segments.own);
    // If the part itself is symmetric, numbers from a grid are accepted only if mirrored segments have equal
    // numbers.
    if (counts && !few && part.has_centre && unlike(counts->sides, pairs) > 0) counts.reset();
    const std::vector<int> sides = counts ? counts->sides : rounded(segments.all, pairs);
    std::vector<int> sum(task.segments.size(), 0);
    std::vector<char> done(segments.all.size(), 0);
    for (const auto& loop : part.region.loops) {
        for (const Index p : loop) {
            const auto t = index(segments.own[index(p)]);
            if (done[t] || segments.starts[t] < 0) continue;
            done[t] = 1;
            for (const Symmetry& image : part.images) sum[image_of(halved, part, image, p)] += sides[t];
        }
    }
    return {std::move(sum), counts ? counts->cost : kInfinity};
}

} // namespace

std::optional<Counts> mirror_counts(const CountTask& task)
{
    const Halved halved = halve_crossed(task);
    std::vector<Symmetry> symmetries;
    for (SegmentSymmetry& symmetry : end_symmetries(halved.region, halved.segment))
        symmetries.push_back(std::move(symmetry.nodes));
    if (symmetries.empty()) return std::nullopt;
    SizeField asked = task.region.size;
    if (!asked) asked = [mean = mean_size(task)](const Vec2&) { return mean; };
    // With few quads, the axes are too short for a graded size, so the requested size is tried first.
    std::vector<SizeField> sizes{paving::sizes_with_boundary(task.region).usual};
    if (quads_asked(task) < kFewQuads) sizes.insert(sizes.begin(), asked);
    return cheapest_of_parts(halved.region, symmetries, sizes, [&](const MirrorPart& part) {
        return counts_by_part(task, halved, part, sizes.size() > 1);
    });
}

double count_axes(MirrorPart& part, const SizeField& size, bool few, const RunContext& context)
{
    // Given sides between two corners form a segment of their own, because no corner may move.
    std::vector<int> segment(part.region.points.size());
    std::vector<BoundarySegment> segments;
    std::vector<std::size_t> of_axis(part.wanted.size());
    for (const auto& loop : part.region.loops) {
        for (std::size_t i = 0, n = loop.size(); i < n; ++i) {
            const int axis = part.axis[index(loop[i])];
            const int last = part.axis[index(loop[(i + n - 1) % n])];
            const bool corner = quads_in(corner_angle(part.region.points, loop, i)) != 2;
            if (i == 0 || axis != last || (axis < 0 && corner)) segments.push_back({0, 1, axis < 0});
            segment[index(loop[i])] = static_cast<int>(segments.size()) - 1;
            segments.back().wanted += 1;
            if (axis >= 0) of_axis[index(axis)] = segments.size() - 1;
        }
    }
    std::vector<int> sides;
    int given = 0;
    for (const BoundarySegment& s : segments) given += s.fixed ? static_cast<int>(s.wanted) : 0;
    for (std::size_t a = 0; a < of_axis.size(); ++a) {
        sides.push_back(static_cast<int>(segments[of_axis[a]].wanted));
        segments[of_axis[a]].wanted = part.wanted[a];
    }
    const auto counts = counts_of_part(part.region, segment, segments, few, context);
    if (counts) {
        for (std::size_t a = 0; a < of_axis.size(); ++a) sides[a] = counts->sides[of_axis[a]];
    }
    // No grid fills the part, so the paver does. Quads then only require an even total number of sides.
    if (std::accumulate(sides.begin(), sides.end(), given) % 2 != 0) ++*std::ranges::max_element(sides);
    divide_axes(part, sides, size);
    return counts ? counts->cost : kInfinity;
}

} // namespace lacuna::quads
