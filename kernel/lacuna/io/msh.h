// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/io/mesh_file.h>

namespace lacuna::io {

using MshOptions = MeshFileOptions;

/// `write_mesh()` for Gmsh.
inline void write_msh(const mesh::HexMesh& mesh, const OutputPath& path, const MshOptions& options = {},
                      const RunContext& context = {})
{
    write_mesh(format_of(DeckFormat::msh), mesh, path, options, {}, context);
}

/// Write the options that Gmsh reads with a mesh when they lie beside it as "<mesh>.msh.opt": faces and sides
/// of cells, a colour a physical group. The file says in words what it does.
/// @throw  as `WholeFile`.
void write_msh_options(const OutputPath& path);

} // namespace lacuna::io
