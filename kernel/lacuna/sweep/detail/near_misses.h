// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/sweep/detail/facet_overlap.h>
#include <lacuna/sweep/detail/shared_faces.h>

#include <span>
#include <vector>

/// Members of an assembly that are close to each other without shared nodes. Internal to this folder.
namespace lacuna::sweep {

/// Two members close to each other, a < b, and the overlap of their faces.
struct NearPair {
    std::size_t a = 0, b = 0;
    double tolerance = 0, window = 0; ///< [model length]
    FaceOverlaps overlaps;
};

/// The larger of two members' tolerances.
double pair_tolerance(const AssemblyMember& a, const AssemblyMember& b);
/// Largest gap that may be unintended: a thousand times the tolerance, but not more than a share of the
/// smaller member [model length].
double near_window(const AssemblyMember& a, const AssemblyMember& b);

/// Maximum distance between corresponding vertices of the rims of two faces.
/// @param at_least  distance of the rims. Vertices that are much farther apart do not correspond.
double corners_apart(const topology::Model& a, FaceId face_a, const topology::Model& b, FaceId face_b,
                     double at_least);
/// The tolerance with which the faces of two models at this distance are joined, rounded up to two digits.
double joining_tolerance(const topology::Model& model, double width);

/// The near misses of pairs of members, ordered by members, then faces.
///
/// Two faces are a near miss under two conditions:
/// - The faces are closer than the window over more than a strip along their rims.
/// - The faces do not diverge: most of the area that is closer than four windows is closer than one window.
///
/// For an edge and a face, the same conditions apply to the length of the edge. Faces that are shared as a
/// whole with some member are excluded, because a thin member between two others is not a gap.
/// @param sag  sag of each member's faces.
/// @throw InvalidInput "assembly.crack", "assembly.overlap"  as `shared_faces()`
std::vector<NearMiss> near_misses(std::span<const AssemblyMember> members,
                                  std::span<const std::vector<double>> sag, std::span<const NearPair> pairs,
                                  const FacesInCommon& common, const RunContext& context = {});

} // namespace lacuna::sweep
