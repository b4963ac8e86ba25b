// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/quads/region.h>
#include <lacuna/surface/shared/seeds.h>
#include <lacuna/surface/shared/source_mesh.h>
#include <lacuna/sweep/detail/known_links.h>
#include <lacuna/sweep/detail/size_words.h>
#include <lacuna/sweep/sweep.h>

/// The options of a sweep that apply to the source's quads.
namespace lacuna::sweep {

surface::QuadStyle style_of(const SweepOptions& options, bool rows_along_walls);

/// The mesher for source faces that are not mapped: the kernel's paver, or the given mesher.
/// @param size  gives the minimum number of rows around rings, and whether other narrow places may need a
///         minimum number of quads across.
quads::PlanarQuadMesher mesher_of(const SweepOptions& options, const SourceSize& size);

/// As `mesher_of()`, for regions that may have an odd number of sides.
quads::PlanarQuadMesher mesher_for_all(const SweepOptions& options, const SourceSize& size);

/// Reduce the requested or default size of a source where its faces are curved or narrow. The default number
/// of quads across narrow places is dropped if it would give too many quads.
/// @param size  `asked` and `by_default` are read, the sizes by shape are set.
void reduce_by_shape(const topology::OpenVolume& volume, const SweepOptions& options, SourceSize& size);

/// The requested or default size, reduced by the shape of the volume. If `VolumePlan::part` is less than 1,
/// the size is reduced everywhere.
/// @throw InvalidInput  a size is not a positive length, or there are too many cells to number.
/// @throw Cancelled
SourceSize source_size(const topology::OpenVolume& volume, const SweepOptions& options, KnownLinks& links,
                       const RunContext& context);

/// Log the estimated number of cells of volumes that are swept together, before meshing.
/// @throw InvalidInput "sweep.many_cells"  more than 50 million cells are expected in sweeps without a given
///         size or without given layers.
void check_cells(const ExpectedCells& expected, const RunContext& context);

/// The size, and the height of rows if requested.
surface::SizeFields size_fields(const surface::SizeField& size, const SweepOptions& options);

} // namespace lacuna::sweep
