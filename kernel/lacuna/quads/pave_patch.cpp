// SPDX-License-Identifier: MIT
#include <lacuna/quads/detail/pave_patch.h>

namespace lacuna::quads::paving {
namespace {

/// Four chains of nodes: bottom and top from left to right, left and right from bottom to top.
struct Sides {
    Cycle bottom, right, top, left;
};

Cycle stretch(const Cycle& cycle, std::size_t from, std::size_t to)
{
    Cycle chain;
    for (std::size_t i = from;; i = (i + 1) % cycle.size()) {
        chain.push_back(cycle[i]);
        if (i == to && (chain.size() > 1)) return chain;
    }
}

Cycle part(const Cycle& chain, std::size_t from, std::size_t to)
{
    return {chain.begin() + static_cast<std::ptrdiff_t>(from),
            chain.begin() + static_cast<std::ptrdiff_t>(to) + 1};
}

Cycle turned(Cycle chain)
{
    std::reverse(chain.begin(), chain.end());
    return chain;
}

/// Running length along a chain, from 0 to 1.
std::vector<double> fractions(const Draft& draft, const Cycle& chain)
{
    std::vector<double> at(chain.size(), 0);
    for (std::size_t i = 1; i < chain.size(); ++i)
        at[i] = at[i - 1] + (draft.at(chain[i]) - draft.at(chain[i - 1])).norm();
    const double whole = at.back();
    for (std::size_t i = 0; i < at.size(); ++i)
        at[i] = whole > 0 ? at[i] / whole : static_cast<double>(i) / static_cast<double>(at.size() - 1);
    return at;
}

/// A Coons patch over four chains: from the unit square to the plane.
class Coons {
public:
    Coons(const Draft& draft, const Sides& sides)
        : draft_(draft),
          sides_(sides),
          bottom_(fractions(draft, sides.bottom)),
          right_(fractions(draft, sides.right)),
          top_(fractions(draft, sides.top)),
          left_(fractions(draft, sides.left))
    {
    }

    /// Where the line from bottom place i to top place k meets that from left place l to right place j.
    [[nodiscard]] Vec2 crossing(std::size_t i, std::size_t k, std::size_t l, std::size_t j) const
    {
        const double b = bottom_[i], c = top_[k] - b, d = left_[l], e = right_[j] - d;
        const double t = (d + e * b) / (1 - e * c);
        return {b + c * t, t};
    }

    [[nodiscard]] Vec2 operator()(const Vec2& st) const
    {
        const double s = st.x(), t = st.y();
        const Vec2 c0 = draft_.at(sides_.bottom.front()), c1 = draft_.at(sides_.bottom.back());
        const Vec2 c2 = draft_.at(sides_.top.back()), c3 = draft_.at(sides_.top.front());
        return (1 - t) * on(sides_.bottom, bottom_, s) + t * on(sides_.top, top_, s) +
               (1 - s) * on(sides_.left, left_, t) + s * on(sides_.right, right_, t) -
               ((1 - s) * (1 - t) * c0 + s * (1 - t) * c1 + s * t * c2 + (1 - s) * t * c3);
    }

private:
    [[nodiscard]] Vec2 on(const Cycle& chain, const std::vector<double>& at, double s) const
    {
        auto i = static_cast<std::size_t>(std::upper_bound(at.begin(), at.end(), s) - at.begin());
        i = std::clamp<std::size_t>(i, 1, at.size() - 1);
        const double gap = at[i] - at[i - 1];
        const double f = gap > 0 ? (s - at[i - 1]) / gap : 0;
        return draft_.at(chain[i - 1]) + f * (draft_.at(chain[i]) - draft_.at(chain[i - 1]));
    }

