// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/shared/criteria.h>
#include <lacuna/sweep/detail/known_links.h>
#include <lacuna/sweep/detail/mean_outline.h>
#include <lacuna/sweep/sweep.h>

#include <string>
#include <vector>

namespace lacuna::sweep {

/// One way to mesh a sealed volume: all that a sweep may choose, as numbers.
struct Plan {
    bool turned = false;    ///< swept from the target
    bool keeps_end = false; ///< the end that it starts from came with quads, which are its mesh
    Outline outline = Outline::source;
    surface::Turning turning = surface::Turning::each;
    std::vector<double> heights{}; ///< of layers that are thinner in bends, as `LayerSpec::heights`
    int per_turn = 12;             ///< sides for a full turn
    bool wedges = false;           ///< see `SweepOptions::wedges`
    double below = kPoorCell;      ///< tried if no mesh has this least scaled Jacobian yet
    std::string why{};             ///< for the report: why it comes first; may be empty
    std::string layers{};          ///< for the report: how `heights` were chosen
};

/// The ways to mesh a volume, best first.
///
/// First the end that came with quads, if one did, is the source; then an end of several faces, whose inner
/// edges are mesh edges then; then the source. The same with all loops turned as one body, if their walls do
/// not tell how far each is turned; the other end; and quads laid out between the outlines of both ends. All
/// of these with layers that are thinner in bends first, if they gain volume. At order 2 the whole list is
/// repeated with more sides, which a quad with two sides on a round rim needs.
/// @param options  checked; `curvature` as planned for the volume.
/// @throw Cancelled
std::vector<Plan> plans(const topology::OpenVolume& volume, const SweepOptions& options, KnownLinks& links,
                        const RunContext& context);

/// The plan, for reports and errors: "swept from the target, with its loops turned as one body".
std::string in_words(const Plan& plan, const topology::OpenVolume& volume);

} // namespace lacuna::sweep
