// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/cad/limits.h>
#include <lacuna/core/run_context.h>
#include <lacuna/io/whole_file.h>
#include <lacuna/topology/open_volume.h>

#include <cstddef>
#include <string>

namespace lacuna::cad {

struct WriteCadOptions {
    /// Gaps sewn up [model length]; 0: the model's tolerance, and ten times more each try where that does not
    /// seal it.
    double tolerance = 0;
    double deviation = 0.05; ///< the solid's volume may differ by this part from that within the facets [-]
    Limits limits{};         ///< of the CAD process
};

/// What was written, as it reads back.
struct WrittenCad {
    double volume = 0;       ///< of the solid [model length³]
    double facet_volume = 0; ///< within the facets of the sealed volume [model length³]
    std::size_t faces = 0;   ///< of the solid
    std::size_t planes = 0;  ///< void faces that became planes
    std::size_t fitted = 0;  ///< void faces that became fitted surfaces, each of one or more
    double tolerance = 0;    ///< of the sewing [model length]
};

/// Write a sealed volume as one CAD solid, whole or not at all: `.step`, `.stp` (lengths of the model as
/// mm) or `.brep`.
///
/// Given CAD faces are those of the file they came from, scaled as the model was. A flat void face is a
/// plane between the given edges themselves, lines and splines; one with four logical sides is a spline
/// surface over its sides (see void_patches()); any other is filled in over its edges and through points of
/// its facets. A given face that has facets alone is written where it is flat. All is sewn; what was
/// written is read back, and must be one closed solid.
///
/// @throw InvalidInput  the volume is not sealed (names free edges); a face that is bent and has facets
///                      alone (names it; write_facets() can write it); an unknown ending, a missing folder.
/// @throw BackendError  a surface cannot be made (names the face), the faces cannot be sewn, the file does
///                      not read back as one closed solid of the volume, the disk is full. Nothing is left
///                      behind.
/// @note  The same volume gives the same bytes; the time in a STEP file's head is that of 1970, its product
///        is called "volume".
WrittenCad write_cad(const topology::OpenVolume& volume, const io::OutputPath& path,
                     const WriteCadOptions& options = {}, const RunContext& context = {});

} // namespace lacuna::cad
