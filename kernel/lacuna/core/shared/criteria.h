// SPDX-License-Identifier: MIT
#pragma once

namespace lacuna {

// Criteria that several parts of the kernel share. A limit that decides one thing in one place stays there.

// Rounding, accuracy, same place

/// Relative rounding error of computed lengths, areas and parameters: a few hundred operations lose four of
/// the sixteen digits.
inline constexpr double kRoundoff = 1e-12;

/// Points closer than this share of the length at hand (a side, an edge, a rim, the diagonal) are the same
/// place, and bends below it are straight. Projections converge to ten digits, and no side of a mesh is as
/// short.
inline constexpr double kSamePlace = 1e-9;

/// Relative accuracy of coordinates in files, which have six to seven digits in single precision. Points this
/// close to a line or a plane are on it, vectors with a smaller sine between them are parallel, and angles
/// differ by more [radian].
inline constexpr double kFileAccuracy = 1e-6;

/// A number of sides that exceeds a whole number by less is rounded down: far above the rounding of sizes and
/// lengths, far below a side.
inline constexpr double kCountSlack = 1e-6;

// Corner

/// Faces whose normals differ by less across an edge are one patch, and a rim that turns by less has no corner
/// [degrees]: a chamfer of 45° has edges, a cylinder of more than twelve sides does not.
inline constexpr double kCreaseAngle = 30;

/// Inner angles of a face [degrees]. A vertex below the first is a corner, where a mapped grid and the rows
/// along a side end; a vertex above the second is a reversal. Half way between one, two and three quads.
inline constexpr double kCornerBelow = 135, kReversalAbove = 225;

/// Cosine of the turn (20°) below which two edges are parts of one curve: imprints split circles into edges of
/// single chords, and coarse circles have some twenty.
inline constexpr double kOneCurve = 0.94;

/// Cosine of the turn (45°) below which an edge continues a line beyond a vertex: half way between straight on
/// and a right angle.
inline constexpr double kContinues = 0.7;

/// Sides of a polyline that turn by less are parts of a bend, by more they form a corner [degrees]: a hexagon
/// still approximates a circle, a square does not.
inline constexpr double kBendBelow = 75;

// Flat, straight

/// A face is flat if its summed area vector falls short of its area by less than this share, and two
/// directions agree if their cosine falls short of 1 by less: normals within about a degree. Facets of flat
/// faces in files are that exact; walls that bend for the eye are not.
inline constexpr double kFlatShare = 2e-4;

/// Relative changes of sizes, bends of sides, gaps of quads [radian for angles] below this are not visible in
/// a mesh, and are not worth the work.
inline constexpr double kVisible = 1e-3;

// Poor: scaled Jacobian, of a quad with straight sides the least sine of its corners

/// A quad below this is folded for all purposes (6°): rows are not kept with it, and corners not opened by it.
inline constexpr double kFoldedQuad = 0.1;

/// Smoothing does not improve a quad below this if its nodes are on a boundary (9°).
inline constexpr double kFlatQuad = 0.15;

/// A quad below this is poor (30°), and more is tried for it; above the next one it is good, and nothing is.
inline constexpr double kPoorQuad = 0.5, kGoodQuad = 0.8;

/// A hexahedron below this is poor. Meshes of other directions and other sides are tried for it.
inline constexpr double kPoorCell = 0.3;

// Same volume

/// Two volumes are the same if they differ by less than this share of the larger: the sag of facets alone
/// makes half a percent.
inline constexpr double kSameVolume = 0.01;

/// A difference of volume above this share is reported, whether an assumption or the mesh causes it: a mesh
/// may lose as much.
inline constexpr double kVolumeNoted = 0.02;

// Sizes and numbers of cells

/// Lengths, sizes and numbers of sides that differ by less than this share are alike, as drawn: they get the
/// same number of sides.
inline constexpr double kAlikeSizes = 0.01;

/// Growth of a size over the distance from a place with short sides, in paving and where quads are estimated.
inline constexpr double kGrading = 0.3;

/// A mesh has the number of quads asked if it is off by no more than this share: the promise of every paving.
inline constexpr double kQuadsOff = 0.25;

/// The promised share of sides with the size asked, and of good rows along the boundary.
inline constexpr double kPromisedShare = 0.95;

} // namespace lacuna
