// SPDX-License-Identifier: MIT
#include <lacuna/quads/detail/patch_template.h>

#include <lacuna/geometry/shared/transfinite.h>
#include <lacuna/quads/detail/plane_stars.h>

#include <algorithm>

namespace lacuna::quads {

namespace {

using Chain = std::vector<Index>; ///< point numbers along a line, both ends included

Chain reversed(Chain chain)
{
    std::ranges::reverse(chain);
    return chain;
}

Chain part(const Chain& chain, std::size_t from, std::size_t to)
{
    return {chain.begin() + static_cast<std::ptrdiff_t>(from),
            chain.begin() + static_cast<std::ptrdiff_t>(to) + 1};
}
Chain rest(const Chain& chain, std::size_t from) { return part(chain, from, chain.size() - 1); }

/// Four sides of a patch. Bottom and top run from left to right; left and right run from bottom to top.
struct FourSides {
    Chain bottom, right, top, left;
};

/// The position in the middle of a row of at least two edges. It is never an end of the row.
std::size_t middle_of(std::size_t edges) { return std::clamp<std::size_t>((edges + 1) / 2, 1, edges - 1); }

class TemplateFiller {
public:
    explicit TemplateFiller(std::span<const Vec2> loop) : loop_(loop.size())
    {
        // A square patch has this many points. Other patches usually have fewer.
        const std::size_t most = (loop_ / 4 + 1) * (loop_ / 4 + 1);
        points_.reserve(loop_ + most);
        points_.assign(loop.begin(), loop.end());
        quads_.reserve(most);
    }

    /// @pre  `can_fill()`, or the sides end in a cut of `find_cuts()`
    void fill(const std::vector<Chain>& sides, bool ends_in_cut)
    {
        if (sides.size() == 4)
            fill_four({sides[0], sides[1], reversed(sides[2]), reversed(sides[3])});
        else
            star(sides, ends_in_cut);
    }

    /// A straight line of new points.
    Chain line(Index from, Index to, int edges)
    {
        Chain chain{from};
        const Vec2 a = at(from), b = at(to);
        for (int k = 1; k < edges; ++k) chain.push_back(add(a + (b - a) * k / edges));
        chain.push_back(to);
        return chain;
    }

    TemplateMesh finish()
    {
        TemplateMesh mesh;
        const auto inner = static_cast<std::ptrdiff_t>(loop_);
        mesh.inner.assign(points_.begin() + inner, points_.end());
        mesh.quads = std::move(quads_);
        const std::vector<Index> valence = valences(mesh.quads, points_.size());
        mesh.irregular = static_cast<int>(
            std::count_if(valence.begin() + inner, valence.end(), [](Index v) { return v != 4; }));
        return mesh;
    }

private:
    [[nodiscard]] const Vec2& at(Index p) const { return points_[index(p)]; }
    Index add(const Vec2& p)
    {
        points_.push_back(p);
        return static_cast<Index>(points_.size()) - 1;
    }

    /// Fill with one grid at each corner, around a node in the middle or a node on the cut.
    void star(const std::vector<Chain>& sides, bool ends_in_cut)
    {
        const std::size_t n = sides.size();
        SideCounts counts{{}, n};
        for (std::size_t i = 0; i < n; ++i) counts.side[i] = static_cast<int>(sides[i].size()) - 1;
        std::array<int, kMostSides> foot{};
        spoke_feet(counts, ends_in_cut, foot);
        const auto foot_of = [&](std::size_t i) { return sides[i][static_cast<std::size_t>(foot[i])]; };
        Vec2 centre(0, 0);
        for (std::size_t i = 0; i < n; ++i) centre += at(foot_of(i)) / static_cast<double>(n);
        const bool on_cut = foot[0] == 0;
        const Index middle = on_cut ? foot_of(n - 1) : add(centre);
        std::vector<Chain> spokes;
        for (std::size_t i = 0; i < n; ++i) {
            const int edges = foot[(i + 1) % n];
            spokes.push_back(edges > 0 && (!on_cut || (i != 0 && i != n - 2))
                                 ? line(foot_of(i), middle, edges)
                                 : Chain{middle});
        }
        if (on_cut) { // the cut consists of the two spokes that end there
            const auto at_middle = sides[n - 1].begin() + foot[n - 1];
            spokes[0] = reversed(Chain(at_middle, sides[n - 1].end()));
            spokes[n - 2] = Chain(sides[n - 1].begin(), at_middle + 1);
        }
        for (std::size_t i = 0; i < n; ++i) {
            const std::size_t last = (i + n - 1) % n;
            const Chain bottom(sides[i].begin(), sides[i].begin() + foot[i] + 1);
            const Chain left = reversed(Chain(sides[last].begin() + foot[last], sides[last].end()));
            grid(bottom, spokes[i], spokes[last], left);
        }
    }

