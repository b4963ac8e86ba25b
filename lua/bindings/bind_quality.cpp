// SPDX-License-Identifier: MIT
#include "bindings/bind_quality.h"

namespace lacuna::lua {

namespace {

constexpr const char* kQualityMeta = "Quality";

void push_worst(lua_State* L, const std::vector<quality::WorstCell>& worst)
{
    lua_createtable(L, static_cast<int>(worst.size()), 0);
    for (std::size_t i = 0; i < worst.size(); ++i) {
        lua_createtable(L, 0, 4);
        lua_pushinteger(L, to_lua(worst[i].cell));
        lua_setfield(L, -2, "cell");
        if (worst[i].layer >= 0) {
            lua_pushinteger(L, to_lua(static_cast<Index>(worst[i].layer)));
            lua_setfield(L, -2, "layer");
        }
        push_vector(L, worst[i].centre);
        lua_setfield(L, -2, "centre");
        set_number(L, "scaled_jacobian", worst[i].scaled_jacobian);
        lua_rawseti(L, -2, to_lua(i));
    }
}

int quality_to_string(lua_State* L)
{
    luaL_checktype(L, 1, LUA_TTABLE);
    luaL_getmetafield(L, 1, "texts");
    lua_pushvalue(L, 1);
    lua_rawget(L, -2);
    return 1;
}

/// quality = mesh:quality()
int mesh_quality(lua_State* L)
{
    auto& state = check<MeshState>(L, 1);
    RunContext& context = push_context(L);
    guard(L, [&] {
        if (!state.quality) state.quality = quality::measure(state.swept.mesh, context);
    });
    push_quality(L, *state.quality);
    return 1;
}

const luaL_Reg kMeshMethods[] = {{"quality", mesh_quality}, {nullptr, nullptr}};

} // namespace

void push_quality(lua_State* L, const quality::Quality& q)
{
    lua_createtable(L, 0, 10);
    set_number(L, "min_scaled_jacobian", q.min_scaled_jacobian);
    set_number(L, "mean_scaled_jacobian", q.mean_scaled_jacobian);
    set_count(L, "inverted", q.inverted);
    set_count(L, "uncertified", q.uncertified);
    set_boolean(L, "certified", q.uncertified == 0 && q.inverted == 0);
    set_count(L, "hexes", q.hexes);
    set_number(L, "volume", q.volume);
    push_worst(L, q.worst);
    lua_setfield(L, -2, "worst");
    lua_createtable(L, static_cast<int>(q.histogram.size()), 0);
    for (std::size_t bin = 0; bin < q.histogram.size(); ++bin) {
        lua_pushinteger(L, static_cast<lua_Integer>(q.histogram[bin]));
        lua_rawseti(L, -2, to_lua(bin));
    }
    lua_setfield(L, -2, "histogram");
    lua_createtable(L, 1, 0);
    lua_createtable(L, 0, 3);
    set_string(L, "name", "scaled_jacobian");
    set_number(L, "min", q.min_scaled_jacobian);
    set_number(L, "mean", q.mean_scaled_jacobian);
    lua_rawseti(L, -2, 1);
    lua_setfield(L, -2, "metrics");

    luaL_setmetatable(L, kQualityMeta);
    luaL_getmetafield(L, -1, "texts"); // weak: what it prints as, by table
    lua_pushvalue(L, -2);
    push_text(L, [&] { return quality::to_table(q); });
    lua_rawset(L, -3);
    lua_pop(L, 1);
}

void bind_quality(lua_State* L)
{
    luaL_newmetatable(L, kQualityMeta);
    lua_pushcfunction(L, quality_to_string);
    lua_setfield(L, -2, "__tostring");
    lua_newtable(L);
    lua_createtable(L, 0, 1);
    set_string(L, "__mode", "k");
    lua_setmetatable(L, -2);
    lua_setfield(L, -2, "texts");
    lua_pop(L, 1);
    add_methods(L, kClassName<MeshState>, kMeshMethods);
}

} // namespace lacuna::lua
