// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/topology/open_volume.h>

#include <span>
#include <vector>

/// What the chords of a face's rim stand for. Internal to this folder.
namespace lacuna::sweep {

/// A chord of a rim and the arc over it.
struct RimChord {
    Vec3 from, to;
    Vec3 bulge = Vec3::Zero(); ///< from the chord's middle to the arc's [model length]
};

/// The chords of a face's loops, each with the arc that it and those beside it bend along: its height is the
/// length squared times the curvature, over eight. O(chords).
std::vector<RimChord> rim_chords(const topology::Model& model, FaceId face);

/// How far a place is off the arcs of a rim, beyond what they may be wrong by [model length]. O(chords).
double off_arcs(const Vec3& p, std::span<const RimChord> rim);

/// How far the corners of two rims are off each other's arcs, at the most [model length]. O(chords²).
double arcs_apart(std::span<const RimChord> one, std::span<const RimChord> other);

/// The area between chords and arcs where two rims are chords of one curve: two faces on either side of it,
/// other chords each, lie over each other by no more [model length²]. O(chords²).
double area_under_arcs(std::span<const RimChord> one, std::span<const RimChord> other, double tolerance);

} // namespace lacuna::sweep
