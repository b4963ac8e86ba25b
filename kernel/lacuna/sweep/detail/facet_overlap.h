// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/core/shared/constants.h>
#include <lacuna/topology/open_volume.h>

#include <map>
#include <span>
#include <utility>

/// Overlap of a face with a face of another volume. Internal to this folder.
namespace lacuna::sweep {

/// Areas of the part of a face that another face covers [model length²].
struct OverlapAreas {
    double on = 0;       ///< within the tolerance
    double same_way = 0; ///< part of it where both have the same orientation
    double within = 0;   ///< within the window
    double around = 0;   ///< within `kAround` times the window
};

/// Overlap of two faces of two volumes.
struct FaceOverlap {
    OverlapAreas a, b;        ///< as seen from each face
    double least = kInfinity; ///< distance within the window [model length]
    double gap = 0;           ///< maximum distance where they are apart
    double depth = 0;         ///< maximum depth where they overlap
    Eigen::AlignedBox3d box;  ///< bounding box of the part within the window
};

using FaceOverlaps = std::map<std::pair<FaceId, FaceId>, FaceOverlap>;

/// Faces are nearly parallel if most of the area within this many windows is also within one window.
inline constexpr double kAround = 4;

/// Compute the overlap of faces of two volumes.
///
/// Facets are paired by their boxes. The overlap of a pair is the common polygon in projection along the
/// first's normal; the distance is linear over it, so it is clipped exactly at each bound.
/// @param sag_a,sag_b  of each face, the maximum distance of its facets from the true surface; the limit of a
///        pair is the tolerance plus both.
/// @param window  [model length], no less than the tolerance.
/// @note  O(facets log + pairs of facets that come near).
FaceOverlaps face_overlaps(const topology::OpenVolume& a, std::span<const double> sag_a,
                           const topology::OpenVolume& b, std::span<const double> sag_b, double tolerance,
                           double window, const RunContext& context = {});

} // namespace lacuna::sweep
