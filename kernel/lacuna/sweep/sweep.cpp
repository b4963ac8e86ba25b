// SPDX-License-Identifier: MIT
#include <lacuna/sweep/sweep.h>

#include <lacuna/closure/close.h>
#include <lacuna/core/error.h>
#include <lacuna/core/shared/progress.h>
#include <lacuna/quality/quality.h>
#include <lacuna/surface/shared/default_size.h>
#include <lacuna/surface/shared/intervals.h>
#include <lacuna/sweep/detail/both_ways.h>
#include <lacuna/sweep/detail/drawn_layers.h>
#include <lacuna/sweep/detail/known_links.h>
#include <lacuna/sweep/detail/mean_outline.h>
#include <lacuna/sweep/detail/plan_heights.h>
#include <lacuna/sweep/detail/second_order.h>
#include <lacuna/sweep/detail/source_quads.h>
#include <lacuna/sweep/detail/sweep_between.h>
#include <lacuna/sweep/detail/volume_share.h>
#include <lacuna/sweep/shared/layer_plan.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace lacuna::sweep {

using namespace topology;

namespace {

/// The rotation between the ends of round walls is undetermined; several loops together may determine it.
bool can_turn_together(const std::vector<surface::LinkingSurface>& links)
{
    return links.size() > 1 &&
           std::ranges::any_of(links, [](const surface::LinkingSurface& link) { return link.lines.empty(); });
}

/// Align each loop by its own walls. If that makes poor cells, rotate all loops together as a rigid body and
/// keep the better result.
ProvedSweep better_turning(const OpenVolume& volume, const std::vector<surface::LinkingSurface>& links,
                           const std::vector<double>& heights, const SourceSize& size,
                           const SweepOptions& options, Outline outline, const RunContext& context)
{
    ProvedSweep alone = sweep_between(volume, links, heights, size, options, outline, context);
    const bool poor = alone.proof.finding ? quality::can_be_improved(alone.proof.finding->fault)
                                          : alone.swept.min_scaled_jacobian < options.improving.good_enough;
    if (!poor) return alone;
    const std::vector<surface::LinkingSurface> as_one = surface::linking_surfaces(
        volume, surface::Turning::together, {}, context);
    if (std::ranges::equal(as_one, links, {}, &surface::LinkingSurface::branch,
                           &surface::LinkingSurface::branch))
        return alone;
    try { // The first error is more informative than the second.
        ProvedSweep together = sweep_between(volume, as_one, heights, size, options, outline, context);
        if (together.proof.finding) {
            log_line(context, together.proof.finding->message.about("loops turned as one body").text());
        } else if (alone.proof.finding ||
                   together.swept.min_scaled_jacobian > alone.swept.min_scaled_jacobian) {
            together.swept.report.insert(
                together.swept.report.begin(),
                "loops: turned as one body; each by its own walls the cells are worse");
            return together;
        }
    } catch (const Cancelled&) {
        throw;
    } catch (const Error& error) {
        log_line(context, error.message().about("loops turned as one body").text());
    }
    return alone;
}

/// Sweep from source to target with the linking surfaces of the walls.
ProvedSweep sweep_one_way(const OpenVolume& volume, const SourceSize& size, const SweepOptions& options,
                          Outline outline, KnownLinks& known, const RunContext& context)
{
    const bool counted = options.layers.count > 0 || !options.layers.heights.empty();
    std::vector<double> heights = counted ? layer_heights(options.layers) : std::vector<double>{};
    if (volume.turned_round) reverse_heights(heights);
    report_progress(context, "linking surfaces");
    const std::vector<surface::LinkingSurface> links = known.of(volume, context);
    return can_turn_together(links) ? better_turning(volume, links, heights, size, options, outline, context)
                                    : sweep_between(volume, links, heights, size, options, outline, context);
}

/// Add middle nodes, prove the mesh, and compare the curved skin with the sealed one. Each curved quad is
/// compared as four straight quads, whose error is at most a quarter of the quad's own straight sides'.
void elevate_and_compare(const OpenVolume& shape, const std::set<FaceId>& kept, ProvedSweep& result,
                         const SweepOptions& options, const RunContext& context)
{
    Swept& swept = result.swept;
    PlacedLayers layers;
    layers.plan = swept.plan;
    if (swept.layers) layers.nodes = std::move(*swept.layers);
    Elevated elevated = elevate(shape, swept.mesh, result.faces, options.second_order, context,
                                swept.layers ? &layers : nullptr, options.crew);
    swept.layers.reset();
    swept.plan.reset();
    if (elevated.layers) {
        swept.layers = std::move(elevated.layers->nodes);
        swept.plan = std::move(elevated.layers->plan);
    }
    swept.report.push_back(std::move(elevated.report));
    const quality::Quality& quality = elevated.quality;
    swept.min_scaled_jacobian = quality.min_scaled_jacobian;
    swept.report.push_back(
        formatted("cells of order 2: all certified, scaled Jacobian {:.6f} at least, {:.6f} on average",
                  quality.min_scaled_jacobian, quality.mean_scaled_jacobian));
    swept.quality = quality;
    if (quality.min_scaled_jacobian < options.min_scaled_jacobian) {
        throw NotSweepable("quality.below_limit",
                           "at order 2 the smallest scaled Jacobian is {}, below the limit of {}",
                           found(quality.min_scaled_jacobian), needed(options.min_scaled_jacobian));
    }
    const FinerSkin fine = finer_skin(swept.skin());
    swept.fidelity = compare(shape, fine.mesh, result.faces, kept, quality.volume,
                             {options.max_deviation, options.beside.between}, context, &fine.nodes);
    for (FaceFidelity& face : swept.fidelity.faces) {
        face.quads /= 4;
        face.side *= 2;
        face.source_side *= 2;
    }
}

/// A proved mesh that was compared with the sealed skin.
Swept sweep_compared(const OpenVolume& volume, const SweepOptions& options, KnownLinks& links,
                     const RunContext& context)
{
    const OneWay one_way = [&](const OpenVolume& way, const SweepOptions& rest, Outline outline) {
        return sweep_one_way(way, source_size(way, rest, links, context), rest, outline, links, context);
    };
    ProvedSweep result = sweep_both_ways(volume, options, one_way, context);
    quality::require(result.proof);
    report_progress(context, "shape of the skin");
    Swept& swept = result.swept;
    // Quads copied from a neighbour are compared too: they are not part of the sealed shape.
    const OpenVolume& shape = shape_of(volume, options);
    const std::set<FaceId> kept = options.beside.shape != nullptr ? std::set<FaceId>{} : result.kept;
    if (options.order == 2) {
        elevate_and_compare(shape, kept, result, options, context);
    } else {
        swept.fidelity = compare(shape, swept.mesh, result.faces, kept, result.proof.quality.volume,
                                 {options.max_deviation, options.beside.between}, context,
                                 swept.layers ? &*swept.layers : nullptr);
    }
    swept.report.push_back(in_words(swept.fidelity));
    swept.faces = std::move(result.faces);
    return std::move(swept);
}

/// Cells with a lower minimum scaled Jacobian are poor. At order 2 they justify another sweep with more sides
/// per turn: a quad with two sides on a round rim opens by nearly 180° between them. Such a quad had 0.002;
/// with a few more sides the rim had none. All other cells tried were above 0.5. A higher value repeats more
/// sweeps. Not measured.
constexpr double kPoor = 0.1;
/// Maximum number of sides per turn in these repeated sweeps: a higher value costs time and cells. Not
/// measured.
constexpr int kMostForCurved = 32;

/// Sweep with the given options. At order 2, use more sides per turn while cells are poor or invalid.
Swept sweep_as_asked(const OpenVolume& volume, const SweepOptions& options, KnownLinks& links,
                     const RunContext& context)
{
    if (options.order == 1 || options.volume_share == 0 || options.curvature == 0)
        return sweep_compared(volume, options, links, context);
    std::optional<Swept> best;
    std::optional<NotSweepable> refused;
    for (SweepOptions rest = options; rest.curvature <= kMostForCurved;
         rest.curvature += rest.curvature / 4 + 1) {
        try {
            Swept next = sweep_compared(volume, rest, links, context);
            if (rest.curvature != options.curvature)
                next.report.push_back(formatted(
                    "order 2: {} sides for a full turn instead of {}, by which cells were poor or not valid",
                    rest.curvature, options.curvature));
            if (!best || next.min_scaled_jacobian > best->min_scaled_jacobian) best = std::move(next);
            if (best->min_scaled_jacobian >= kPoor) break;
        } catch (const NotSweepable& error) {
            if (!refused) refused = error;
            if (!best && refused->code() != "sweep.second_order") throw;
        }
    }
    if (!best) throw NotSweepable(*refused);
    return std::move(*best);
}

/// The options, including requested intervals on layers.
SweepOptions with_layer_intervals(const OpenVolume& volume, SweepOptions options, KnownLinks& known,
                                  const RunContext& context)
{
    if (options.intervals.empty()) return options;
    const auto layers = surface::find_intervals(volume, known.of(volume, context), options.intervals).layers;
    if (!layers) return options;
    LayerSpec& spec = options.layers;
    if (spec.count > 0 || !spec.heights.empty()) {
        const auto count = std::max(spec.heights.size(), static_cast<std::size_t>(spec.count));
        throw NotSweepable(Message("surface.sides_asked",
                                   "intervals: {} asks for {} layers, and option 'layers' for {}",
                                   layers->name, found(layers->count), found(count))
                               .remedy("leave out one of them"));
    }
    spec.count = layers->count;
    // Edges run from the end at which the sweep starts; layers run from the source named by the user.
    const bool turn = volume.turned_round && !layers->from_named_source;
    spec.bias = turn ? 1 / layers->bias : layers->bias;
    return options;
}

/// A mesh that follows the shape.
/// @throw NotSweepable "sweep.deviation"
Swept sweep_true(const OpenVolume& volume, const SweepOptions& options, KnownLinks& links,
                 const RunContext& context)
{
    Swept swept = sweep_as_asked(volume, options, links, context);
    const std::optional<Message> misfit = sweep::misfit(
        swept.fidelity, swept.mesh.layers, {options.max_deviation, options.beside.between, options.size});
    if (misfit) throw NotSweepable(*misfit);
    // At order 2, given middle nodes may bulge from straight facets.
    if (options.max_deviation <= 0 && options.order == 1) require_volume(swept.fidelity, swept.mesh.layers);
    return swept;
}

Swept sweep_once(const OpenVolume& volume, const SweepOptions& asked, KnownLinks& links,
                 const RunContext& context)
{
    check_cancelled(context);
    report_progress(context, "size");
    check(asked, context);
    if (!closure::is_watertight(volume)) {
        throw NotSweepable(Message("sweep.not_closed", "the volume is not sealed")
                               .remedy("close it first with volume:close()"));
    }
    SweepOptions options = with_layer_intervals(volume, asked, links, context);
    const surface::SizeField size = options.size ? checked_size(options.size, "size")
                                                 : even_size(surface::default_size(volume).length);
    links.plan = plan_volume(volume, links.of(volume, context), options, size, context);
    options.curvature = links.plan.per_turn;
    // The volumes of an assembly are counted together.
    if (!asked.beside.settle) check_cells(source_size(volume, options, links, context).expected, context);
    const std::optional<DrawnLayers> drawn = drawn_layers(volume, options, links, context);
    if (!drawn) return sweep_true(volume, options, links, context);
    std::optional<Message> why;
    try {
        SweepOptions moved = options;
        moved.layers = {};
        moved.layers.heights = drawn->heights;
        Swept swept = sweep_true(volume, moved, links, context);
        swept.report.push_back(drawn->report);
        return swept;
    } catch (const NotSweepable& error) {
        why = error.message();
    }
    log_line(context, why->about("layers nearer to each other in the bends").text());
    Swept swept = sweep_true(volume, options, links, context);
    swept.report.push_back(
        why->about("layers: even ones; nearer to each other in the bends they fail").text());
    return swept;
}

Swept sweep_or_with_wedges(const OpenVolume& volume, const SweepOptions& asked, const RunContext& context)
{
    KnownLinks links(volume);
    if (asked.fallback != Fallback::wedges || asked.wedges) return sweep_once(volume, asked, links, context);
    std::optional<NotSweepable> why;
    try {
        return sweep_once(volume, asked, links, context);
    } catch (const NotSweepable& error) {
        why = error;
    }
    try {
        SweepOptions with_wedges = asked;
        with_wedges.wedges = true;
        Swept swept = sweep_once(volume, with_wedges, links, context);
        swept.report.push_back(formatted("fallback: meshed with wedges, because {}", why->message().text()));
        return swept;
    } catch (const Cancelled&) {
        throw;
    } catch (const Error& error) { // the error without wedges is more informative
        log_line(context, error.message().about("with wedges").text());
    }
    throw NotSweepable(*why);
}

/// Relative volume difference above which a note is added.
constexpr double kNoted = 0.02;
/// Target for the sizes in that note, to reach 1 %: bends and barrels lost up to 1.6 times the estimate.
constexpr double kWanted = 0.006;

/// The volume difference, and numbers that would avoid it: the error of straight sides grows with the square
/// of their length.
std::string volume_in_words(const Swept& swept)
{
    const double lost = volume_lost(swept.fidelity), part = std::sqrt(kWanted / std::abs(lost));
    double length = 0;
    for (const Segment& side : swept.mesh.rim)
        length += (swept.mesh.nodes[index(side[1])] - swept.mesh.nodes[index(side[0])]).norm();
    return formatted(
        "the mesh has {:.2g} % {} volume than what was sealed; by the sag of straight sides size = "
        "{:.2g} and layers = {} keep it within 1 %",
        100 * std::abs(lost), lost > 0 ? "less" : "more",
        part * length / static_cast<double>(swept.mesh.rim.size()),
        static_cast<int>(std::ceil(swept.mesh.layers / part)));
}

/// A warning about the effect of a default size.
std::string poor_in_words(double least)
{
    return formatted(
        "quality: the least scaled Jacobian is {:.2g} with the size by default; look whether the "
        "shape has corners as sharp as that there, ask for another 'size', or have such meshes refused "
        "by 'min_scaled_jacobian'",
        least);
}

} // namespace

Swept sweep(const OpenVolume& volume, const SweepOptions& asked, const RunContext& context)
{
    SweepOptions options = asked;
    options.improving = with_deadline(options.improving);
    Swept swept = sweep_or_with_wedges(volume, options, context);
    if (!asked.size && swept.min_scaled_jacobian < kPoor) {
        swept.defaults.push_back(poor_in_words(swept.min_scaled_jacobian));
        swept.report.push_back(swept.defaults.back());
    }
    if (std::abs(volume_lost(swept.fidelity)) > kNoted) {
        swept.notes.push_back(volume_in_words(swept));
        swept.report.push_back("note: " + swept.notes.back());
    }
    if (asked.beside.settle) return swept;
    for (const std::string& line : swept.defaults) log_line(context, line);
    for (const std::string& note : swept.notes) log_line(context, "note: " + note);
    return swept;
}

} // namespace lacuna::sweep
