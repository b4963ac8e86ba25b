// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/shared/criteria.h>
#include <lacuna/sweep/detail/drawn_layers.h>
#include <lacuna/sweep/detail/known_links.h>
#include <lacuna/sweep/detail/mean_outline.h>
#include <lacuna/sweep/sweep.h>

#include <optional>
#include <string>
#include <vector>

namespace lacuna::sweep {

/// One way to mesh a sealed volume, with all choices of a sweep as numbers.
struct Plan {
    bool turned = false;    ///< swept from the target to the source
    bool keeps_end = false; ///< the end where it starts has given quads, which are kept
    Outline outline = Outline::source;
    surface::Turning turning = surface::Turning::each;
    std::optional<DrawnLayers> drawn{}; ///< layers that are thinner in bends; empty: as the options ask
    int per_turn = 12;                  ///< sides for a full turn
    bool wedges = false;      ///< see `SweepOptions::wedges`; as a fallback, tried only if no plan without
                              ///< wedges gave a mesh
    double below = kPoorCell; ///< tried only if no mesh has reached this least scaled Jacobian yet
    std::string why{};        ///< for the report: why it comes first; may be empty
};

/// The ways to mesh a volume, best first.
///
/// The first plan uses the given source and target, unless one end has given quads or, failing that, one end
/// has several faces (whose inner edges become mesh edges): that end becomes the source. Then follow: all
/// loops rotated together, if the walls of some loop do not determine its rotation; the other end as source;
/// and quads laid out between the outlines of both ends. If layers that are thinner in bends reduce the
/// volume error, all of these plans come first with such layers. At order 2 the whole list is repeated with
/// more sides, because a quad with two sides on a round rim needs them. Plans with wedges, if the fallback
/// allows them, are last.
/// @param options  checked; `curvature` as planned for the volume.
/// @throw Cancelled
std::vector<Plan> plans(const topology::OpenVolume& volume, const SweepOptions& options, KnownLinks& links,
                        const RunContext& context);

/// The plan in words for reports and errors: "swept from the target, its loops turned as one body, 12 sides
/// for a full turn".
std::string in_words(const Plan& plan, const topology::OpenVolume& volume);

} // namespace lacuna::sweep
