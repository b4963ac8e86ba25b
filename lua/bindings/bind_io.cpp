// SPDX-License-Identifier: MIT
#include "bindings/bind_quality.h"
#include "bindings/io_paths.h"
#include "bindings/lacuna_lua.h"
#include "bindings/options.h"

#include <lacuna/io/facets.h>
#include <lacuna/io/msh.h>
#include <lacuna/io/msh_reader.h>
#include <lacuna/io/vtk.h>

namespace lacuna::lua {

namespace {

struct WriteArguments {
    io::MshOptions msh;
    bool version_given = false, binary_given = false;
};

void read_version(lua_State* L, int index, const Where& where, WriteArguments& arguments)
{
    const double version = read_number(L, index, where);
    if (version != 4.1 && version != 2.2) fail_value(L, where, "4.1 or 2.2", index);
    arguments.msh.version = version;
    arguments.version_given = true;
}

void read_binary(lua_State* L, int index, const Where& where, WriteArguments& arguments)
{
    arguments.msh.binary = read_boolean(L, index, where);
    arguments.binary_given = true;
}

const Option<WriteArguments> kWriteOptions[] = {{"version", read_version}, {"binary", read_binary}};

/// A format by its ending, and which options it has.
struct Format {
    const char* ending;
    bool has_version, has_binary;
    void (*write)(const mesh::HexMesh& mesh, const std::string& path, const io::MshOptions& options,
                  const RunContext& context);
};

const Format kFormats[] = {
    {".msh", true, true,
     [](const auto& mesh, const auto& path, const auto& options, const auto& context) {
         io::write_msh(mesh, path, options, context);
     }},
    {".vtu", false, false,
     [](const auto& mesh, const auto& path, const auto&, const auto& context) {
         io::write_vtu(mesh, path, context);
     }},
    {".vtk", false, true,
     [](const auto& mesh, const auto& path, const auto& options, const auto& context) {
         io::write_vtk(mesh, path, {options.binary}, context);
     }},
};

const Format& format_of(const std::string& path, const WriteArguments& arguments)
{
    std::string known;
    for (const Format& format : kFormats) {
        known += std::string(" ") + format.ending;
        if (ending_of(path) != format.ending) continue;
        const bool idle_version = arguments.version_given && !format.has_version;
        if (idle_version || (arguments.binary_given && !format.has_binary))
            throw InvalidInput("lua.idle_option",
                               std::string("write: ") + format.ending + " files have no option '" +
                                   (idle_version ? "version" : "binary") + "'; leave it out");
        return format;
    }
    throw InvalidInput("lua.unknown_ending",
                       "write: the ending of " + path + " says no format; meshes are written as" + known);
}

/// mesh:write(path [, options])
int write(lua_State* L)
{
    lua_settop(L, 3);
    const auto& state = check<MeshState>(L, 1);
    const char* path = push_output_path(L, 2, "write");
    WriteArguments arguments;
    read_options(L, 3, "write", kWriteOptions, arguments);
    RunContext& context = push_context(L);
    guard(L, [&] { format_of(path, arguments).write(state.swept.mesh, path, arguments.msh, context); });
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

const Option<io::FacetFileOptions> kFacetOptions[] = {{"binary", boolean<&io::FacetFileOptions::binary>}};

/// volume:write_facets(path [, options])
int write_facets(lua_State* L)
{
    lua_settop(L, 3);
    const auto& state = check<VolumeState>(L, 1);
    const char* path = push_output_path(L, 2, "write_facets");
    io::FacetFileOptions options;
    read_options(L, 3, "write_facets", kFacetOptions, options);
    RunContext& context = push_context(L);
    guard(L, [&] { io::write_facets(state.volume, path, options, context); });
    return 0;
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
const luaL_Reg kVolumeMethods[] = {{"write_facets", write_facets}, {nullptr, nullptr}};

const luaL_Reg kFunctions[] = {{"check", check_file}, {nullptr, nullptr}};

} // namespace

void bind_io(lua_State* L)
{
    luaL_setfuncs(L, kFunctions, 0);
    add_methods(L, kClassName<MeshState>, kMeshMethods);
    add_methods(L, kClassName<VolumeState>, kVolumeMethods);
}

} // namespace lacuna::lua
