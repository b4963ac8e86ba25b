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

/// Points coincide if their distance, divided by the length of an edge, a boundary or the diagonal, is
/// smaller. Likewise, a bend with a smaller relative sag counts as straight, and directions with a smaller
/// sine as parallel. Projections converge to ten digits, and no side of a mesh is that short.
inline constexpr double kSamePlace = 1e-9;

/// Relative accuracy of coordinates in files: six to seven digits in single precision. Points this close to
/// a line or a plane are on it, vectors with a smaller sine between them are parallel, and angles that differ
/// by less are equal [radian].
inline constexpr double kFileAccuracy = 1e-6;

/// Relative changes of sizes, bends of sides, gaps between quads, and angles [radian] below this are
/// invisible in a mesh and ignored.
inline constexpr double kVisible = 1e-3;

// Corner

/// Faces form one patch if the angle between their normals across the edge is smaller; a rim has no corner
/// where it turns by less [degrees]. So the edges of a 45° chamfer are kept, and a cylinder of more than
/// twelve sides is one patch.
inline constexpr double kCreaseAngle = 30;

/// Limits on the inner angle of a face at a vertex [degrees]. A vertex with an angle below the first limit is
/// a corner, where a mapped grid and the rows along a side end; above the second limit it is a reversal. The
/// limits lie half way between the angles that fit one and two quads (90°, 180°), and two and three (180°,
/// 270°).
inline constexpr double kCornerBelow = 135, kReversalAbove = 225;

/// Cosine of 20°. Two edges belong to one curve if they turn by less: imprints split circles into edges of
/// single chords, and even coarse circles have some twenty chords.
inline constexpr double kOneCurve = 0.94;

/// An edge continues a line beyond a vertex if the angle between their directions is below 45°, half way
/// between straight and a right angle. This is the cosine, rounded.
inline constexpr double kContinues = 0.7;

/// Two consecutive segments of a polyline form a bend if the angle between their directions is smaller, else
/// a corner [degrees]. A hexagon thus approximates a circle, a square does not.
inline constexpr double kBendBelow = 75;

// Flat

/// Sine of about one degree. Directions count as parallel, and a line as straight, if they turn by less.
/// Facets in files deviate by tenths of a degree.
inline constexpr double kParallel = 0.02;

/// A face is flat if the length of its summed area vector falls short of its area by less than this share.
/// Two normals agree if their cosine falls short of 1 by less. The value corresponds to kParallel.
inline constexpr double kFlatShare = kParallel * kParallel / 2;

// Poor quality: limits of the smallest scaled Jacobian of a cell, or of the smallest sine of the corner
// angles of a plane quad

/// A quad below this counts as folded (6°). No row may contain one, and no change of connections may create
/// one.
inline constexpr double kFoldedQuad = 0.1;
/// A quad below this counts as flat (9°). Its nodes are moved before smoothing, which hardly improves a quad
/// with nodes on a boundary.
inline constexpr double kFlatQuad = 0.15;

/// A quad below the first value is poor (30°) and gets further attempts; one above the second is good (53°)
/// and gets none.
inline constexpr double kPoorQuad = 0.5, kGoodQuad = 0.8;

/// A hexahedron below this is poor: other directions and sizes are tried. Solvers accept 0.2.
inline constexpr double kPoorCell = 0.3;
/// A tetrahedron below this is a sliver, and a note says so. Meshes without narrow places reach 0.1.
inline constexpr double kSliver = 0.02;

// Same volume

/// Two volumes are equal if they differ by less than this share of the larger: the sag of facets alone causes
/// half a percent.
inline constexpr double kSameVolume = 0.01;

/// A volume difference above this share is reported, whether it is caused by an assumption or by the mesh. It
/// is twice the difference below which volumes count as equal.
inline constexpr double kVolumeNoted = 2 * kSameVolume;

// Same size, same number

/// Lengths, sizes and numbers of sides count as equal if they differ by less than this share. Edges that are
/// equal in this sense get the same number of sides.
inline constexpr double kAlikeSizes = 0.01;

/// A number of sides that exceeds a whole number by less than this is rounded down. The value is far above
/// the rounding errors of sizes and lengths, and far below one side.
inline constexpr double kCountSlack = 1e-6;

/// Increase of the edge length per distance from a place with short edges, in paving and in estimates of the
/// number of quads [-].
inline constexpr double kGrading = 0.3;

/// A paving may deviate from the requested number of quads by this share.
inline constexpr double kQuadsOff = 0.25;

/// A paving is accepted if at least this share of its sides has the requested size, and at least this share
/// of its rows along the boundary is good.
inline constexpr double kPromisedShare = 0.95;

} // namespace lacuna
