// SPDX-License-Identifier: MIT
#include <lacuna/quads/detail/pattern_loop.h>

#include <algorithm>
#include <cmath>

namespace lacuna::quads {
namespace {

/// Make another node the first node of the loop.
void start_at(PatternLoop& loop, std::size_t first)
{
    const auto rotate = [by = static_cast<std::ptrdiff_t>(first)](auto&... lists) {
        (std::rotate(lists.begin(), lists.begin() + by, lists.end()), ...);
    };
    rotate(loop.nodes, loop.heading, loop.direction, loop.soft, loop.movable);
    for (std::size_t i = loop.size() - first; i < loop.size(); ++i) {
        loop.heading[i] += loop.turns;
        loop.direction[i] += loop.turns;
    }
}

bool is_hard(const PatternLoop& loop, std::size_t i) { return loop.turn(i) != 0 && !loop.movable[i]; }

/// Places one row at a time.
class PatternRows {
public:
    PatternRows(PatternLoop& loop, std::vector<Vec2>& points, std::vector<Quad>& quads,
                const SizeField& height)
        : loop_(loop), points_(points), quads_(quads), height_(height)
    {
    }

    /// Place a row along the whole loop.
    void lay_round()
    {
        const std::size_t n = loop_.size();
        std::vector<Index> inner;
        for (std::size_t i = 0; i < n; ++i) inner.push_back(add_inner(i));
        for (std::size_t i = 0; i < n; ++i)
            quads_.push_back({loop_.nodes[i], loop_.nodes[(i + 1) % n], inner[(i + 1) % n], inner[i]});
        loop_.nodes = std::move(inner);
        for (int& rows : loop_.soft) rows = std::max(rows - 1, 0);
    }

    /// Place a row along the whole loop, whose only end is its first node. There, one quad takes the corner.
    /// @return false if the loop turns at a node next to this end.
    bool lay_round_end()
    {
        const std::size_t n = loop_.size();
        if (n < kFewestRoundEnd || loop_.turn(1) != 0 || loop_.turn(n - 1) != 0) return false;
        std::vector<Index> inner(n - 2);
        inner[0] = add(at(1) + at(n - 1) - at(0));
        for (std::size_t i = 1; i < inner.size(); ++i) inner[i] = add_inner(i + 1);
        quads_.push_back({loop_.nodes[0], loop_.nodes[1], inner[0], loop_.nodes[n - 1]});
        PatternLoop next;
        next.turns = loop_.turns;
        for (std::size_t i = 0; i < inner.size(); ++i) {
            const std::size_t own = i + 1;
            quads_.push_back(
                {loop_.nodes[own], loop_.nodes[own + 1], inner[(i + 1) % inner.size()], inner[i]});
            next.push(inner[i], loop_.heading[own], loop_.direction[own], std::max(loop_.soft[own] - 1, 0),
                      loop_.movable[own]);
        }
        loop_ = std::move(next);
        return true;
    }

    /// Place a row from the first node to the node `end`, which may be the first node again. At both nodes
    /// the boundary itself turns.
    /// @return false if there is no side on which the row can stop.
    bool lay_part(std::size_t end)
    {
        const std::size_t n = loop_.size();
        if (end == n && loop_.turn(0) == 1) return lay_round_end();
        const bool ends_at_start = loop_.turn(0) == 1, ends_at_end = loop_.turn(end % n) == 1;
        const std::size_t left = n - end; // number of sides that are not in the part
        if (loop_.turn(0) > 1 || loop_.turn(end % n) > 1) return false;
        if (left > 0 && left < 1 + (ends_at_start ? 1U : 0U) + (ends_at_end ? 1U : 0U)) return false;
        if (ends_at_start && loop_.movable[n - 1] && loop_.turn(n - 1) > 0) return false;
        if (ends_at_end && loop_.movable[end + 1] && loop_.turn(end + 1) > 0) return false;
        std::vector<Index> inner(end + 1);
        inner[0] = ends_at_start ? loop_.nodes[n - 1] : add_square(0, 0);
        for (std::size_t i = 1; i < end; ++i) inner[i] = add_inner(i);
        inner[end] = ends_at_end ? loop_.nodes[end + 1] : add_square(end, end - 1);
        for (std::size_t i = 0; i < end; ++i)
            quads_.push_back({loop_.nodes[i], loop_.nodes[(i + 1) % n], inner[i + 1], inner[i]});
        PatternLoop next;
        next.turns = loop_.turns;
        if (!ends_at_start) {
            const int up = loop_.heading[0] + 1;
            next.push(loop_.nodes[0], up, up, 0, 0);
        }
        for (std::size_t i = 0; i < end; ++i)
            next.push(inner[i], loop_.heading[i], loop_.direction[i],
                      i > 0 ? std::max(loop_.soft[i] - 1, 0) : 0, i > 0 ? loop_.movable[i] : 0);
        if (!ends_at_end) {
            const int down = loop_.heading[end - 1] - 1;
            next.push(inner[end], down, down, 0, 0);
        }
        // If the row stops at a soft turn, the loop now turns at this node.
        const std::size_t first = end + (ends_at_end ? 1 : 0);
        for (std::size_t i = first; i < n - (ends_at_start ? 1 : 0); ++i)
            next.push(loop_.nodes[i], loop_.heading[i], loop_.direction[i], i == first ? 0 : loop_.soft[i],
                      i == first ? 0 : loop_.movable[i]);
        loop_ = std::move(next);
        return true;
    }

private:
    static constexpr std::size_t kFewestRoundEnd = 5; ///< in shorter loops, the row's inner side would have
                                                      ///< fewer than three nodes

