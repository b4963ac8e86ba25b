// SPDX-License-Identifier: MIT
#include <lacuna/quads/detail/patch_patterns.h>

#include <lacuna/quads/detail/patch_cuts.h>

#include <algorithm>

namespace lacuna::quads {

namespace {

using Chain = std::vector<Index>; ///< point numbers along a line, both ends included

class Filler {
public:
    explicit Filler(std::span<const Vec2> loop)
    {
        // A patch as long as wide has this many points; others have fewer, as a rule.
        const std::size_t most = (loop.size() / 4 + 1) * (loop.size() / 4 + 1);
        points_.reserve(loop.size() + most);
        points_.assign(loop.begin(), loop.end());
        quads_.reserve(most);
    }

    /// @pre  it can be filled without a cut
    void fill(const std::vector<Chain>& sides, bool is_cut)
    {
        if (sides.size() == 4) {
            grid(sides[0], sides[1], reversed(sides[2]), reversed(sides[3]));
            return;
        }
        const std::size_t n = sides.size();
        SideLengths lengths{{}, n};
        for (std::size_t i = 0; i < n; ++i) lengths.side[i] = static_cast<int>(sides[i].size()) - 1;
        std::array<int, kMostSides> split{};
        splits(lengths, is_cut, split);
        const auto middle_of = [&](std::size_t i) { return sides[i][static_cast<std::size_t>(split[i])]; };
        Vec2 centre(0, 0);
        for (std::size_t i = 0; i < n; ++i) centre += at(middle_of(i)) / static_cast<double>(n);
        const Index middle = split[0] > 0 ? add(centre) : middle_of(n - 1);
        std::vector<Chain> spokes;
        for (std::size_t i = 0; i < n; ++i) {
            const int length = split[(i + 1) % n];
            spokes.push_back(length > 0 && (split[0] > 0 || (i != 0 && i != n - 2))
                                 ? line(middle_of(i), middle, length)
                                 : Chain{middle});
        }
        if (split[0] == 0) { // the cut is both spokes that end there
            const auto at_middle = sides[n - 1].begin() + split[n - 1];
            spokes[0] = reversed(Chain(at_middle, sides[n - 1].end()));
            spokes[n - 2] = Chain(sides[n - 1].begin(), at_middle + 1);
        }
        for (std::size_t i = 0; i < n; ++i) {
            const std::size_t last = (i + n - 1) % n;
            const Chain bottom(sides[i].begin(), sides[i].begin() + split[i] + 1);
            const Chain left = reversed(Chain(sides[last].begin() + split[last], sides[last].end()));
            grid(bottom, spokes[i], spokes[last], left);
        }
    }

    /// A straight line of new points.
    Chain line(Index from, Index to, int pieces)
    {
        Chain chain{from};
        const Vec2 a = at(from), b = at(to);
        for (int k = 1; k < pieces; ++k) chain.push_back(add(a + (b - a) * k / pieces));
        chain.push_back(to);
        return chain;
    }

    static Chain reversed(Chain chain)
    {
        std::reverse(chain.begin(), chain.end());
        return chain;
    }

    Filling finish(std::size_t loop)
    {
        Filling filling;
        filling.inner.assign(points_.begin() + static_cast<std::ptrdiff_t>(loop), points_.end());
        filling.quads = std::move(quads_);
        std::vector<int> valence(points_.size(), 0);
        for (const Quad& quad : filling.quads) {
            for (const Index p : quad) ++valence[static_cast<std::size_t>(p)];
        }
        filling.irregular = static_cast<int>(
            std::count_if(valence.begin() + static_cast<std::ptrdiff_t>(loop), valence.end(),
                          [](int v) { return v != 4; }));
        return filling;
    }

private:
    [[nodiscard]] const Vec2& at(Index p) const { return points_[static_cast<std::size_t>(p)]; }
    Index add(const Vec2& p)
    {
        points_.push_back(p);
        return static_cast<Index>(points_.size()) - 1;
    }

    /// left--top-->     bottom and top run alike, so do left and right
    void grid(const Chain& bottom, const Chain& right, const Chain& top, const Chain& left)
    {
        const std::size_t m = bottom.size() - 1, n = left.size() - 1;
        if (m == 0 || n == 0) return;
        Chain row = bottom;
        for (std::size_t j = 1; j <= n; ++j) {
            Chain next;
            next.reserve(m + 1);
            if (j == n)
                next = top;
            else
                next.push_back(left[j]);
            const double t = static_cast<double>(j) / static_cast<double>(n);
            for (std::size_t i = 1; j < n && i < m; ++i) {
                const double s = static_cast<double>(i) / static_cast<double>(m);
                const Vec2 across = (1 - s) * at(left[j]) + s * at(right[j]);
                const Vec2 up = (1 - t) * at(bottom[i]) + t * at(top[i]);
                const Vec2 corners = (1 - t) * ((1 - s) * at(bottom[0]) + s * at(bottom[m])) +
                                     t * ((1 - s) * at(top[0]) + s * at(top[m]));
                next.push_back(add(across + up - corners));
            }
            if (j < n) next.push_back(right[j]);
            for (std::size_t i = 0; i < m; ++i) quads_.push_back({row[i], row[i + 1], next[i + 1], next[i]});
            row = std::move(next);
        }
    }

    std::vector<Vec2> points_;
    std::vector<Quad> quads_;
};

/// The sides of a part of the loop: from one place on to another, cut at the corners between.
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

Filling fill(std::span<const Vec2> loop, std::span<const std::size_t> corners, const Cut& cut)
{
    Filler filler(loop);
    if (cut.pieces == 0) {
        filler.fill(sides_between(corners[0], corners[0], loop.size(), corners), false);
        return filler.finish(loop.size());
    }
    const Chain middle = filler.line(static_cast<Index>(cut.to), static_cast<Index>(cut.from), cut.pieces);
    for (const bool first : {true, false}) {
        std::vector<Chain> sides = first ? sides_between(cut.from, cut.to, loop.size(), corners)
                                         : sides_between(cut.to, cut.from, loop.size(), corners);
        sides.push_back(first ? middle : Filler::reversed(middle));
        filler.fill(sides, true);
    }
    return filler.finish(loop.size());
}

} // namespace lacuna::quads
