// SPDX-License-Identifier: MIT
#include <lacuna/quads/detail/patch_cuts.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace lacuna::quads {

namespace {

/// Cuts are not looked at that slant more, or have that much fewer or more quads along than their length has room for.
constexpr double kMostSlant = 0.7, kShortest = 0.6, kLongest = 1.6;

SideLengths lengths_of(std::size_t loop, std::span<const std::size_t> corners)
{
    SideLengths lengths{{}, corners.size()};
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const std::size_t next = i + 1 < corners.size() ? corners[i + 1] : corners[0] + loop;
        lengths.side[i] = static_cast<int>(next - corners[i]);
    }
    return lengths;
}

/// Twice what `splits()` finds for side i: every second side's length, added and subtracted in turn.
int twice_split(const SideLengths& lengths, std::size_t i)
{
    const std::size_t n = lengths.count;
    int twice = 0;
    for (std::size_t j = 0, at = i; j < n; ++j, at = at + 2 < n ? at + 2 : at + 2 - n)
        twice += j % 2 == 0 ? lengths.side[at] : -lengths.side[at];
    return twice;
}

int least_twice(bool is_cut, std::size_t i) { return is_cut && i == 0 ? 0 : 2; }

/// Can it be filled without a cut?
bool needs_no_cut(const SideLengths& lengths)
{
    std::array<int, kMostSides> split{};
    const auto& side = lengths.side;
    if (lengths.count == 4) return side[0] == side[2] && side[1] == side[3];
    return (lengths.count == 3 || lengths.count == 5) && splits(lengths, false, split);
}

/// Numbers of pieces, both ends included.
struct Pieces {
    int low, high;
};

/// For cuts between two sides of a patch, the numbers of pieces that leave two parts to be filled without another cut.
///
/// Such a cut starts `a` along the first side and ends `b` along the second. What `splits()` asks of either part is linear in
/// a, b and the pieces, each with a factor of 1 or -1: a bound from below or above on the pieces.
class PieceBounds {
public:
    PieceBounds(const SideLengths& lengths, std::size_t side, std::size_t between)
    {
        const std::size_t n = lengths.count;
        const auto along = [&](std::size_t i) { return lengths.side[(side + i) % n]; };
        // The sides of the parts with a = b = 0 and no pieces, and how they change with a and b.
        SideLengths first{{}, between + 2}, second{{}, n - between + 2};
        for (std::size_t i = 0; i < between; ++i) first.side[i] = along(i);
        for (std::size_t i = between; i < n; ++i) second.side[i - between] = along(i);
        add(first, 0, between);
        add(second, n - between, 0);
    }

    /// For one a: the tightest of those that rise with b, and of those that fall.
    struct Row {
        std::array<int, 2> low, high;

        [[nodiscard]] Pieces at(int b) const
        {
            return {std::max({1, low[0] - b, low[1] + b}), std::min(high[0] - b, high[1] + b)};
        }
    };
    [[nodiscard]] Row row(int a) const
    {
        Row row{{-kFar, -kFar}, {kFar, kFar}};
        for (std::size_t i = 0; i < count_; ++i) {
            const Bound& bound = bounds_[i];
            const int value = bound.constant + bound.a * a;
            const std::size_t rises = bound.b > 0 ? 1 : 0;
            if (bound.is_low)
                row.low[rises] = std::max(row.low[rises], value);
            else
                row.high[rises] = std::min(row.high[rises], value);
        }
        return row;
    }

private:
    static constexpr int kFar = std::numeric_limits<int>::max() / 2; ///< more than any sum of sides

    struct Bound {
        int constant = 0, a = 0, b = 0;
        bool is_low = false;
    };

    /// @param part    the cut is the last of its sides
    /// @param with_a  side of the part that changes with a, as the other does with b: the first gets shorter, the other longer
    void add(const SideLengths& part, std::size_t with_a, std::size_t with_b)
    {
        const auto change = [&](std::size_t of, std::size_t i) {
            SideLengths unit{{}, part.count};
            unit.side[of] = of == 0 ? -1 : 1;
            return twice_split(unit, i);
        };
        for (std::size_t i = 0; i < part.count; ++i) {
            // constant + a + b ± pieces >= 0
            const int sign = change(part.count - 1, i), turned = -sign;
            bounds_[count_++] = {turned * (twice_split(part, i) - least_twice(true, i)),
                                 turned * change(with_a, i), turned * change(with_b, i), sign > 0};
        }
    }

