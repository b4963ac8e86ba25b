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
std::string guess_of_bent(const topology::OpenVolume& sealed, const Closure& closure, RolesBy by);

/// What of a volume sealed by roles that were found nothing given tells, in words; empty where all is told:
/// what `guess_of_bent()` says, or a hole of a given face that is closed in its plane, though an end away
/// from it is missing as well. The hole may go through. Faces that look into the void, as those of a
/// counterbore do, leave no such doubt.
/// @param given  the faces of `model` that are the volume's first
std::string guess_of(const topology::Model& model, const std::vector<FaceId>& given,
                     const topology::OpenVolume& sealed, const Closure& closure);

/// What is said of holes of given faces that void walls close in their planes: a pocket that is missing whole
/// leaves no other trace.
std::vector<std::string> notes_of_holes(const topology::Model& model, const std::vector<FaceId>& given,
                                        const topology::OpenVolume& sealed, const Closure& closure);

} // namespace lacuna::closure
