// SPDX-License-Identifier: MIT
#pragma once

#include "program/command_line.h"
#include "program/stopping.h"

namespace lacuna::program {

/// Run the recipes of the line side by side, `line.jobs` at once, each in a process of its own with the
/// line's options: what ends one ends no other.
///
/// What a recipe prints comes whole, in the order of the line, on the stream it printed to. Of each that
/// fails its name and exit code follow on standard error. Ctrl-C, SIGTERM and SIGHUP are passed on to those
/// that run, and no other is begun.
/// @return  `failed` where any recipe failed.
Exit run_batch(const CommandLine& line);

} // namespace lacuna::program
