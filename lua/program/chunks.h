// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/interpreter.h>

#include <lua.hpp>

namespace lacuna::program {

/// A Lua source of the program, loaded and left on the stack. @pre there is one of that name.
lua_State* push_chunk(Interpreter& interpreter, const char* name);
/// The text of one. @pre as above
const char* chunk_text(const char* name);

} // namespace lacuna::program
