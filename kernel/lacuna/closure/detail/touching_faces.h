// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/closure/close.h>
#include <lacuna/core/message.h>

#include <optional>
#include <vector>

namespace lacuna::closure {

/// Whether two straight sides of a loop join two others of one shape, so that straight lines between these
/// fill it.
bool is_ruled_between_alike(const topology::Model& model, const topology::Loop& loop);

/// Whether a loop lies on a ball, a circular cylinder or a cone.
bool lies_on_round_face(const topology::Model& model, const topology::Loop& loop);

/// Whether the rim of one missing face determines its shape: straight lines fill it, or it lies on one ball,
/// cylinder or cone that does not contain the given faces beside it.
bool tells_face(const topology::Model& model, const topology::Loop& loop, const RunContext& context = {});

/// The loops of two or three missing faces that touch, where one free loop runs round them. Flat faces whose
/// runs of the loop determine their planes meet in straight void edges, three of them in a void vertex. A
/// flat face and one that its rim determines meet in a straight edge, or in the image of the opposite side.
/// @param rim  a loop that is not flat; the void edges are added to the model.
/// @return  empty if there is no such split, or several.
std::optional<std::vector<topology::Loop>> split_touching(topology::Model& model, const topology::Rim& rim,
                                                          const RunContext& context);

/// Whether a void face closes a hole in one bent given face, or in parts of one cylinder or sphere, as where
/// a whole bore or boss is missing.
bool closes_hole_in_bent_face(const topology::Model& model, FaceId face);

/// Whether a void face is bent and its rim does not determine its shape.
bool is_untold(const topology::Model& model, FaceId face);

/// The error "topology.shape_open" about the first bent void face that its rim does not determine, without a
/// remedy.
std::optional<Message> untold_face(const topology::OpenVolume& sealed, const Closure& closure);

} // namespace lacuna::closure
