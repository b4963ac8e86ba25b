// SPDX-License-Identifier: MIT
#include "bindings/classes.h"

#include "bindings/lacuna_lua.h"

#include <utility>

namespace lacuna::lua {

void refresh(ModelState& state, const RunContext& context)
{
    if (!state.stale) return;
    state.model = healing::model_of(state.added, context);
    state.stale = false;
}

void bring_up_to_date(lua_State* L, ModelState& state)
{
    if (!state.stale) return;
    const RunContext& context = push_context(L);
    guard(L, [&] { refresh(state, context); });
    lua_pop(L, 1);
}

const Box<ModelState>& hold_model(lua_State* L, int index)
{
    const Box<ModelState>& state = hold_box<ModelState>(L, index);
    bring_up_to_date(L, *state);
    return state;
}

FaceId face_now(const FaceHandle& handle)
{
    FaceId face = handle.face;
    for (std::size_t m = handle.moves; m < handle.model->moves.size() && face.valid(); ++m)
        face = handle.model->moves[m][face.index()];
    return face;
}

FaceId face_of(const FaceHandle& handle)
{
    const FaceId face = face_now(handle);
    if (!face.valid())
        throw InvalidInput(Message("lua.face_grown_over", "this face is now part of a face made by face_from")
                               .remedy("use that face, or select faces after face_from"));
    return face;
}

Busy::Busy(VolumeState& state, const char* method) : state_(state)
{
    if (state.busy)
        throw InvalidInput(Message("lua.busy", "{}: this volume is in use by its {}()", method, state.busy)
                               .remedy("call {} after it has returned", method));
    state.busy = method;
}

RunContext& push_context(lua_State* L)
{
    const Host& lent = host(L);
    auto& context = temporary<RunContext>(L);
    context.threads = lent.threads;
    context.cancel = lent.cancel;
    if (lent.log)
        context.log = [&lent](std::string_view line) { lent.log(line); }; // one pointer: no allocation
    if (lent.progress)
        context.progress = [&lent](std::string_view stage, double share) {
            lent.in_stage = true;
            lent.progress(stage, share);
        };
    return context;
}

void push_edge(lua_State* L, const topology::Model& model, EdgeId edge)
{
    lua_createtable(L, 0, 5);
    set_field(L, "tag", model[edge].tag);
    set_field(L, "from", model[model[edge].from].tag);
    set_field(L, "to", model[model[edge].to].tag);
    set_field(L, "length", topology::edge_length(model, edge));
}

void push_face(lua_State* L, const Box<ModelState>& model, FaceId face)
{
    give_new<FaceHandle>(L, [&] { return FaceHandle{model, face, model->moves.size()}; });
}

void push_groups(lua_State* L, const std::vector<fill::Group>& groups)
{
    push_array(L, groups, [&](const auto& item) {
        lua_createtable(L, 0, 3);
        set_field(L, "name", item.name.c_str());
        set_field(L, "dim", static_cast<std::size_t>(item.dim));
        set_field(L, "cells", item.cells);
    });
}

void push_filled(lua_State* L, fill::Filled& filled, const StageSeconds& seconds)
{
    if (auto* parts = std::get_if<fill::FilledParts>(&filled.mesh))
        give_new<AssemblyMeshState>(L, [&] {
            return AssemblyMeshState{std::move(*parts), std::nullopt, seconds};
        });
    else
        give_new<MeshState>(L, [&] {
            return MeshState{std::move(std::get<fill::FilledVolume>(filled.mesh)), seconds};
        });
}

namespace {

int report_to_string(lua_State* L)
{
    luaL_checktype(L, 1, LUA_TTABLE);
    luaL_Buffer buffer;
    luaL_buffinit(L, &buffer);
    const auto count = static_cast<lua_Integer>(lua_rawlen(L, 1));
    for (lua_Integer i = 1; i <= count; ++i) {
        if (i > 1) luaL_addchar(&buffer, '\n');
        lua_rawgeti(L, 1, i);
        luaL_tolstring(L, -1, nullptr); // a recipe may have put anything there
        lua_remove(L, -2);
        luaL_addvalue(&buffer);
    }
    luaL_pushresult(&buffer);
    return 1;
}

} // namespace

void push_report(lua_State* L, const std::vector<std::string>& lines, const StageSeconds& seconds)
{
    push(L, lines);
    lua_createtable(L, 0, static_cast<int>(seconds.size()));
    for (const auto& [stage, taken] : seconds) set_field(L, stage.c_str(), taken);
    lua_setfield(L, -2, "seconds");
    if (luaL_newmetatable(L, "Report")) {
        set_functions(L, {{"__tostring", report_to_string}});
        set_field(L, "__metatable", "Report");
    }
    lua_setmetatable(L, -2);
}

std::size_t check_number(lua_State* L, const char* call, std::size_t count)
{
    int whole = 0;
    const lua_Integer number = lua_type(L, 2) == LUA_TNUMBER ? lua_tointegerx(L, 2, &whole) : 0;
    if (!whole || number < 1 || static_cast<std::size_t>(number) > count) {
        const char* found = push_found(L, 2);
        fail(L, "%s: the number must be from 1 to %I, found %s", call, static_cast<lua_Integer>(count),
             found);
    }
    return from_lua(number);
}

} // namespace lacuna::lua
