// SPDX-License-Identifier: MIT
// The module's table: every kernel folder's bindings, then the Lua sources inside the binary.
#include "bindings/bind_buffer.h"
#include "bindings/classes.h"
#include "bindings/embedded.h"
#include "bindings/lacuna_lua.h"
#include "bindings/options.h"

#include <lacuna/geometry/shared/triangulate.h>

#include <cstring>

namespace lacuna::lua {

int gmsh_version(lua_State* L);
void bind_convert(lua_State* L);

namespace {

void (*const kBinders[])(lua_State*) = {
    bind_topology, bind_open_volume, bind_matching,       bind_closure, bind_mesh, bind_quads,
    bind_sweep,    bind_assembly,    bind_assembly_sweep, bind_quality, bind_io,   bind_cad,
    bind_buffer,   bind_convert,     bind_view,           bind_copies,
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

/// used_params(): record that the recipe has read the words of the command line.
int used_params_from_lua(lua_State* L)
{
    lua_pushboolean(L, 1);
    lua_setfield(L, LUA_REGISTRYINDEX, kUsedParams);
    return 0;
}

/// cells = triangles(points, loops): triangulate the inside of loops, arrays of numbers of points { x, y }
int triangles_from_lua(lua_State* L)
{
    luaL_checktype(L, 1, LUA_TTABLE);
    luaL_checktype(L, 2, LUA_TTABLE);
    lua_settop(L, 2);
    auto& points = temporary<std::vector<Vec2>>(L);
    auto& loops = temporary<std::vector<std::vector<Index>>>(L);
    const std::size_t point_count = lua_rawlen(L, 1), loop_count = lua_rawlen(L, 2);
    guard(L, [&] {
        points.resize(point_count);
        loops.resize(loop_count);
    });
    for (std::size_t i = 0; i < points.size(); ++i) {
        lua_rawgeti(L, 1, to_lua(i));
        for (int k = 0; k < 2; ++k) {
            lua_rawgeti(L, -1, k + 1);
            points[i][k] = luaL_checknumber(L, -1);
            lua_pop(L, 1);
        }
        lua_pop(L, 1);
    }
    for (std::size_t l = 0; l < loops.size(); ++l) {
        lua_rawgeti(L, 2, to_lua(l));
        const std::size_t length = lua_rawlen(L, -1);
        guard(L, [&] { loops[l].resize(length); });
        for (std::size_t i = 0; i < loops[l].size(); ++i) {
            lua_rawgeti(L, -1, to_lua(i));
            loops[l][i] = static_cast<Index>(luaL_checkinteger(L, -1) - 1);
            lua_pop(L, 1);
        }
        lua_pop(L, 1);
    }
    auto& found = temporary<geometry::Triangulation>(L);
    RunContext& context = push_context(L);
    guard(L, [&] {
        geometry::TriangulateOptions options;
        options.interior_points = false;
        found = geometry::triangulate(points, loops, options, context);
    });
    push_array(L, found.triangles, [&](const auto& item) {
        push_array(L, item, [L](const auto& corner) { push(L, to_lua(index(corner))); });
    });
    return 1;
}

const luaL_Reg kInternal[] = {
    {"fail", fail_from_lua},           {"nearest", nearest_from_lua},
    {"found", found_from_lua},         {"used_params", used_params_from_lua},
    {"triangles", triangles_from_lua}, {nullptr, nullptr},
};

/// __index of the module: Gmsh is asked for its version at the first access to gmsh_version.
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
    // Stack: module. The mode "t" takes text only.
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
    set_field(L, "version", LACUNA_VERSION);
    lua_createtable(L, 0, 1);
    set_functions(L, {{"__index", index_module}});
    lua_setmetatable(L, -2);
    for (std::size_t i = 0; i < kEmbeddedChunkCount; ++i) run_embedded(L, kEmbeddedChunks[i]);
    return 1;
}
