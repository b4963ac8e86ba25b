// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/shared/constants.h>

/// What counts as a corner, flat, poor, the same place or the same volume. A limit that decides the same in
/// several files is defined here once; one that decides a single thing stays beside it.

namespace lacuna {

// Same place

/// Relative rounding error of computed lengths, areas and parameters: a few hundred operations lose four of
/// the sixteen digits.
inline constexpr double kRoundoff = 1e-12;

/// Points closer than this share of the length at hand (a side, an edge, a rim, the diagonal) are the same
/// place, and a bend below it is none: projections converge to ten digits, and no side of a mesh is as short.
inline constexpr double kSamePlace = 1e-9;

/// Relative accuracy of coordinates in files: six to seven digits in single precision. Points this close to
/// a line or a plane are on it, vectors with a smaller sine between them are parallel, and angles that differ
/// by less are equal [radian].
inline constexpr double kFileAccuracy = 1e-6;

/// Relative changes of sizes, bends of sides and gaps of quads below this, and angles [radian], are not
/// visible in a mesh and not worth the work.
inline constexpr double kVisible = 1e-3;

// Corner

/// Faces whose normals differ by less across an edge are one patch; a rim that turns by less has no corner
/// [degrees]. A chamfer of 45° has edges, a cylinder of more than twelve sides does not.
inline constexpr double kCreaseAngle = 30;

/// Inner angles of a face [degrees]. A vertex below the first is a corner, where a mapped grid and the rows
/// along a side end; a vertex above the second is a reversal. Half way between one, two and three quads.
inline constexpr double kCornerBelow = 135, kReversalAbove = 225;

/// Cosine of the turn (20°) below which two edges belong to one curve: imprints split circles into edges of
/// single chords, and coarse circles have some twenty.
inline constexpr double kOneCurve = 0.94;

/// Cosine of the turn (45°) below which an edge continues a line beyond a vertex: half way between straight
/// and a right angle.
inline constexpr double kContinues = 0.7;

/// Sides of a polyline that turn by less form a bend, others a corner [degrees]: a hexagon still approximates
/// a circle, a square does not.
inline constexpr double kBendBelow = 75;

// Flat

/// Sine of the largest angle between directions that count as parallel, and of the largest turn of a line
/// that counts as straight: a degree. Facets in files are off by tenths of that.
inline constexpr double kParallel = 0.02;

/// A face is flat if its summed area vector falls short of its area by less than this share, and normals
/// agree if their cosine falls short of 1 by less: they are parallel.
inline constexpr double kFlatShare = kParallel * kParallel / 2;

// Poor: least scaled Jacobian, of a plane quad the least sine of its corners

/// A quad below this counts as folded (6°): no row keeps it, and no corner is opened by it.
inline constexpr double kFoldedQuad = 0.1;

/// A quad below this is flat (9°): smoothing hardly improves it where its nodes are on a boundary.
inline constexpr double kFlatQuad = 0.15;

/// A quad below the first is poor (30°), and more is tried for it; one above the second is good (53°), and
/// more would be wasted.
inline constexpr double kPoorQuad = 0.5, kGoodQuad = 0.8;

/// A hexahedron below this is poor: other directions and sizes are tried. Solvers accept 0.2.
inline constexpr double kPoorCell = 0.3;

// Same volume

/// Two volumes are the same if they differ by less than this share of the larger: the sag of facets alone
/// makes half a percent.
inline constexpr double kSameVolume = 0.01;

/// A difference of volume above this share is reported, whether an assumption or the mesh causes it: a mesh
/// may lose as much.
inline constexpr double kVolumeNoted = 0.02;

// Same size, same number

/// Lengths, sizes and numbers of sides that differ by less than this share are alike, as drawn: they get the
/// same number of sides.
inline constexpr double kAlikeSizes = 0.01;

/// A number of sides that exceeds a whole number by less is rounded down: far above the rounding of sizes and
/// lengths, far below a side.
inline constexpr double kCountSlack = 1e-6;

/// Growth of a size over the distance from a place with short sides, in paving and where quads are estimated.
inline constexpr double kGrading = 0.3;

/// A mesh has the number of quads asked if it is off by no more than this share, the promise of every paving.
inline constexpr double kQuadsOff = 0.25;

/// The promised share of sides with the size asked, and of good rows along the boundary.
inline constexpr double kPromisedShare = 0.95;

} // namespace lacuna
