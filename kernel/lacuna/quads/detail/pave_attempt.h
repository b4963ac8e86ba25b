// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/quads/detail/partial_mesh.h>
#include <lacuna/quads/shared/pave.h>

namespace lacuna::quads::paving {

/// Which rows are placed along the boundary before a region is filled.
enum class RowStyle {
    by_shape,  ///< as many rows as suit each loop
    no_rows,   ///< none; the region is cut as it is
    triangles, ///< none; `quads_of_triangles()` fills the region
};

/// A mesh of one attempt at a region.
struct Attempt {
    PlanarQuads mesh;
    PaveReport report;
    RowStyle style = RowStyle::by_shape;
    double worst = -2;         ///< minimum sine of a quad; -2: no mesh, -1: a mesh with a fault
    Vec2 where = Vec2::Zero(); ///< centre of the worst quad
};

/// Find the worst quad.
void judge(Attempt& attempt);

/// The input common to all attempts at a region.
struct AttemptSetting {
    const PlanarRegion& region;
    SizeField size;  ///< size in the region, graded from its boundary sides
    double flat = 0; ///< quads with a smaller sine count as folded [-]
};

/// Fill a region in one way: by rows, cuts and patches, or by triangles. The mesh is not improved yet.
Attempt begin_attempt(const AttemptSetting& setting, RowStyle style, const CutWeights& weights,
                      const RunContext& context);

/// Open folds, clean and smooth.
/// @param thorough  whether cleaning is thorough, see `CleanOptions`
void finish_attempt(Attempt& attempt, const AttemptSetting& setting, bool thorough,
                    const RunContext& context);

} // namespace lacuna::quads::paving
