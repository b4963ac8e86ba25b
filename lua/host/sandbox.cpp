// SPDX-License-Identifier: MIT
// Protects against accidents, not against attacks: it keeps a recipe from files, processes and endless loops,
// but does not stop exploits of faults in Lua, Gmsh or the C library.
#include "host/sandbox.h"

#include "bindings/lacuna_lua.h"

#include <cstring>

namespace lacuna::lua {

namespace {

const luaL_Reg kLibraries[] = {
    {LUA_GNAME, luaopen_base},        {LUA_TABLIBNAME, luaopen_table},
    {LUA_STRLIBNAME, luaopen_string}, {LUA_MATHLIBNAME, luaopen_math},
    {LUA_UTF8LIBNAME, luaopen_utf8},  {LUA_COLIBNAME, luaopen_coroutine},
    {"lacuna", luaopen_lacuna},       {nullptr, nullptr},
};

/// load() for text only: upvalue 1 is Lua's load, and the mode is always "t".
int load_text(lua_State* L)
{
    lua_settop(L, 4);
    const bool has_environment = !lua_isnil(L, 4);
    lua_pushvalue(L, lua_upvalueindex(1));
    lua_pushvalue(L, 1);
    lua_pushvalue(L, 2);
    lua_pushliteral(L, "t");
    if (has_environment) lua_pushvalue(L, 4);
    lua_call(L, has_environment ? 4 : 3, LUA_MULTRET);
    return lua_gettop(L) - 4;
}

/// require() for modules that are already loaded: `lacuna` only.
int require_known(lua_State* L)
{
    const char* name = luaL_checkstring(L, 1);
    luaL_getsubtable(L, LUA_REGISTRYINDEX, LUA_LOADED_TABLE);
    if (std::strcmp(name, "lacuna") != 0)
        return luaL_error(L, "the sandbox has no module '%s', only 'lacuna'", name);
    lua_getfield(L, -1, name);
    return 1;
}

/// Replacement for functions of os, io and others, for a better message than "a nil value".
int refuse(lua_State* L)
{
    return luaL_error(L, "the sandbox has no '%s'", lua_tostring(L, lua_upvalueindex(1)));
}

void put_refusals(lua_State* L)
{
    for (const char* name : {"os", "io", "debug", "package"}) {
        lua_newtable(L);
        lua_createtable(L, 0, 1);
        lua_pushstring(L, name);
        lua_pushcclosure(L, refuse, 1);
        lua_setfield(L, -2, "__index");
        lua_pushliteral(L, "sandbox");
        lua_setfield(L, -2, "__metatable");
        lua_setmetatable(L, -2);
        lua_setglobal(L, name);
    }
    for (const char* name : {"dofile", "loadfile"}) {
        lua_pushstring(L, name);
        lua_pushcclosure(L, refuse, 1);
        lua_setglobal(L, name);
    }
}

} // namespace

void open_sandbox_libraries(lua_State* L)
{
    for (const luaL_Reg* library = kLibraries; library->func; ++library) {
        const bool global = std::strcmp(library->name, "lacuna") != 0;
        luaL_requiref(L, library->name, library->func, global);
        lua_pop(L, 1);
    }
    lua_getglobal(L, "load");
    lua_pushcclosure(L, load_text, 1);
    lua_setglobal(L, "load");
    lua_pushcfunction(L, require_known);
    lua_setglobal(L, "require");
    lua_getglobal(L, LUA_STRLIBNAME);
    lua_pushnil(L);
    lua_setfield(L, -2, "dump");
    lua_pop(L, 1);
    put_refusals(L);
}

} // namespace lacuna::lua
