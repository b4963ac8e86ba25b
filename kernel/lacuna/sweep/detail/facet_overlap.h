// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/topology/open_volume.h>

#include <limits>
#include <map>
#include <span>
#include <utility>

/// How much of a face lies on, or near, a face of another volume. Internal to this folder.
namespace lacuna::sweep {

/// Areas of the part of a face that another lies over [model length²].
struct OverlapAreas {
    double on = 0;       ///< no further apart than their limit
    double same_way = 0; ///< of that, where both face the same way
    double within = 0;   ///< no further apart than the window
    double around = 0;   ///< than `kAround` times the window
};

/// What two faces of two volumes have over each other.
struct FaceOverlap {
    OverlapAreas a, b;                                      ///< as each face has it
    double least = std::numeric_limits<double>::infinity(); ///< distance within the window [model length]
    double gap = 0;                                         ///< the largest, where they are apart
    double depth = 0;                                       ///< the largest, where they reach into each other
    Eigen::AlignedBox3d box;                                ///< of what is within the window
};

using FaceOverlaps = std::map<std::pair<FaceId, FaceId>, FaceOverlap>;

/// Where faces bend away from each other less is within the window than within this many times it.
inline constexpr double kAround = 4;

/// What faces of two volumes have over each other.
///
/// Facets of either are paired by their boxes. Each pair's overlap is the polygon that both have as seen
/// along the first's normal; its distance runs evenly over it, so it is clipped exactly where that passes a
/// bound.
/// @param sag_a,sag_b  of each face, how far its facets may be off what they stand for; the limit of a pair
///                     is the tolerance and both.
/// @param window  [model length], no less than the tolerance.
/// @note  O(facets log + pairs of facets that come near).
FaceOverlaps face_overlaps(const topology::OpenVolume& a, std::span<const double> sag_a,
                           const topology::OpenVolume& b, std::span<const double> sag_b, double tolerance,
                           double window, const RunContext& context = {});

} // namespace lacuna::sweep
