// SPDX-License-Identifier: MIT
#pragma once

#include "program/command_line.h"
#include "program/stopping.h"

#include <lacuna/core/shared/team.h>

#include <functional>

namespace lacuna::program {

/// Whether this process has rank 0, or runs alone. Only rank 0 prints errors before run_as_several().
bool is_first();
/// Whether `mpirun` started several processes.
bool is_one_of_several();

/// Run a command line as one of several processes. Rank 0 runs it, the others help with shared tasks; a note
/// says so if there were none. Unless a number of threads is given, each process uses its share of the cores.
/// @throw BadUsage  the command line cannot be run by several processes.
Exit run_as_several(const CommandLine& line, const std::function<Exit(const CommandLine&, const Crew*)>& run);

} // namespace lacuna::program
