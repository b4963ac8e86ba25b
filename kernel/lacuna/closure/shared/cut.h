// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/closure/shared/steps.h>
#include <lacuna/core/run_context.h>
#include <lacuna/geometry/newell.h>
#include <lacuna/topology/open_volume.h>

#include <vector>

namespace lacuna::closure {

/// Cut a volume by a plane into pieces that share the cut faces.
///
/// Faces that the plane crosses are split and keep their tags, names and exact surfaces. Each region of the
/// plane inside the volume becomes a void face, named `cut_1` and so on, which belongs to both adjacent
/// pieces: `sweep::sweep_assembly()` gives both the same quads. If the plane crosses missing faces, the
/// volume is closed first, so that its void faces are cut too. If it cannot be closed as a whole, straight
/// void edges join the open ends of the section, and each piece can be closed on its own.
///
/// A cut face that meets an end becomes a wall of its pieces. Any other cut face becomes the end that a piece
/// lacks, together with coplanar walls next to it. If a piece has no other end, one is chosen from its other
/// faces, if they determine it. A piece between two cuts has the two cut faces as ends.
/// @return  pieces behind the plane first.
/// @throw NotSweepable "closure.cut_misses"  the plane crosses nothing; names the faces it touches or the
///         distance. "closure.cut_apart" the volume stays connected, as a ring does that is cut once.
///         "closure.cut_touches" the plane runs along faces that nearly lie in it. "closure.cut_gaps" open
///         ends of walls that cannot be joined without crossings.
/// @throw InvalidInput  the errors of `topology::imprint_walks()`.
/// @note  O(facets log facets).
std::vector<StepPiece> cut_by_plane(const topology::OpenVolume& volume, const geometry::Plane& plane,
                                    const RunContext& context = {});

/// Cut like `cut_by_plane()`, but only in the regions of the plane whose rims run along one of the given
/// edges; without edges, in all regions. Cut lines across flat faces have no inner points, so that coarse
/// meshes fold no facets.
/// @param least  the least distance between the cut and an edge beside it [model length]. Edges that meet the
///         plane, or share a vertex with such an edge, may be nearer: there, the volume itself is that thin.
/// @throw NotSweepable "closure.cut_thin"  an edge is nearer, or a piece is thinner; or the errors of
///         `cut_by_plane()`.
std::vector<StepPiece> cut_at_edges(const topology::OpenVolume& volume, const geometry::Plane& plane,
                                    const std::vector<EdgeId>& edges, double least,
                                    const RunContext& context = {});

/// Cut a volume by a face of a model into pieces that share it.
///
/// If the rim of the face runs along edges of the volume, as the rim of a modelled partition does, the pieces
/// share the face itself, whatever its shape. Any other face must be flat and cuts by its plane. A face of
/// the volume cuts along the whole plane. A face of another model cuts only where its own facets are inside
/// the volume.
/// @param face  a face of `model`, which may be the model of the volume.
/// @throw NotSweepable "closure.cut_face"  a curved face whose rim leaves the volume's edges; names the face
///         and the place. Or the errors of `cut_by_plane()`.
std::vector<StepPiece> cut_by_face(const topology::OpenVolume& volume, const topology::Model& model,
                                   FaceId face, const RunContext& context = {});

} // namespace lacuna::closure
