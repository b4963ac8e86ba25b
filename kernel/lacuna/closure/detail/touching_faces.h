// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/closure/close.h>
#include <lacuna/core/message.h>

#include <optional>
#include <vector>

namespace lacuna::closure {

/// Whether a four-sided loop has two opposite straight sides, and its other two sides are similar curves: a
/// ruled face between these then fills the loop.
bool is_ruled_between_alike(const topology::Model& model, const topology::Loop& loop);

/// Whether a loop lies on a ball, a circular cylinder or a cone.
bool lies_on_round_face(const topology::Model& model, const topology::Loop& loop);

/// Whether the rim of one missing face determines its shape: the face is ruled between similar sides, or the
/// rim lies on a sphere, a circular cylinder or a cone. A rim that is a hole in one bent face, or in parts of
/// one cylinder or sphere, determines nothing: a bore or boss may be missing there.
bool tells_face(const topology::Model& model, const topology::Loop& loop, const RunContext& context = {});

/// Split a free loop that runs around two or three adjacent missing faces into the loops of these faces.
///
/// If there are two faces, one is flat, because its part of the loop lies in a plane. The other is flat too,
/// or its rim determines its shape. The void edge between them is straight, or a shifted copy of the opposite
/// side of the second face. If there are three faces, either all are flat and meet in a void vertex, or one
/// is flat and the other two are split as above.
/// @param rim  a loop that is not flat. The void edges and the void vertex are added to the model.
/// @return  empty if no split fits, or more than one.
std::optional<std::vector<topology::Loop>> split_touching(topology::Model& model, const topology::Rim& rim,
                                                          const RunContext& context);

/// Whether a void face closes a hole in one bent given face, or in parts of one cylinder or sphere, as where
/// a whole bore or boss is missing.
bool closes_hole_in_bent_face(const topology::Model& model, FaceId face);

/// Whether a void face is bent and its rim does not determine its shape.
bool is_untold(const topology::Model& model, FaceId face);

/// The error "topology.shape_open" about the first bent void face whose rim does not determine its shape,
/// without a remedy.
/// @param least  a face is left out if a pocket as deep as its mouth is wide holds less [model length³]
std::optional<Message> untold_face(const topology::OpenVolume& sealed, const Closure& closure,
                                   double least = 0);

} // namespace lacuna::closure
