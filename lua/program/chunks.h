// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/interpreter.h>

#include <lua.hpp>

namespace lacuna::program {

/// Load a Lua source that is part of the program, and push it on the stack. @pre the name exists
lua_State* push_chunk(Interpreter& interpreter, const char* name);
/// The text of such a source. @pre the name exists
const char* chunk_text(const char* name);

} // namespace lacuna::program
