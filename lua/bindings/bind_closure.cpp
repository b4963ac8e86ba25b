// SPDX-License-Identifier: MIT
#include "bindings/classes.h"
#include "bindings/options.h"

namespace lacuna::lua {

namespace {

using closure::CloseOptions;
using closure::EdgeShape;

const Word<EdgeShape> kEdgeShapes[] = {
    {"straight", EdgeShape::straight},
    {"follow", EdgeShape::follow},
    {"auto", EdgeShape::automatic},
};

void read_edge_shape(lua_State* L, int index, const Where& where, CloseOptions& options)
{
    options.edge_shape = read_word(L, index, where, kEdgeShapes);
}

const Option<CloseOptions> kCloseOptions[] = {{"edge_shape", read_edge_shape}};

/// Tags of entities of the model, as an array in the table on top.
template <class Id>
void set_tags(lua_State* L, const char* key, const topology::Model& model, const std::vector<Id>& ids)
{
    lua_createtable(L, static_cast<int>(ids.size()), 0);
    for (std::size_t i = 0; i < ids.size(); ++i) {
        lua_pushinteger(L, model[ids[i]].tag);
        lua_rawseti(L, -2, to_lua(i));
    }
    lua_setfield(L, -2, key);
}

void push_closure(lua_State* L, const topology::Model& model, const closure::Closure& closed)
{
    lua_createtable(L, 0, 6);
    set_count(L, "void_edges", closed.void_edges.size());
    set_count(L, "void_faces", closed.void_faces.size());
    set_boolean(L, "watertight", closed.watertight);
    set_strings(L, "algorithms", closed.algorithms);
    set_tags(L, "void_edge_tags", model, closed.void_edges);
    set_tags(L, "void_face_tags", model, closed.void_faces);
}

/// { void_edges=, void_faces=, watertight=, algorithms= } = volume:close([options])
int close(lua_State* L)
{
    lua_settop(L, 2);
    auto& state = hold<VolumeState>(L, 1);
    if (state.closure && has_options(L, 2, "close"))
        fail(L, "close: the volume is sealed already, by other options");
    CloseOptions options;
    read_options(L, 2, "close", kCloseOptions, options);
    RunContext& context = push_context(L);
    guard(L, [&] {
        const Busy busy(state, "close");
        close_volume(state, options, context);
    });
    push_closure(L, state.volume.model, *state.closure);
    return 1;
}

/// boolean = volume:is_watertight()
int is_watertight(lua_State* L)
{
    const auto& state = hold<VolumeState>(L, 1);
    bool watertight = false;
    guard(L, [&] { watertight = closure::is_watertight(state.volume); });
    lua_pushboolean(L, watertight);
    return 1;
}

const luaL_Reg kVolumeMethods[] = {{"close", close}, {"is_watertight", is_watertight}, {nullptr, nullptr}};

} // namespace

void bind_closure(lua_State* L) { add_methods(L, kClassName<VolumeState>, kVolumeMethods); }

} // namespace lacuna::lua
