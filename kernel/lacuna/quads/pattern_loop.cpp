// SPDX-License-Identifier: MIT
#include <lacuna/quads/detail/pattern_loop.h>

#include <lacuna/quads/detail/partial_mesh.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>

namespace lacuna::quads {
namespace {

using paving::kRightAngle;
using paving::turn_between;

/// A turn is soft where the boundary's own differs from it by more than this [right angles]. At an end one
/// quad has the whole angle, so half way to a side is the most, 135° or a sine of 0.7. Three quads share a
/// corner and four a reversal: the limit is the bar's of `least_irregular()`, for each of them. Each has 0.8
/// right angles. Choices, not measurements.
constexpr double kSoftEnd = 0.5 + 1e-9, kSoftHalf = 0.49, kSoftCorner = 0.65 / 3;

double square(double x) { return x * x; }

/// What a loop's own angles are: the turn at each node and the direction of each side [right angles].
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

/// An angle in right angles, from -2 to 2.
double in_quarters(double angle) { return std::remainder(angle, 2 * std::numbers::pi) / kRightAngle; }

LoopAngles angles_of(std::span<const Vec2> points, const std::vector<Index>& loop, const LoopFrame& frame)
{
    const std::size_t n = loop.size();
    const auto at = [&](std::size_t i) -> const Vec2& {
        return points[static_cast<std::size_t>(loop[i % n])];
    };
    LoopAngles angles;
    double before = 0;
    for (std::size_t i = 0; i <= n; ++i) {
        const Vec2 out = at(i + 1) - at(i), back = at(i + n - 1) - at(i);
        const double turn = 2 - turn_between(out, back) / kRightAngle;
        const double reference = frame_angle(frame, (at(i) + at(i + 1)) / 2);
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

/// Whether a turn takes place rows further in, since the boundary's own differs too much from it.
bool is_soft(double own, int turn, TurnStyle style)
{
    const double limit = turn < 0                        ? kSoftCorner * (2 - turn)
                         : style == TurnStyle::hard_ends ? kSoftEnd
                                                         : kSoftHalf;
    return turn != 0 && std::abs(own - turn) > limit;
}

/// What a soft turn costs where few are wanted: half as much as a side across the grid. A choice.
constexpr double kSoftTurn = 0.5;

/// Headings of least cost from one of the first side.
class HeadingSearch {
public:
    HeadingSearch(const LoopAngles& angles, double weight, TurnStyle style)
        : angles_(angles), weight_(weight), style_(style)
    {
    }

    /// @return the cost; the headings in `best`.
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

    /// The headings that are tried for a side: those nearest to its direction.
    [[nodiscard]] int heading(std::size_t i, int slot) const
    {
        return static_cast<int>(std::lround(angles_.direction[i])) + slot - kWidth / 2;
    }
    static constexpr int kWidth = 3;

private:
    static constexpr double kInfinity = std::numeric_limits<double>::infinity();
    using Costs = std::array<double, kWidth>;
    static std::size_t index(int slot) { return static_cast<std::size_t>(slot); }
    [[nodiscard]] std::size_t slot(std::size_t i, int h) const { return index(h - heading(i, 0)); }
    [[nodiscard]] double side_cost(std::size_t i, int h) const
    {
        return weight_ * square(angles_.direction[i] - h);
    }
    [[nodiscard]] double node_cost(std::size_t i, int turn) const
    {
        const bool costs = style_ == TurnStyle::few_soft && is_soft(angles_.turn[i], turn, style_);
        return square(angles_.turn[i] - turn) + (costs ? kSoftTurn : 0);
    }

    const LoopAngles& angles_;
    double weight_;
    TurnStyle style_;
};

/// Start the loop at another of its nodes.
void rotate(PatternLoop& loop, std::size_t first)
{
    const auto by = static_cast<std::ptrdiff_t>(first);
    std::rotate(loop.nodes.begin(), loop.nodes.begin() + by, loop.nodes.end());
    std::rotate(loop.heading.begin(), loop.heading.begin() + by, loop.heading.end());
    std::rotate(loop.direction.begin(), loop.direction.begin() + by, loop.direction.end());
    std::rotate(loop.soft.begin(), loop.soft.begin() + by, loop.soft.end());
    std::rotate(loop.movable.begin(), loop.movable.begin() + by, loop.movable.end());
    for (std::size_t i = loop.size() - first; i < loop.size(); ++i) {
        loop.heading[i] += loop.turns;
        loop.direction[i] += loop.turns;
    }
}

bool is_hard(const PatternLoop& loop, std::size_t i) { return loop.turn(i) != 0 && !loop.movable[i]; }

/// Lays one row at a time.
class PatternRows {
public:
    PatternRows(PatternLoop& loop, std::vector<Vec2>& points, std::vector<Quad>& quads,
                const std::function<double(const Vec2&)>& height)
        : loop_(loop), points_(points), quads_(quads), height_(height)
    {
    }

    /// Lay a row along the whole loop.
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

    /// Lay a row along the whole loop, whose first node is its only end: one quad has that corner.
    /// @return false where the loop turns beside it.
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

    /// Lay a row from the first node, which is hard, to the next hard node `end`, which may be the first
    /// again.
    /// @return false where there is no side for it to end on.
    bool lay_part(std::size_t end)
    {
        const std::size_t n = loop_.size();
        if (end == n && loop_.turn(0) == 1) return lay_round_end();
        const bool ends_at_start = loop_.turn(0) == 1, ends_at_end = loop_.turn(end % n) == 1;
        const std::size_t left = n - end; // sides beyond the part
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
        // Where the row ends at a soft turn, the turn is made there.
        const std::size_t first = end + (ends_at_end ? 1 : 0);
        for (std::size_t i = first; i < n - (ends_at_start ? 1 : 0); ++i)
            next.push(loop_.nodes[i], loop_.heading[i], loop_.direction[i], i == first ? 0 : loop_.soft[i],
                      i == first ? 0 : loop_.movable[i]);
        loop_ = std::move(next);
        return true;
    }

private:
    static constexpr std::size_t kFewestRoundEnd = 5; ///< nodes, so that three are left

    [[nodiscard]] const Vec2& at(std::size_t i) const
    {
        return points_[static_cast<std::size_t>(loop_.nodes[i % loop_.size()])];
    }

    Index add(const Vec2& p)
    {
        points_.push_back(p);
        return static_cast<Index>(points_.size()) - 1;
    }

    /// A node above node i of the loop.
    Index add_inner(std::size_t i)
    {
        const std::size_t n = loop_.size();
        const Vec2 along = (at(i + 1) - at(i)).normalized() + (at(i) - at(i + n - 1)).normalized();
        const double length = along.norm();
        const Vec2 unit = length > 0 ? Vec2(along / length) : Vec2(1, 0);
        return add(at(i) + height_(at(i)) * Vec2(-unit.y(), unit.x()));
    }

    /// A node square to a side at one of its ends.
    Index add_square(std::size_t i, std::size_t side)
    {
        const Vec2 along = (at(side + 1) - at(side)).normalized();
        return add(at(i) + height_(at(i)) * Vec2(-along.y(), along.x()));
    }

    PatternLoop& loop_;
    std::vector<Vec2>& points_;
    std::vector<Quad>& quads_;
    const std::function<double(const Vec2&)>& height_;
};

/// How many more sides run along the headings 0 and 1 than back.
std::array<int, 2> excess_of(const PatternLoop& loop)
{
    std::array<int, 2> excess{};
    for (const int h : loop.heading) {
        const int quarter = ((h % 4) + 4) % 4;
        excess[static_cast<std::size_t>(quarter % 2)] += quarter < 2 ? 1 : -1;
    }
    return excess;
}

/// A turn moved by a side, so that a loop is nearer to closing.
struct TurnMove {
    std::size_t side = 0, from = 0, to = 0; ///< the side that changes its heading, the nodes of the turn
    int heading = 0;                        ///< that it gets
    std::array<int, 2> left{};              ///< excess afterwards
};

/// By how much the boundary turns at a node [right angles].
double own_turn(const PatternLoop& loop, std::size_t i)
{
    return i > 0 ? loop.direction[i] - loop.direction[i - 1]
                 : loop.direction[0] + loop.turns - loop.direction[loop.size() - 1];
}

/// Whether the quads of a turn at a node would have angles of 54° to 126° there, a sine of 0.8.
bool may_turn(const PatternLoop& loop, std::size_t i, int turn)
{
    constexpr double kOffSquare = 0.4; // a choice, not a measurement
    if (turn < -2 || turn > 1 || loop.movable[i]) return false;
    return std::abs((2 - own_turn(loop, i)) / (2 - turn) - 1) < kOffSquare;
}

/// @param hard  of turns that the boundary makes itself, where the nodes they leave and get to allow it; else
///              of those that may be anywhere.
/// @return nothing where none brings the loop nearer to closing
std::optional<TurnMove> cheapest_move(const PatternLoop& loop, const std::array<int, 2>& excess, bool hard)
{
    const std::size_t n = loop.size();
    std::optional<TurnMove> best;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < n; ++i) {
        const int turn = loop.turn(i);
        if (turn == 0 || (loop.movable[i] != 0) == hard) continue;
        const std::size_t before = (i + n - 1) % n, after = (i + 1) % n;
        for (const bool forward : {true, false}) {
            // The side that takes the heading of its neighbour, and the node the turn moves to.
            const std::size_t changed = forward ? i : before, next = forward ? after : before;
            const int there = loop.turn(next) + turn;
            if (hard ? !may_turn(loop, i, 0) || !may_turn(loop, next, there) : loop.turn(next) != 0) continue;
            const int h = loop.heading[changed] + (forward ? -turn : turn);
            std::array<int, 2> now = excess;
            for (const auto& [heading, by] : {std::pair{loop.heading[changed], -1}, {h, 1}}) {
                const int quarter = ((heading % 4) + 4) % 4;
                now[static_cast<std::size_t>(quarter % 2)] += quarter < 2 ? by : -by;
            }
            if (badness(now) >= badness(excess)) continue;
            const double cost = square(loop.direction[changed] - h) -
                                square(loop.direction[changed] - loop.heading[changed]);
            if (cost >= least) continue;
            least = cost;
            best = {changed, i, next, h, now};
        }
    }
    return best;
}

const Vec2& point(const std::vector<Vec2>& points, Index p) { return points[static_cast<std::size_t>(p)]; }

} // namespace

Vec2 centre_of(const std::vector<Vec2>& points, const std::vector<Index>& loop)
{
    const Vec2& origin = point(points, loop[0]);
    Vec2 sum = Vec2::Zero();
    double area = 0;
    for (std::size_t i = 0; i < loop.size(); ++i) {
        const Vec2 a = point(points, loop[i]) - origin,
                   b = point(points, loop[(i + 1) % loop.size()]) - origin;
        sum += paving::cross(a, b) * (a + b) / 3;
        area += paving::cross(a, b);
    }
    return area != 0 ? Vec2(origin + sum / area) : origin;
}

double main_angle(const PlanarRegion& region)
{
    // Less than this share of all that was summed is no direction: that of a regular octagon with round
    // corners. A choice, not a measurement.
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
            add(point(region.points, loop[(i + 1) % loop.size()]) - point(region.points, loop[i]));
        if (clear()) return std::arg(sum) / 4;
    }
    std::vector<Vec2> centres;
    for (const auto& loop : region.loops) centres.push_back(centre_of(region.points, loop));
    sum = whole = 0;
    for (std::size_t a = 0; a < centres.size(); ++a) {
        for (std::size_t b = a + 1; b < centres.size(); ++b) add(centres[b] - centres[a]);
    }
    if (clear()) return std::arg(sum) / 4;
    const Vec2 first = point(region.points, region.loops[0][0]) - centres[0];
    return std::atan2(first.y(), first.x());
}

bool has_half_ends(const PlanarRegion& region)
{
    for (const auto& loop : region.loops) {
        const std::size_t n = loop.size();
        for (std::size_t i = 0; i < n; ++i) {
            const auto at = [&](std::size_t k) -> const Vec2& { return point(region.points, loop[k % n]); };
            const double off = turn_between(at(i + 1) - at(i), at(i + n - 1) - at(i)) / kRightAngle - 1;
            if (off > kSoftHalf && off <= kSoftEnd) return true;
        }
    }
    return false;
}

std::optional<PatternLoop> head_loop(std::span<const Vec2> points, const std::vector<Index>& loop,
                                     const LoopFrame& frame, double side_weight, int rows, TurnStyle style)
{
    const LoopAngles angles = angles_of(points, loop, frame);
    HeadingSearch search(angles, side_weight, style);
    PatternLoop headed{loop, {}, angles.direction, {}, {}, angles.turns};
    double least = std::numeric_limits<double>::infinity();
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
        headed.soft.push_back(soft ? rows : 0);
        headed.movable.push_back(soft ? 1 : 0);
    }
    return headed;
}

