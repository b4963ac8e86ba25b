// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/healing/detail/loose_model.h>
#include <lacuna/healing/stitch.h>

#include <string>

namespace lacuna::healing {

// What is left over once edges have merged; every act is counted and noted in the report.

/// Remove faces whose border lies on itself everywhere and that have next to no area.
void leave_out_thin_faces(LooseModel& loose, double tolerance, StitchReport& report);

/// Of faces that lie on each other everywhere remove all but one, or two where other faces go on from both.
void leave_out_repeated_faces(LooseModel& loose, double tolerance, StitchReport& report,
                              const RunContext& context);

/// Note pairs of edges of one face alone that have the same ends and part a little between them.
void note_gaps(const LooseModel& loose, double tolerance, StitchReport& report, const RunContext& context);

/// A length as messages give it.
std::string in_words(double length);

} // namespace lacuna::healing
