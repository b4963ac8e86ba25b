// SPDX-License-Identifier: MIT
#pragma once

#include "program/progress_line.h"

#include <lacuna/interpreter.h>

#include <string>

namespace lacuna::program {

/// Read statements, run them and print the results, until the end of the input.
/// @param history  file for the lines typed; empty: that of LACUNA_HISTORY, else none.
/// @throw ScriptError  the history file cannot be written.
void run_prompt(Interpreter& interpreter, const std::string& history, ProgressLine& progress);

} // namespace lacuna::program
