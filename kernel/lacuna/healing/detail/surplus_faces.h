// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/healing/detail/loose_model.h>
#include <lacuna/healing/shared/stitch.h>

namespace lacuna::healing {

// Clean-up after edges have merged. The report counts and notes every removal.

/// Remove sliver faces: faces whose border folds onto itself everywhere, so that they have almost no area.
void leave_out_thin_faces(LooseModel& loose, double tolerance, StitchReport& report);

/// Of each set of coincident faces, remove all but one. Keep two if other faces are connected to both.
void leave_out_repeated_faces(LooseModel& loose, double tolerance, StitchReport& report,
                              const RunContext& context);

/// Note pairs of free edges that have the same ends and a small gap between them.
void note_gaps(const LooseModel& loose, double tolerance, StitchReport& report, const RunContext& context);

/// The note about a face that is left out because it is too thin.
Message thin_face_note(const topology::Model& model, FaceId face, double tolerance);

} // namespace lacuna::healing
