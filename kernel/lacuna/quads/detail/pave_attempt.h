// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/quads/detail/partial_mesh.h>
#include <lacuna/quads/shared/pave.h>

namespace lacuna::quads::paving {

/// How a region is filled: the rows along its boundary, or none.
enum class RowStyle {
    by_shape,  ///< as many rows as each loop is worth
    no_rows,   ///< the region is cut as it is
    thin,      ///< rows also where loops are near each other
    buffer,    ///< one row with at least two quads at every node, so that all other nodes are free to move
    triangles, ///< no rows: `quads_of_triangles()`
};

/// Quads made in one way.
struct Attempt {
    PlanarQuads mesh;
    PaveReport report;
    RowStyle style = RowStyle::by_shape;
    double worst = -2;         ///< least sine; -2: no mesh, -1: one with a fault
    Vec2 where = Vec2::Zero(); ///< the worst quad's centre
};

/// Find the worst quad.
void judge(Attempt& attempt);

/// What is the same for all attempts at a region.
struct AttemptSetting {
    const PlanarRegion& region;
    SizeField size;  ///< of the region, with its boundary's
    double flat = 0; ///< quads with a smaller sine count as folded
};

/// Fill a region in one way, by rows, cuts and patches or by triangles; nothing is improved yet.
Attempt begin_attempt(const AttemptSetting& setting, RowStyle style, const CutWeights& weights,
                      const RunContext& context);

/// Open folds, clean and smooth.
/// @param thorough  of the cleaning, see `CleanOptions`
void finish_attempt(Attempt& attempt, const AttemptSetting& setting, bool thorough,
                    const RunContext& context);

} // namespace lacuna::quads::paving