    const Draft& draft_;
    const Sides& sides_;
    std::vector<double> bottom_, right_, top_, left_;
};

/// A grid. @pre opposite sides have as many edges
void fill_grid(Draft& draft, const Sides& sides)
{
    const std::size_t n = sides.bottom.size() - 1, m = sides.left.size() - 1;
    const auto first = static_cast<Index>(draft.points.size());
    if (n > 1 && m > 1) {
        const std::vector<double> b = fractions(draft, sides.bottom), t = fractions(draft, sides.top);
        const std::vector<double> l = fractions(draft, sides.left), r = fractions(draft, sides.right);
        const Vec2 c0 = draft.at(sides.bottom.front()), c1 = draft.at(sides.bottom.back());
        const Vec2 c2 = draft.at(sides.top.back()), c3 = draft.at(sides.top.front());
        draft.points.reserve(draft.points.size() + (n - 1) * (m - 1));
        for (std::size_t j = 1; j < m; ++j) {
            for (std::size_t i = 1; i < n; ++i) {
                const double c = t[i] - b[i], e = r[j] - l[j];
                const double v = (l[j] + e * b[i]) / (1 - e * c);
                const double u = b[i] + c * v;
                draft.points.push_back(
                    (1 - v) * draft.at(sides.bottom[i]) + v * draft.at(sides.top[i]) +
                    (1 - u) * draft.at(sides.left[j]) + u * draft.at(sides.right[j]) -
                    ((1 - u) * (1 - v) * c0 + u * (1 - v) * c1 + u * v * c2 + (1 - u) * v * c3));
            }
        }
    }
    const auto node = [&](std::size_t i, std::size_t j) {
        if (j == 0) return sides.bottom[i];
        if (j == m) return sides.top[i];
        if (i == 0) return sides.left[j];
        if (i == n) return sides.right[j];
        return first + static_cast<Index>((j - 1) * (n - 1) + i - 1);
    };
    if (n == 1) {
        for (std::size_t j = 1; j < m; ++j) draft.link(sides.left[j], sides.right[j]);
    }
    if (m == 1) {
        for (std::size_t i = 1; i < n; ++i) draft.link(sides.bottom[i], sides.top[i]);
    }
    for (std::size_t j = 0; j < m; ++j) {
        for (std::size_t i = 0; i < n; ++i)
            draft.quads.push_back({node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)});
    }
}

/// A chain of new nodes between two places of the unit square, ends given.
Cycle chain_between(Draft& draft, const Coons& coons, const Vec2& from, const Vec2& to, Index first,
                    Index last, std::size_t edges)
{
    Cycle chain{first};
    for (std::size_t i = 1; i < edges; ++i) {
        const double f = static_cast<double>(i) / static_cast<double>(edges);
        chain.push_back(draft.add(coons((1 - f) * from + f * to)));
    }
    chain.push_back(last);
    return chain;
}

/// A place in a row of `count` edges for something `share` of the way along; never at the ends.
std::size_t inner_place(std::size_t count, double share)
{
    const auto at = static_cast<std::size_t>(std::lround(static_cast<double>(count) * share));
    return std::clamp<std::size_t>(at, 1, count - 1);
}

/// k columns come up from the bottom and leave to the right: one node of three quads, one of five.
///
///    +------+-----------+
///    |      |           |     bottom = x + k + x1, top = x + x1
///    |      5-----------+     left = y + y1, right = y + k + y1
///    |      |\          |
///    |      | \ k       |     The side from 5 to 3 has k edges.
///    +------5  3--------+
///    |      |k |        |
///    +------+--+--------+
void fill_turned(Draft& draft, const Sides& s, std::size_t k)
{
    const std::size_t c = s.top.size() - 1, d = s.left.size() - 1;
    const std::size_t x = inner_place(c, 0.5), y = inner_place(d, 0.5);
    const Coons coons(draft, s);
    const Vec2 at5 = (coons.crossing(x, x, y, y + k) + coons.crossing(x, x, y, y)) / 2;
    const Vec2 at3 = coons.crossing(x + k, x, y, y);
    const Index five = draft.add(coons(at5)), three = draft.add(coons(at3));
    const auto bottom = [&](std::size_t i) { return Vec2(fractions(draft, s.bottom)[i], 0); };
    const auto right = [&](std::size_t i) { return Vec2(1, fractions(draft, s.right)[i]); };
    const Cycle down5 = chain_between(draft, coons, bottom(x), at5, s.bottom[x], five, y);
    const Cycle down3 = chain_between(draft, coons, bottom(x + k), at3, s.bottom[x + k], three, y);
    const Cycle west = chain_between(draft, coons, Vec2(0, fractions(draft, s.left)[y]), at5, s.left[y], five,
                                     x);
    const Cycle north = chain_between(draft, coons, at5, Vec2(fractions(draft, s.top)[x], 1), five, s.top[x],
                                      d - y);
    const Cycle slant = chain_between(draft, coons, at5, at3, five, three, k);
    const Cycle east3 = chain_between(draft, coons, at3, right(y), three, s.right[y], c - x);
    const Cycle east5 = chain_between(draft, coons, at5, right(y + k), five, s.right[y + k], c - x);
    const std::size_t a = s.bottom.size() - 1, b = s.right.size() - 1;
    fill_grid(draft, {part(s.bottom, 0, x), down5, west, part(s.left, 0, y)});
    fill_grid(draft, {part(s.bottom, x, x + k), down3, slant, down5});
    fill_grid(draft, {part(s.bottom, x + k, a), part(s.right, 0, y), east3, down3});
    fill_grid(draft, {east3, part(s.right, y, y + k), east5, turned(slant)});
    fill_grid(draft, {west, north, part(s.top, 0, x), part(s.left, y, d)});
    fill_grid(draft, {east5, part(s.right, y + k, b), part(s.top, x, c), north});
}

using Counts = std::array<long, 4>;

Counts counts_of(const Sides& s)
{
    return {static_cast<long>(s.bottom.size()) - 1, static_cast<long>(s.right.size()) - 1,
            static_cast<long>(s.top.size()) - 1, static_cast<long>(s.left.size()) - 1};
}

/// Turn the patch over to an equal one: left and right, or bottom and top exchanged.
Sides swap_left_right(const Sides& s) { return {turned(s.bottom), s.left, turned(s.top), s.right}; }
Sides swap_bottom_top(const Sides& s) { return {s.top, turned(s.right), s.bottom, turned(s.left)}; }
/// Exchange rows and columns.
Sides transpose(const Sides& s) { return {s.left, s.top, s.right, s.bottom}; }

bool can_fill_four(Counts n)
{
    if (n[0] < n[2]) std::swap(n[0], n[2]);
    if (n[1] < n[3]) std::swap(n[1], n[3]);
    const long da = n[0] - n[2], db = n[1] - n[3];
    if ((da + db) % 2 != 0) return false;
    if (da == 0 && db == 0) return n[0] > 0 && n[1] > 0;
    if (da == db) return n[2] >= 2 && n[3] >= 2;
    const long least_top = da > db ? n[2] : n[3];
    const long rows = (da > db ? n[3] : n[2]) - (std::max(da, db) - std::min(da, db)) / 2;
    return least_top >= 4 && rows >= 2;
}

/// @pre can_fill_four()
void fill_four(Draft& draft, Sides s)
{
    const std::size_t first_quad = draft.quads.size();
    bool mirrored = false;
    if (s.bottom.size() < s.top.size()) {
        s = swap_bottom_top(s);
        mirrored = !mirrored;
    }
    if (s.right.size() < s.left.size()) {
        s = swap_left_right(s);
        mirrored = !mirrored;
    }
    const Counts n = counts_of(s);
    const long da = n[0] - n[2], db = n[1] - n[3];
    if (da == 0 && db == 0) {
        fill_grid(draft, s);
    } else if (da == db) {
        fill_turned(draft, s, static_cast<std::size_t>(da));
    } else {
        if (da < db) {
            s = transpose(s);
            mirrored = !mirrored;
        }
        // Two turns: some columns leave to the left, the others to the right. A line between them.
        const Counts m = counts_of(s);
        const long more = m[0] - m[2], to_left = (more - (m[1] - m[3])) / 2;
        const long rows = m[3] - to_left;
        const auto top = static_cast<std::size_t>(m[2] / 2);
        const std::size_t bottom = top + static_cast<std::size_t>(to_left);
        const Coons coons(draft, s);
        const Cycle line = chain_between(draft, coons, Vec2(fractions(draft, s.bottom)[bottom], 0),
                                         Vec2(fractions(draft, s.top)[top], 1), s.bottom[bottom], s.top[top],
                                         static_cast<std::size_t>(rows));
        fill_four(draft, {part(s.bottom, 0, bottom), line, part(s.top, 0, top), s.left});
        fill_four(draft, {part(s.bottom, bottom, s.bottom.size() - 1), s.right,
                          part(s.top, top, s.top.size() - 1), line});
    }
    if (!mirrored) return;
    for (std::size_t q = first_quad; q < draft.quads.size(); ++q)
        std::swap(draft.quads[q][1], draft.quads[q][3]);
}

/// Edges p[i] from corner i to the foot on side i of the line from the centre, for a patch of 3 or 5 sides;
/// empty where it does not go.
///
/// The block at corner i lies between the lines to sides i and i − 1. Its opposite sides have as many edges
/// where the line to side i has p[i + 1] edges and p[i] + p[i + 2] = side i. With 3 or 5 sides that has one
/// solution.
std::vector<long> shares(std::span<const std::size_t> sides)
{
    const auto n = sides.size();
    std::vector<long> p(n);
    long sum = 0, sign = 1;
    std::size_t at = 0;
    for (std::size_t step = 0; step < n; ++step) {
        sum += sign * static_cast<long>(sides[at]);
        sign = -sign;
        at = (at + 2) % n;
    }
    if (sum % 2 != 0) return {};
    p[0] = sum / 2;
    at = 0;
    for (std::size_t step = 1; step < n; ++step) {
        const std::size_t next = (at + 2) % n;
        p[next] = static_cast<long>(sides[at]) - p[at];
        at = next;
    }
    for (const long v : p) {
        if (v < 1) return {};
    }
    return p;
}

bool fill_star(Draft& draft, const std::vector<Cycle>& side)
{
    const std::size_t n = side.size();
    std::vector<std::size_t> edges;
    for (const Cycle& chain : side) edges.push_back(chain.size() - 1);
    const std::vector<long> p = shares(edges);
    if (p.empty()) return false;
    std::vector<std::size_t> foot(n), lines(n);
    Vec2 centre = Vec2::Zero();
    for (std::size_t i = 0; i < n; ++i) {
        foot[i] = static_cast<std::size_t>(p[i]);
        lines[i] = static_cast<std::size_t>(p[(i + 1) % n]);
        centre += draft.at(side[i][foot[i]]) / static_cast<double>(n);
    }
    const Index middle = draft.add(centre);
    std::vector<Cycle> line(n);
    for (std::size_t i = 0; i < n; ++i) {
        const Vec2 from = draft.at(side[i][foot[i]]);
        line[i].push_back(side[i][foot[i]]);
        for (std::size_t k = 1; k < lines[i]; ++k) {
            const double f = static_cast<double>(k) / static_cast<double>(lines[i]);
            line[i].push_back(draft.add((1 - f) * from + f * centre));
        }
        line[i].push_back(middle);
    }
    for (std::size_t i = 0; i < n; ++i) {
        // The block at the corner where side i begins.
        const std::size_t before = (i + n - 1) % n;
        fill_grid(draft, {part(side[i], 0, foot[i]), line[i], line[before],
                          turned(part(side[before], foot[before], side[before].size() - 1))});
    }
    return true;
}

} // namespace

