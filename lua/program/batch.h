// SPDX-License-Identifier: MIT
#pragma once

#include "program/command_line.h"
#include "program/stopping.h"

namespace lacuna::program {

/// Run the recipes of the command line in parallel, `line.jobs` at a time, each in its own process with the
/// options of the command line, so that a crash ends one recipe only.
///
/// The output of each recipe is printed as a whole, in the order of the command line, on the stream it was
/// written to. For recipes that fail, name and exit code follow on standard error. Ctrl-C, SIGTERM and SIGHUP
/// are passed on to the running recipes, and no further recipe is started.
/// @return  `failed` where any recipe failed.
Exit run_batch(const CommandLine& line);

} // namespace lacuna::program