bool has_doubtful_turns(const PlanarRegion& region)
{
    const LoopFrame frame{false, Vec2::Zero(), main_angle(region)};
    return std::ranges::any_of(region.loops, [&](const std::vector<Index>& loop) {
        const auto soft = head_loop(region.points, loop, frame, kStraightWeight, 1);
        if (!soft || std::ranges::find(soft->movable, 1) == soft->movable.end()) return false;
        const auto few = head_loop(region.points, loop, frame, kStraightWeight, 1, TurnStyle::few_soft);
        return few && few->heading != soft->heading;
    });
}

int fitting_rows(const PatternLoop& loop)
{
    // Rows over the sides of a quarter turn: the square within a disc is then about half as wide as it.
    constexpr double kOfQuarter = 0.22;
    const std::size_t n = loop.size();
    int most = 1;
    for (std::size_t i = 0; i < n; ++i) {
        if (!loop.movable[i] || loop.turn(i) != 1) continue;
        // Sides that run within half a right angle of the direction between the two headings.
        const double middle = i > 0 ? loop.heading[i] - 0.5 : loop.heading[0] - 0.5;
        int sides = 0;
        for (std::size_t k = 0; k < n; ++k) {
            if (std::abs(loop.direction[k] - middle) < 0.5) ++sides;
        }
        most = std::max(most, static_cast<int>(std::lround(kOfQuarter * sides)));
    }
    return most;
}