    /// Fill four sides whose numbers of edges may differ.
    void fill_four(FourSides s)
    {
        const std::size_t first_quad = quads_.size();
        bool mirrored = false;
        if (s.bottom.size() < s.top.size()) {
            s = {s.top, reversed(s.right), s.bottom, reversed(s.left)};
            mirrored = !mirrored;
        }
        if (s.right.size() < s.left.size()) {
            s = {reversed(s.bottom), s.left, reversed(s.top), s.right};
            mirrored = !mirrored;
        }
        if (s.bottom.size() - s.top.size() < s.right.size() - s.left.size()) {
            s = {reversed(s.right), reversed(s.bottom), reversed(s.left), reversed(s.top)};
            mirrored = !mirrored;
        }
        const std::size_t more = s.bottom.size() - s.top.size(), less = s.right.size() - s.left.size();
        if (more == 0)
            grid(s.bottom, s.right, s.top, s.left);
        else if (more == less)
            turn_columns(s, more);
        else
            turn_both_ways(s, (more - less) / 2);
        if (!mirrored) return;
        for (std::size_t q = first_quad; q < quads_.size(); ++q) std::swap(quads_[q][1], quads_[q][3]);
    }

    /// Turn some columns to the left and the others to the right, with a line between both groups.
    void turn_both_ways(const FourSides& s, std::size_t to_left)
    {
        const std::size_t edges = s.left.size() - 1 - to_left;
        const std::size_t top = (s.top.size() - 1) / 2, bottom = top + to_left;
        Chain line;
        {
            const PatchPoints points = points_of(s);
            const auto patch = points.patch();
            line = chain(patch, {patch.bottom(bottom), 0}, {patch.top(top), 1}, s.bottom[bottom], s.top[top],
                         edges);
        }
        fill_four({part(s.bottom, 0, bottom), line, part(s.top, 0, top), s.left});
        fill_four({rest(s.bottom, bottom), s.right, rest(s.top, top), line});
    }

    /// Turn k columns, which enter at the bottom, to the right. They turn around one node of three quads and
    /// one node of five quads.
    ///
    ///    +------+-----------+
    ///    |      |           |     bottom = x + k + x1, top = x + x1
    ///    |      5-----------+     left = y + y1, right = y + k + y1
    ///    |      |\          |
    ///    |      | \ k       |     The line from 5 to 3 has k edges.
    ///    +------5  3--------+
    ///    |      |k |        |
    ///    +------+--+--------+
    void turn_columns(const FourSides& s, std::size_t k)
    {
        const std::size_t c = s.top.size() - 1, d = s.left.size() - 1;
        const std::size_t x = middle_of(c), y = middle_of(d);
        const PatchPoints points = points_of(s);
        const auto patch = points.patch();
        const Vec2 at5 = (patch.crossing(x, x, y, y + k) + patch.crossing(x, x, y, y)) / 2;
        const Vec2 at3 = patch.crossing(x + k, x, y, y);
        const Index five = add(patch(at5)), three = add(patch(at3));
        const Chain down5 = chain(patch, {patch.bottom(x), 0}, at5, s.bottom[x], five, y);
        const Chain down3 = chain(patch, {patch.bottom(x + k), 0}, at3, s.bottom[x + k], three, y);
        const Chain west = chain(patch, {0, patch.left(y)}, at5, s.left[y], five, x);
        const Chain north = chain(patch, at5, {patch.top(x), 1}, five, s.top[x], d - y);
        const Chain slant = chain(patch, at5, at3, five, three, k);
        const Chain east3 = chain(patch, at3, {1, patch.right(y)}, three, s.right[y], c - x);
        const Chain east5 = chain(patch, at5, {1, patch.right(y + k)}, five, s.right[y + k], c - x);
        grid(part(s.bottom, 0, x), down5, west, part(s.left, 0, y));
        grid(part(s.bottom, x, x + k), down3, slant, down5);
        grid(rest(s.bottom, x + k), part(s.right, 0, y), east3, down3);
        grid(east3, part(s.right, y, y + k), east5, reversed(slant));
        grid(west, north, part(s.top, 0, x), rest(s.left, y));
        grid(east5, rest(s.right, y + k), rest(s.top, x), north);
    }

