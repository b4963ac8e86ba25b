// SPDX-License-Identifier: MIT
#include <lacuna/quads/detail/patch_template.h>

#include <lacuna/core/shared/criteria.h>
#include <lacuna/quads/shared/measure_plane.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace lacuna::quads {

namespace {

/// Twice the foot that `spoke_feet()` finds for side i: the sum of the numbers of edges of sides i, i + 2,
/// i + 4 …, with alternating signs.
int twice_foot(const SideCounts& counts, std::size_t i)
{
    const std::size_t n = counts.count;
    int twice = 0;
    for (std::size_t j = 0, at = i; j < n; ++j, at = at + 2 < n ? at + 2 : at + 2 - n)
        twice += j % 2 == 0 ? counts.side[at] : -counts.side[at];
    return twice;
}

/// Whether a patch can be filled without a cut.
bool needs_no_cut(const SideCounts& counts)
{
    std::array<int, kMostSides> foot{};
    const auto& side = counts.side;
    if (counts.count == 4) return side[0] == side[2] && side[1] == side[3];
    return (counts.count == 3 || counts.count == 5) && spoke_feet(counts, false, foot);
}

/// Ranks cuts by their lengths and directions.
class CutRanker {
public:
    explicit CutRanker(std::span<const Vec2> loop) : loop_(loop)
    {
        const std::size_t n = loop.size();
        along_.reserve(n);
        for (std::size_t i = 0; i < n; ++i) {
            spacing_ += (loop[(i + 1) % n] - loop[i]).norm() / static_cast<double>(n);
            const Vec2 side = loop[(i + 1) % n] - loop[(i + n - 1) % n];
            along_.push_back({side, std::max(side.norm(), std::numeric_limits<double>::min())});
        }
    }

    /// Add the cuts between two positions, for each accepted number of edges.
    template <class Fits>
    void add(std::size_t from, std::size_t to, const Fits& fits, std::vector<TemplateCut>& found) const
    {
        const Vec2 across = loop_[to] - loop_[from];
        const double length = across.norm(), fitting = length / spacing_;
        if (!(length > 0)) return;
        // Slant of the cut at one of its ends, from 0 (perpendicular to the outline) to 1.
        const auto slant_at = [&](std::size_t i) {
            return std::abs(along_[i].side.dot(across / length)) / along_[i].length;
        };
        const double slant = (slant_at(from) + slant_at(to)) / 2;
        if (slant > kContinues) return; // it runs along the outline rather than away from it
        int low = std::max(1, static_cast<int>(fitting * kShortestOfSize));
        if ((to + loop_.size() - from + index(low)) % 2 != 0) ++low; // both parts need even numbers of edges
        const int high = std::min(static_cast<int>(loop_.size()),
                                  static_cast<int>(fitting * kLongestOfSize) + 1);
        for (int k = low; k <= high; k += 2) {
            if (fits(k)) found.push_back({from, to, k, std::abs(std::log(fitting / k)) + slant});
        }
    }

private:
    struct Along {
        Vec2 side;
        double length;
    };
    std::span<const Vec2> loop_;
    std::vector<Along> along_; ///< for each position: vector from the previous position to the next one
    double spacing_ = 0;
};

/// Whether a patch of four sides can be filled with two irregular nodes or none.
bool needs_one_pair(const SideCounts& counts)
{
    const auto& side = counts.side;
    return std::abs(side[0] - side[2]) == std::abs(side[1] - side[3]) && can_fill(counts);
}

void keep_best(std::vector<TemplateCut>& cuts, std::size_t most)
{
    const auto best = cuts.begin() + static_cast<std::ptrdiff_t>(std::min(most, cuts.size()));
    std::partial_sort(cuts.begin(), best, cuts.end(),
                      [](const TemplateCut& x, const TemplateCut& y) { return x.fault < y.fault; });
    cuts.erase(best, cuts.end());
}

} // namespace

SideCounts side_counts(std::size_t loop, std::span<const std::size_t> corners)
{
    SideCounts counts{{}, corners.size()};
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const std::size_t next = i + 1 < corners.size() ? corners[i + 1] : corners[0] + loop;
        counts.side[i] = static_cast<int>(next - corners[i]);
    }
    return counts;
}

