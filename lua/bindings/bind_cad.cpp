// SPDX-License-Identifier: MIT
#include "bindings/cad_limits.h"
#include "bindings/classes.h"
#include "bindings/io_paths.h"
#include "bindings/lacuna_lua.h"
#include "bindings/options.h"

#include <lacuna/cad/load.h>
#include <lacuna/cad/write_cad.h>

namespace lacuna::lua {

namespace {

const Option<cad::WriteCadOptions> kCadWriteOptions[] = {
    {"tolerance", positive<&cad::WriteCadOptions::tolerance>},
    {"deviation", positive<&cad::WriteCadOptions::deviation>},
    {"cad_seconds", read_cad_seconds},
    {"cad_megabytes", read_cad_megabytes},
};

/// { volume=, faces=, planes=, fitted=, tolerance= } = volume:write_cad(path [, options])
int write_cad(lua_State* L)
{
    lua_settop(L, 3);
    const auto& state = hold<VolumeState>(L, 1);
    const io::OutputPath& path = push_output_path(L, 2, "write_cad");
    auto& options = temporary<cad::WriteCadOptions>(L);
    read_options(L, 3, "write_cad", kCadWriteOptions, options);
    options.limits.may_raise = !host(L).sandboxed;
    RunContext& context = push_context(L);
    cad::WrittenCad written;
    guard(L, [&] {
        options.unit = state.unit;
        written = cad::write_cad(state.volume, path, options, context);
    });
    lua_createtable(L, 0, 5);
    set_field(L, "volume", written.volume);
    set_field(L, "tolerance", written.tolerance);
    set_field(L, "faces", written.faces);
    set_field(L, "planes", written.planes);
    set_field(L, "fitted", written.fitted);
    return 1;
}

} // namespace

int gmsh_version(lua_State* L)
{
    push_text(L, [] { return cad::gmsh_version(); });
    return 1;
}

void bind_cad(lua_State* L) { add_methods<VolumeState>(L, {{"write_cad", write_cad}}); }

} // namespace lacuna::lua
