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

/// Verdict's scaled Jacobian of a quad in the plane: the smallest sine of its corners, from -1 to 1. It is 1
/// for a rectangle, negative if a corner is folded, and 0 if a side has no length.
double scaled_jacobian(std::span<const Vec2> points, const Quad& quad);

/// The least scaled Jacobian of all quads; 1 if there are none.
double least_scaled_jacobian(std::span<const Vec2> points, std::span<const Quad> quads);
/// The least scaled Jacobian of all quads, computed by all threads.
double least_scaled_jacobian(std::span<const Vec2> points, std::span<const Quad> quads,
                             const RunContext& context);

/// A side has the requested size if the ratio of its length and this size is within these bounds. A narrower
/// range would reject graded meshes. A wider range would accept sides that are twice too long.
inline constexpr double kShortestOfSize = 0.6, kLongestOfSize = 1.6;

/// Quality of quads over a region.
struct PlaneQuality {
    std::size_t quads = 0, points = 0;
    double min_scaled_jacobian = 1;
    double mean_scaled_jacobian = 1;
    std::size_t interior = 0;           ///< nodes that are not on the boundary
    std::size_t irregular = 0;          ///< interior nodes whose number of quads is not four
    std::size_t boundary_irregular = 0; ///< boundary nodes whose number of quads does not fit their angle
    std::size_t rows = 0;               ///< boundary sides
    std::size_t good_rows = 0;          ///< boundary sides with a good row quad, see `measure_plane()`
    std::size_t possible_rows = 0;      ///< boundary sides with `may_be_good()` at both ends
    std::size_t edges = 0;
    /// Edges 0.6 to 1.6 times as long as requested; all edges if no size is given.
    std::size_t edges_of_size = 0;
    double mean_edge_ratio = 1; ///< mean of edge length / requested size; 1 if no size is given

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

/// The angle inside the region at each of its boundary nodes, one loop after the other [radian].
std::vector<double> boundary_angles(const PlanarRegion& region);

/// Limits for a good row quad:
/// - `kRowOffRight`: largest deviation of a corner from its ideal angle (`row_corner()`) [radian];
/// - `kRowOffHeight`: largest deviation of a node of the side opposite to the boundary from the row's height,
///   as a share of the row's height [-].
inline constexpr double kRowOffRight = std::numbers::pi / 9, kRowOffHeight = 0.3;

/// Ideal corner angle of a row quad at a boundary node [radian]. If two quads share the node and the boundary
/// bends there by at most 45°, as on a round hole, it is half the node's angle. Otherwise it is 90°. The
/// corner at the other end of the quad's side that leads inward from this node should be 180° minus this
/// angle.
/// @param angle  angle of the node inside the region [radian].
/// @param quads  number of quads at the node.
double row_corner(double angle, Index quads);

/// Whether `quads` quads can share a boundary node so that the corner of each is within `kRowOffRight` of
/// `row_corner()`. A single quad in a corner below 70° or above 110° cannot.
/// @param angle  angle of the node inside the region [radian].
bool may_be_good(double angle, Index quads);
/// Whether `may_be_good()` holds for at least one number of quads from one to four.
bool may_be_good(double angle);

/// Measure quads over a region.
///
/// A row quad is a quad on a boundary side. It is good if
/// - its four corners are within 20° of their ideal angles (90° along a straight boundary, see
///   `row_corner()`), and
/// - the heights of both nodes opposite to the boundary side differ from the row's height by at most 30 %.
///
/// The row's height is the requested size at the middle of the boundary side; without a size, it is the
/// side's own length.
/// @pre  `find_fault()` finds no fault other than folded corners.
PlaneQuality measure_plane(const PlanarQuads& mesh, const PlanarRegion& region);

/// The smallest number of irregular interior nodes that topology permits if each of them has three or five
/// quads.
///
/// The sum rule: the sum of 4 − quads over the interior nodes plus the sum of 2 − quads over the boundary
/// nodes is 4 times the Euler number. The number of quads at a boundary node is its angle divided by a right
/// angle, rounded. Near a half, both neighbouring integers are possible, and the better one is taken.
/// @param angles  angles inside the region at its boundary nodes [radian]; nodes on straight sides may be
///         left out
/// @param euler   Euler number of the region: 2 minus the number of its loops
/// @param either  largest distance from a half at which both integers are possible [right angles]
int least_irregular(std::span<const double> angles, int euler, double either = 0);

/// `least_irregular()` for a region. No mesh has fewer irregular nodes if boundary nodes whose number of
/// quads does not fit their angle are counted too.
int least_irregular(const PlanarRegion& region);

/// The first reason, in words, why the quads are not a valid mesh of the region. Empty if they are valid.
///
/// Checked: boundary points moved or missing; corners that are not points or occur twice; sides used by three
/// quads, or by two in the same direction; boundary sides that are not those of the loops; points without a
/// quad; a mesh in several pieces or pinched at a point; corners that are not positive.
std::string find_fault(const PlanarQuads& mesh, const PlanarRegion& region);

} // namespace lacuna::quads
