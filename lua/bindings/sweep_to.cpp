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

namespace {

/// The numbers of a mesh, as fields of the report on top of the stack.
void set_numbers(lua_State* L, const fill::Filled& filled)
{
    std::size_t nodes = 0, hexes = 0, wedges = 0;
    int layers = 0;
    double least = 1;
    bool streamed = true;
    for (const sweep::Swept& part : fill::parts(filled)) {
        nodes += mesh::corner_count(part.mesh) + mesh::middle_count(part.mesh);
        hexes += part.mesh.hex_count();
        wedges += part.mesh.wedge_count();
        layers = std::max(layers, part.mesh.layers);
        least = std::min(least, part.min_scaled_jacobian);
        streamed = streamed && part.layers.has_value();
    }
    if (const auto* parts = std::get_if<fill::FilledParts>(&filled.mesh)) nodes = parts->swept.nodes;
    set_field(L, "nodes", nodes);
    set_field(L, "hexes", hexes);
    set_field(L, "wedges", wedges);
    set_field(L, "layers", layers);
    set_field(L, "min_scaled_jacobian", least);
    set_field(L, "streamed", streamed);
    const Crew* const crew = host(L).crew;
    set_field(L, "processes", streamed && crew != nullptr ? crew->size : 1);
}

} // namespace

int push_run(lua_State* L, SweepRun& run, bool has_file)
{
    if (!has_file) {
        push_filled(L, run.filled, run.seconds);
        return 1;
    }
    push_report(L, run.report, run.seconds);
    if (const auto* parts = std::get_if<fill::FilledParts>(&run.filled.mesh)) set_near_misses(L, *parts);
    set_numbers(L, run.filled);
    return 1;
}

} // namespace lacuna::lua
