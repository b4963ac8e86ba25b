// SPDX-License-Identifier: MIT
#pragma once

#include <lua.hpp>

namespace lacuna::lua {

/// Open the libraries that a recipe in the sandbox may have, `lacuna` among them, and take away from them
/// what it must not have. Raises.
void open_sandbox_libraries(lua_State* L);

} // namespace lacuna::lua
