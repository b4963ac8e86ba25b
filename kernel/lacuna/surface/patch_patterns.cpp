// SPDX-License-Identifier: MIT
#include <lacuna/surface/patch_patterns.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace lacuna::surface {

namespace {

using Chain = std::vector<Index>; ///< point numbers along a line, both ends included

constexpr std::size_t kMostSides = 7;
/// Cuts are not looked at that slant more, or have that much fewer or more quads along than their length has room for.
constexpr double kMostSlant = 0.7, kShortest = 0.6, kLongest = 1.6;

/// Numbers of quads along the sides of a patch.
struct Lengths {
    std::array<int, kMostSides> side{};
    std::size_t count = 0;

    [[nodiscard]] int operator[](std::size_t i) const { return side[i % count]; }
    void add(int length)
    {
        if (count < kMostSides) side[count] = length;
        ++count;
    }
};

Lengths lengths_of(std::size_t loop, std::span<const std::size_t> corners)
{
    Lengths lengths;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const std::size_t next = i + 1 < corners.size() ? corners[i + 1] : corners[0] + loop;
        lengths.add(static_cast<int>(next - corners[i]));
    }
    return lengths;
}

/// How far from its first corner each side is split when grids meet at one point inside; side i is
/// split[i] + split[i + 2] long. False where that has no solution in whole numbers above 0.
///
/// Of a part whose last side is a cut, the first may be 0: then the grids meet at a point of the cut.
bool splits(const Lengths& lengths, bool is_cut, std::array<int, kMostSides>& split)
{
    const std::size_t n = lengths.count;
    for (std::size_t i = 0; i < n; ++i) {
        int twice = 0;
        for (std::size_t j = 0, at = i; j < n; ++j, at = at + 2 < n ? at + 2 : at + 2 - n)
            twice += j % 2 == 0 ? lengths.side[at] : -lengths.side[at];
        if (twice < (is_cut && i == 0 ? 0 : 2) || twice % 2 != 0) return false;
        split[i] = twice / 2;
    }
    return true;
}

/// Can it be filled without a cut?
bool is_base(const Lengths& lengths, bool is_cut)
{
    std::array<int, kMostSides> split;
    if (lengths.count == 4) return lengths[0] == lengths[2] && lengths[1] == lengths[3];
    return (lengths.count == 3 || lengths.count == 5) && splits(lengths, is_cut, split);
}

class Filler {
public:
    explicit Filler(std::span<const Vec2> loop) : points_(loop.begin(), loop.end()) {}