bool can_fill(std::span<const std::size_t> sides)
{
    for (const std::size_t side : sides) {
        if (side == 0) return false;
    }
    if (sides.size() == 4) {
        return can_fill_four({static_cast<long>(sides[0]), static_cast<long>(sides[1]),
                              static_cast<long>(sides[2]), static_cast<long>(sides[3])});
    }
    return (sides.size() == 3 || sides.size() == 5) && !shares(sides).empty();
}

std::vector<std::size_t> star_feet(std::span<const std::size_t> sides)
{
    const std::vector<long> p = shares(sides);
    return {p.begin(), p.end()};
}

bool fill_patch(Draft& draft, const Cycle& cycle, std::span<const std::size_t> corners)
{
    std::vector<Cycle> side;
    std::vector<std::size_t> edges;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        side.push_back(stretch(cycle, corners[i], corners[(i + 1) % corners.size()]));
        edges.push_back(side.back().size() - 1);
    }
    if (!can_fill(edges)) return false;
    if (side.size() == 4)
        fill_four(draft, {side[0], side[1], turned(side[2]), turned(side[3])});
    else
        fill_star(draft, side);
    return true;
}

void fill_small(Draft& draft, const Cycle& c)
{
    if (c.size() == 4) {
        draft.quads.push_back({c[0], c[1], c[2], c[3]});
        return;
    }
    std::vector<Quad> best;
    double best_worst = -2;
    for (std::size_t i = 0; i < 3; ++i) {
        const Quad one{c[i], c[i + 1], c[i + 2], c[i + 3]};
        const Quad two{c[i + 3], c[(i + 4) % 6], c[(i + 5) % 6], c[i]};
        const double worst = std::min(least_sine(draft, one), least_sine(draft, two));
        if (worst <= best_worst || one[0] == one[3] || draft.linked(one[0], one[3])) continue;
        best_worst = worst;
        best = {one, two};
    }
    // Three quads about a node in the middle, where two would be flat.
    Vec2 middle = Vec2::Zero();
    for (const Index p : c) middle += draft.at(p) / 6;
    const Index centre = draft.add(middle);
    bool used = false;
    for (std::size_t i = 0; i < 2; ++i) {
        std::vector<Quad> three;
        double worst = 1;
        for (std::size_t k = 0; k < 3; ++k) {
            const std::size_t at = i + 2 * k;
            three.push_back({c[at % 6], c[(at + 1) % 6], c[(at + 2) % 6], centre});
            worst = std::min(worst, least_sine(draft, three.back()));
        }
        // A third quad must be worth it.
        if (!best.empty() && worst <= best_worst + 0.3) continue;
        best_worst = worst + 0.3;
        best = three;
        used = true;
    }
    if (!used) {
        draft.points.pop_back();
        draft.link(best.front()[0], best.front()[3]);
    }
    draft.quads.insert(draft.quads.end(), best.begin(), best.end());
}

} // namespace lacuna::quads::paving