    /// A chain of new points between two positions of the unit square.
    Chain chain(const geometry::CoonsPatch<Vec2>& patch, const Vec2& from, const Vec2& to, Index first,
                Index last, std::size_t edges)
    {
        Chain points{first};
        for (std::size_t i = 1; i < edges; ++i) {
            const double f = static_cast<double>(i) / static_cast<double>(edges);
            points.push_back(add(patch((1 - f) * from + f * to)));
        }
        points.push_back(last);
        return points;
    }

    /// The points of four sides. They are copied, because the points of the mesh move in memory when the mesh
    /// grows.
    struct PatchPoints {
        std::vector<Vec2> bottom, right, top, left;
        [[nodiscard]] geometry::CoonsPatch<Vec2> patch() const { return {bottom, right, top, left}; }
    };
    [[nodiscard]] PatchPoints points_of(const FourSides& s) const
    {
        return {points_of(s.bottom), points_of(s.right), points_of(s.top), points_of(s.left)};
    }
    [[nodiscard]] std::vector<Vec2> points_of(const Chain& chain) const
    {
        std::vector<Vec2> points;
        points.reserve(chain.size());
        for (const Index p : chain) points.push_back(at(p));
        return points;
    }

    /// Fill a grid between four chains. Bottom and top have the same direction, and so have left and right.
    void grid(const Chain& bottom, const Chain& right, const Chain& top, const Chain& left)
    {
        const std::size_t m = bottom.size() - 1, n = left.size() - 1;
        if (m == 0 || n == 0) return;
        const auto first = static_cast<Index>(points_.size());
        if (m > 1 && n > 1) {
            const std::vector<Vec2> nodes = geometry::transfinite(points_of(bottom), points_of(right),
                                                                  points_of(top), points_of(left));
            for (std::size_t j = 1; j < n; ++j) {
                for (std::size_t i = 1; i < m; ++i) points_.push_back(nodes[j * (m + 1) + i]);
            }
        }
        const auto node = [&](std::size_t i, std::size_t j) {
            if (j == 0) return bottom[i];
            if (j == n) return top[i];
            if (i == 0) return left[j];
            if (i == m) return right[j];
            return first + static_cast<Index>((j - 1) * (m - 1) + i - 1);
        };
        for (std::size_t j = 0; j < n; ++j) {
            for (std::size_t i = 0; i < m; ++i)
                quads_.push_back({node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)});
        }
    }

    std::size_t loop_;
    std::vector<Vec2> points_;
    std::vector<Quad> quads_;
};

/// The sides of a part of the loop between two positions, divided at the corners of the loop.
std::vector<Chain> sides_between(std::size_t from, std::size_t to, std::size_t loop,
                                 std::span<const std::size_t> corners)
{
    std::vector<Chain> sides{{static_cast<Index>(from)}};
    for (std::size_t i = from; i != to || sides.back().size() == 1;) {
        i = (i + 1) % loop;
        sides.back().push_back(static_cast<Index>(i));
        if (i == to) break;
        if (std::ranges::find(corners, i) != corners.end()) sides.push_back({static_cast<Index>(i)});
    }
    return sides;
}

} // namespace

TemplateMesh fill_template(std::span<const Vec2> loop, std::span<const std::size_t> corners,
                           const TemplateCut& cut)
{
    TemplateFiller filler(loop);
    if (cut.edges == 0) {
        filler.fill(sides_between(corners[0], corners[0], loop.size(), corners), false);
        return filler.finish();
    }
    const Chain middle = filler.line(static_cast<Index>(cut.to), static_cast<Index>(cut.from), cut.edges);
    for (const bool first : {true, false}) {
        std::vector<Chain> sides = first ? sides_between(cut.from, cut.to, loop.size(), corners)
                                         : sides_between(cut.to, cut.from, loop.size(), corners);
        sides.push_back(first ? middle : reversed(middle));
        filler.fill(sides, true);
    }
    return filler.finish();
}

} // namespace lacuna::quads
