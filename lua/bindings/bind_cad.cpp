// SPDX-License-Identifier: MIT
#include "bindings/classes.h"
#include "bindings/io_paths.h"
#include "bindings/lacuna_lua.h"
#include "bindings/options.h"

#include <lacuna/cad/load.h>
#include <lacuna/cad/write_cad.h>

namespace lacuna::lua {

namespace {

void read_feature_angle(lua_State* L, int index, const Where& where, cad::LoadOptions& options)
{
    options.feature_angle = read_positive(L, index, where);
    if (options.feature_angle > 180) fail_value(L, where, "degrees in (0, 180]", index);
}

const Option<cad::LoadOptions> kLoadOptions[] = {
    {"tolerance", positive<&cad::LoadOptions::tolerance>},
    {"feature_angle", read_feature_angle},
    {"keep_mesh", boolean<&cad::LoadOptions::keep_mesh>},
    {"scale", positive<&cad::LoadOptions::scale>},
};

/// The path or the array of paths at `index`, as a temporary.
std::vector<std::string>& push_paths(lua_State* L, int index)
{
    const Where where{"load", "path"};
    auto& paths = temporary<std::vector<std::string>>(L);
    const auto add = [&](int element, const Where& at) {
        const char* path = read_string(L, element, at);
        guard(L, [&] { paths.emplace_back(path); });
    };
    if (lua_type(L, index) == LUA_TTABLE && lua_rawlen(L, index) > 0)
        read_array(L, index, where, "", add);
    else if (lua_type(L, index) == LUA_TSTRING)
        add(index, {"load", nullptr});
    else
        fail_value(L, {"load", nullptr}, "the path of a file or an array of paths", index);
    return paths;
}

/// model = lacuna.load(path | {paths} [, options])
int load(lua_State* L)
{
    lua_settop(L, 2);
    auto& paths = push_paths(L, 1);
    cad::LoadOptions options;
    read_options(L, 2, "load", kLoadOptions, options);
    const Host& lent = host(L);
    RunContext& context = push_context(L);
    lua_gc(L, LUA_GCCOLLECT); // to Lua a model is a few bytes: it would let old ones pile up
    auto& box = new_box<ModelState>(L);
    guard(L, [&] {
        for (const std::string& path : paths) check_input_path(lent, path);
        box = std::make_shared<ModelState>();
        box->model = cad::load(paths, options, context);
    });
    return 1;
}

const Option<cad::WriteCadOptions> kWriteOptions[] = {
    {"tolerance", positive<&cad::WriteCadOptions::tolerance>},
    {"deviation", positive<&cad::WriteCadOptions::deviation>},
};

/// { volume=, faces=, planes=, fitted=, tolerance= } = volume:write_cad(path [, options])
int write_cad(lua_State* L)
{
    lua_settop(L, 3);
    const auto& state = check<VolumeState>(L, 1);
    const char* path = push_output_path(L, 2, "write_cad");
    cad::WriteCadOptions options;
    read_options(L, 3, "write_cad", kWriteOptions, options);
    RunContext& context = push_context(L);
    cad::WrittenCad written;
    guard(L, [&] { written = cad::write_cad(state.volume, path, options, context); });
    lua_createtable(L, 0, 5);
    set_number(L, "volume", written.volume);
    set_number(L, "tolerance", written.tolerance);
    set_count(L, "faces", written.faces);
    set_count(L, "planes", written.planes);
    set_count(L, "fitted", written.fitted);
    return 1;
}

} // namespace

/// Push the version of Gmsh.
int gmsh_version(lua_State* L)
{
    push_text(L, [] { return cad::gmsh_version(); });
    return 1;
}

namespace {
const luaL_Reg kFunctions[] = {{"load", load}, {nullptr, nullptr}};
const luaL_Reg kVolumeMethods[] = {{"write_cad", write_cad}, {nullptr, nullptr}};
} // namespace

void bind_cad(lua_State* L)
{
    luaL_setfuncs(L, kFunctions, 0);
    add_methods(L, kClassName<VolumeState>, kVolumeMethods);
}

} // namespace lacuna::lua