std::vector<int> rows_to_try(int fitting)
{
    constexpr int kAlways = 3; // a choice, not a measurement
    std::vector<int> rows;
    for (int r = 1; r <= kAlways; ++r) rows.push_back(r);
    for (const int r : {fitting / 2, 2 * fitting / 3, fitting}) {
        if (r > rows.back()) rows.push_back(r);
    }
    if (fitting <= kAlways) return rows;
    const auto off = [&](int r) { return std::abs(std::log(static_cast<double>(r) / fitting)); };
    std::stable_sort(rows.begin(), rows.end(), [&](int a, int b) { return off(a) < off(b); });
    return rows;
}

void set_soft_rows(PatternLoop& loop, int rows)
{
    constexpr int kMostInward = 3; // a choice, not a measurement
    for (std::size_t i = 0; i < loop.size(); ++i) {
        if (loop.movable[i]) loop.soft[i] = loop.turn(i) < 0 ? std::min(rows, kMostInward) : rows;
    }
}

bool is_ring_loop(std::span<const Vec2> points, const PatternLoop& loop)
{
    // Corners of 112° and less: two quads would be left with a sine of 0.83. A choice, not a measurement.
    constexpr double kEnd = 0.75;
    const std::size_t n = loop.size();
    const auto at = [&](std::size_t i) -> const Vec2& {
        return points[static_cast<std::size_t>(loop.nodes[i % n])];
    };
    for (std::size_t i = 0; i < n; ++i) {
        if (loop.movable[i]) return false;
        if (loop.turn(i) == 0 &&
            2 - turn_between(at(i + 1) - at(i), at(i + n - 1) - at(i)) / kRightAngle > kEnd)
            return false;
    }
    return loop.turns == 0;
}

