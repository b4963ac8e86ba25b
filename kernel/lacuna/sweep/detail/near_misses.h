// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/sweep/detail/facet_overlap.h>
#include <lacuna/sweep/detail/shared_faces.h>

#include <span>
#include <vector>

/// Members of an assembly that come near each other and share no nodes. Internal to this folder.
namespace lacuna::sweep {

/// Two members near each other, a < b, and what their faces have over each other.
struct NearPair {
    std::size_t a = 0, b = 0;
    double tolerance = 0, window = 0; ///< [model length]
    FaceOverlaps overlaps;
};

/// The larger of two members' tolerances.
double pair_tolerance(const AssemblyMember& a, const AssemblyMember& b);
/// What is further apart than this is meant to be: `kNearMiss` times the tolerance, and no more than a share
/// of the smaller member [model length].
double near_window(const AssemblyMember& a, const AssemblyMember& b);

/// How far vertices of a face's rim are from those of another that they stand for, at the most.
/// @param at_least  vertices of which the nearest is further away than a few times this stand for none.
double corners_apart(const topology::Model& a, FaceId face_a, const topology::Model& b, FaceId face_b,
                     double at_least);
/// The tolerance with which two models' faces are one that are apart so far, rounded up to two digits.
double joining_tolerance(const topology::Model& model, double width);

/// The near misses of pairs of members, ordered by members, then faces.
///
/// Faces miss each other where they lie over each other within the window, over more than a strip along
/// their rims, and do not bend away from each other: most of what is within four windows is within one. An
/// edge misses a face where the same holds for its length. What is shared as a whole, with anyone, misses no
/// one: a thin member between two others is no gap.
/// @param sag  of each member's faces.
/// @throw InvalidInput "assembly.crack", "assembly.overlap"  as `shared_faces()`
std::vector<NearMiss> near_misses(std::span<const AssemblyMember> members,
                                  std::span<const std::vector<double>> sag, std::span<const NearPair> pairs,
                                  const FacesInCommon& common, const RunContext& context = {});

} // namespace lacuna::sweep
