// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/io/whole_file.h>
#include <lacuna/topology/open_volume.h>

#include <string>

namespace lacuna::io {

struct FacetFileOptions {
    bool binary = true;      ///< for .stl and .msh; .obj is always text
    bool all_groups = false; ///< for .msh, see `MeshFileOptions::all_groups`
};

/// Write the facets of a sealed volume, oriented outward; the file is complete or does not appear. The file
/// extension determines the format:
///
/// - `.stl`: one solid. Binary files hold single-precision numbers: a point is rounded in the same way in all
///   its facets.
/// - `.obj`: each point once, and a line of groups for each face: a unique one (`wall:12`, `source:3`,
///   `target:void:1`), then its names.
/// - `.msh`: version 4.1, with a surface entity for each face. Its physical group is that of the face's quads
///   in a mesh: the given name, otherwise `source`, `target`, `wall:<tag>` or `void:<n>`. Given faces keep
///   their tags; void faces get tags above the highest one.
///
/// @throw InvalidInput  the volume is not sealed (names free edges), an unknown extension, a missing folder.
/// @throw BackendError  the disk is full or the file cannot be written; no file is left.
/// @note  The same volume gives the same bytes.
void write_facets(const topology::OpenVolume& volume, const OutputPath& path,
                  const FacetFileOptions& options = {}, const RunContext& context = {});

} // namespace lacuna::io
