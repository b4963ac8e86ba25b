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

/// Reference directions of the headings, for the nodes of one loop.
struct LoopFrame {
    bool polar = false; ///< heading 0 runs counter-clockwise around `centre`; otherwise along `angle`
    Vec2 centre = Vec2::Zero();
    double angle = 0; ///< [radians]
};

/// The frame along a region's main direction.
LoopFrame straight_frame(const PlanarRegion& region);

/// Centre of the area within a loop.
Vec2 centre_of(const std::vector<Vec2>& points, const std::vector<Index>& loop);

/// The direction along or across which most of the boundary runs. If there is none, the direction of the
/// lines between the centres of the loops [radians].
double main_angle(const PlanarRegion& region);

/// A loop whose sides follow the lines of a grid.
///
/// Headings are counted in right angles and not reduced modulo 4, so the difference of two neighbouring
/// headings is the turn at the node between them: 1 at an end, 0 on a side, -1 at a corner, -2 at a reversal.
/// If the boundary itself turns differently there, the turn is soft: the grid turns some rows of quads
/// further inside.
struct PatternLoop {
    std::vector<Index> nodes;
    std::vector<int> heading;      ///< heading of the side from each node to the next
    std::vector<double> direction; ///< direction of each side, unwrapped like the headings [right angles]
    std::vector<int> soft;         ///< for each node, number of rows to place before the loop may turn there
    std::vector<char> movable;     ///< for each node, whether its turn may be moved to a neighbour
    int turns = 0;                 ///< total turn of the loop in its frame, in right angles

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

/// How the grid turns at ends of 135°, whose angle is halfway to a side, and at angles between a corner and a
/// side.
enum class TurnStyle {
    /// The grid turns where this fits the boundary best; behind a row if the boundary itself turns less.
    soft,
    hard_ends, ///< as `soft`, but one quad takes the whole angle of an end of 135°
    /// A turn stays on the boundary if that fits almost as well, because soft turns cost irregular nodes.
    few_soft,
};

/// Whether a region's boundary has ends of about 135°.
bool has_half_ends(const PlanarRegion& region);

/// Give every side of a loop a heading.
///
/// The headings are those of least cost, by dynamic programming. Each side costs the square of its deviation
/// from its heading; each node, the square of the deviation of its angle from its turn. A row is placed at
/// every soft turn.
/// @return empty if corners are too sharp for any headings.
std::optional<PatternLoop> head_loop(std::span<const Vec2> points, const std::vector<Index>& loop,
                                     const LoopFrame& frame, TurnStyle style = TurnStyle::soft);

/// Whether `TurnStyle::few_soft` gives any loop other headings in a straight grid than `TurnStyle::soft`.
bool has_doubtful_turns(const PlanarRegion& region);

/// The number of rows that suits the soft turns where a loop bulges: about a third of the radius of the
/// widest turn; 1 if there are no such turns. The rows are placed in front of all soft turns.
int fitting_rows(const PatternLoop& loop);

/// The numbers of rows to try: one to three, and for wider turns also larger numbers. The number nearest to
/// the fitting one comes first.
std::vector<int> rows_to_try(int fitting);

/// Set the number of rows before soft turns. Where the loop is bent inward there are at most three, because
/// other loops surround a hole.
/// @pre  `loop` is unchanged since `head_loop()`.
void set_soft_rows(PatternLoop& loop, int rows);

/// Whether grid lines can follow a loop all around: the loop has no soft turns and turns by nothing in all,
/// and the grid turns at every corner that suits only one quad.
/// @pre  `loop` is unchanged since `head_loop()`, in a polar frame.
bool is_ring_loop(std::span<const Vec2> points, const PatternLoop& loop);

/// Place rows of quads along the parts of a loop with soft turns, until all turns are on the loop's nodes.
///
/// A part of the loop ends at nodes where the boundary itself turns. At an end (one quad), the row stops on
/// the adjacent side. At corners and reversals, the row gets an edge of its own. If an end is the only such
/// node, the row runs around the whole loop and one quad has that corner.
/// @return false if rows would use a side twice.
bool lay_pattern_rows(PatternLoop& loop, std::vector<Vec2>& points, std::vector<Quad>& quads,
                      const SizeField& height);

/// How far a loop is from closing, from its excess of sides along headings 0 and 1; 0 if it closes.
inline int badness(const std::array<int, 2>& excess) { return excess[0] * excess[0] + excess[1] * excess[1]; }

/// Move the movable turns, by as few nodes as possible, until the loop closes in the grid, that is, until it
/// has as many sides in each direction as in the opposite one.
/// @param period  excess of sides along heading 0 that counts as closed, for a grid around a hole.
/// @return false if that is impossible.
bool close_pattern_loop(PatternLoop& loop, int period);

/// Make a closed round loop one column narrower and one row higher in the grid.
/// @return  false if its turns do not allow this.
bool trade_column_for_row(PatternLoop& loop);

/// The loop's positions in the grid, from (0, 0).
GridLoop positions_of(const PatternLoop& loop);

} // namespace lacuna::quads
