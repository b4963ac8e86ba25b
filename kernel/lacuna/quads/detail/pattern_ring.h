// SPDX-License-Identifier: MIT
#pragma once

/// Rings whose loops have different numbers of sides or are not concentric. Only sources of this folder
/// include it.

#include <lacuna/quads/detail/pattern_loop.h>

#include <span>
#include <vector>

namespace lacuna::quads {

/// Widths of a ring along its outer loop.
struct RingWidths {
    double least = 0, most = 0; ///< [model length]
    std::size_t narrowest = 0;  ///< index of the outer loop's node where the ring is narrowest
    /// Mean number of nodes between `narrowest` and the two points where the width is halfway between `least`
    /// and `most`.
    std::size_t half = 0;

    /// Number of rows by which the rest of the ring should exceed its narrow part, so that all rows are about
    /// as high as `height`. 0 if `measure_plane()` accepts the row heights of a ring with the same number of
    /// rows everywhere.
    [[nodiscard]] int steps(double height) const;
    /// Number of rows of this height that may change their number of quads. It is one less than the mean
    /// number of rows.
    [[nodiscard]] int changing(double height) const;
};

/// Whether at least three edges lie between any two ends of a row along a loop. At each end, the row's inner
/// side has one edge less on both adjacent sides, so a side of three edges keeps one edge.
/// @param ends  positions in the loop, ascending. @param n  number of nodes of the loop.
bool ends_apart(std::span<const std::size_t> ends, std::size_t n);

/// @pre  each loop has a node. O(outer nodes × inner nodes).
RingWidths ring_widths(std::span<const Vec2> points, const std::vector<Index>& outer,
                       const std::vector<Index>& inner);

/// Whether a loop runs around the ring without a turn of its headings.
bool runs_round(const PatternLoop& loop);

/// Let a loop without turns step inward by `rows` rows on the part within `half` nodes of `middle`, and step
/// outward again at the end of this part. Each step consists of two soft turns. The number of sides of the
/// loop along the grid decreases by twice the number of rows.
/// @return false if the part is too short.
bool step_in(PatternLoop& loop, std::size_t middle, std::size_t half, int rows);

/// Place rows along a loop without turns until its number of sides has changed by `by`.
///
/// The first row has as many quads as the loop has sides, so no irregular node lies on the boundary. Each
/// further row turns at `corners` evenly spaced nodes; the last row may turn at fewer nodes. A turn that is
/// an end (one quad) removes two sides; a turn that is a corner (three quads) adds two sides. The turns of
/// successive rows lie above each other. Each such column of turns contains one node of valence 3 and one
/// node of valence 5. The nodes of each row are evenly spaced.
/// @param by  even number of sides to add (> 0) or remove (< 0), at least twice `corners`.
/// @return false if `by` or `corners` is not allowed, if turns would be less than three sides apart, or if a
///         row would have fewer than three nodes.
bool change_sides(PatternLoop& loop, int by, int corners, std::vector<Vec2>& points, std::vector<Quad>& quads,
                  const SizeField& height);

} // namespace lacuna::quads
