// SPDX-License-Identifier: MIT
#pragma once

#include "bindings/options.h"

#include <lacuna/io/whole_file.h>

#include <string>

namespace lacuna::lua {

struct Host;

/// Where a recipe may write `path`: the path itself, or, in the sandbox, the place below the output folder.
/// @throw InvalidInput  outside the output folder, or the sandbox has none.
io::OutputPath output_path(const Host& host, const std::string& path);
/// Refuse to read scripts, in the sandbox.
void check_input_path(const Host& host, const std::string& path);

/// Read the path at `index`; its output_path() as a temporary.
const io::OutputPath& push_output_path(lua_State* L, int index, const char* call);

} // namespace lacuna::lua