bool spoke_feet(const SideCounts& counts, bool ends_in_cut, std::array<int, kMostSides>& foot)
{
    for (std::size_t i = 0; i < counts.count; ++i) {
        const int twice = twice_foot(counts, i);
        if (twice < (ends_in_cut && i == 0 ? 0 : 2) || twice % 2 != 0) return false;
        foot[i] = twice / 2;
    }
    return true;
}

bool can_fill(const SideCounts& counts)
{
    if (counts.count != 4) return needs_no_cut(counts);
    // Columns that turn must leave at least one row and one column beside each irregular node, in each
    // direction.
    const int more = std::abs(counts.side[0] - counts.side[2]),
              less = std::abs(counts.side[1] - counts.side[3]);
    const int across = std::min(counts.side[0], counts.side[2]),
              along = std::min(counts.side[1], counts.side[3]);
    if ((more + less) % 2 != 0) return false;
    if (more == 0 && less == 0) return true;
    if (more == less) return across >= 2 && along >= 2;
    const int top = more > less ? across : along, rows = more > less ? along : across;
    return top >= 4 && rows - (std::max(more, less) - std::min(more, less)) / 2 >= 2;
}

std::vector<TemplateCut> find_cuts(std::span<const Vec2> loop, std::span<const std::size_t> corners,
                                   std::size_t most)
{
    const std::size_t n = corners.size();
    std::vector<TemplateCut> found;
    if (n < 2 || n > 6 || loop.size() % 2 != 0) return found;
    const SideCounts counts = side_counts(loop.size(), corners);
    if (needs_no_cut(counts)) found.push_back({});
    if (!found.empty()) return found;
    const CutRanker ranker(loop);
    // Difference between the indices of the two sides that the cut joins. For an even number of sides, the
    // cut has one or three corners on either side. With two corners on either side, the parts of a patch of
    // four sides would only be strips.
    const std::size_t between = n / 2 - (n == 4 ? 1 : 0);
    // If the cut joins opposite sides, each pair would occur twice.
    const std::size_t pairs = 2 * between == n ? n / 2 : n;
    const auto steps = [&](int edges) { return n % 2 != 0 ? 1 + edges / static_cast<int>(kPlacesTried) : 1; };
    for (std::size_t side = 0; side < pairs; ++side) {
        const std::size_t other = (side + between) % n;
        // The part from the start of the cut to its end has between + 2 sides, and the other part has n -
        // between + 2 sides.
        SideCounts first{{}, between + 2}, second{{}, n - between + 2};
        for (std::size_t i = 1; i < between; ++i) first.side[i] = counts.side[(side + i) % n];
        for (std::size_t i = 1; i < n - between; ++i) second.side[i] = counts.side[(other + i) % n];
        // A part of four sides may have two irregular nodes, any other part one irregular node.
        const auto fits = [&](int edges) {
            std::array<int, kMostSides> feet{};
            first.side[between + 1] = second.side[n - between + 1] = edges;
            return std::ranges::all_of(std::array{&first, &second}, [&](const SideCounts* part) {
                return part->count == 4 ? needs_one_pair(*part) : spoke_feet(*part, true, feet);
            });
        };
        for (int a = 1; a < counts.side[side]; a += steps(counts.side[side])) {
            for (int b = 1; b < counts.side[other]; b += steps(counts.side[other])) {
                first.side[0] = counts.side[side] - a;
                first.side[between] = b;
                second.side[0] = counts.side[other] - b;
                second.side[n - between] = a;
                ranker.add((corners[side] + index(a)) % loop.size(),
                           (corners[other] + index(b)) % loop.size(), fits, found);
            }
        }
    }
    // There are half as many pairs of opposite sides, so that half as many cuts are kept.
    keep_best(found, pairs < n ? (most + 1) / 2 : most);
    return found;
}

int fewest_irregular(std::size_t loop, std::span<const std::size_t> corners)
{
    if (corners.size() < 2 || corners.size() > 6) return std::numeric_limits<int>::max();
    const bool even = corners.size() % 2 == 0, whole = needs_no_cut(side_counts(loop, corners));
    return (even ? 0 : 1) + (whole ? 0 : 2);
}

} // namespace lacuna::quads
