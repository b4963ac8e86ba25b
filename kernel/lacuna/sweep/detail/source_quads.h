// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/quads/region.h>
#include <lacuna/surface/shared/seeds.h>
#include <lacuna/surface/shared/source_mesh.h>
#include <lacuna/sweep/detail/known_links.h>
#include <lacuna/sweep/detail/size_words.h>
#include <lacuna/sweep/sweep.h>

/// What the options of a sweep ask of the source's quads.
namespace lacuna::sweep {

surface::QuadStyle style_of(const SweepOptions& options, bool rows_along_walls);

/// What fills the source faces that are not mapped: the kernel's paver, or the mesher handed in.
/// @param narrow  quads are asked for across places that may be narrow.
quads::PlanarQuadMesher mesher_of(const SweepOptions& options, bool narrow);

/// The same for regions that may have an odd number of sides.
quads::PlanarQuadMesher mesher_for_all(const SweepOptions& options, bool narrow);

/// A field that refuses what is no length before anything is divided by it.
/// @throw InvalidInput  by the field, names the option.
surface::SizeField checked_size(const surface::SizeField& field, const std::string& option);

/// The size asked for, or the default; smaller where the shape needs it, and all over where the plan for the
/// volume says so.
/// @throw InvalidInput  a size that is no positive length; too many cells to number. @throw Cancelled
SourceSize source_size(const topology::OpenVolume& volume, const SweepOptions& options, KnownLinks& links,
                       const RunContext& context);

/// Log the number of cells that are to be expected of volumes swept together, before any is meshed.
/// @throw InvalidInput "sweep.many_cells"  more than 50 million that were not asked for by both numbers.
void check_cells(const ExpectedCells& expected, const RunContext& context);

/// The size, and the height of rows where they are asked for.
surface::SizeFields size_fields(const surface::SizeField& size, const SweepOptions& options);

} // namespace lacuna::sweep
