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
/// Refuse to read what makes Gmsh run a script, in the sandbox.
void check_input_path(const Host& host, const std::string& path);

/// Read the path at `index`; its output_path() as a temporary.
const io::OutputPath& push_output_path(lua_State* L, int index, const char* call);

/// Lower-case ending of a path with its dot, ".msh"; empty where there is none.
std::string ending_of(const std::string& path);

} // namespace lacuna::lua
