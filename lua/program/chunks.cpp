// SPDX-License-Identifier: MIT
#include "program/chunks.h"

#include "bindings/embedded.h"
#include "bindings/lacuna_lua.h"

#include <cstring>
#include <stdexcept>
#include <string>

namespace lacuna::program {

const char* chunk_text(const char* name)
{
    for (std::size_t i = 0; i < lua::kProgramChunkCount; ++i)
        if (std::strcmp(lua::kProgramChunks[i].name, name) == 0) return lua::kProgramChunks[i].source;
    throw std::logic_error(std::string("the program holds no ") + name);
}

lua_State* push_chunk(Interpreter& interpreter, const char* name)
{
    lua_State* const L = interpreter.state();
    const char* const source = chunk_text(name);
    if (luaL_loadbufferx(L, source, std::strlen(source), lua::kEmbeddedSource, "t") != LUA_OK)
        throw std::logic_error(lua_tostring(L, -1));
    return L;
}

} // namespace lacuna::program
