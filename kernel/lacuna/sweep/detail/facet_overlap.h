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
    double same_way = 0; ///< the part of `on` where both faces have the same orientation
    double within = 0;   ///< at a distance of at most `window`
    double around = 0;   ///< at a distance of at most `kAround` times `window`
};

/// Overlap of two faces of two volumes.
struct FaceOverlap {
    OverlapAreas a, b;        ///< areas on the first face and on the second one
    double least = kInfinity; ///< smallest distance [model length]
    double gap = 0;           ///< largest distance where the volumes do not overlap
    double depth = 0;         ///< largest depth where the volumes overlap
    Eigen::AlignedBox3d box;  ///< bounding box of the part within the window
};

using FaceOverlaps = std::map<std::pair<FaceId, FaceId>, FaceOverlap>;

/// Two faces are compared up to this multiple of the window, to tell whether they stay near each other or
/// diverge.
inline constexpr double kAround = 4;

/// Compute the overlap of faces of two volumes.
///
/// Facets are paired by their bounding boxes. The overlap of a pair is the common polygon in the projection
/// along the normal of the first facet. Over this polygon the distance is linear, so the polygon is clipped
/// exactly at each distance limit.
/// @param sag_a,sag_b  for each face, the maximum distance of its facets from the true surface. The limit for
///         `on` is the tolerance plus both values.
/// @param window  largest distance that is of interest, at least the tolerance [model length].
/// @note  O(facets log + pairs of facets that are near each other).
FaceOverlaps face_overlaps(const topology::OpenVolume& a, std::span<const double> sag_a,
                           const topology::OpenVolume& b, std::span<const double> sag_b, double tolerance,
                           double window, const RunContext& context = {});

} // namespace lacuna::sweep
