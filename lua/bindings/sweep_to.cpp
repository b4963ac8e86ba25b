// SPDX-License-Identifier: MIT
#include "bindings/sweep_to.h"

#include "bindings/lacuna_lua.h"
#include "bindings/options.h"

#include <algorithm>

namespace lacuna::lua {

void push_write_options(lua_State* L, int index)
{
    if (lua_type(L, index) != LUA_TTABLE) {
        lua_pushnil(L);
        return;
    }
    lua_newtable(L);
    for (lua_pushnil(L); lua_next(L, index) != 0;) {
        lua_pushvalue(L, -2);
        lua_insert(L, -2);
        lua_rawset(L, -4);
    }
    lua_pushliteral(L, "write");
    lua_rawget(L, -2);
    lua_pushliteral(L, "write");
    lua_pushnil(L);
    lua_rawset(L, -4);
    lua_insert(L, -2);
    lua_replace(L, index);
    if (lua_type(L, -1) != LUA_TNIL && lua_type(L, -1) != LUA_TTABLE)
        fail_value(L, {"sweep_to", "write"}, "a table of options { version =, binary =, quality = }", -1);
}

void set_told(lua_State* L, const Told& told)
{
    set_count(L, "nodes", told.nodes);
    set_count(L, "hexes", told.hexes);
    set_count(L, "wedges", told.wedges);
    set_count(L, "layers", static_cast<std::size_t>(told.layers));
    set_number(L, "min_scaled_jacobian", told.least);
    set_boolean(L, "streamed", told.streamed);
    set_count(L, "processes", static_cast<std::size_t>(told.processes));
}

void write_swept_parts(lua_State* L, const io::OutputPath& path, WriteArguments& file, const Crew* crew,
                       const RunContext& context)
{
    const int mesh = lua_gettop(L);
    auto& state = *hold_box<AssemblyMeshState>(L, mesh);
    Told told{.nodes = state.swept.nodes};
    std::size_t held = 0;
    for (const sweep::Swept& part : state.swept.parts) {
        held += part.layers ? 0 : 1;
        told.hexes += part.mesh.hex_count();
        told.wedges += part.mesh.wedge_count();
        told.layers = std::max(told.layers, part.mesh.layers);
        told.least = std::min(told.least, part.min_scaled_jacobian);
    }
    told.streamed = held == 0;
    told.processes = told.streamed && crew != nullptr ? crew->size : 1;
    const Host& lent = host(L);
    guard(L, [&] {
        if (held > 0)
            state.swept.report.push_back(
                "sweep_to: " + std::to_string(held) + " of " + std::to_string(state.swept.parts.size()) +
                " parts were held in memory, since their nodes are more than placed layers, or the file is "
                "not written so");
        write_pieces(state, path, file, crew, context);
        write_options_beside(lent, path, file);
    });
    lua_getfield(L, mesh, "report");
    set_told(L, told);
}

} // namespace lacuna::lua
