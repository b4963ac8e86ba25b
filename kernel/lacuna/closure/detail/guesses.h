// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/closure/close.h>
#include <lacuna/core/message.h>

#include <optional>
#include <vector>

namespace lacuna::closure {

/// The error about the first void face with an ambiguous bend in a sealed volume, without a remedy; empty if
/// there is none. The code is "closure.shape_open" if the user chose the roles, otherwise
/// "topology.shape_open". Two kinds of void faces are ambiguous:
///
/// - A membrane: a face whose rim does not determine its inside. If the user chose the roles, the membrane is
///   the missing end, and closing interpolates it (Algorithm 4). In that case it is ambiguous only if it
///   differs from a thin-plate spline over the same rim, or if straight sides suggest several flat faces.
/// - A bent void face that is far from another quadric through its rim.
///
/// A membrane over a rough rim is not ambiguous. A rim is rough, not bent, if its points deviate from a plane
/// by at most a twentieth of its diameter, and different smooth faces over it change the enclosed volume by
/// at most 2 %.
std::optional<Message> guess_of_bent(const topology::OpenVolume& sealed, const Closure& closure, RolesBy by);

/// The given face with a hole that a void face closes in its plane, if there is one.
std::optional<FaceId> face_round_hole(const topology::Model& model, FaceId filler);

/// A face of `model` with a hole that was closed in the face's plane, while an end that does not touch the
/// face is missing too. The hole may extend to that end. Invalid if there is no such face, or if the normals
/// of the given faces point into the void, as in a counterbore.
/// @param given  the faces of `model` that come first in the volume
FaceId open_hole(const topology::Model& model, const std::vector<FaceId>& given,
                 const topology::OpenVolume& sealed, const Closure& closure);
/// The error "topology.shape_open" about the hole that `open_hole()` finds, without a remedy.
Message guess_of_hole(const topology::Model& model, FaceId face);

/// Add a note. If `share` exceeds 2 %, the note is also listed in `Closure::assumptions`.
/// @param share  relative change of the volume if the assumption is wrong
void assume(Closure& closure, Message note, double share, Assumed what = Assumed::shape);

/// Note an assumption about missing walls next to a missing end. The uncertain volume is that of a bulge of
/// each missing wall by a quarter of its width, where the width is 4 area / perimeter.
void assume_walls(const topology::OpenVolume& sealed, const Message& note, Closure& closure);

/// Note assumptions about void faces, with the relative change of the volume if an assumption is wrong
/// (`assume()`):
/// - If the normals of the given faces do not point into the void: a face that closes a hole of a given face
///   in the face's plane. A pocket may be missing behind it. It is assumed to be as deep as the hole is
///   wide. In an end that a person named, the hole is a part of the end and is not noted.
/// - If the normals point into the void: a face of an end that covers a hole of a given face.
/// - If the normals point into the void: a void face that is the smaller part of a ball.
void note_closed_holes(const topology::Model& model, const std::vector<FaceId>& given,
                       const topology::OpenVolume& sealed, RolesBy by, Closure& closure);

/// Note assumptions about void faces:
/// - membranes;
/// - faces over rough rims;
/// - if the program found the roles: flat faces in circles, flat faces that meet other void faces and whose
///   given edges do not show their plane, and other faces whose rim does not determine how many faces are
///   missing.
void note_open_rims(const topology::OpenVolume& sealed, RolesBy by, Closure& closure);

/// Note void faces between two flat rims of given faces:
/// - if the program found the roles: shoulders and whole branches may be missing there as well;
/// - if a person named them: the plane of one rim may end the volume, where it crosses a face at the other
///   rim.
void note_joined_rims(const topology::OpenVolume& sealed, RolesBy by, Closure& closure);

} // namespace lacuna::closure
