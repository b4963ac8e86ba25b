// SPDX-License-Identifier: MIT
#include "bindings/classes.h"
#include "bindings/io_paths.h"
#include "bindings/lacuna_lua.h"
#include "bindings/options.h"
#include "bindings/sweep_arguments.h"
#include "bindings/sweep_to.h"

#include <lacuna/closure/shared/branches.h>

namespace lacuna::lua {

namespace {

int push_swept_volume(lua_State* L, const char* call, VolumeState& state, SweepArguments& arguments,
                      const SweepFile* file, bool layered_parts)
{
    RunContext& context = push_context(L);
    if (arguments.threads != 0) context.threads = arguments.threads;
    auto& volumes = temporary<std::vector<VolumeState*>>(L);
    guard(L, [&] { volumes.push_back(&state); });
    return push_swept(L, volumes, call, file, context, [&](const RunContext& part) {
        return fill::sweep(state, {arguments, layered_parts}, part);
    });
}

/// mesh = volume:sweep(options)
int sweep_volume(lua_State* L)
{
    lua_settop(L, 2);
    VolumeState& state = hold<VolumeState>(L, 1);
    return push_swept_volume(L, "sweep", state, push_sweep_arguments(L, 2, "sweep", state), nullptr, false);
}

/// report = volume:sweep_to(path, options)
int sweep_to(lua_State* L)
{
    lua_settop(L, 3);
    VolumeState& state = hold<VolumeState>(L, 1);
    const io::OutputPath& path = push_output_path(L, 2, "sweep_to");
    push_write_options(L, 3);
    const team::WriteRequest& file = push_layered_write(L, lua_gettop(L), path);
    SweepArguments& arguments = push_sweep_arguments(L, 3, "sweep_to", state);
    const bool layered_parts = team::may_be_layered_of_parts(file, path);
    guard(L, [&] {
        if (!layered_parts && !closure::has_pieces(state.volume)) team::refuse_interfaces(file);
    });
    arguments.layered = true;
    arguments.crew = host(L).crew;
    const SweepFile written{&path, &file};
    return push_swept_volume(L, "sweep_to", state, arguments, &written, layered_parts);
}

} // namespace

void bind_sweep(lua_State* L)
{
    add_methods<VolumeState>(L, {{"sweep", sweep_volume}, {"sweep_to", sweep_to}});
}

} // namespace lacuna::lua
