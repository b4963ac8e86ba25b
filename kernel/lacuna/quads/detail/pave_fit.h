// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/quads/detail/pave_draft.h>

#include <vector>

namespace lacuna::quads::paving {

/// How well a loop can be filled as one patch.
struct Fit {
    std::vector<std::size_t> corners; ///< 3 to 5 places in the cycle; empty where it cannot be filled
    double quality = 0; ///< 1 for a rectangle of right counts and sizes; 0 and less: it would fold
};

/// The best corners of a loop, and what a patch over them would be like, by a few sample cells.
///
/// Places where the outline turns are corners. A round loop of inner nodes gets four where they lie best:
/// rows lie around it, so its nodes need not be flat.
Fit fit_patch(const Draft& draft, const Cycle& cycle, const std::vector<double>& angles);

/// The inner angles at all places of a loop.
std::vector<double> angles_of(const Draft& draft, const Cycle& cycle);

} // namespace lacuna::quads::paving
