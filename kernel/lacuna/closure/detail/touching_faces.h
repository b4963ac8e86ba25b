// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/closure/close.h>
#include <lacuna/closure/detail/rim_quadrics.h>
#include <lacuna/core/message.h>

#include <optional>
#include <vector>

namespace lacuna::closure {

/// Whether a four-sided loop has two opposite straight sides, and the other two sides are similar curves. A
/// ruled face between these curves then fills the loop.
bool is_ruled_between_alike(const topology::Model& model, const topology::Loop& loop);

/// Whether a loop lies on a quadric of a wanted kind.
bool lies_on_quadric(const topology::Model& model, const topology::Loop& loop,
                     bool (&is_wanted)(const Quadric&));

/// Whether the rim of one missing face determines its shape: the face is ruled between similar sides, or the
/// rim lies on a bent quadric. A hole in one bent face, or in parts of one cylinder or sphere, does not
/// determine the face: a bore or boss may be missing there. A ruled face is accepted even there.
bool tells_face(const topology::Model& model, const topology::Loop& loop, const RunContext& context = {});

/// Split a free loop that runs around two or three adjacent missing faces into the loops of these faces.
///
/// Two faces: one is flat; the other is flat too, or its rim determines its shape. The void edge between them
/// is straight, or a shifted copy of the opposite side of the second face, or the edge in which the plane
/// meets the round wall of the second face (`edge_in_plane()`). Three faces: all are flat and meet in a void
/// vertex, or one is flat and the other two are as in the case of two faces.
/// @param rim  a loop that is not flat.
/// @return  the loops; their void edges, and the void vertex if there is one, are added to the model. Empty
///         if no split fits, or more than one.
std::optional<std::vector<topology::Loop>> split_touching(topology::Model& model, const topology::Rim& rim,
                                                          const RunContext& context);

/// Whether a void face closes a hole in one bent given face, or in parts of one cylinder or sphere. A whole
/// bore or boss may be missing there.
bool closes_hole_in_bent_face(const topology::Model& model, FaceId face);

/// Whether a void face continues a given face beside it: both lie in one plane, or are parts of spheres or
/// cylinders of equal radius. No edge would separate them if only one face were missing.
bool continues_face_beside(const topology::Model& model, FaceId face);

/// Whether nothing but a quadric that is not round determines the shape of a bent void face. A freeform face
/// may end in such a rim as well.
bool has_only_quadric(const topology::Model& model, FaceId face);

/// Whether the shape of a bent void face rests on edges between missing faces: its given edges alone
/// determine neither a round wall through its rim, nor a face that is ruled between similar sides.
bool rests_on_void_edges(const topology::Model& model, FaceId face);

/// Whether a void face is bent and its rim does not determine its shape; for a face with two rims, see
/// `is_ring_at_step()`.
bool is_untold(const topology::Model& model, FaceId face);

/// The error "topology.shape_open" about the first bent void face whose rim does not determine its shape,
/// without a remedy.
/// @param least  a face is left out if a pocket as deep as its mouth is wide holds less [model length³]
std::optional<Message> untold_face(const topology::OpenVolume& sealed, const Closure& closure,
                                   double least = 0);

} // namespace lacuna::closure
