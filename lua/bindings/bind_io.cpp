// SPDX-License-Identifier: MIT
#include "bindings/bind_quality.h"
#include "bindings/io_paths.h"
#include "bindings/lacuna_lua.h"
#include "bindings/options.h"

#include <lacuna/io/msh.h>
#include <lacuna/io/msh_reader.h>

namespace lacuna::lua {

namespace {

void read_version(lua_State* L, int index, const Where& where, io::MshOptions& options)
{
    const double version = read_number(L, index, where);
    if (version != 4.1 && version != 2.2) fail_value(L, where, "4.1 or 2.2", index);
    options.version = version;
}

const Option<io::MshOptions> kWriteOptions[] = {
    {"version", read_version},
    {"binary", boolean<&io::MshOptions::binary>},
};

/// mesh:write(path [, options])
int write(lua_State* L)
{
    lua_settop(L, 3);
    const auto& state = check<MeshState>(L, 1);
    const char* path = push_output_path(L, 2, "write");
    io::MshOptions options;
    read_options(L, 3, "write", kWriteOptions, options);
    RunContext& context = push_context(L);
    guard(L, [&] {
        if (ending_of(path) != ".msh")
            throw InvalidInput("io.unknown_ending", std::string("write: ") + path +
                                                        ": meshes are written as .msh so far; "
                                                        "the other formats are not available yet");
        io::write_msh(state.swept.mesh, path, options, context);
    });
    return 0;
}

/// A method the kernel has nothing for yet, and what does instead.
template <class T>
int not_yet(lua_State* L, const char* name, const char* instead)
{
    lua_settop(L, 2);
    check<T>(L, 1);
    push_output_path(L, 2, name);
    fail(L, "%s is not available yet; %s", name, instead);
}

int view(lua_State* L) { return not_yet<MeshState>(L, "view", "write a .msh and open it in Gmsh"); }
int write_facets(lua_State* L)
{
    return not_yet<VolumeState>(L, "write_facets",
                                "sweep the volume and write the mesh, whose skin is the facets' shape");
}
int write_cad(lua_State* L)
{
    return not_yet<VolumeState>(L, "write_cad", "sweep the volume and write the mesh");
}

/// quality = lacuna.check(path): of the hexahedra of a .msh file
int check_file(lua_State* L)
{
    lua_settop(L, 1);
    const char* path = read_string(L, 1, {"check", nullptr});
    const Host& lent = host(L);
    RunContext& context = push_context(L);
    auto& measured = temporary<quality::Quality>(L);
    guard(L, [&] {
        check_input_path(lent, path);
        const io::HexCells cells = io::read_msh_hexes(path);
        if (cells.hexes.empty())
            throw InvalidInput("lua.no_hexahedra", std::string("check: ") + path + " holds no hexahedra");
        measured = quality::measure_cells(cells.nodes, cells.hexes, context);
    });
    push_quality(L, measured);
    return 1;
}

const luaL_Reg kMeshMethods[] = {{"write", write}, {"view", view}, {nullptr, nullptr}};
const luaL_Reg kVolumeMethods[] = {
    {"write_facets", write_facets}, {"write_cad", write_cad}, {nullptr, nullptr}};

const luaL_Reg kFunctions[] = {{"check", check_file}, {nullptr, nullptr}};

} // namespace

void bind_io(lua_State* L)
{
    luaL_setfuncs(L, kFunctions, 0);
    add_methods(L, kClassName<MeshState>, kMeshMethods);
    add_methods(L, kClassName<VolumeState>, kVolumeMethods);
}

} // namespace lacuna::lua
