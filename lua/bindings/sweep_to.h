// SPDX-License-Identifier: MIT
#pragma once

// Common parts of the sweeps of volumes and of assemblies, with and without a file.

#include "bindings/classes.h"
#include "bindings/lacuna_lua.h"
#include "bindings/write_mesh.h"

#include <lacuna/core/shared/progress.h>

#include <memory>
#include <vector>

struct lua_State;

namespace lacuna::lua {

/// Take `write` out of the table of options at `index`: replace the table by a copy without it and push the
/// value.
void push_write_options(lua_State* L, int index);

/// A file that a mesh is written to as it is made.
struct SweepFile {
    const io::OutputPath* path;
    const team::WriteRequest* request;
};

/// A sweep, and the report of its file.
struct SweepRun {
    fill::Filled filled;
    StageSeconds seconds;
    std::vector<std::string> report;
};

/// Push the mesh, or the report of its file.
int push_run(lua_State* L, SweepRun& run, bool has_file);

/// Sweep volumes of a recipe; then push the mesh, or write it and push the report of the file. The volumes
/// change only when everything is done.
/// @param volumes  in the order of the volumes of the `fill::Filled` that `sweep()` returns.
/// @param file     null: none
/// @param sweep    called with the context of its part of the call
template <class Sweep>
int push_swept(lua_State* L, const std::vector<VolumeState*>& volumes, const char* call,
               const SweepFile* file, RunContext& context, const Sweep& sweep)
{
    lua_gc(L, LUA_GCCOLLECT); // for Lua a mesh is a few bytes, so it would let unused meshes pile up
    auto& run = temporary<SweepRun>(L);
    const Host& lent = host(L);
    guard(L, [&] {
        std::vector<std::unique_ptr<Busy>> busy;
        for (VolumeState* volume : volumes) busy.push_back(std::make_unique<Busy>(*volume, call));
        StageClock clock(context);
        const double swept = file != nullptr ? 0.5 : 1; // share of the call; writing takes about as long
        run.filled = sweep(part_of(context, 0, swept));
        if (file != nullptr)
            run.report = team::write_swept(run.filled, *file->request, *file->path, lent.crew,
                                           part_of(context, swept, 1));
        for (std::size_t v = 0; v < volumes.size(); ++v) *volumes[v] = std::move(run.filled.volumes[v]);
        run.seconds = clock.seconds();
    });
    return push_run(L, run, file != nullptr);
}

} // namespace lacuna::lua
