// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/quads/detail/pave_draft.h>
#include <lacuna/quads/pave.h>

namespace lacuna::quads::paving {

/// What lies along the boundary.
enum class RowStyle {
    by_shape,  ///< as many rows as each loop is worth
    one_patch, ///< none: the region is one patch
    none,      ///< the region is cut as it is
    thin,      ///< rows also where loops are near each other
    buffer,    ///< one row with two quads at least at every node, so that all other nodes are free to move
    split_triangles ///< no rows: `quads_of_triangles()`
};

/// Quads made in one way.
struct Attempt {
    PlanarQuads mesh;
    PaveReport report;
    RowStyle style = RowStyle::by_shape;
    double worst = -2;         ///< least sine; -2: no mesh, -1: one with a fault
    Vec2 where = Vec2::Zero(); ///< the worst quad's place
};

/// Find the worst quad.
void judge(Attempt& attempt);

/// Fill a region in one way: rows, cuts and patches, or triangles; open what folds, clean and smooth it.
/// @param flat  quads with a smaller sine count as folded.
Attempt try_pave(const PlanarRegion& region, const PaveOptions& options, RowStyle style, const Taste& taste,
                 double flat, const RunContext& context);

} // namespace lacuna::quads::paving
