// SPDX-License-Identifier: MIT
#include "bindings/classes.h"
#include "bindings/io_paths.h"
#include "bindings/lacuna_lua.h"
#include "bindings/options.h"
#include "bindings/sweep_members.h"
#include "bindings/sweep_to.h"

#include <algorithm>
#include <string>
#include <vector>

namespace lacuna::lua {

namespace {

/// The options of one volume: those for all, which have words as keys, and what [volume] says over them. Left
/// on the stack.
void push_options_of(lua_State* L, int index, const Box<VolumeState>& volume)
{
    lua_newtable(L);
    const int merged = lua_gettop(L);
    const auto lay_over = [&](int from) {
        for (lua_pushnil(L); lua_next(L, from) != 0;) {
            if (lua_type(L, -2) == LUA_TSTRING) {
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
    }
}

/// Refuse keys that are neither words nor volumes of the assembly, and keys of a volume's options that are no
/// words.
void check_volume_keys(lua_State* L, int index, const char* call, const AssemblyState& assembly)
{
    for (lua_pushnil(L); lua_next(L, index) != 0; lua_pop(L, 1)) {
        if (lua_type(L, -2) == LUA_TSTRING) continue;
        const Box<VolumeState>* const key = test_box<VolumeState>(L, -2);
        const auto is_key = [key](const AssemblyState::Entry& entry) { return entry.volume == *key; };
        if (key == nullptr || !*key || std::ranges::none_of(assembly.entries, is_key))
            fail(L, "%s: the keys of the options are words, or volumes of the assembly", call);
        if (lua_type(L, -1) != LUA_TTABLE) fail_value(L, {call, "[volume]"}, "a table of options", -1);
        const int own = lua_gettop(L);
        for (lua_pushnil(L); lua_next(L, own) != 0; lua_pop(L, 1)) {
            if (lua_type(L, -2) == LUA_TSTRING) continue;
            fail(L,
                 "%s: the keys of one volume's options are words; found a %s: give each volume's options "
                 "in the table of the whole",
                 call, test_box<VolumeState>(L, -2) != nullptr ? "volume" : luaL_typename(L, -2));
        }
    }
}

/// Which options that name faces a volume has of its own.
void read_own(lua_State* L, int index, const Box<VolumeState>& volume, SweepArguments& arguments)
{
    for (lua_pushnil(L); lua_next(L, index) != 0; lua_pop(L, 1)) {
        const Box<VolumeState>* const key = test_box<VolumeState>(L, -2);
        if (key == nullptr || *key != volume) continue;
        for (const char* option : kOfFaces) {
            if (lua_getfield(L, -1, option) != LUA_TNIL) guard(L, [&] { arguments.own.insert(option); });
            lua_pop(L, 1);
        }
    }
}

/// Sweep the assembly that is the first argument with the options at `index`, nil or a table; its mesh is on
/// top of the stack then.
/// @param crew  of a mesh that need not hold its nodes; null: nobody
/// @return  what it was swept in, which stays as long as the stack
RunContext& push_swept(lua_State* L, int index, const char* call, bool layered, const Crew* crew)
{
    const auto& assembly = hold<AssemblyState>(L, 1);
    if (lua_isnoneornil(L, index)) {
        lua_newtable(L);
        lua_replace(L, index);
    }
    if (lua_type(L, index) != LUA_TTABLE) fail_value(L, {call, nullptr}, "a table of options", index);
    check_volume_keys(L, index, call, assembly);
    auto& arguments = temporary<std::vector<SweepArguments*>>(L);
    for (const AssemblyState::Entry& entry : assembly.entries) {
        if (!entry.volume) continue;
        luaL_checkstack(L, 16, "too many volumes");
        push_options_of(L, index, entry.volume);
        SweepArguments& own = push_sweep_arguments(L, lua_gettop(L), call, *entry.volume);
        own.options.layered = layered;
        own.options.crew = layered ? crew : nullptr;
        read_own(L, index, entry.volume, own);
        guard(L, [&] { arguments.push_back(&own); });
    }
    RunContext& context = push_context(L);
    if (!arguments.empty() && arguments.front()->threads != 0) context.threads = arguments.front()->threads;
    lua_gc(L, LUA_GCCOLLECT);
    auto& box = new_box<AssemblyMeshState>(L);
    guard(L, [&] {
        StageClock clock(context);
        std::vector<ToMesh> members;
        std::vector<sweep::LeftOut> left_out;
        auto own = arguments.begin();
        for (std::size_t m = 0; m < assembly.entries.size(); ++m) {
            const AssemblyState::Entry& entry = assembly.entries[m];
            for (std::unique_ptr<FixedMember>& fixed : fixed_members(entry, context))
                members.push_back({nullptr, nullptr, std::move(fixed), false});
            if (!entry.volume) continue;
            SweepArguments& options = **own++;
            const std::string name = entry.volume->name.empty() ? "volume_" + std::to_string(m + 1)
                                                                : entry.volume->name;
            options.name = name;
            const auto add = [&] { add_members(members, entry.volume, name, name, options, context); };
            if (!do_or_leave_out(left_out, name, options, add))
                members.push_back({entry.volume, &options, nullptr, true});
        }
        box = sweep_members(members, std::move(left_out), false, context);
        box->seconds = clock.seconds();
    });
    return context;
}

/// mesh = assembly:sweep(options)
int sweep_assembly(lua_State* L)
{
    lua_settop(L, 2);
    push_swept(L, 2, "sweep", false, nullptr);
    return 1;
}

/// report = assembly:sweep_to(path, options)
int sweep_assembly_to(lua_State* L)
{
    lua_settop(L, 3);
    check<AssemblyState>(L, 1);
    const io::OutputPath& path = push_output_path(L, 2, "sweep_to");
    push_write_options(L, 3);
    WriteArguments& file = push_layered_write(L, lua_gettop(L), path);
    const Crew* const crew = host(L).crew;
    const RunContext& context = push_swept(L, 3, "sweep_to", may_be_layered_of_parts(file, path), crew);
    write_swept_parts(L, path, file, crew, context);
    return 1;
}

const luaL_Reg kAssemblyMethods[] = {
    {"sweep", sweep_assembly}, {"sweep_to", sweep_assembly_to}, {nullptr, nullptr}};

} // namespace

void bind_assembly_sweep(lua_State* L) { add_methods(L, kClassName<AssemblyState>, kAssemblyMethods); }

} // namespace lacuna::lua
