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

/// Write the facets of a sealed volume, oriented outward, whole or not at all. The ending says the format:
///
/// - `.stl`: one solid. Binary files hold floats: points are rounded, each to the same place for all its
///   facets.
/// - `.obj`: the points once, a line of groups a face: one of its own (`wall:12`, `source:3`,
///   `target:void:1`), then its names.
/// - `.msh`: 4.1, a surface entity a face, with the physical group its quads have in a mesh: the name it
///   was given, else `source`, `target`, `wall:<tag>` or `void:<n>`. Given faces keep their tags, void faces
///   count on from the highest.
///
/// @throw InvalidInput  the volume is not sealed (names free edges), an unknown ending, a missing folder.
/// @throw BackendError  the disk is full or the file cannot be written; nothing is left behind.
/// @note  The same volume gives the same bytes.
void write_facets(const topology::OpenVolume& volume, const OutputPath& path,
                  const FacetFileOptions& options = {}, const RunContext& context = {});

} // namespace lacuna::io
