// SPDX-License-Identifier: MIT
#include <lacuna/quads/detail/ring_counts.h>

#include <lacuna/core/shared/criteria.h>
#include <lacuna/quads/detail/partial_mesh.h>
#include <lacuna/quads/detail/pattern_ring.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <span>
#include <utility>

namespace lacuna::quads {
namespace {

/// A narrower range for rings with further holes. Rows bend around these holes, which changes the lengths of
/// edges further.
constexpr CountRange kRingWithHoles{1 / 1.55, 1.55};

/// The index of the hole with the most nodes; of several such holes, the first. 0: there is no hole.
std::size_t longest_hole(const PlanarRegion& region)
{
    std::size_t longest = 0;
    for (std::size_t l = 1; l < region.loops.size(); ++l) {
        if (longest == 0 || region.loops[l].size() > region.loops[longest].size()) longest = l;
    }
    return longest;
}

/// Number of sides of a loop that are longer or shorter than accepted. Each of these sides costs as much as
/// one missing side.
double out_of_size(const CountedLoop& loop)
{
    int sum = 0;
    for (const CountedRun& run : loop.runs) {
        const double off = run.count / run.wanted;
        if (off < kRing.least || off > kRing.most) sum += run.count;
    }
    return sum;
}

/// The number of times that a loop repeats the same sequence of segments.
int repeats(const CountTask& task, std::size_t l)
{
    std::vector<double> wanted;
    const std::vector<Index>& loop = task.region.loops[l];
    for (std::size_t i = 0; i < loop.size(); ++i) {
        const std::size_t own = task.segment_of(loop[i]);
        if (i == 0 || own != task.segment_of(loop[i - 1])) wanted.push_back(task.segments[own].wanted);
    }
    const std::size_t n = wanted.size();
    for (std::size_t period = 1; period < n; ++period) {
        if (n % period != 0) continue;
        bool same = true;
        for (std::size_t i = 0; i < n && same; ++i)
            same = std::abs(wanted[i] - wanted[i % period]) <= kAlikeSizes * wanted[i];
        if (same) return static_cast<int>(n / period);
    }
    return 1;
}

/// Number of wanted sides around a ring.
double wanted_along(const CountedLoop& loop)
{
    double sum = 0;
    for (const CountedRun& run : loop.runs)
        sum += run.quarter % 2 != 0 ? 0 : run.quarter == 0 ? run.wanted : -run.wanted;
    return std::abs(sum);
}

/// The two loops of a ring with the smallest total cost. The cost of each loop is relative to its wanted
/// number of sides.
/// @param multiple  the number of sides of the outer loop along the ring is a multiple of this.
/// @param more      candidates for the number of sides that the outer loop has in addition to those of the
///         inner loop.
std::optional<std::vector<CountedLoop>> ring_ends(const CountTask& task,
                                                  const std::array<CountedLoop, 2>& ends,
                                                  const std::array<int, 2>& along, int multiple,
                                                  std::span<const int> more, const CountRange& range)
{
    std::optional<std::vector<CountedLoop>> best;
    double least = kInfinity;
    const int low = std::max(3, std::min(along[0], along[1])), high = std::max(along[0], along[1]);
    // Weight of the deviation from the wanted number of sides along the ring. It does not apply if rows
    // change their number of quads (`by` is not 0), because such rows adapt. Chosen on gears of 400 and 3,000
    // quads.
    constexpr double kQuads = 3;
    const double mean = (wanted_along(ends[0]) + wanted_along(ends[1])) / 2;
    for (const int by : more) {
        for (int sides = (low + multiple - 1) / multiple * multiple; sides < high + multiple;
             sides += multiple) {
            if (sides - by < 3) continue;
            const double off = by == 0 ? sides / mean - 1 : 0;
            double cost = kQuads * off * off;
            bool closed = true;
            std::vector<CountedLoop> tried(ends.begin(), ends.end());
            for (std::size_t e = 0; e < 2 && closed; ++e) {
                tried[e].excess[0] -= e == 0 ? sides : by - sides;
                closed = close_counts(task, tried[e], range);
                cost += (sum_of_costs(tried[e]) + out_of_size(tried[e])) / tried[e].wanted;
            }
            if (!closed || cost >= least) continue;
            least = cost;
            best = std::move(tried);
        }
    }
    return best;
}

/// The loops of a region, with headings measured around one of its holes (`LoopFrame::polar`).
struct RingLoops {
    std::array<CountedLoop, 2> ends; ///< the outer loop and the hole
    std::array<int, 2> along{};      ///< their numbers of sides along the ring, rounded
    std::vector<CountedLoop> others; ///< loops of the other holes, closed
};

/// @return empty if a loop fits no grid around a hole.
std::optional<RingLoops> ring_loops(const CountTask& task, std::size_t about)
{
    const PlanarRegion& region = task.region;
    RingLoops ring;
    const Vec2 centre = centre_of(region.points, region.loops[about]);
    for (std::size_t l = 0; l < region.loops.size(); ++l) {
        const Vec2 own = centre_of(region.points, region.loops[l]);
        const bool is_end = l == 0 || l == about;
        LoopFrame frame{is_end, own, 0};
        if (!is_end) frame.angle = std::atan2(own.y() - centre.y(), own.x() - centre.x());
        auto headed = head_loop(region.points, region.loops[l], frame);
        if (!headed || headed->turns != (is_end ? 0 : -4) ||
            (is_end && !is_ring_loop(region.points, *headed)))
            return std::nullopt;
        auto loop = counted_loop(task, std::move(*headed));
        if (!loop) return std::nullopt;
        if (!is_end) {
            if (!close_counts(task, *loop, kSegment)) return std::nullopt;
            ring.others.push_back(std::move(*loop));
            continue;
        }
        const std::size_t e = l == 0 ? 0 : 1;
        ring.along[e] = std::abs(loop->excess[0]);
        ring.ends[e] = std::move(*loop);
    }
    return ring;
}

/// Numbers of sides for a ring with a single hole whose rows cannot all have the same number of quads within
/// `kRingSegment`. For symmetric loops, one side from each corner to the next is tried first, within a wider
/// range. Otherwise rows change their number of quads.
/// @param symmetric  number of times that segments repeat along both loops.
std::optional<std::vector<CountedLoop>> changing_ends(const CountTask& task, const RingLoops& ring,
                                                      int symmetric, int changing)
{
    const auto& [ends, along, others] = ring;
    std::optional<std::vector<CountedLoop>> best;
    if (symmetric > 2) {
        // A loop with many corners gets one side per corner, and the other loop gets the same number. The
        // mesh is then symmetric.
        constexpr CountRange kMany{kRing.least, 4}; // up to four times as many sides as requested
        const auto corners = static_cast<int>(
            std::ranges::count_if(ends[0].runs, [](const CountedRun& run) { return run.quarter == 0; }));
        if (corners % symmetric == 0 && corners > 2 * symmetric - 1)
            best = ring_ends(task, ends, {corners, corners}, corners, std::array{0}, kMany);
    }
    if (best) return best;
    // Rows change their number of quads at two nodes, symmetrically.
    std::vector<int> more;
    for (int rows = 1; rows <= changing; ++rows) more.push_back(along[0] > along[1] ? 4 * rows : -4 * rows);
    best = ring_ends(task, ends, along, 2, more, kSegment);
    if (!best) best = ring_ends(task, ends, along, 2, more, kRingSegment);
    return best;
}

} // namespace

std::optional<std::vector<int>> ring_counts(const CountTask& task)
{
    const PlanarRegion& region = task.region;
    const std::size_t about = longest_hole(region);
    if (about == 0) return std::nullopt;
    const auto ring = ring_loops(task, about);
    if (!ring) return std::nullopt;
    const bool alone = ring->others.empty();
    // Prefer numbers that preserve the symmetry of the loops.
    const int symmetric = alone ? std::lcm(repeats(task, 0), repeats(task, about)) : 1;
    std::optional<std::vector<CountedLoop>> best;
    const RingWidths widths = ring_widths(region.points, region.loops[0], region.loops[about]);
    const double size = mean_size(task);
    const int steps = alone ? widths.steps(size) : 0;
    // Prefer an even number of sides along the ring, so that quads alone can fill a face on the other side of
    // a loop.
    for (int last = 0; const int multiple : {std::lcm(symmetric, 2), 2, 1}) {
        if (!best && multiple != std::exchange(last, multiple))
            best = ring_ends(task, ring->ends, ring->along, multiple, std::array{2 * steps},
                             alone ? kRingSegment : kRingWithHoles);
    }
    if (!best && alone) best = changing_ends(task, *ring, symmetric, widths.changing(size));
    if (!best) return std::nullopt;
    best->insert(best->end(), ring->others.begin(), ring->others.end());
    return counts_of(task, *best);
}

} // namespace lacuna::quads
