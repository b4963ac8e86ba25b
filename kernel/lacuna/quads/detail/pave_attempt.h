// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/quads/detail/partial_mesh.h>
#include <lacuna/quads/shared/pave.h>

namespace lacuna::quads::paving {

/// The rows that are placed along the boundary before a region is filled.
enum class RowStyle {
    by_shape,  ///< as many rows as suit each loop
    no_rows,   ///< no rows; the region is cut without them
    triangles, ///< no rows; `quads_of_triangles()` fills the region
};

/// The mesh of one attempt to fill a region.
struct Attempt {
    PlanarQuads mesh;
    PaveReport report;
    RowStyle style = RowStyle::by_shape;
    double worst = -2;         ///< least sine of the corners of all quads; -2: no mesh, -1: an invalid mesh
    Vec2 where = Vec2::Zero(); ///< centre of the worst quad
};

/// Set `worst` and `where` of an attempt.
void judge(Attempt& attempt);

/// The inputs of all attempts to fill one region.
struct AttemptSetting {
    const PlanarRegion& region;
    SizeField size;  ///< size in the region, graded from its boundary sides
    double flat = 0; ///< a quad counts as folded if the sine of a corner is smaller than this [-]
};

/// Fill a region in one way: with rows, cuts and patches, or with triangles. The mesh is not improved yet.
Attempt begin_attempt(const AttemptSetting& setting, RowStyle style, const CutWeights& weights,
                      const RunContext& context);

/// Open the folds of a mesh, then clean and smooth it.
/// @param thorough  whether cleaning is thorough, see `CleanOptions`
void finish_attempt(Attempt& attempt, const AttemptSetting& setting, bool thorough,
                    const RunContext& context);

} // namespace lacuna::quads::paving
