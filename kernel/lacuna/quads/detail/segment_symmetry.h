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
    std::vector<std::size_t> onto; ///< image of each segment
};

/// Number of segments: one more than the highest segment number.
std::size_t segment_count(std::span<const int> segment);

/// The symmetries of a region's boundary nodes that map segments onto segments. Such a symmetry never maps an
/// end of a segment to the inside of another segment.
/// @param segment  for each boundary node, the number (0, 1, …) of the segment that contains the side from
///         this node to the next.
std::vector<SegmentSymmetry> segment_symmetries(const PlanarRegion& region, std::span<const int> segment);

/// The symmetries of `segment_symmetries()` that also map the first node of each loop with a single segment
/// onto the first node of a loop with a single segment. Without this condition, a symmetry need not map new
/// nodes onto each other, because a loop with a single segment is divided from its first node on.
std::vector<SegmentSymmetry> end_symmetries(const PlanarRegion& region, std::span<const int> segment);

/// Two segments that are mirror images of each other. A segment that is its own mirror image is paired with
/// itself.
using SegmentPair = std::array<std::size_t, 2>;

/// For each reflection of `end_symmetries()`, its pairs of segments in the order of the loops.
std::vector<SegmentPair> mirrored_segments(const PlanarRegion& region, std::span<const int> segment);

/// Whether the segments of every pair have equal numbers of sides.
bool are_alike(std::span<const int> counts, std::span<const SegmentPair> pairs);

/// Number of pairs whose segments have unequal numbers of sides. A segment that is its own mirror image
/// counts if its number is odd.
int unlike(std::span<const int> counts, std::span<const SegmentPair> pairs);

} // namespace lacuna::quads
