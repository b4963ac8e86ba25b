// SPDX-License-Identifier: MIT
#include <lacuna/quads/detail/pattern_ring.h>

#include <lacuna/core/shared/constants.h>
#include <lacuna/quads/detail/partial_mesh.h>
#include <lacuna/quads/shared/measure_plane.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace lacuna::quads {
namespace {

/// Places rows along a loop that change its number of sides.
class ChangingRows {
public:
    ChangingRows(PatternLoop& loop, std::vector<Vec2>& points, std::vector<Quad>& quads,
                 const SizeField& height)
        : loop_(loop), points_(points), quads_(quads), height_(height)
    {
    }

    /// Place one row. @param corners  positions in the loop, ascending. On return, the positions in the new
    /// loop.
    bool lay(std::vector<std::size_t>& corners, bool grows)
    {
        const std::vector<Index> nodes = loop_.nodes;
        const std::size_t n = nodes.size();
        // At a corner, the row has one node beside three nodes of the loop, or three nodes beside one.
        if (!ends_apart(corners, n)) return false;
        std::vector<char> turns(n, 0);
        for (const std::size_t c : corners) turns[c] = 1;
        // For each node, the first and the last new node beside it. They differ only where the row grows.
        std::vector<Index> first(n), last(n);
        std::vector<Index> row;
        for (std::size_t i = 0; i < n; ++i) {
            if (!grows && (turns[(i + 1) % n] || turns[(i + n - 1) % n])) continue;
            const Index above = add_above(nodes, i);
            first[i] = last[i] = above;
            if (turns[i] && grows) {
                first[i] = add_above(nodes, i);
                last[i] = add_above(nodes, i);
                row.push_back(first[i]);
            }
            if (turns[i])
                corners[static_cast<std::size_t>(std::count(
                    turns.begin(), turns.begin() + static_cast<std::ptrdiff_t>(i), 1))] = row.size();
            row.push_back(above);
            if (turns[i] && grows) {
                row.push_back(last[i]);
                quads_.push_back({nodes[i], last[i], above, first[i]});
            }
        }
        if (row.size() < 3) return false;
        for (std::size_t i = 0; i < n && !grows; ++i) {
            if (!turns[i]) continue;
            const std::size_t before = (i + n - 1) % n, after = (i + 1) % n;
            last[before] = first[before] = last[after] = first[after] = first[i];
            quads_.push_back({nodes[before], nodes[i], nodes[after], first[i]});
        }
        for (std::size_t i = 0; i < n; ++i) {
            const std::size_t next = (i + 1) % n;
            if (last[i] != first[next]) quads_.push_back({nodes[i], nodes[next], first[next], last[i]});
        }
        loop_.nodes = std::move(row);
        make_even(corners.empty() ? 0 : corners.front());
        return true;
    }

private:
    Index add_above(const std::vector<Index>& nodes, std::size_t i)
    {
        points_.push_back(point_above(points_, nodes, i, height_));
        return static_cast<Index>(points_.size()) - 1;
    }

    /// Space the nodes of the loop evenly along it. One node stays in its position.
    void make_even(std::size_t staying)
    {
        const std::size_t n = loop_.nodes.size();
        std::vector<Index> nodes = loop_.nodes;
        std::rotate(nodes.begin(), nodes.begin() + static_cast<std::ptrdiff_t>(staying), nodes.end());
        std::vector<Vec2> line;
        for (const Index p : nodes) line.push_back(points_[index(p)]);
        line.push_back(line.front());
        std::vector<double> arc{0};
        for (std::size_t i = 0; i < n; ++i) arc.push_back(arc.back() + (line[i + 1] - line[i]).norm());
        std::size_t piece = 0;
        for (std::size_t i = 1; i < n; ++i) {
            const double at = arc.back() * static_cast<double>(i) / static_cast<double>(n);
            while (piece + 1 < n && arc[piece + 1] < at) ++piece;
            const double length = arc[piece + 1] - arc[piece];
            const double part = length > 0 ? (at - arc[piece]) / length : 0;
            points_[index(nodes[i])] = line[piece] + part * (line[piece + 1] - line[piece]);
        }
    }

    PatternLoop& loop_;
    std::vector<Vec2>& points_;
    std::vector<Quad>& quads_;
    const SizeField& height_;
};

} // namespace

