// SPDX-License-Identifier: MIT
#include <lacuna/core/shared/criteria.h>
#include <lacuna/quads/detail/pattern_loop.h>

#include <array>
#include <cmath>

namespace lacuna::quads {
namespace {

/// For headings 0 and 1: number of sides along the heading minus the number in the opposite direction.
std::array<int, 2> excess_of(const PatternLoop& loop)
{
    std::array<int, 2> excess{};
    for (const int h : loop.heading) advance(excess, h);
    return excess;
}

/// A move of a turn by one side, after which the loop is closer to closing.
struct TurnMove {
    /// The side that changes its heading, and the nodes at which the turn is before and after the move.
    std::size_t side = 0, from = 0, to = 0;
    int heading = 0;           ///< new heading of the side
    std::array<int, 2> left{}; ///< excess after the move
};

/// Turn of the boundary at a node [right angles].
double own_turn(const PatternLoop& loop, std::size_t i)
{
    return i > 0 ? loop.direction[i] - loop.direction[i - 1]
                 : loop.direction[0] + loop.turns - loop.direction[loop.size() - 1];
}

/// Whether the quads at a node would be good there if the loop turned by `turn`: `kGoodQuad` is the sine of
/// their angles.
bool may_turn(const PatternLoop& loop, std::size_t i, int turn)
{
    if (turn < -2 || turn > 1 || loop.movable[i]) return false;
    return std::sin((2 - own_turn(loop, i)) / (2 - turn) * kRightAngle) > kGoodQuad;
}

/// @param hard  true: move turns of the boundary itself, if the angles at the old and the new node permit it;
///         false: move the movable turns.
/// @return empty if no move brings the loop closer to closing
std::optional<TurnMove> cheapest_move(const PatternLoop& loop, const std::array<int, 2>& excess, bool hard)
{
    const std::size_t n = loop.size();
    std::optional<TurnMove> best;
    double least = kInfinity;
    for (std::size_t i = 0; i < n; ++i) {
        const int turn = loop.turn(i);
        if (turn == 0 || (loop.movable[i] != 0) == hard) continue;
        const std::size_t before = (i + n - 1) % n, after = (i + 1) % n;
        for (const bool forward : {true, false}) {
            // The side that gets the heading of its neighbour, and the node to which the turn moves.
            const std::size_t changed = forward ? i : before, next = forward ? after : before;
            const int there = loop.turn(next) + turn;
            if (hard ? !may_turn(loop, i, 0) || !may_turn(loop, next, there) : loop.turn(next) != 0) continue;
            const int h = loop.heading[changed] + (forward ? -turn : turn);
            std::array<int, 2> now = excess;
            advance(now, loop.heading[changed], -1);
            advance(now, h);
            if (badness(now) >= badness(excess)) continue;
            const auto off = [&](int heading) { return std::abs(loop.direction[changed] - heading); };
            const double cost = off(h) * off(h) - off(loop.heading[changed]) * off(loop.heading[changed]);
            if (cost >= least) continue;
            least = cost;
            best = {changed, i, next, h, now};
        }
    }
    return best;
}

} // namespace

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
    std::vector<std::size_t> ends; // nodes at which a row of the loop meets a column
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
    GridLoop grid{loop.nodes, {}};
    GridPosition at{0, 0};
    for (const int h : loop.heading) {
        grid.positions.push_back(at);
        advance(at, h);
    }
    return grid;
}

} // namespace lacuna::quads
