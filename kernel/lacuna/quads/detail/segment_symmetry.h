// SPDX-License-Identifier: MIT
#pragma once

/// Symmetries of a region whose boundary is divided into segments. Only sources of this folder include it.

#include <lacuna/quads/detail/outline_symmetry.h>

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace lacuna::quads {

/// A symmetry that maps segments onto segments.
struct SegmentSymmetry {
    Symmetry nodes;
    std::vector<std::size_t> onto; ///< of each segment its image
};

/// One more than the highest number of a segment.
std::size_t segment_count(std::span<const int> segment);

/// Those of the symmetries of a region's boundary nodes. None maps the end of a segment onto the inside of
/// another.
/// @param segment  of the side from each node to the next, 0, 1, …
std::vector<SegmentSymmetry> segment_symmetries(const PlanarRegion& region, std::span<const int> segment);

/// Those of them that also map the first node of a loop that is one segment onto such a node, as is needed
/// where nodes are counted from there.
std::vector<SegmentSymmetry> end_symmetries(const PlanarRegion& region, std::span<const int> segment);

/// Two segments that mirror each other or, twice the same, one that mirrors itself.
using SegmentPair = std::array<std::size_t, 2>;

/// The pairs of `end_symmetries()`, for each mirroring in the order of the loops.
std::vector<SegmentPair> mirrored_segments(const PlanarRegion& region, std::span<const int> segment);

/// Whether both of every pair have as many sides.
bool are_alike(std::span<const int> counts, std::span<const SegmentPair> pairs);

/// How many pairs have unlike numbers of sides, or an odd one where a segment mirrors itself.
int unlike(std::span<const int> counts, std::span<const SegmentPair> pairs);

} // namespace lacuna::quads
