// SPDX-License-Identifier: MIT
#include "bindings/classes.h"
#include "bindings/io_paths.h"
#include "bindings/lacuna_lua.h"
#include "bindings/options.h"
#include "bindings/sweep_arguments.h"
#include "bindings/sweep_to.h"

#include <algorithm>
#include <string_view>
#include <vector>

namespace lacuna::lua {

namespace {

/// Whether a key is `contacts`, the only option that single volumes do not have.
bool is_contacts(lua_State* L, int key) { return std::string_view(lua_tostring(L, key)) == "contacts"; }

/// Push the options of one volume: those for all volumes, which have words as keys, overridden by those at
/// [volume]. `member` records whether the options that name faces are given for this volume itself.
void push_options_of(lua_State* L, int index, const Box<VolumeState>& volume, fill::Member& member)
{
    lua_newtable(L);
    const int merged = lua_gettop(L);
    const auto lay_over = [&](int from) {
        for (lua_pushnil(L); lua_next(L, from) != 0;) {
            if (lua_type(L, -2) == LUA_TSTRING && (from != index || !is_contacts(L, -2))) {
                lua_pushvalue(L, -2);
                lua_insert(L, -2);
                lua_rawset(L, merged);
            } else {
                lua_pop(L, 1);
            }
        }
    };
    lay_over(index);
    for (lua_pushnil(L); lua_next(L, index) != 0; lua_pop(L, 1)) {
        const Box<VolumeState>* const key = test_box<VolumeState>(L, -2);
        if (key == nullptr || *key != volume) continue;
        lay_over(lua_absindex(L, -1));
        member.own_boundary_layers = lua_getfield(L, -1, "boundary_layers") != LUA_TNIL;
        member.own_intervals = lua_getfield(L, -2, "intervals") != LUA_TNIL;
        lua_pop(L, 2);
    }
}

/// Refuse keys that are neither words nor volumes of the assembly, and keys of a volume's options that are
/// not words.
void check_volume_keys(lua_State* L, int index, const char* call, const AssemblyState& assembly)
{
    for (lua_pushnil(L); lua_next(L, index) != 0; lua_pop(L, 1)) {
        if (lua_type(L, -2) == LUA_TSTRING) continue;
        const Box<VolumeState>* const key = test_box<VolumeState>(L, -2);
        const auto is_key = [key](const AssemblyState::Entry& entry) { return entry.volume == *key; };
        if (key == nullptr || !*key || std::ranges::none_of(assembly.entries, is_key))
            fail(L, "%s: the keys of the options must be names of options, or volumes of the assembly", call);
        if (lua_type(L, -1) != LUA_TTABLE) fail_value(L, {call, "[volume]"}, "a table of options", -1);
        const int own = lua_gettop(L);
        for (lua_pushnil(L); lua_next(L, own) != 0; lua_pop(L, 1)) {
            if (lua_type(L, -2) == LUA_TSTRING) continue;
            fail(L,
                 "%s: the keys of one volume's options must be names of options, found a %s; give "
                 "[volume] = { ... } for each volume in the table of the call",
                 call, test_box<VolumeState>(L, -2) != nullptr ? "volume" : luaL_typename(L, -2));
        }
    }
}

/// Sweep the assembly that is the first argument with the options at `index`, nil or a table.
/// @param file  null: push the mesh; otherwise write the file and push its report
/// @param crew  processes that share a mesh written by layers; null: this process alone
int push_swept_assembly(lua_State* L, int index, const char* call, const SweepFile* file, bool layered,
                        const Crew* crew)
{
    const auto& assembly = hold<AssemblyState>(L, 1);
    if (lua_isnoneornil(L, index)) {
        lua_newtable(L);
        lua_replace(L, index);
    }
    if (lua_type(L, index) != LUA_TTABLE) fail_value(L, {call, nullptr}, "a table of options", index);
    check_volume_keys(L, index, call, assembly);
    auto& members = temporary<std::vector<fill::Member>>(L);
    auto& volumes = temporary<std::vector<VolumeState*>>(L);
    int threads = 0;
    for (const AssemblyState::Entry& entry : assembly.entries) {
        guard(L, [&] { members.push_back(entry.member()); });
        if (!entry.volume) continue;
        luaL_checkstack(L, 16, "too many volumes");
        push_options_of(L, index, entry.volume, members.back());
        SweepArguments& own = push_sweep_arguments(L, lua_gettop(L), call, *entry.volume);
        own.layered = layered;
        own.crew = layered ? crew : nullptr;
        if (volumes.empty()) threads = own.threads;
        guard(L, [&] {
            volumes.push_back(entry.volume.get());
            members.back().options = own;
        });
    }
    const fill::ContactRequest& contacts = push_contact_request(L, index);
    RunContext& context = push_context(L);
    if (threads != 0) context.threads = threads;
    return push_swept(L, volumes, "sweep", file, context,
                      [&](const RunContext& part) { return fill::sweep(members, part, contacts); });
}

/// mesh = assembly:sweep(options)
int sweep_assembly(lua_State* L)
{
    lua_settop(L, 2);
    return push_swept_assembly(L, 2, "sweep", nullptr, false, nullptr);
}

/// report = assembly:sweep_to(path, options)
int sweep_assembly_to(lua_State* L)
{
    lua_settop(L, 3);
    check<AssemblyState>(L, 1);
    const io::OutputPath& path = push_output_path(L, 2, "sweep_to");
    push_write_options(L, 3);
    const team::WriteRequest& file = push_layered_write(L, lua_gettop(L), path);
    const SweepFile written{&path, &file};
    return push_swept_assembly(L, 3, "sweep_to", &written, team::may_be_layered_of_parts(file, path),
                               host(L).crew);
}

} // namespace

void bind_assembly_sweep(lua_State* L)
{
    add_methods<AssemblyState>(L, {{"sweep", sweep_assembly}, {"sweep_to", sweep_assembly_to}});
}

} // namespace lacuna::lua