bool ends_apart(std::span<const std::size_t> ends, std::size_t n)
{
    constexpr std::size_t kApart = 3;
    for (std::size_t e = 0; e < ends.size(); ++e) {
        const std::size_t next = ends[(e + 1) % ends.size()] + (e + 1 == ends.size() ? n : 0);
        if (next < ends[e] + kApart) return false;
    }
    return true;
}

int RingWidths::steps(double height) const
{
    // With the same number of rows everywhere, all row heights are accepted if the ratio of the ring's widths
    // is smaller than the ratio of the accepted limits.
    if (!(least > 0) || most < kLongestOfSize / kShortestOfSize * least) return 0;
    // Take half the difference that would make all rows equally high. Near the steps, where the width of the
    // ring is in between, the rows are then neither too high nor too low.
    return static_cast<int>(std::lround((most - least) / (2 * height)));
}

int RingWidths::changing(double height) const
{
    return static_cast<int>(std::lround((most + least) / (2 * height))) - 1;
}

RingWidths ring_widths(std::span<const Vec2> points, const std::vector<Index>& outer,
                       const std::vector<Index>& inner)
{
    std::vector<double> width;
    for (const Index p : outer) {
        double least = kInfinity;
        for (const Index q : inner)
            least = std::min(least, (points[index(q)] - points[index(p)]).squaredNorm());
        width.push_back(std::sqrt(least));
    }
    const std::size_t n = width.size();
    RingWidths widths;
    widths.narrowest = static_cast<std::size_t>(std::ranges::min_element(width) - width.begin());
    widths.least = width[widths.narrowest];
    widths.most = *std::ranges::max_element(width);
    const double middle = (widths.least + widths.most) / 2;
    std::size_t ahead = 0, back = 0;
    while (ahead + 1 < n / 2 && width[(widths.narrowest + ahead) % n] < middle) ++ahead;
    while (back + 1 < n / 2 && width[(widths.narrowest + n - back) % n] < middle) ++back;
    widths.half = (ahead + back) / 2;
    return widths;
}

bool runs_round(const PatternLoop& loop)
{
    return loop.turns == 0 &&
           std::ranges::all_of(loop.heading, [&](int h) { return h == loop.heading.front(); });
}

bool step_in(PatternLoop& loop, std::size_t middle, std::size_t half, int rows)
{
    const std::size_t n = loop.size();
    const auto d = static_cast<std::size_t>(rows);
    if (rows < 1 || half < d + 1 || 2 * half + 2 > n) return false;
    const std::size_t start = (middle + n - half) % n;
    const auto set = [&](std::size_t from, int by) {
        for (std::size_t i = 0; i < d; ++i) loop.heading[(from + i) % n] += by;
        for (const std::size_t i : {from % n, (from + d) % n}) loop.soft[i] = loop.movable[i] = 1;
    };
    set(start, 1);
    set(start + 2 * half - d, -1);
    return true;
}

bool change_sides(PatternLoop& loop, int by, int corners, std::vector<Vec2>& points, std::vector<Quad>& quads,
                  const SizeField& height)
{
    const std::size_t n = loop.size();
    const bool grows = by > 0;
    const int pairs = std::abs(by) / 2;
    if (by % 2 != 0 || corners < 1 || pairs < corners) return false;
    ChangingRows rows(loop, points, quads, height);
    std::vector<std::size_t> none;
    if (!rows.lay(none, grows)) return false;
    std::vector<std::size_t> at;
    for (int c = 0; c < corners; ++c)
        at.push_back(n * static_cast<std::size_t>(c) / static_cast<std::size_t>(corners));
    for (int row = 0; row < (pairs + corners - 1) / corners; ++row) {
        // The remaining change may need turns at only some of the corners in the last row.
        at.resize(static_cast<std::size_t>(std::min(corners, pairs - row * corners)));
        if (!rows.lay(at, grows)) return false;
    }
    const int heading = loop.heading.front();
    loop.heading.assign(loop.size(), heading);
    loop.direction.assign(loop.size(), heading);
    loop.soft.assign(loop.size(), 0);
    loop.movable.assign(loop.size(), 0);
    return true;
}

} // namespace lacuna::quads
