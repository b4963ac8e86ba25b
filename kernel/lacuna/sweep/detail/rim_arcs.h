// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/shared/constants.h>
#include <lacuna/topology/open_volume.h>

#include <set>
#include <span>
#include <vector>

/// Edges of a face's rim, and the arcs that their chords approximate. Internal to this folder.
namespace lacuna::sweep {

/// Relative error of the height or sag of an arc that is estimated from chords. It decides how far apart two
/// sets of chords of one curve may be. Even for seven chords, the height of a parabola differs by a tenth
/// from that of a circle; for curves that bend unevenly, heights differ more.
inline constexpr double kArcError = 0.25;

/// The edges of a face's loops, without seams.
std::set<EdgeId> rim_edges(const topology::Model& model, FaceId face);

/// The point of a polyline closest to a position.
struct OnLine {
    double at = 0;               ///< running length [model length]
    double distance = kInfinity; ///< [model length]
};
OnLine closest_on(std::span<const Vec3> line, const Vec3& p);

/// A chord of a rim and the arc over it.
struct RimChord {
    Vec3 from, to;
    /// Vector from the middle of the chord to the middle of the arc [model length].
    Vec3 bulge = Vec3::Zero();
};

/// The chords of a face's loops, each with the arc that its neighbours define. The height of an arc is the
/// squared length of the chord times the curvature, divided by eight. O(chords).
std::vector<RimChord> rim_chords(const topology::Model& model, FaceId face);

/// Distance of a position from the arcs of a rim, reduced by the uncertainty of the arcs [model length].
/// O(chords).
double off_arcs(const Vec3& p, std::span<const RimChord> rim);

/// Maximum distance of the corners of either rim from the arcs of the other rim [model length]. O(chords²).
double arcs_apart(std::span<const RimChord> one, std::span<const RimChord> other);

/// The area between the chords and arcs of two rims that approximate one curve. Two faces on opposite sides
/// of such a curve, with different chords, overlap by at most this area [model length²]. O(chords²).
double area_under_arcs(std::span<const RimChord> one, std::span<const RimChord> other, double tolerance);

} // namespace lacuna::sweep
