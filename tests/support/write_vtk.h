// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/io/mesh_file.h>

#include <vector>

namespace lacuna::io {

struct VtuOptions {
    std::vector<CellField> fields{}; ///< each becomes a cell array
};
struct VtkOptions {
    bool binary = true;
    std::vector<CellField> fields{}; ///< each becomes a cell array
};

/// `write_mesh()` for VTK: XML, and the legacy format.
inline void write_vtu(const mesh::HexMesh& mesh, const OutputPath& path, const VtuOptions& options = {},
                      const RunContext& context = {})
{
    write_mesh(format_of(DeckFormat::vtu), mesh, path, {.fields = options.fields}, {}, context);
}
inline void write_vtk(const mesh::HexMesh& mesh, const OutputPath& path, const VtkOptions& options = {},
                      const RunContext& context = {})
{
    write_mesh(format_of(DeckFormat::vtk), mesh, path, {.binary = options.binary, .fields = options.fields},
               {}, context);
}

} // namespace lacuna::io
