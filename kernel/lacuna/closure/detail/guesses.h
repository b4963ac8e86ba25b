// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/closure/close.h>
#include <lacuna/core/message.h>

#include <optional>
#include <vector>

namespace lacuna::closure {

/// Whether the user or the program chose the roles of the faces.
enum class RolesBy { person, finding };

/// The error about an ambiguous bend in a sealed volume, without a remedy; empty if no bend is ambiguous. The
/// code is "closure.shape_open" if the user chose the roles, otherwise "topology.shape_open". Two kinds of
/// void faces are ambiguous:
///
/// - A membrane: a face whose rim does not determine its inside. If the user chose the roles, a membrane is
///   the missing end, which closing interpolates (Algorithm 4). It is then ambiguous only in two cases: the
///   membrane differs from the thin plate over the same rim; or straight sides suggest several flat faces.
/// - A bent void face whose rim also lies on other quadrics that are far from the face.
///
/// A membrane over a rough rim is not ambiguous: the rim's points are off a plane by at most a twentieth of
/// the rim's diameter, and smooth faces over it enclose the same volume to 2 %.
std::optional<Message> guess_of_bent(const topology::OpenVolume& sealed, const Closure& closure, RolesBy by);

/// A face of `model` with a hole that was closed in the face's plane, although an end far from the face is
/// missing too: the hole may extend to that end. Invalid if there is no such face, or if the facets' normals
/// point into the void, as in a counterbore.
/// @param given  the faces of `model` that come first in the volume
FaceId open_hole(const topology::Model& model, const std::vector<FaceId>& given,
                 const topology::OpenVolume& sealed, const Closure& closure);
/// The error "topology.shape_open" about the hole that `open_hole()` finds, without a remedy.
Message guess_of_hole(const topology::Model& model, FaceId face);

/// Add a note. It is listed among the assumptions if the alternative changes the volume enough.
/// @param share  relative change of the volume under the alternative
void assume(Closure& closure, Message note, double share);

/// Note an assumption about missing walls next to a missing end. The uncertain share of the volume is
/// estimated as the volume of a bulge of these walls by a quarter of their width. The width of a wall is
/// taken as 4 area / perimeter.
void assume_walls(const topology::OpenVolume& sealed, const Message& note, Closure& closure);

/// Note holes of given faces that void faces close in their planes: a pocket that is missing entirely leaves
/// no other trace. The note is an assumption if a pocket as deep as its mouth is wide would change the volume
/// enough. Two more cases are noted: an end that covers a hole of given faces whose normals point into the
/// void, and a void face that is the smaller part of a ball.
void note_closed_holes(const topology::Model& model, const std::vector<FaceId>& given,
                       const topology::OpenVolume& sealed, Closure& closure);

/// Note void faces over rims that do not determine their inside, those over rough rims and, if the roles were
/// found, flat ones in a circle.
void note_open_rims(const topology::OpenVolume& sealed, RolesBy by, Closure& closure);

/// Note void faces between two flat rims of given faces: shoulders and whole branches may be missing there as
/// well.
void note_joined_rims(const topology::Model& model, Closure& closure);

} // namespace lacuna::closure