    [[nodiscard]] const Vec2& at(std::size_t i) const { return point_of(points_, loop_.nodes, i); }

    Index add(const Vec2& p)
    {
        points_.push_back(p);
        return static_cast<Index>(points_.size()) - 1;
    }

    /// Add a node above node i of the loop.
    Index add_inner(std::size_t i) { return add(point_above(points_, loop_.nodes, i, height_)); }

    /// Add a node perpendicular to a side, above one of its ends.
    Index add_square(std::size_t i, std::size_t side)
    {
        const Vec2 along = (at(side + 1) - at(side)).normalized();
        return add(at(i) + height_(at(i)) * Vec2(-along.y(), along.x()));
    }

    PatternLoop& loop_;
    std::vector<Vec2>& points_;
    std::vector<Quad>& quads_;
    const SizeField& height_;
};

} // namespace

int fitting_rows(const PatternLoop& loop)
{
    // Number of rows for each side of a quarter turn. The square inside a disc is then about half as wide as
    // the disc.
    constexpr double kOfQuarter = 0.22;
    const std::size_t n = loop.size();
    int most = 1;
    for (std::size_t i = 0; i < n; ++i) {
        if (!loop.movable[i] || loop.turn(i) != 1) continue;
        // Count the sides whose direction differs by less than half a right angle from the direction halfway
        // between the two headings.
        const double middle = i > 0 ? loop.heading[i] - 0.5 : loop.heading[0] - 0.5;
        int sides = 0;
        for (std::size_t k = 0; k < n; ++k) {
            if (std::abs(loop.direction[k] - middle) < 0.5) ++sides;
        }
        most = std::max(most, static_cast<int>(std::lround(kOfQuarter * sides)));
    }
    return most;
}

/// Up to this number, rows are always tried in front of a soft turn. Where a loop is bent inward, more rows
/// would run into the rows of other loops.
constexpr int kFewRows = 3;

std::vector<int> rows_to_try(int fitting)
{
    std::vector<int> rows;
    for (int r = 1; r <= kFewRows; ++r) rows.push_back(r);
    for (const int r : {fitting / 2, 2 * fitting / 3, fitting}) {
        if (r > rows.back()) rows.push_back(r);
    }
    if (fitting <= kFewRows) return rows;
    const auto off = [&](int r) { return std::abs(std::log(static_cast<double>(r) / fitting)); };
    std::ranges::stable_sort(rows, [&](int a, int b) { return off(a) < off(b); });
    return rows;
}

void set_soft_rows(PatternLoop& loop, int rows)
{
    for (std::size_t i = 0; i < loop.size(); ++i) {
        if (loop.movable[i]) loop.soft[i] = loop.turn(i) < 0 ? std::min(rows, kFewRows) : rows;
    }
}

bool lay_pattern_rows(PatternLoop& loop, std::vector<Vec2>& points, std::vector<Quad>& quads,
                      const SizeField& height)
{
    while (true) {
        const std::size_t n = loop.size();
        std::size_t soft = 0, hard = n;
        while (soft < n && loop.soft[soft] == 0) ++soft;
        if (soft == n) return true;
        for (std::size_t k = 1; k < n && hard == n; ++k) {
            if (is_hard(loop, (soft + n - k) % n)) hard = (soft + n - k) % n;
        }
        PatternRows rows(loop, points, quads, height);
        if (hard == n) {
            rows.lay_round();
            continue;
        }
        start_at(loop, hard);
        std::size_t end = 1;
        while (end < n && !is_hard(loop, end)) ++end;
        if (!rows.lay_part(end)) return false;
    }
}

} // namespace lacuna::quads
