// SPDX-License-Identifier: MIT
#pragma once

/// Loops of a region with a grid heading for every side. Only sources of this folder include it.

#include <lacuna/quads/detail/submap_grid.h>
#include <lacuna/quads/region.h>

#include <array>
#include <optional>
#include <span>
#include <vector>

namespace lacuna::quads {

/// Reference directions of the headings of one loop.
struct LoopFrame {
    bool polar = false; ///< heading 0 runs counter-clockwise around `centre`; otherwise along `angle`
    Vec2 centre = Vec2::Zero();
    double angle = 0; ///< [radians]
};

/// The frame along a region's main direction.
LoopFrame straight_frame(const PlanarRegion& region);

/// Centre of the area within a loop.
Vec2 centre_of(const std::vector<Vec2>& points, const std::vector<Index>& loop);

/// The direction to which most of the boundary is parallel or perpendicular [radian]. If there is no such
/// direction, the direction of the lines between the centres of the loops.
double main_angle(const PlanarRegion& region);

/// A loop whose sides follow the lines of a grid.
///
/// Headings are counted in right angles and not reduced modulo 4, so the difference of two neighbouring
/// headings is the turn at the node between them: 1 at an end, 0 on a side, -1 at a corner, -2 at a reversal.
/// Soft turn: a turn of the headings at a node where the boundary itself does not turn by as many right
/// angles. Some rows of quads are placed along the boundary, and the grid turns behind these rows.
struct PatternLoop {
    std::vector<Index> nodes;
    std::vector<int> heading; ///< heading of the side from each node to the next
    /// Direction of each side in the loop's frame [right angles]; like the headings, not reduced modulo 4.
    std::vector<double> direction;
    /// For each node, the number of rows that must be placed along the boundary before the grid turns there.
    std::vector<int> soft;
    std::vector<char> movable; ///< for each node, whether its turn may be moved to a neighbour
    int turns = 0;             ///< total turn of the loop in its frame, in right angles

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

/// How the grid turns at doubtful nodes: nodes whose angle is about halfway between an end (90°) and a side
/// (180°), called ends of 135°, and nodes whose angle is between a side and a corner (270°).
enum class TurnStyle {
    /// The grid turns where this fits the boundary best. Where the boundary itself turns less, the turn is
    /// soft.
    soft,
    hard_ends, ///< as `soft`, but at an end of 135° one quad takes the whole angle
    /// The grid turns at the boundary's own corners if this fits almost as well as `soft`, because every soft
    /// turn adds an irregular node.
    few_soft,
};

/// Whether a region's boundary has ends of about 135°.
bool has_half_ends(const PlanarRegion& region);

/// Give every side of a loop a heading.
///
/// Dynamic programming finds the headings of least total cost. A side costs the square of the difference
/// between its direction and its heading. A node costs the square of the difference between the boundary's
/// turn and the headings' turn. Every soft turn gets one row.
/// @return empty if corners are too sharp for any headings.
std::optional<PatternLoop> head_loop(std::span<const Vec2> points, const std::vector<Index>& loop,
                                     const LoopFrame& frame, TurnStyle style = TurnStyle::soft);

/// Whether a straight grid gives some loop other headings with `TurnStyle::few_soft` than with
/// `TurnStyle::soft`.
bool has_doubtful_turns(const PlanarRegion& region);

/// The number of rows that suits the soft turns at which the region bulges: together, the rows are about as
/// high as a third of the radius of the widest of these turns. 1 if there is no such turn.
int fitting_rows(const PatternLoop& loop);

/// The numbers of rows to try: one to three, and also larger numbers for wider turns. The number nearest to
/// `fitting` comes first.
std::vector<int> rows_to_try(int fitting);

/// Set the number of rows at all soft turns. Turns where the boundary is bent inward get at most three rows,
/// because around a hole the other loops limit the room.
/// @pre  `loop` is unchanged since `head_loop()`.
void set_soft_rows(PatternLoop& loop, int rows);

/// Whether grid lines can follow a loop all around. Conditions:
/// - the loop has no soft turns, and a total turn of zero;
/// - the grid turns at every node whose angle suits only one quad.
/// @pre  `loop` is unchanged since `head_loop()`, in a polar frame.
bool is_ring_loop(std::span<const Vec2> points, const PatternLoop& loop);

/// Place rows of quads along the parts of a loop with soft turns, until all turns are on the loop's nodes.
///
/// Such a part extends between two nodes where the boundary itself turns. At an end (a node of one quad), the
/// row stops on the next side. At a corner or reversal, the row stops at a new edge. If the loop has only one
/// such node and it is an end, the row runs around the whole loop, and one quad has its corner at the end.
/// @return false if two rows would need the same side.
bool lay_pattern_rows(PatternLoop& loop, std::vector<Vec2>& points, std::vector<Quad>& quads,
                      const SizeField& height);

/// Measure of how far a loop is from closing in the grid: the sum of the squares of its excess of sides along
/// headings 0 and 1. It is 0 if the loop closes.
inline int badness(const std::array<int, 2>& excess) { return excess[0] * excess[0] + excess[1] * excess[1]; }

/// Move the movable turns, by as few nodes as possible, until the loop closes in the grid. A loop closes if
/// it has as many sides in each direction as in the opposite direction.
/// @param period  for a grid around a hole: the excess of sides along heading 0 with which the loop closes.
/// @return false if that is impossible.
bool close_pattern_loop(PatternLoop& loop, int period);

/// Make a closed round loop one column narrower and one row higher in the grid, by moving its turns.
/// @return  false if the turns cannot be moved in this way.
bool trade_column_for_row(PatternLoop& loop);

/// The loop's positions in the grid, from (0, 0).
GridLoop positions_of(const PatternLoop& loop);

} // namespace lacuna::quads
