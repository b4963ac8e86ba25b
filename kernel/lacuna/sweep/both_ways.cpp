// SPDX-License-Identifier: MIT
#include <lacuna/sweep/detail/both_ways.h>

#include <lacuna/core/error.h>
#include <lacuna/core/shared/criteria.h>
#include <lacuna/surface/shared/imprint.h>

#include <algorithm>
#include <optional>
#include <string>
#include <utility>

namespace lacuna::sweep {

using namespace topology;

namespace {

/// Whether the source keeps its given quads.
bool keeps_quads(const OpenVolume& volume, const SweepOptions& options)
{
    if (options.quads == Quads::keep) return true;
    const std::vector<FaceId> source = volume.faces(Role::source);
    const bool any = options.quads == Quads::automatic && options.rows == 0;
    return std::ranges::any_of(source, [&](FaceId face) {
        const Face& f = volume.model[face];
        return (any || options.beside.handed.contains(face)) &&
               (!f.given_quads.empty() || has_cells_to_keep(f, options.wedges));
    });
}

/// The result of one direction: a mesh, or an error.
struct Outcome {
    std::optional<ProvedSweep> result;
    std::optional<Message> refusal;

    [[nodiscard]] bool usable() const { return result && !result->proof.finding; }
    [[nodiscard]] bool good() const { return usable() && result->swept.min_scaled_jacobian >= kPoorCell; }
    [[nodiscard]] Message why() const { return refusal ? *refusal : result->proof.finding->message; }
};

Outcome outcome_of(const OpenVolume& volume, const SweepOptions& options, const OneWay& sweep_one_way,
                   Outline outline = Outline::source)
{
    Outcome outcome;
    try {
        outcome.result = sweep_one_way(volume, options, outline);
    } catch (const NotSweepable& error) {
        outcome.refusal = error.message();
    }
    return outcome;
}

/// Take the mesh, and put the direction at the start of its report.
ProvedSweep taken(Outcome& outcome, const std::string& way)
{
    std::vector<std::string>& report = outcome.result->swept.report;
    report.insert(report.begin(), way);
    return std::move(*outcome.result);
}

std::string how_it_was(const Outcome& outcome)
{
    return outcome.usable()
               ? formatted("the least scaled Jacobian is {:.2g}", outcome.result->swept.min_scaled_jacobian)
               : outcome.why().about("it is refused").text();
}

/// Whether the quads can be generated in the mean outline of both ends, each a single face.
bool can_lie_between(const OpenVolume& volume, const SweepOptions& options)
{
    return (options.quads == Quads::automatic || options.quads == Quads::paved) && options.rows == 0 &&
           options.boundary_layers.empty() && volume.faces(Role::source).size() == 1 &&
           volume.faces(Role::target).size() == 1;
}

/// The end that the volume is swept from, as the user named it.
std::string end_of(const OpenVolume& volume) { return volume.turned_round ? "target" : "source"; }

} // namespace

OpenVolume turned_round(OpenVolume volume)
{
    for (Role& role : volume.role) {
        if (role != Role::wall) role = role == Role::source ? Role::target : Role::source;
    }
    volume.turned_round = !volume.turned_round;
    return volume;
}

ProvedSweep sweep_both_ways(const OpenVolume& volume, const SweepOptions& options,
                            const OneWay& sweep_one_way, const RunContext& context)
{
    if (keeps_quads(volume, options)) return sweep_one_way(volume, options, Outline::source);
    // If only the target has given quads, the sweep starts there.
    const OpenVolume turned = turned_round(volume);
    if (keeps_quads(turned, options)) {
        Outcome kept = outcome_of(turned, options, sweep_one_way);
        if (kept.usable())
            return taken(kept, formatted("swept from the {}, which came with quads; the {} did not",
                                         end_of(turned), end_of(volume)));
        if (kept.refusal && kept.refusal->code() == "surface.given_triangles")
            throw NotSweepable(*kept.refusal);
        log_line(context,
                 formatted("swept from the {}, to keep its quads: {}", end_of(turned), kept.why().text()));
    }
    const bool turned_first = options.rows == 0 && !surface::inner_edges(volume, Role::target).empty() &&
                              surface::inner_edges(volume, Role::source).empty();
    const OpenVolume &first = turned_first ? turned : volume, &second = turned_first ? volume : turned;
    Outcome one = outcome_of(first, options, sweep_one_way);
    if (one.good() && turned_first)
        return taken(one, formatted("swept from the {}, whose faces meet in edges; the {} is one face",
                                    end_of(first), end_of(volume)));
    if (one.good()) return std::move(*one.result);
    log_line(context, formatted("swept from the {}: {}; the other way is tried", end_of(first),
                                one.usable() ? formatted("least scaled Jacobian {:.2g}",
                                                         one.result->swept.min_scaled_jacobian)
                                             : one.why().text()));
    Outcome other = outcome_of(second, options, sweep_one_way);
    const bool swap = other.usable() && (!one.usable() || other.result->swept.min_scaled_jacobian >
                                                              one.result->swept.min_scaled_jacobian);
    const Outcome* better = swap ? &other : &one;
    Outcome mean;
    std::string mean_from;
    // If poor cells were the problem, try the mean outline, from either end.
    const bool poor_cells = one.result || other.result;
    for (const OpenVolume* way : {&first, &second}) {
        if (better->good() || !poor_cells || !can_lie_between(*way, options)) break;
        Outcome between = outcome_of(*way, options, sweep_one_way, Outline::mean);
        if (!between.usable())
            log_line(context, between.why().about("laid out between the outlines of both ends").text());
        if (!between.usable() || (better->usable() && between.result->swept.min_scaled_jacobian <=
                                                          better->result->swept.min_scaled_jacobian))
            continue;
        mean = std::move(between);
        better = &mean;
        mean_from = end_of(*way);
    }
    if (better == &mean)
        return taken(mean,
                     formatted("laid out between the outlines of both ends and swept from the {}; from one "
                               "outline alone {}",
                               mean_from, how_it_was(swap ? other : one)));
    if (swap)
        return taken(other, formatted("swept from the {}; from the {} {}", end_of(second), end_of(first),
                                      how_it_was(one)));
    if (one.usable()) return std::move(*one.result);
    // The first error is more informative than the second.
    throw NotSweepable(one.why().attempt(other.why().about("from the " + end_of(second))));
}

} // namespace lacuna::sweep
