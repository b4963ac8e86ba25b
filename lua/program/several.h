// SPDX-License-Identifier: MIT
#pragma once

#include "program/command_line.h"
#include "program/stopping.h"

#include <lacuna/core/team.h>

#include <functional>

namespace lacuna::program {

/// Whether this process is the first of those that `mpirun` started, or alone; the first alone tells of what
/// goes wrong before run_as_several().
bool is_first();
/// Whether `mpirun` started several.
bool is_one_of_several();

/// Run a command line as one of several processes: the first runs it, with the others as its crew, and says
/// so where they had nothing to do. Each takes its share of the cores, where no number of threads is given.
/// @throw BadUsage  several cannot do that together.
Exit run_as_several(const CommandLine& line, const std::function<Exit(const CommandLine&, const Crew*)>& run);

} // namespace lacuna::program