    /// @pre  is_base()
    void fill(const std::vector<Chain>& sides, bool is_cut)
    {
        if (sides.size() == 4) {
            grid(sides[0], sides[1], reversed(sides[2]), reversed(sides[3]));
            return;
        }
        Lengths lengths;
        for (const Chain& side : sides) lengths.add(static_cast<int>(side.size()) - 1);
        std::array<int, kMostSides> split;
        splits(lengths, is_cut, split);
        const std::size_t n = sides.size();
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
            Chain next = j == n ? top : Chain{left[j]};
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

/// A cut from `from` to `to`, places in the loop, of so many pieces.
struct Cut {
    std::size_t from, to;
    int pieces;
    double fault; ///< the less, the straighter and squarer
};

/// The sides of the two parts of a cut loop: from `cut.from` forward to `cut.to`, and the rest.
struct Halves {
    Lengths first, second;
};

Halves halves(const Lengths& lengths, std::span<const std::size_t> corners, std::size_t loop,
              std::size_t side, std::size_t between, const Cut& cut)
{
    // Side `side` is cut at `from`; `between` corners on is the side that is cut at `to`.
    const std::size_t n = corners.size();
    const int before = static_cast<int>(cut.from - corners[side]);
    const std::size_t other = (side + between) % n;
    const int beyond = static_cast<int>((cut.to + loop - corners[other]) % loop);
    Halves parts;
    parts.first.add(lengths[side] - before);
    for (std::size_t k = 1; k < between; ++k) parts.first.add(lengths[side + k]);
    parts.first.add(beyond);
    parts.first.add(cut.pieces);
    parts.second.add(lengths[other] - beyond);
    for (std::size_t k = between + 1; k < n; ++k) parts.second.add(lengths[side + k]);
    parts.second.add(before);
    parts.second.add(cut.pieces);
    return parts;
}

/// How far from square a straight cut meets the sides: 0 to 1.
double slant_of(std::span<const Vec2> loop, std::size_t from, std::size_t to)
{
    const std::size_t n = loop.size();
    const Vec2 along = (loop[to] - loop[from]).normalized();
    const auto slant = [&](std::size_t i) {
        const Vec2 side = loop[(i + 1) % n] - loop[(i + n - 1) % n];
        return std::abs(side.dot(along)) / std::max(side.norm(), std::numeric_limits<double>::min());
    };
    return (slant(from) + slant(to)) / 2;
}

/// Cuts that leave two parts to be filled without another.
std::vector<Cut> cuts(std::span<const Vec2> loop, std::span<const std::size_t> corners, std::size_t most)
{
    const Lengths lengths = lengths_of(loop.size(), corners);
    const std::size_t n = corners.size();
    double spacing = 0;
    for (std::size_t i = 0; i < loop.size(); ++i)
        spacing += (loop[(i + 1) % loop.size()] - loop[i]).norm() / static_cast<double>(loop.size());
    std::vector<Cut> found;
    // Between the two sides cut there are one or three corners: a part of four sides, a strip, mends nothing.
    const std::size_t between = n / 2 - (n == 4 ? 1 : 0);
    for (std::size_t side = 0; side < n; ++side) {
        const std::size_t other = (side + between) % n;
        for (int a = 1; a < lengths[side]; ++a) {
            for (int b = 1; b < lengths[other]; ++b) {
                const std::size_t from = corners[side] + static_cast<std::size_t>(a);
                const std::size_t to = corners[other] + static_cast<std::size_t>(b);
                const std::size_t start = from % loop.size(), end = to % loop.size();
                const double slant = slant_of(loop, start, end);
                if (slant > kMostSlant) continue;
                const double pieces = (loop[end] - loop[start]).norm() / spacing;
                int low = std::max(1, static_cast<int>(pieces * kShortest));
                if ((to - from + static_cast<std::size_t>(low)) % 2 != 0) ++low; // parts have even outlines
                const int high = static_cast<int>(pieces * kLongest) + 1;
                for (int k = low; k <= high; k += 2) {
                    const Halves parts = halves(lengths, corners, loop.size(), side, between,
                                                {from, to, k, 0});
                    if (!is_base(parts.first, true) || !is_base(parts.second, true)) continue;
                    const double fault = std::abs(std::log(pieces / k)) + slant;
                    found.push_back({start, end, k, fault});
                }
            }
        }
    }
    const auto best = found.begin() + static_cast<std::ptrdiff_t>(std::min(most, found.size()));
    std::partial_sort(found.begin(), best, found.end(),
                      [](const Cut& x, const Cut& y) { return x.fault < y.fault; });
    found.erase(best, found.end());
    return found;
}

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

int fewest_irregular(std::size_t loop, std::span<const std::size_t> corners)
{
    if (corners.size() < 2 || corners.size() > 6) return std::numeric_limits<int>::max();
    const bool even = corners.size() % 2 == 0;
    if (!is_base(lengths_of(loop, corners), false)) return even ? 2 : std::numeric_limits<int>::max();
    return even ? 0 : 1;
}

std::vector<Filling> fillings(std::span<const Vec2> loop, std::span<const std::size_t> corners,
                              std::size_t most)
{
    std::vector<Filling> result;
    if (corners.size() < 2 || corners.size() > 6 || loop.size() % 2 != 0) return result;
    if (is_base(lengths_of(loop.size(), corners), false)) {
        Filler filler(loop);
        filler.fill(sides_between(corners[0], corners[0], loop.size(), corners), false);
        result.push_back(filler.finish(loop.size()));
        return result;
    }
    if (corners.size() % 2 != 0) return result;
    for (const Cut& cut : cuts(loop, corners, most)) {
        Filler filler(loop);
        const Chain middle = filler.line(static_cast<Index>(cut.to), static_cast<Index>(cut.from),
                                         cut.pieces);
        for (const bool first : {true, false}) {
            std::vector<Chain> sides = first ? sides_between(cut.from, cut.to, loop.size(), corners)
                                             : sides_between(cut.to, cut.from, loop.size(), corners);
            sides.push_back(first ? middle : Filler::reversed(middle));
            filler.fill(sides, true);
        }
        result.push_back(filler.finish(loop.size()));
    }
    return result;
}

} // namespace lacuna::surface
