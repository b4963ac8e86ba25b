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

/// The least of all quads; 1 of none.
double least_scaled_jacobian(std::span<const Vec2> points, std::span<const Quad> quads);
/// The same on all threads.
double least_scaled_jacobian(std::span<const Vec2> points, std::span<const Quad> quads,
                             const RunContext& context);

/// Sides this much shorter or longer than asked for are of another size. Choices, not measurements.
inline constexpr double kShortestOfSize = 0.6, kLongestOfSize = 1.6;

/// Quality of quads over a region.
struct PlaneQuality {
    std::size_t quads = 0, points = 0;
    double min_scaled_jacobian = 1;
    double mean_scaled_jacobian = 1;
    std::size_t interior = 0;           ///< nodes that are not on the boundary
    std::size_t irregular = 0;          ///< of them, those with other than four quads
    std::size_t boundary_irregular = 0; ///< boundary nodes whose quads are not as many as right angles fit in
    std::size_t rows = 0;               ///< boundary sides
    std::size_t good_rows = 0;          ///< of them, those with a good row quad, see `measure_plane()`
    std::size_t possible_rows = 0;      ///< boundary sides with both ends where `may_be_good()` holds
    std::size_t edges = 0;
    std::size_t edges_of_size = 0; ///< of them, those 0.6 to 1.6 times as long as asked; all without a size
    double mean_edge_ratio = 1;    ///< edge length over asked size, mean; 1 without a size

    [[nodiscard]] double irregular_share() const { return share(irregular, interior); }
    [[nodiscard]] double row_share() const { return rows == 0 ? 1 : share(good_rows, rows); }
    /// The share of good rows that the outline's corners allow.
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

/// How far the corners of a good row quad may be off what is wanted [radian], and the height of what is
/// opposite its boundary side, of that. Choices, not measurements.
inline constexpr double kRowOffRight = std::numbers::pi / 9, kRowOffHeight = 0.3;

/// The angle wanted of a row quad's corner at a boundary node [radian]: half of the node's where a side bends
/// there by 45° at most and two quads share it, for both halves of a round hole's corner cannot be right;
/// else a right one. The corner across the row is wanted to be as much on the other side of a right angle.
/// @param angle  inside the region [radian].
/// @param quads  at the node.
double row_corner(double angle, Index quads);

/// Whether so many quads at a boundary node can all have corners there within kRowOffRight of what is wanted
/// of row quads: not one in a corner below 70° or above 110°, say.
/// @param angle  inside the region [radian].
bool may_be_good(double angle, Index quads);
/// The same of any number of quads.
bool may_be_good(double angle);

/// Measure quads over a region.
///
/// A row quad is good when its four corners are within 20° of what is wanted, right ones where the boundary
/// is straight (`row_corner()`), and both ends of the side opposite the boundary lie at the row's height
/// above it, 30 % more or less. The row's height is the size asked at the middle of the side; without a size,
/// the side's own length.
/// @pre  `find_fault()` finds none but folded corners.
PlaneQuality measure_plane(const PlanarQuads& mesh, const PlanarRegion& region);

/// The least number of irregular interior nodes that topology allows, where all have three or five quads.
///
/// The sum rule: over interior nodes the sum of 4 − quads, and over boundary nodes the sum of 2 − quads, are
/// 4 times the Euler number together. Boundary nodes have the quads that right angles fit in their angle; one
/// within `either` right angles of half way between two numbers has either, whichever is better.
/// @param angles  inside the region, at its boundary nodes; straight ones may be left out [radian]
/// @param euler   of the region: 2 less its loops
int least_irregular(std::span<const double> angles, int euler, double either = 0);

/// The same of a region. No mesh has fewer when boundary nodes with other quads than fit in their angle count
/// as well.
int least_irregular(const PlanarRegion& region);

/// The first reason why quads are no valid mesh of the region, in words; empty where they are one.
///
/// Looked for: boundary points moved or missing; corners that are no points or occur twice; sides used by
/// three quads, or by two in one direction; boundary sides that are not those of the loops; points without a
/// quad; a mesh that is not in one piece or is pinched at a point; corners that are not positive.
std::string find_fault(const PlanarQuads& mesh, const PlanarRegion& region);

} // namespace lacuna::quads
