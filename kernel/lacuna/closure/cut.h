// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/closure/steps.h>
#include <lacuna/core/run_context.h>
#include <lacuna/geometry/newell.h>
#include <lacuna/topology/open_volume.h>

#include <vector>

namespace lacuna::closure {

/// Cut a volume by a plane into pieces that share what was cut.
///
/// Faces that the plane crosses are split and keep their tags, names and exact surfaces. The part of the
/// plane within the volume becomes one void face a region, named `cut_1` and so on, that both pieces beside
/// it have: `sweep::sweep_assembly()` makes its quads one. Where the plane meets what is missing, the volume
/// is closed first, so that its void faces are cut too. Where it cannot be closed as a whole, straight void
/// edges join the ends of what the plane crosses, and each piece can close its part.
///
/// A cut that meets an end is a wall of its pieces. Otherwise it is the end that a piece lacks, with those
/// walls that lie in its plane and go on from it. A piece without ends gets one from its other faces where
/// they show it, and has its two cuts as ends where it lies between two.
/// @return  pieces behind the plane first.
/// @throw NotSweepable "closure.cut_misses"  the plane crosses nothing; names what it touches or how far off
///         it is. "closure.cut_apart"  the cut does not come apart, as of a ring cut once.
///         "closure.cut_touches"  it runs along faces nearly in it. "closure.cut_gaps"  ends of walls that
///         cannot be joined without crossing.
/// @throw InvalidInput  as `topology::imprint_walks()`.
/// @note  O(facets log facets).
std::vector<StepPiece> cut_by_plane(const topology::OpenVolume& volume, const geometry::Plane& plane,
                                    const RunContext& context = {});

/// Cut a volume by a face of a model into pieces that share it.
///
/// A face whose rim runs along edges of the volume, as a partition that was modelled with it, is what the
/// pieces share, whatever its shape. Another flat face cuts by its plane: one of the volume's own along all
/// of the plane, one of another model where its own facets are within the volume.
/// @param face  of `model`, which may be the volume's.
/// @throw NotSweepable "closure.cut_face"  a curved face whose rim leaves the volume's edges; names the face
///         and the place. Else as `cut_by_plane()`.
std::vector<StepPiece> cut_by_face(const topology::OpenVolume& volume, const topology::Model& model,
                                   FaceId face, const RunContext& context = {});

} // namespace lacuna::closure
