// SPDX-License-Identifier: MIT
#pragma once

// Writing meshes while they are made: volume:sweep_to reads the options of its file and writes it with these
// functions.

#include "bindings/classes.h"
#include "bindings/lacuna_lua.h"

#include <lacuna/io/whole_file.h>

namespace lacuna::lua {

struct WriteArguments;

/// Read the options of mesh:write at `index`, nil or a table, for a file that is written a layer at a time;
/// as a temporary. Refuses file extensions and options that such files do not have.
WriteArguments& push_layered_write(lua_State* L, int index, const io::OutputPath& path);

/// Whether the mesh of an assembly is written a layer at a time; its parts then need not hold their nodes.
bool may_be_layered_of_parts(const WriteArguments& arguments, const io::OutputPath& path);

/// Refuse the option `interfaces`, which the mesh of one volume does not have.
void refuse_interfaces(const WriteArguments& arguments);

/// Write the file with Gmsh's display options beside a .msh, if asked to.
void write_options_beside(const Host& lent, const io::OutputPath& mesh, const WriteArguments& arguments);

/// Write a mesh whose nodes may still have to be made; the file is the same as from mesh:write, byte for
/// byte.
void write_layered(const fill::FilledVolume& filled, const io::OutputPath& path, WriteArguments& arguments,
                   const Crew* crew, const RunContext& context);

/// Write the mesh of an assembly, whose nodes may still have to be made, as assembly_mesh:write does.
void write_pieces(const fill::FilledParts& state, const io::OutputPath& path, WriteArguments& arguments,
                  const Crew* crew, const RunContext& context);

} // namespace lacuna::lua
