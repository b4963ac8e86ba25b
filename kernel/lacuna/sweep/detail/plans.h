// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/shared/criteria.h>
#include <lacuna/sweep/detail/known_links.h>
#include <lacuna/sweep/detail/mean_outline.h>
#include <lacuna/sweep/sweep.h>

#include <string>
#include <vector>

namespace lacuna::sweep {

/// One way to mesh a sealed volume: the choices that a sweep leaves open.
struct Plan {
    bool turned = false;    ///< swept from the target to the source
    bool keeps_end = false; ///< the quads given on the end where the sweep starts are kept
    Outline outline = Outline::source;
    surface::Turning turning = surface::Turning::each;
    int per_turn = 12; ///< sides for a full turn
    /// See `SweepOptions::wedges`; as a fallback, tried only if no plan without wedges gave a mesh.
    bool wedges = false;
    double below = kPoorCell; ///< tried only if no mesh has reached this minimum scaled Jacobian yet
    std::string why{};        ///< for the report: why this plan is the first; may be empty
};

/// Whether quads are laid out on the target first, unless an end keeps quads: the target has several faces,
/// whose inner edges become mesh edges, the source has one, and the option `rows` is not used.
bool lies_on_target(const topology::OpenVolume& volume, const SweepOptions& options);

/// The ways to mesh a volume, best first.
///
/// If the source keeps given quads, the only plan sweeps from it. With boundary layers and quads from a
/// neighbour, a second plan sweeps from the target. If the source keeps no quads, the first plan sweeps from
/// the given source to the target. It sweeps from the target instead
/// - if only the target has given quads;
/// - if neither end has given quads, and `lies_on_target()`.
///
/// The next plans are a common rotation of all loops, if the walls of some loop do not determine its
/// rotation; the sweep from the other end; and quads laid out between the outlines of both ends. Plans with
/// wedges come last, if the fallback allows them.
/// @param options  checked options, with `curvature` as planned for the volume.
/// @throw Cancelled
std::vector<Plan> plans(const topology::OpenVolume& volume, const SweepOptions& options, KnownLinks& links,
                        const RunContext& context);

/// The plan in words for reports and errors: "swept from the target, its loops rotated together, 12 sides
/// for a full turn".
std::string in_words(const Plan& plan, const topology::OpenVolume& volume);

} // namespace lacuna::sweep
