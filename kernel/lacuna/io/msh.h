// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/mesh/hex_mesh.h>

#include <string>

namespace lacuna::io {

struct MshOptions {
    bool binary = true;
    double version = 4.1; ///< 4.1, or 2.2 for readers that know no other
};

/// Write hexahedra and skin with a named physical group for every entity, whole or not at all: the file is
/// written beside its place and renamed.
/// @throw InvalidInput  the folder does not exist, the version is unknown.
/// @throw BackendError  the disk is full or the file cannot be written; nothing is left behind.
void write_msh(const mesh::HexMesh& mesh, const std::string& path, const MshOptions& options = {},
               const RunContext& context = {});

} // namespace lacuna::io
