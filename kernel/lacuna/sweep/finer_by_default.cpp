// SPDX-License-Identifier: MIT
#include <lacuna/sweep/detail/finer_by_default.h>

#include <lacuna/core/error.h>
#include <lacuna/core/number_text.h>
#include <lacuna/sweep/detail/finer_sides.h>
#include <lacuna/sweep/detail/words.h>

#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace lacuna::sweep {

namespace {

FidelityOptions fidelity_options(const SweepOptions& options)
{
    return {options.max_deviation, options.beside.between, options.size};
}

/// How often numbers that nobody asked for are made finer, at most, and the cells that this may lead to: what
/// is asked for by nobody must not take minutes. Choices, not measurements.
constexpr int kMostFiner = 4;
constexpr double kMostFinerCells = 300000;

/// The options with a size or a number of layers, where nobody asked for one and the mesh is too coarse for a
/// face that bends.
std::optional<SweepOptions> finer_than_default(const Swept& swept, const SweepOptions& asked,
                                               const SweepOptions& taken)
{
    const FaceFidelity* worst = worst_misfit(swept.fidelity);
    if (worst == nullptr || worst->misfit != Misfit::straight) return std::nullopt;
    const int layers = swept.mesh.layers;
    const FinerSides finer = finer_sides(*worst, layers, fidelity_options(taken));
    const bool no_layers = asked.layers.count == 0 && asked.layers.heights.empty();
    SweepOptions rest = taken;
    double times = 1;
    if (finer.layers > 0 && no_layers) {
        rest.layers.count = finer.layers;
        times = static_cast<double>(finer.layers) / layers;
    } else if (finer.layers == 0 && !asked.size) {
        rest.size = [size = finer.size](const Vec3&) { return size; };
        times = std::pow(worst->source_side / finer.size, 2);
        // Without a size some layers were taken at least; they stay.
        if (no_layers) rest.layers.count = layers;
    } else {
        return std::nullopt;
    }
    if (times * static_cast<double>(swept.mesh.cell_count()) > kMostFinerCells) return std::nullopt;
    return rest;
}

/// What became finer, and why.
std::string finer_in_words(const Swept& coarse, const SweepOptions& before, const SweepOptions& after)
{
    const FaceFidelity& worst = *worst_misfit(coarse.fidelity);
    const std::string what =
        after.layers.count > coarse.mesh.layers
            ? "layer count: " + std::to_string(after.layers.count) + " instead of " +
                  std::to_string(coarse.mesh.layers)
            : "size: " + in_short(after.size(worst.found_at)) + " [model length] instead of " +
                  in_short(before.size ? before.size(worst.found_at) : worst.source_side);
    return what + " by default, with which the skin of the mesh was " + in_short(worst.found) + " off " +
           worst.name;
}

/// Finer sizes and more layers where nobody asked for any, as long as a face bends away between nodes.
/// @return  nothing where there is nothing to make finer.
std::optional<Swept> finer_where_not_asked(const SweepOptions& asked, SweepOptions taken, const Swept& coarse,
                                           const SweepBy& again, const RunContext& context)
{
    std::vector<std::string> why;
    std::optional<Swept> swept;
    for (int k = 0; k < kMostFiner; ++k) {
        const Swept& now = swept ? *swept : coarse;
        const std::optional<SweepOptions> finer = finer_than_default(now, asked, taken);
        if (!finer) break;
        why.push_back(finer_in_words(now, taken, *finer));
        try {
            Swept next = again(*finer);
            // Given nodes leave no more. Fewer may come of it too, where another layout is the better one.
            if (next.mesh.cell_count() == now.mesh.cell_count()) break;
            swept = std::move(next);
        } catch (const NotSweepable& error) {
            log_line(context, why.back() + ": " + error.what());
            break;
        }
        taken = *finer;
        swept->report.insert(swept->report.end(), why.begin(), why.end());
        swept->defaults = why;
    }
    return swept;
}

} // namespace

Swept require_or_refine(const SweepOptions& asked, const SweepOptions& taken, Swept swept,
                        const SweepBy& again, const RunContext& context)
{
    const std::string found = misfit_in_words(swept.fidelity, swept.mesh.layers, fidelity_options(asked));
    if (found.empty()) return swept;
    std::optional<Swept> finer = finer_where_not_asked(asked, taken, swept, again, context);
    if (!finer) throw NotSweepable("sweep.deviation", found);
    const std::string left = misfit_in_words(finer->fidelity, finer->mesh.layers, fidelity_options(asked));
    if (left.empty()) return std::move(*finer);
    throw NotSweepable("sweep.deviation",
                       found + ". Tried in vain: " + finer->defaults.back() + "; then " + left);
}

} // namespace lacuna::sweep
