// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/healing/detail/loose_model.h>
#include <lacuna/healing/shared/stitch.h>

namespace lacuna::healing {

// Removal of faces that are superfluous after edges have merged. The report counts and notes every removal.

/// Remove sliver faces: faces that use each of their edges twice and have almost no area, and faces without
/// facets.
void leave_out_thin_faces(LooseModel& loose, double tolerance, StitchReport& report);

/// Remove all but one of several coincident faces. Two of them are kept if each is needed by other faces at
/// their border, as where two solids touch.
void leave_out_repeated_faces(LooseModel& loose, double tolerance, StitchReport& report,
                              const RunContext& context);

/// Note pairs of free edges that have the same ends and a gap between them that is small compared with their
/// length.
void note_gaps(const LooseModel& loose, double tolerance, StitchReport& report, const RunContext& context);

/// The note about a face that is left out because it is too thin.
Message thin_face_note(const topology::Model& model, FaceId face, double tolerance);

} // namespace lacuna::healing
