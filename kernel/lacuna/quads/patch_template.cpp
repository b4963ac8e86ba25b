// SPDX-License-Identifier: MIT
#include <lacuna/quads/detail/patch_template.h>

#include <lacuna/geometry/transfinite.h>

#include <algorithm>

namespace lacuna::quads {

namespace {

using Chain = std::vector<Index>; ///< point numbers along a line, both ends included

Chain reversed(Chain chain)
{
    std::reverse(chain.begin(), chain.end());
    return chain;
}

class TemplateFiller {
public:
    explicit TemplateFiller(std::span<const Vec2> loop) : loop_(loop.size())
    {
        // A patch as long as wide has this many points; others have fewer, as a rule.
        const std::size_t most = (loop_ / 4 + 1) * (loop_ / 4 + 1);
        points_.reserve(loop_ + most);
        points_.assign(loop.begin(), loop.end());
        quads_.reserve(most);
    }

    /// @pre  the sides need no cut
    void fill(const std::vector<Chain>& sides, bool ends_in_cut)
    {
        if (sides.size() == 4)
            grid(sides[0], sides[1], reversed(sides[2]), reversed(sides[3]));
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
        std::vector<int> valence(points_.size(), 0);
        for (const Quad& quad : mesh.quads) {
            for (const Index p : quad) ++valence[index(p)];
        }
        mesh.irregular = static_cast<int>(
            std::count_if(valence.begin() + inner, valence.end(), [](int v) { return v != 4; }));
        return mesh;
    }

private:
    [[nodiscard]] const Vec2& at(Index p) const { return points_[index(p)]; }
    Index add(const Vec2& p)
    {
        points_.push_back(p);
        return static_cast<Index>(points_.size()) - 1;
    }

    /// Grids around a node in the middle, or on the cut.
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
        if (on_cut) { // the cut is both spokes that end there
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

    /// left--top-->     bottom and top run alike, so do left and right
    void grid(const Chain& bottom, const Chain& right, const Chain& top, const Chain& left)
    {
        const std::size_t m = bottom.size() - 1, n = left.size() - 1;
        if (m == 0 || n == 0) return;
        const auto first = static_cast<Index>(points_.size());
        if (m > 1 && n > 1) {
            const auto side = [&](const Chain& chain) {
                std::vector<Vec2> points;
                points.reserve(chain.size());
                for (const Index p : chain) points.push_back(at(p));
                return points;
            };
            const std::vector<Vec2> nodes = geometry::transfinite(side(bottom), side(right), side(top),
                                                                  side(left));
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

/// The sides of a part of the loop, from one position on to another, cut at the corners between.
std::vector<Chain> sides_between(std::size_t from, std::size_t to, std::size_t loop,
                                 std::span<const std::size_t> corners)
{
    std::vector<Chain> sides{{static_cast<Index>(from)}};
    for (std::size_t i = from; i != to || sides.back().size() == 1;) {
        i = (i + 1) % loop;
        sides.back().push_back(static_cast<Index>(i));
        if (i == to) break;
        if (std::find(corners.begin(), corners.end(), i) != corners.end())
            sides.push_back({static_cast<Index>(i)});
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
