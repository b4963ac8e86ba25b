// SPDX-License-Identifier: MIT
#pragma once

#include "program/progress_line.h"

#include <lacuna/interpreter.h>

#include <string>

namespace lacuna::program {

/// Read statements, run them and print the results, until the end of the input. A history file that cannot be
/// written is reported on standard error.
/// @param history  file for the lines typed; empty: that of LACUNA_HISTORY, else none.
/// @throw Cancelled  SIGTERM or SIGHUP ends the prompt.
void run_prompt(Interpreter& interpreter, const std::string& history, ProgressLine& progress);

} // namespace lacuna::program
