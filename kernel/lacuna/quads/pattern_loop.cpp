// SPDX-License-Identifier: MIT
#include <lacuna/quads/detail/pattern_loop.h>

#include <lacuna/core/shared/constants.h>
#include <lacuna/core/shared/criteria.h>
#include <lacuna/quads/detail/partial_mesh.h>
#include <lacuna/quads/shared/measure_plane.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>

namespace lacuna::quads {
namespace {

/// A turn is soft if it differs from the boundary's own turn by more than this [right angles].
/// - At an end, one quad takes the whole angle. The limit is halfway to a side: 135°, a sine of 0.7.
/// - Three quads share the angle of a corner, and four that of a reversal. Each of them may have about 0.8
///   right angles, the limit of `least_irregular()`.
///
/// Higher limits give fewer irregular nodes and worse quads at the boundary.
constexpr double kSoftEnd = 0.5 + 1e-9, kSoftHalf = 0.49, kSoftCorner = 0.65 / 3;

double square(double x) { return x * x; }

/// A loop's own angles: the turn at each node and the direction of each side [right angles].
struct LoopAngles {
    std::vector<double> turn, direction;
    int turns = 0;
};

double frame_angle(const LoopFrame& frame, const Vec2& p)
{
    if (!frame.polar) return frame.angle;
    const Vec2 out = p - frame.centre;
    return std::atan2(out.y(), out.x()) + kRightAngle;
}

/// An angle in units of right angles, from -2 to 2.
double in_quarters(double angle) { return std::remainder(angle, kFullTurn) / kRightAngle; }

LoopAngles angles_of(std::span<const Vec2> points, const std::vector<Index>& loop, const LoopFrame& frame)
{
    const std::size_t n = loop.size();
    LoopAngles angles;
    double before = 0;
    for (std::size_t i = 0; i <= n; ++i) {
        const Vec2 &here = point_of(points, loop, i), &next = point_of(points, loop, i + 1),
                   out = next - here;
        const double turn = 2 - corner_angle(points, loop, i) / kRightAngle;
        const double reference = frame_angle(frame, (here + next) / 2);
        const double direction = i == 0 ? in_quarters(std::atan2(out.y(), out.x()) - reference)
                                        : angles.direction.back() + turn - in_quarters(reference - before);
        before = reference;
        if (i == n) {
            angles.turns = static_cast<int>(std::lround(direction - angles.direction[0]));
            break;
        }
        angles.turn.push_back(turn);
        angles.direction.push_back(direction);
    }
    return angles;
}

/// Whether a turn is soft: it differs so much from the boundary's own turn that the grid turns behind some
/// rows of quads.
bool is_soft(double own, int turn, TurnStyle style)
{
    const double limit = turn < 0                        ? kSoftCorner * (2 - turn)
                         : style == TurnStyle::hard_ends ? kSoftEnd
                                                         : kSoftHalf;
    return turn != 0 && std::abs(own - turn) > limit;
}

/// Finds the headings with the least cost, for a given heading of the first side.
class HeadingSearch {
public:
    /// @param weight  weight of the deviation of a side's direction, relative to the deviation of a node's
    ///         angle.
    HeadingSearch(const LoopAngles& angles, double weight, TurnStyle style)
        : angles_(angles), weight_(weight), style_(style)
    {
    }

    /// @return the cost of the best headings, which are stored in `best`.
    double run(int start, std::vector<int>& best)
    {
        const std::size_t n = angles_.turn.size();
        std::vector<Costs> cost(n);
        std::vector<std::array<char, kWidth>> from(n);
        cost[0].fill(kInfinity);
        cost[0][slot(0, start)] = side_cost(0, start);
        for (std::size_t i = 1; i < n; ++i) {
            cost[i].fill(kInfinity);
            for (int s = 0; s < kWidth; ++s) {
                const int here = heading(i, s);
                for (int b = 0; b < kWidth; ++b) {
                    const int turn = here - heading(i - 1, b);
                    if (turn > 1 || turn < -2) continue;
                    const double c = cost[i - 1][index(b)] + node_cost(i, turn);
                    if (c >= cost[i][index(s)]) continue;
                    cost[i][index(s)] = c;
                    from[i][index(s)] = static_cast<char>(b);
                }
                cost[i][index(s)] += side_cost(i, here);
            }
        }
        double least = kInfinity;
        int last = -1;
        for (int s = 0; s < kWidth; ++s) {
            const int turn = start + angles_.turns - heading(n - 1, s);
            if (turn > 1 || turn < -2) continue;
            const double c = cost[n - 1][index(s)] + node_cost(0, turn);
            if (c >= least) continue;
            least = c;
            last = s;
        }
        if (last < 0) return kInfinity;
        best.resize(n);
        for (std::size_t i = n; i-- > 0;) {
            best[i] = heading(i, last);
            last = from[i][index(last)];
        }
        return least;
    }