    std::array<Bound, 2 * kMostSides> bounds_{};
    std::size_t count_ = 0;
};

/// The lengths and directions that rank cuts.
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

    /// Add the cuts from one place to another.
    void add(std::size_t from, std::size_t to, Pieces pieces, std::vector<Cut>& found) const
    {
        const Vec2 across = loop_[to] - loop_[from];
        const double length = across.norm(), fitting = length / spacing_;
        pieces.low = std::max(pieces.low, static_cast<int>(fitting * kShortest));
        pieces.high = std::min(pieces.high, static_cast<int>(fitting * kLongest) + 1);
        if ((to + loop_.size() - from + static_cast<std::size_t>(pieces.low)) % 2 != 0)
            ++pieces.low; // parts have even outlines
        if (pieces.low > pieces.high || !(length > 0)) return;
        // How far from square it meets the sides, 0 to 1.
        const auto slant_at = [&](std::size_t i) {
            return std::abs(along_[i].side.dot(across / length)) / along_[i].length;
        };
        const double slant = (slant_at(from) + slant_at(to)) / 2;
        if (slant > kMostSlant) return;
        for (int k = pieces.low; k <= pieces.high; k += 2)
            found.push_back({from, to, k, std::abs(std::log(fitting / k)) + slant});
    }

private:
    struct Along {
        Vec2 side;
        double length;
    };
    std::span<const Vec2> loop_;
    std::vector<Along> along_; ///< from the place before to the one after
    double spacing_ = 0;
};

} // namespace

bool splits(const SideLengths& lengths, bool is_cut, std::array<int, kMostSides>& split)
{
    for (std::size_t i = 0; i < lengths.count; ++i) {
        const int twice = twice_split(lengths, i);
        if (twice < least_twice(is_cut, i) || twice % 2 != 0) return false;
        split[i] = twice / 2;
    }
    return true;
}

std::vector<Cut> find_cuts(std::span<const Vec2> loop, std::span<const std::size_t> corners, std::size_t most)
{
    const std::size_t n = corners.size();
    std::vector<Cut> found;
    if (n < 2 || n > 6 || loop.size() % 2 != 0) return found;
    const SideLengths lengths = lengths_of(loop.size(), corners);
    if (needs_no_cut(lengths)) found.push_back({});
    if (!found.empty() || n % 2 != 0) return found;
    const CutRanker ranker(loop);
    // Between the two sides cut there are one or three corners: a part of four sides, a strip, mends nothing.
    const std::size_t between = n / 2 - (n == 4 ? 1 : 0);
    // Sides opposite each other are a pair once.
    const std::size_t pairs = 2 * between == n ? n / 2 : n;
    for (std::size_t side = 0; side < pairs; ++side) {
        const std::size_t other = (side + between) % n;
        const PieceBounds bounds(lengths, side, between);
        for (int a = 1; a < lengths.side[side]; ++a) {
            const PieceBounds::Row row = bounds.row(a);
            for (int b = 1; b < lengths.side[other]; ++b) {
                const Pieces pieces = row.at(b);
                if (pieces.low > pieces.high) continue;
                ranker.add((corners[side] + static_cast<std::size_t>(a)) % loop.size(),
                           (corners[other] + static_cast<std::size_t>(b)) % loop.size(), pieces, found);
            }
        }
    }
    // Sides opposite each other have half as many cuts, and as many fewer of them are worth a look.
    const std::size_t kept = std::min(pairs < n ? (most + 1) / 2 : most, found.size());
    const auto best = found.begin() + static_cast<std::ptrdiff_t>(kept);
    std::partial_sort(found.begin(), best, found.end(),
                      [](const Cut& x, const Cut& y) { return x.fault < y.fault; });
    found.erase(best, found.end());
    return found;
}

int fewest_irregular(std::size_t loop, std::span<const std::size_t> corners)
{
    if (corners.size() < 2 || corners.size() > 6) return std::numeric_limits<int>::max();
    const bool even = corners.size() % 2 == 0;
    if (!needs_no_cut(lengths_of(loop, corners))) return even ? 2 : std::numeric_limits<int>::max();
    return even ? 0 : 1;
}

} // namespace lacuna::quads
