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
/// volume is closed first, so that its void faces are cut too. If the volume cannot be closed, straight void
/// edges join the open ends of the section, and each piece can be closed separately.
///
/// Roles of the cut faces in each piece, the first rule that applies:
/// 1. A cut face that touches faces of an end in its own plane becomes part of this end.
/// 2. If the piece has both ends, a cut face that touches neither of them and is about parallel to the source
///    becomes part of the end with the same outward normal.
/// 3. A cut face becomes a wall if the piece has both ends, or if it or adjacent walls in its plane touch an
///    end.
/// 4. Any other cut face becomes a missing end, together with adjacent walls in its plane. If the piece then
///    lacks the other end, this end is chosen from the walls, if they determine it.
/// If the ends of a piece would touch, or a body of it would have none, all its faces are walls.
/// @return  pieces behind the plane first.
/// @throw NotSweepable "closure.cut_misses"  the plane crosses nothing; names the faces it touches or the
///         distance. "closure.cut_apart"  the volume stays in one piece, like a ring that is cut once.
///         "closure.cut_touches"  the plane runs along faces that nearly lie in it. "closure.cut_gaps"  the
///         open ends of the section cannot be joined without crossings.
/// @throw InvalidInput  the errors of `topology::imprint_walks()`.
/// @note  O(facets log facets).
std::vector<StepPiece> cut_by_plane(const topology::OpenVolume& volume, const geometry::Plane& plane,
                                    const RunContext& context = {});

/// Cut like `cut_by_plane()`, but only in the regions of the plane whose rims run along one of the given
/// edges; without edges, in all regions. Cut lines across flat faces have no inner points. Otherwise a line
/// could have more points than its mesh has nodes, and facets between the points would fold.
/// @param least  the least distance between the cut and an edge beside it [model length]. It does not apply
///         to edges that meet the plane or share a vertex with such an edge: there the volume itself is thin.
/// @throw NotSweepable "closure.cut_thin"  an edge is nearer than `least`, or a piece is thinner; or the
///         errors of `cut_by_plane()`.
std::vector<StepPiece> cut_at_edges(const topology::OpenVolume& volume, const geometry::Plane& plane,
                                    const std::vector<EdgeId>& edges, double least,
                                    const RunContext& context = {});

/// Cut a volume by a face of a model into pieces that share it.
///
/// If the rim of the face runs along edges of the volume, as the rim of a modelled partition does, the pieces
/// share the face itself; it may be curved. Any other face must be flat, and its plane cuts the volume. The
/// whole plane cuts if the face belongs to the volume; if the face belongs to another model, only those
/// regions of the plane cut that contain facets of the face.
/// @param face  a face of `model`, which may be the model of the volume.
/// @throw NotSweepable "closure.cut_face"  the face is curved and its rim does not run along edges of the
///         volume; names the face and the place. Or the errors of `cut_by_plane()`.
std::vector<StepPiece> cut_by_face(const topology::OpenVolume& volume, const topology::Model& model,
                                   FaceId face, const RunContext& context = {});

} // namespace lacuna::closure
