// SPDX-License-Identifier: MIT
#pragma once

#include "bindings/options.h"

#include <lacuna/io/whole_file.h>

#include <string>

namespace lacuna::lua {

struct Host;

/// The place where a recipe may write `path`: the path itself or, in the sandbox, the place below the output
/// folder.
/// @throw InvalidInput  the path leads out of the output folder, or the sandbox has no output folder.
io::OutputPath output_path(const Host& host, const std::string& path);
/// In the sandbox, refuse to read scripts.
void check_input_path(const Host& host, const std::string& path);

/// Push the output_path() of the path at `index`, as a temporary.
const io::OutputPath& push_output_path(lua_State* L, int index, const char* call);

} // namespace lacuna::lua