    /// A heading that is tried for a side. The headings nearest to the side's direction are tried.
    [[nodiscard]] int heading(std::size_t i, int slot) const
    {
        return static_cast<int>(std::lround(angles_.direction[i])) + slot - kWidth / 2;
    }
    static constexpr int kWidth = 3;

private:
    using Costs = std::array<double, kWidth>;
    static std::size_t index(int slot) { return static_cast<std::size_t>(slot); }
    [[nodiscard]] std::size_t slot(std::size_t i, int h) const { return index(h - heading(i, 0)); }
    [[nodiscard]] double side_cost(std::size_t i, int h) const
    {
        return weight_ * square(angles_.direction[i] - h);
    }
    [[nodiscard]] double node_cost(std::size_t i, int turn) const
    {
        // With few soft turns, each costs as much as a side that is perpendicular to its heading.
        const bool costs = style_ == TurnStyle::few_soft && is_soft(angles_.turn[i], turn, style_);
        return square(angles_.turn[i] - turn) + (costs ? 1 : 0);
    }

    const LoopAngles& angles_;
    double weight_;
    TurnStyle style_;
};

} // namespace

Vec2 centre_of(const std::vector<Vec2>& points, const std::vector<Index>& loop)
{
    const Vec2& origin = points[index(loop[0])];
    Vec2 sum = Vec2::Zero();
    double area = 0;
    for (std::size_t i = 0; i < loop.size(); ++i) {
        const Vec2 a = point_of(points, loop, i) - origin, b = point_of(points, loop, i + 1) - origin;
        sum += cross(a, b) * (a + b) / 3;
        area += cross(a, b);
    }
    return area != 0 ? Vec2(origin + sum / area) : origin;
}

double main_angle(const PlanarRegion& region)
{
    // The boundary has no main direction if the absolute value of the sum is less than this share of the sum
    // of all absolute values. An example is a regular octagon with round corners. With a higher value, the
    // centres of the loops decide more often. With 0, a body of the benchmarks has a least scaled Jacobian of
    // 0.77 instead of 0.79.
    constexpr double kClear = 0.1;
    std::complex<double> sum = 0;
    double whole = 0;
    const auto add = [&](const Vec2& along) {
        const double length = along.norm();
        if (!(length > 0)) return;
        const std::complex<double> unit(along.x() / length, along.y() / length);
        sum += length * std::pow(unit, 4);
        whole += length;
    };
    const auto clear = [&] { return std::abs(sum) > kClear * whole; };
    for (const auto& loop : region.loops) {
        for (std::size_t i = 0; i < loop.size(); ++i)
            add(point_of(region.points, loop, i + 1) - point_of(region.points, loop, i));
        if (clear()) return std::arg(sum) / 4;
    }
    std::vector<Vec2> centres;
    for (const auto& loop : region.loops) centres.push_back(centre_of(region.points, loop));
    sum = whole = 0;
    for (std::size_t a = 0; a < centres.size(); ++a) {
        for (std::size_t b = a + 1; b < centres.size(); ++b) add(centres[b] - centres[a]);
    }
    if (clear()) return std::arg(sum) / 4;
    const Vec2 first = region.points[index(region.loops[0][0])] - centres[0];
    return std::atan2(first.y(), first.x());
}

LoopFrame straight_frame(const PlanarRegion& region) { return {.angle = main_angle(region)}; }

bool has_half_ends(const PlanarRegion& region)
{
    return std::ranges::any_of(boundary_angles(region), [](double angle) {
        const double off = angle / kRightAngle - 1;
        return off > kSoftHalf && off <= kSoftEnd;
    });
}

std::optional<PatternLoop> head_loop(std::span<const Vec2> points, const std::vector<Index>& loop,
                                     const LoopFrame& frame, TurnStyle style)
{
    // Weight of a side's direction relative to a node's angle. For a grid around a hole the angles must
    // decide, because the sides of a slot do not follow circles. There, all sides together weigh one.
    const LoopAngles angles = angles_of(points, loop, frame);
    HeadingSearch search(angles, frame.polar ? 1 / static_cast<double>(loop.size()) : 1, style);
    PatternLoop headed{loop, {}, angles.direction, {}, {}, angles.turns};
    double least = kInfinity;
    for (int s = 0; s < HeadingSearch::kWidth; ++s) {
        std::vector<int> headings;
        const double cost = search.run(search.heading(0, s), headings);
        if (cost >= least) continue;
        least = cost;
        headed.heading = std::move(headings);
    }
    if (headed.heading.empty()) return std::nullopt;
    for (std::size_t i = 0; i < loop.size(); ++i) {
        const int turn = headed.turn(i);
        const bool soft = is_soft(angles.turn[i], turn, style);
        headed.soft.push_back(soft ? 1 : 0);
        headed.movable.push_back(soft ? 1 : 0);
    }
    return headed;
}

bool has_doubtful_turns(const PlanarRegion& region)
{
    const LoopFrame frame = straight_frame(region);
    return std::ranges::any_of(region.loops, [&](const std::vector<Index>& loop) {
        const auto soft = head_loop(region.points, loop, frame);
        if (!soft || std::ranges::find(soft->movable, 1) == soft->movable.end()) return false;
        const auto few = head_loop(region.points, loop, frame, TurnStyle::few_soft);
        return few && few->heading != soft->heading;
    });
}

bool is_ring_loop(std::span<const Vec2> points, const PatternLoop& loop)
{
    // A ring grid must not pass an end of the boundary straight.
    for (std::size_t i = 0; i < loop.size(); ++i) {
        if (loop.movable[i]) return false;
        if (loop.turn(i) == 0 && corner_angle(points, loop.nodes, i) < kCornerBelow * kDegree) return false;
    }
    return loop.turns == 0;
}

} // namespace lacuna::quads
