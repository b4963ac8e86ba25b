// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/shared/constants.h>

/// Limits for corners, flatness, quality, coincidence and equal volumes. A limit that several files use is
/// defined here once; a limit with a single use stays next to that use.

namespace lacuna {

// Same place

/// Relative rounding error of computed lengths, areas and parameters: a few hundred operations lose four of
/// the sixteen digits.
inline constexpr double kRoundoff = 1e-12;

/// Points coincide if their distance is below this share of a reference length: of an edge, a boundary or the
/// diagonal. Also, a line with a smaller relative sag counts as straight, and directions with a smaller sine
/// between them count as parallel. The value is above the error of projections, which converge to ten digits,
/// and far below the length of any side of a mesh.
inline constexpr double kSamePlace = 1e-9;

/// Relative accuracy of coordinates in files: single precision has six to seven digits. Points whose relative
/// distance from a line or plane is smaller lie on it, vectors with a smaller sine between them are parallel,
/// angles with a smaller difference are equal [radian], and a number of sides computed from them is rounded
/// up unless it exceeds a whole number by less.
inline constexpr double kFileAccuracy = 1e-6;

/// Smaller relative changes of sizes, relative bends of sides and gaps between quads, and smaller angles
/// [radian], are invisible in a mesh and are ignored.
inline constexpr double kVisible = 1e-3;

// Corner

/// Two faces form one patch if the angle between their normals at the common edge is smaller. A rim has no
/// corner at a point where it turns by a smaller angle [degrees]. With this value, the edges of a 45° chamfer
/// are kept, and a cylinder of more than twelve flat sides is one patch.
inline constexpr double kCreaseAngle = 30;

/// Limits on the inner angle of a face at a vertex [degrees]. Below the first limit, the vertex is a corner:
/// sides of a mapped grid, and rows of quads along a side, end there. Above the second limit, the vertex is a
/// reversal. The first limit lies half way between the angles of one and of two quads (90°, 180°), the second
/// half way between those of two and of three quads (180°, 270°).
inline constexpr double kCornerBelow = 135, kReversalAbove = 225;

/// Cosine of 20°. Two edges belong to one curve if the angle between their directions is smaller. Imprints
/// may split a circle into edges of one chord each, and even coarse circles have about twenty chords.
inline constexpr double kOneCurve = 0.94;

/// Cosine of 45°, rounded. An edge continues a line beyond a vertex if the angle between their directions is
/// smaller. 45° is half way between straight and a right angle.
inline constexpr double kContinues = 0.7;

/// Two consecutive segments of a polyline form a bend if the angle between their directions is smaller, else
/// a corner [degrees]. A hexagon thus approximates a circle, a square does not.
inline constexpr double kBendBelow = 75;

// Flat

/// Sine of about one degree. Directions count as parallel, and a line counts as straight, if their angle or
/// its turn is smaller. For comparison: facets in files deviate by tenths of a degree.
inline constexpr double kParallel = 0.02;

/// A face is flat if the length of its summed area vector is more than (1 - kFlatShare) times its area. Two
/// normals agree if the cosine of their angle is more than 1 - kFlatShare. The value corresponds to
/// kParallel, because cos x ≈ 1 - x² / 2.
inline constexpr double kFlatShare = kParallel * kParallel / 2;

// Poor quality: limits of the smallest scaled Jacobian of a cell, or of the smallest sine of the corner
// angles of a plane quad

/// A quad below this counts as folded (6°). No row may contain such a quad, and no change of connectivity may
/// create one.
inline constexpr double kFoldedQuad = 0.1;
/// A quad below this counts as flat (9°). Its nodes are moved before smoothing, because smoothing hardly
/// improves a flat quad with nodes on a boundary.
inline constexpr double kFlatQuad = 0.15;

/// Below the first value, a quad is poor (30°), and further methods are tried. Above the second value, a quad
/// is good (53°), and no method is tried to improve it.
inline constexpr double kPoorQuad = 0.5, kGoodQuad = 0.8;

/// A hexahedron below this is poor: other sweep directions and sizes are tried. Solvers accept 0.2 and more.
inline constexpr double kPoorCell = 0.3;

/// Distance from a face, as a share of a quad's side, up to which a quad follows the face. It exceeds the sag
/// of a 60° chord (0.13), by which two meshes of one surface may differ. Of points farther away, another part
/// of the skin may be nearest, or an opposite part of the face.
inline constexpr double kFollowsFace = 0.25;

// Same volume

/// Two volumes are equal if they differ by less than this share of the larger volume. The sag of facets alone
/// causes differences of half a percent.
inline constexpr double kSameVolume = 0.01;

/// A relative volume difference above this value is reported, whether an assumption or the mesh causes it.
/// The value is twice the difference below which volumes count as equal. Rows of boundary layers whose
/// thickness, and so volume, is off by more are refused.
inline constexpr double kVolumeNoted = 2 * kSameVolume;

// Same size, same number

/// Lengths, sizes, numbers of sides and scaled Jacobians count as equal if they differ by less than this.
/// Edges that are equal in this sense get the same number of sides, a face whose points have equal distances
/// from an axis is round, and a smaller gain of quality is not worth any work.
inline constexpr double kAlikeSizes = 0.01;

/// Increase of the edge length with the distance from a place with short edges [length per length]. Used by
/// paving and by estimates of the number of quads.
inline constexpr double kGrading = 0.3;

/// Largest deviation of the number of quads of a paving, as a share of the requested number.
inline constexpr double kQuadsOff = 0.25;

/// A paving is accepted if at least this share of its sides has the requested size, and at least this share
/// of its rows along the boundary is good.
inline constexpr double kPromisedShare = 0.95;

} // namespace lacuna
