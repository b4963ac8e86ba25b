// SPDX-License-Identifier: MIT
#pragma once

#include <lua.hpp>

namespace lacuna::lua {

/// Open the libraries that a recipe in the sandbox may use, including `lacuna`, and remove their unsafe
/// functions. May raise a Lua error.
void open_sandbox_libraries(lua_State* L);

} // namespace lacuna::lua
