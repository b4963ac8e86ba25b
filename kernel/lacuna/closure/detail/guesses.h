// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/closure/close.h>

#include <string>
#include <vector>

namespace lacuna::closure {

/// Who said what each face is to the sweep.
enum class RolesBy { person, finding };

/// Whether a void face is bent in a way that nothing given tells, as `guess_of_bent()` says.
/// @param sealed  with what `closure` added
bool bends_untold(const topology::OpenVolume& sealed, const Closure& closure);

/// Where a sealed volume bends as nothing given tells, in words; empty where all is told.
///
/// - A bent void face whose rim says nothing of its inside: a membrane, or one with more than four corners.
///   Where a person named the roles a membrane is the end that is missing (Algorithm 4), and closing tells
///   what it leaves open; it is in doubt where the smoothest faces over its rim, a membrane and a thin plate,
///   differ, or straight sides tell of several flat faces.
/// - A bent void face whose rim lies on other quadrics that are far off it.
/// - A bent void face along whose rim given edges go round corners in one plane: a flat face is missing
///   there.
///
/// No rough rim is in doubt: one whose points are off a plane by a twentieth of its diameter at most, where
/// smooth faces over it enclose the same to 2 %.
std::string guess_of_bent(const topology::OpenVolume& sealed, const Closure& closure, RolesBy by);

/// A face of `model` with a hole that is closed in its plane, though an end away from it is missing as well:
/// the hole may go through. Not valid where there is none. Faces that look into the void, as those of a
/// counterbore do, leave no such doubt.
/// @param given  the faces of `model` that are the volume's first
FaceId open_hole(const topology::Model& model, const std::vector<FaceId>& given,
                 const topology::OpenVolume& sealed, const Closure& closure);
std::string hole_in_words(const topology::Model& model, FaceId face);

/// An assumption matters where the volume would differ otherwise by more than this share: as much as a mesh
/// may lose of what is sealed.
constexpr double kMatters = 0.02;

/// Add a note of what is assumed, which is an assumption where it matters.
/// @param share  of the volume by which it would differ otherwise
void assume(Closure& closure, const char* code, std::string text, double share);

/// Note the holes of given faces that void walls close in their planes: a pocket that is missing whole leaves
/// no other trace. It matters where one as deep as its mouth is wide would.
void note_closed_holes(const topology::Model& model, const std::vector<FaceId>& given,
                       const topology::OpenVolume& sealed, Closure& closure);

/// Note void faces over rims that leave open how the inside bends, and those over rough rims.
void note_open_rims(const topology::OpenVolume& sealed, RolesBy by, Closure& closure);

} // namespace lacuna::closure
