// SPDX-License-Identifier: MIT
#pragma once

#include "program/progress_line.h"

#include <lacuna/interpreter.h>

#include <string>

namespace lacuna::program {

/// Read, run, print until the end of the input.
/// @param history  file that lines typed are kept in; empty: that of LACUNA_HISTORY, else none.
/// @throw ScriptError  the history cannot be kept there.
void run_prompt(Interpreter& interpreter, const std::string& history, ProgressLine& progress);

} // namespace lacuna::program
