// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/core/types.h>
#include <lacuna/quads/region.h>

#include <cstddef>
#include <numbers>
#include <span>
#include <string>
#include <vector>

namespace lacuna::quads {

/// Verdict's scaled Jacobian of a quad in the plane: the least sine of its corners, -1…1, 1 for a rectangle,
/// negative where a corner is folded, 0 where a side has no length.
double scaled_jacobian(std::span<const Vec2> points, const Quad& quad);

/// The least scaled Jacobian of all quads; 1 if there are none.
double least_scaled_jacobian(std::span<const Vec2> points, std::span<const Quad> quads);
/// The same on all threads.
double least_scaled_jacobian(std::span<const Vec2> points, std::span<const Quad> quads,
                             const RunContext& context);

/// A side has the size asked if its length divided by that size is within these bounds. A narrower range
/// would reject graded meshes, a wider one would accept sizes off by a factor of two.
inline constexpr double kShortestOfSize = 0.6, kLongestOfSize = 1.6;

/// Quality of quads over a region.
struct PlaneQuality {
    std::size_t quads = 0, points = 0;
    double min_scaled_jacobian = 1;
    double mean_scaled_jacobian = 1;
    std::size_t interior = 0;           ///< nodes that are not on the boundary
    std::size_t irregular = 0;          ///< of them, those with other than four quads
    std::size_t boundary_irregular = 0; ///< boundary nodes whose number of quads does not fit their angle
    std::size_t rows = 0;               ///< boundary sides
    std::size_t good_rows = 0;          ///< of them, those with a good row quad, see `measure_plane()`
    std::size_t possible_rows = 0;      ///< boundary sides with `may_be_good()` at both ends
    std::size_t edges = 0;
    std::size_t edges_of_size = 0; ///< of them, those 0.6 to 1.6 times as long as asked; all if no size is
                                   ///< given
    double mean_edge_ratio = 1;    ///< mean of edge length / size asked; 1 if no size is given

    [[nodiscard]] double irregular_share() const { return share(irregular, interior); }
    [[nodiscard]] double row_share() const { return rows == 0 ? 1 : share(good_rows, rows); }
    /// The largest share of good rows that the outline's corners allow.
    [[nodiscard]] double possible_row_share() const { return rows == 0 ? 1 : share(possible_rows, rows); }
    [[nodiscard]] double size_share() const { return edges == 0 ? 1 : share(edges_of_size, edges); }

private:
    static double share(std::size_t part, std::size_t whole)
    {
        return whole == 0 ? 0 : static_cast<double>(part) / static_cast<double>(whole);
    }
};

/// The angle inside the region at each of its boundary nodes, loop after loop [radian].
std::vector<double> boundary_angles(const PlanarRegion& region);

/// Limits for a good row quad: the deviation of a corner from its ideal angle [radian], and the deviation
/// from the row's height of the ends of the side opposite to the boundary, as a share of that height.
inline constexpr double kRowOffRight = std::numbers::pi / 9, kRowOffHeight = 0.3;

/// Ideal corner angle of a row quad at a boundary node [radian]: half the node's angle if two quads share the
/// node and the boundary bends by at most 45° there, as on a round hole; otherwise 90°. The corner across the
/// row has the supplementary ideal angle.
/// @param angle  inside the region [radian].
/// @param quads  at the node.
double row_corner(double angle, Index quads);

/// Whether a boundary node with this many quads allows corners within kRowOffRight of their ideal angle. A
/// single quad in a corner below 70° or above 110° does not.
/// @param angle  inside the region [radian].
bool may_be_good(double angle, Index quads);
/// Whether some number of quads, from one to four, allows such corners.
bool may_be_good(double angle);

/// Measure quads over a region.
///
/// A row quad is good if its four corners are within 20° of their ideal angles (90° along a straight
/// boundary, see `row_corner()`) and both ends of the side opposite the boundary are within 30 % of the row's
/// height. The row's height is the size asked at the middle of the boundary side; without a size, it is the
/// side's own length.
/// @pre  `find_fault()` finds no fault other than folded corners.
PlaneQuality measure_plane(const PlanarQuads& mesh, const PlanarRegion& region);

/// The least number of irregular interior nodes that topology allows if each has three or five quads.
///
/// The sum rule: the sum of 4 − quads over the interior nodes plus the sum of 2 − quads over the boundary
/// nodes is 4 times the Euler number. A boundary node has as many quads as right angles fit in its angle; one
/// whose angle is within `either` right angles of half way between two numbers has whichever of them is
/// better.
/// @param angles  inside the region at its boundary nodes; straight ones may be left out [radian]
/// @param euler   of the region: 2 minus the number of its loops
int least_irregular(std::span<const double> angles, int euler, double either = 0);

/// As above, for a region. No mesh has fewer irregular nodes if boundary nodes whose number of quads does not
/// fit their angle are counted too.
int least_irregular(const PlanarRegion& region);

/// The first reason, in words, why the quads are not a valid mesh of the region; empty if they are valid.
///
/// Checked: boundary points moved or missing; corners that are no points or occur twice; sides used by three
/// quads, or by two in the same direction; boundary sides that are not those of the loops; points without a
/// quad; a mesh in several pieces or pinched at a point; corners that are not positive.
std::string find_fault(const PlanarQuads& mesh, const PlanarRegion& region);

} // namespace lacuna::quads
