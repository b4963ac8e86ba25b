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

/// Write the options that Gmsh reads with a mesh if they are next to it as "<mesh>.msh.opt": show faces and
/// sides of cells, one colour for each physical group. Comments in the file explain its effect.
/// @throw  as `WholeFile`.
void write_msh_options(const OutputPath& path);

} // namespace lacuna::io