bool lay_pattern_rows(PatternLoop& loop, std::vector<Vec2>& points, std::vector<Quad>& quads,
                      const std::function<double(const Vec2&)>& height)
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
        rotate(loop, hard);
        std::size_t end = 1;
        while (end < n && !is_hard(loop, end)) ++end;
        if (!rows.lay_part(end)) return false;
    }
}

bool close_pattern_loop(PatternLoop& loop, int period)
{
    auto excess = excess_of(loop);
    excess[0] -= period;
    while (excess[0] != 0 || excess[1] != 0) {
        auto move = cheapest_move(loop, excess, false);
        if (!move) move = cheapest_move(loop, excess, true);
        if (!move) return false;
        loop.heading[move->side] = move->heading;
        loop.movable[move->to] = loop.movable[move->from];
        loop.movable[move->from] = 0;
        excess = move->left;
    }
    return true;
}

bool trade_column_for_row(PatternLoop& loop)
{
    const std::size_t n = loop.size();
    std::vector<std::size_t> ends; // sides that run along a row and then along a column
    for (std::size_t i = 0; i < n; ++i) {
        const std::size_t before = (i + n - 1) % n;
        if (loop.turn(i) == 0 || loop.heading[before] % 2 != 0) continue;
        if (!loop.movable[i] || loop.turn(before) != 0) return false;
        ends.push_back(i);
    }
    if (ends.size() != 2) return false;
    for (const std::size_t i : ends) {
        const std::size_t before = (i + n - 1) % n;
        loop.heading[before] += loop.turn(i);
        std::swap(loop.movable[i], loop.movable[before]);
    }
    return true;
}

GridLoop positions_of(const PatternLoop& loop)
{
    constexpr std::array<GridPosition, 4> kSteps{{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};
    GridLoop grid{loop.nodes, {}};
    GridPosition at{0, 0};
    for (const int h : loop.heading) {
        grid.positions.push_back(at);
        const GridPosition& step = kSteps[static_cast<std::size_t>(((h % 4) + 4) % 4)];
        at = {at[0] + step[0], at[1] + step[1]};
    }
    return grid;
}

} // namespace lacuna::quads
