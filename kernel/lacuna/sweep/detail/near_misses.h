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
/// Gaps above this are intended: `kNearMiss` times the tolerance, limited to a share of the smaller member
/// [model length].
double near_window(const AssemblyMember& a, const AssemblyMember& b);

/// Maximum distance of the vertices of a face's rim from corresponding vertices of another rim.
/// @param at_least  a vertex has no counterpart if the nearest vertex is more than a few times this distance
///          away.
double corners_apart(const topology::Model& a, FaceId face_a, const topology::Model& b, FaceId face_b,
                     double at_least);
/// The tolerance that joins two models' faces at this distance, rounded up to two digits.
double joining_tolerance(const topology::Model& model, double width);

/// The near misses of pairs of members, ordered by members, then faces.
///
/// Two faces are a near miss if they cover each other within the window, over more than a strip along their
/// rims, and do not diverge: most of the area within four windows is within one. An edge and a face are
/// judged in the same way by the edge's length. Faces that are shared as a whole with any member are
/// excluded: a thin member between two others is not a gap.
/// @param sag  sag of each member's faces.
/// @throw InvalidInput "assembly.crack", "assembly.overlap"  as `shared_faces()`
std::vector<NearMiss> near_misses(std::span<const AssemblyMember> members,
                                  std::span<const std::vector<double>> sag, std::span<const NearPair> pairs,
                                  const FacesInCommon& common, const RunContext& context = {});

} // namespace lacuna::sweep
