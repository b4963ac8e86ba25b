// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/io/whole_file.h>
#include <lacuna/topology/open_volume.h>

#include <string>

namespace lacuna::io {

struct FacetFileOptions {
    bool binary = true;      ///< of .stl and .msh; .obj is always text
    bool all_groups = false; ///< of .msh: as `MeshFileOptions::all_groups`
};

/// Write the facets of a sealed volume, oriented outward: the complete file or none. The file extension
/// determines the format:
///
/// - `.stl`: one solid. Binary files hold floats: points are rounded, each to the same value in all its
///   facets.
/// - `.obj`: each point once, and a line of groups for each face: a unique one (`wall:12`, `source:3`,
///   `target:void:1`), then its names.
/// - `.msh`: 4.1, a surface entity for each face, with the physical group that its quads have in a mesh: the
///   given name, otherwise `source`, `target`, `wall:<tag>` or `void:<n>`. Given faces keep their tags; void
///   faces follow the highest tag.
///
/// @throw InvalidInput  the volume is not sealed (names free edges), an unknown extension, a missing folder.
/// @throw BackendError  the disk is full or the file cannot be written; no file is left.
/// @note  The same volume gives the same bytes.
void write_facets(const topology::OpenVolume& volume, const OutputPath& path,
                  const FacetFileOptions& options = {}, const RunContext& context = {});

} // namespace lacuna::io
