// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/quads/detail/partial_mesh.h>

#include <vector>

namespace lacuna::quads::paving {

/// The quality with which a loop can be filled as one patch.
struct PatchFit {
    std::vector<std::size_t> corners; ///< 3 to 5 positions in the cycle; empty if no patch fits
    /// 1 for a rectangle with equal numbers on opposite sides and quads of the right size; <= 0 if it folds
    /// [-].
    double quality = 0;
};

/// The best corners of a loop, and the quality of a patch with these corners, estimated from a few sample
/// cells.
///
/// Nodes where the outline turns are corners.
PatchFit fit_patch(const PartialMesh& partial, const Cycle& cycle, const std::vector<double>& angles);

} // namespace lacuna::quads::paving
