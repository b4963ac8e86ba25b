// SPDX-License-Identifier: MIT
// The module's table: every kernel folder's bindings, then the Lua sources inside the binary.
#include "bindings/bind_buffer.h"
#include "bindings/classes.h"
#include "bindings/embedded.h"
#include "bindings/lacuna_lua.h"
#include "bindings/options.h"

#include <cstring>

namespace lacuna::lua {

int gmsh_version(lua_State* L);
void bind_convert(lua_State* L);

namespace {

void (*const kBinders[])(lua_State*) = {
    bind_topology, bind_open_volume, bind_matching,       bind_closure, bind_mesh,
    bind_sweep,    bind_assembly,    bind_assembly_sweep, bind_quality, bind_io,
    bind_cad,      bind_buffer,      bind_convert,        bind_view,
};

// --- what the embedded Lua sources get besides the module ---------------------------------------------

/// fail(code, message): an error at the recipe's line, as the C++ side raises them.
int fail_from_lua(lua_State* L)
{
    const char* code = luaL_checkstring(L, 1);
    luaL_checkstring(L, 2);
    lua_settop(L, 2);
    raise(L, code);
}

/// word = nearest(word, words)
int nearest_from_lua(lua_State* L)
{
    luaL_checktype(L, 2, LUA_TTABLE);
    lua_pushstring(L, nearest_in_table(L, 2, luaL_checkstring(L, 1)));
    return 1;
}

/// text = found(value)
int found_from_lua(lua_State* L)
{
    push_found(L, 1);
    return 1;
}

/// used_params(): the recipe has read the words of the command line.
int used_params_from_lua(lua_State* L)
{
    lua_pushboolean(L, 1);
    lua_setfield(L, LUA_REGISTRYINDEX, kUsedParams);
    return 0;
}

const luaL_Reg kInternal[] = {
    {"fail", fail_from_lua},   {"nearest", nearest_from_lua},
    {"found", found_from_lua}, {"used_params", used_params_from_lua},
    {nullptr, nullptr},
};

/// Upvalue-free __index of the module: what is asked of Gmsh only when somebody wants to know.
int index_module(lua_State* L)
{
    if (lua_type(L, 2) != LUA_TSTRING || std::strcmp(lua_tostring(L, 2), "gmsh_version") != 0) return 0;
    gmsh_version(L);
    lua_pushvalue(L, -1);
    lua_setfield(L, 1, "gmsh_version");
    return 1;
}

void run_embedded(lua_State* L, const EmbeddedChunk& chunk)
{
    // Stack: module. The mode "t" takes text alone.
    if (luaL_loadbufferx(L, chunk.source, std::strlen(chunk.source), kEmbeddedSource, "t") != LUA_OK)
        lua_error(L);
    lua_pushvalue(L, -2);
    luaL_newlib(L, kInternal);
    lua_call(L, 2, 0);
}

} // namespace

} // namespace lacuna::lua

extern "C" int luaopen_lacuna(lua_State* L)
{
    using namespace lacuna::lua;
    luaL_checkversion(L);
    lua_newtable(L);
    for (const auto bind : kBinders) bind(L);
    lua_pushliteral(L, LACUNA_VERSION);
    lua_setfield(L, -2, "version");
    lua_createtable(L, 0, 1);
    lua_pushcfunction(L, index_module);
    lua_setfield(L, -2, "__index");
    lua_setmetatable(L, -2);
    for (std::size_t i = 0; i < kEmbeddedChunkCount; ++i) run_embedded(L, kEmbeddedChunks[i]);
    return 1;
}
