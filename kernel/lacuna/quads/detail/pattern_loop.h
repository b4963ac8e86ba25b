// SPDX-License-Identifier: MIT
#pragma once

/// Loops of a region with a heading in a grid for every side. Only sources of this folder include it.

#include <lacuna/quads/detail/submap_grid.h>
#include <lacuna/quads/region.h>

#include <array>
#include <optional>
#include <span>
#include <vector>

namespace lacuna::quads {

/// Directions that headings are counted from, for the nodes of one loop.
struct LoopFrame {
    bool polar = false; ///< heading 0 goes counter-clockwise round `centre`; else along `angle`
    Vec2 centre = Vec2::Zero();
    double angle = 0; ///< [radians]
};

/// That of a region's main direction.
LoopFrame straight_frame(const PlanarRegion& region);

/// Centre of the area within a loop.
Vec2 centre_of(const std::vector<Vec2>& points, const std::vector<Index>& loop);

/// The direction that most of the boundary runs along or across; where it has none, that of the lines between
/// the loops' centres [radians].
double main_angle(const PlanarRegion& region);

/// A loop whose sides run along the lines of a grid.
///
/// Headings are counted in right angles and not taken modulo 4, so that the difference of two neighbours is
/// the turn at the node between them: 1 at an end, 0 on a side, -1 at a corner, -2 at a reversal. Where the
/// boundary does not turn like that by itself the turn is soft: it takes place rows of quads further in.
struct PatternLoop {
    std::vector<Index> nodes;
    std::vector<int> heading;      ///< of the side from each node to the next
    std::vector<double> direction; ///< of the side itself, unwrapped like the headings [right angles]
    std::vector<int> soft;         ///< rows to be laid before the loop may turn at each node
    std::vector<char> movable;     ///< whether the turn at a node may be moved to a neighbour
    int turns = 0;                 ///< right angles by which the loop turns in its frame

    [[nodiscard]] std::size_t size() const { return nodes.size(); }
    void push(Index node, int side_heading, double side_direction, int soft_rows, char may_move)
    {
        nodes.push_back(node);
        heading.push_back(side_heading);
        direction.push_back(side_direction);
        soft.push_back(soft_rows);
        movable.push_back(may_move);
    }
    [[nodiscard]] int turn(std::size_t i) const
    {
        return i > 0 ? heading[i] - heading[i - 1] : heading[0] + turns - heading[nodes.size() - 1];
    }
};

/// Where a grid turns. Of ends of 135°, half way to a side, and of what is between a corner and a side.
enum class TurnStyle {
    soft,      ///< where the boundary fits best; behind a row, in a node of three quads, where it turns less
    hard_ends, ///< the same, but one quad has the whole angle of an end of 135°
    few_soft,  ///< on the boundary where that fits hardly worse: soft turns cost irregular nodes
};

/// Whether a region's boundary has such ends.
bool has_half_ends(const PlanarRegion& region);

/// Give every side of a loop a heading.
///
/// The headings are those of least cost, found by dynamic programming: every side costs the square of its
/// deviation from its heading, every node that of its angle from its turn.
/// A row is laid where a turn is soft.
/// @return nothing where corners are so sharp that no headings suit them.
std::optional<PatternLoop> head_loop(std::span<const Vec2> points, const std::vector<Index>& loop,
                                     const LoopFrame& frame, TurnStyle style = TurnStyle::soft);

/// Whether `TurnStyle::few_soft` gives some loop other headings in a straight grid than `TurnStyle::soft`.
bool has_doubtful_turns(const PlanarRegion& region);

/// How many rows suit the soft turns where a loop bulges: a third of the radius or so of the widest. 1 where
/// there are none. Rows are to be laid behind all of them.
int fitting_rows(const PatternLoop& loop);

/// The numbers of rows worth a trial: one to three, or of deeper turns the fitting one first.
std::vector<int> rows_to_try(int fitting);

/// Lay other numbers of rows before soft turns; no more than three where the loop is bent inward, for holes
/// have others about them.
/// @pre  `loop` is as `head_loop()` made it.
void set_soft_rows(PatternLoop& loop, int rows);

/// Whether a grid may go round along a loop: it has no soft turns, and does not run straight on where the
/// boundary has an end, a corner that one quad would suit and two would have to share.
/// @pre  `loop` is as `head_loop()` made it in a polar frame.
bool is_ring_loop(std::span<const Vec2> points, const PatternLoop& loop);

/// Lay rows of quads along the parts of a loop with soft turns, until all turns are on the loop's nodes.
///
/// A part ends at nodes that turn by themselves. At an end (one quad) the row ends on the neighbouring side;
/// at corners and reversals it gets an edge of its own. Where an end is the only such node, the row goes
/// round the whole loop and one quad has that corner.
/// @return false where rows would use a side twice.
bool lay_pattern_rows(PatternLoop& loop, std::vector<Vec2>& points, std::vector<Quad>& quads,
                      const SizeField& height);

/// How far a loop is from closing, of its sides along headings 0 and 1 over those back; 0 where it closes.
inline int badness(const std::array<int, 2>& excess) { return excess[0] * excess[0] + excess[1] * excess[1]; }

/// Move the turns that may be moved, by as little as possible, until the loop closes in the grid: as many
/// sides one way as back.
/// @param period  by which the sides along heading 0 exceed those back.
/// @return false where that cannot be.
bool close_pattern_loop(PatternLoop& loop, int period);

/// Make a round loop that is closed one column narrower and one row higher in the grid.
/// @return false where its turns may not move so.
bool trade_column_for_row(PatternLoop& loop);

/// The loop's positions in the grid, from (0, 0).
GridLoop positions_of(const PatternLoop& loop);

} // namespace lacuna::quads
