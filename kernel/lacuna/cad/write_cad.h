// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/cad/limits.h>
#include <lacuna/core/run_context.h>
#include <lacuna/io/whole_file.h>
#include <lacuna/topology/open_volume.h>

#include <cstddef>

namespace lacuna::cad {

struct WriteCadOptions {
    /// Largest gap that sewing closes [model length]. With 0, the first attempt uses the tolerance of the
    /// model, and each further attempt ten times as much.
    double tolerance = 0;
    /// Allowed relative difference between the volume of the solid and that of the facets [-].
    double deviation = 0.05;
    Limits limits{};    ///< limits of the CAD process
    std::string unit{}; ///< unit of the model's lengths, which a STEP file states; empty: millimetres
};

/// The solid that was written, measured after reading it back.
struct WrittenCad {
    double volume = 0;       ///< volume of the solid [model length³]
    double facet_volume = 0; ///< volume inside the facets of the sealed volume [model length³]
    std::size_t faces = 0;   ///< number of faces of the solid
    std::size_t planes = 0;  ///< void faces written as planes
    std::size_t fitted = 0;  ///< void faces written as one or more fitted surfaces
    double tolerance = 0;    ///< tolerance that was used for sewing [model length]
};

/// Write a sealed volume as one CAD solid, in a `.step`, `.stp` or `.brep` file. STEP files declare `unit`.
/// The file appears only if everything succeeds.
///
/// Given CAD faces are copied from their source file, scaled as the model was. A planar void face becomes a
/// plane bounded by the exact given edges, lines and splines. A void face with four logical sides becomes
/// spline surfaces (see void_patches()). Other void faces become filled surfaces over their edges and some
/// points of their facets. Given faces without an exact surface must be planar. The faces are sewn, and the
/// file is read back: it must contain one closed solid.
///
/// @throw InvalidInput  the volume is not sealed (names free edges); a curved face has no exact surface
///                      (names it; write_facets() can write it); the file extension is unknown; the folder
///                      is missing.
/// @throw BackendError  a surface cannot be made (names the face), the faces cannot be sewn, the file does
///                      not read back as one closed solid of the right volume, or the disk is full. No file
///                      is left behind.
/// @note  The same volume gives the same bytes: the time stamp of a STEP file is set to 1970, and its product
///        is called "volume".
WrittenCad write_cad(const topology::OpenVolume& volume, const io::OutputPath& path,
                     const WriteCadOptions& options = {}, const RunContext& context = {});

} // namespace lacuna::cad
