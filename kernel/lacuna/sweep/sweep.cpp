// SPDX-License-Identifier: MIT
#include <lacuna/sweep/sweep.h>

#include <lacuna/closure/close.h>
#include <lacuna/core/error.h>
#include <lacuna/core/shared/attempt.h>
#include <lacuna/core/shared/criteria.h>
#include <lacuna/core/shared/limits.h>
#include <lacuna/core/shared/progress.h>
#include <lacuna/matching/side_lines.h>
#include <lacuna/quality/quality.h>
#include <lacuna/surface/shared/default_size.h>
#include <lacuna/surface/shared/intervals.h>
#include <lacuna/sweep/detail/known_links.h>
#include <lacuna/sweep/detail/plan_heights.h>
#include <lacuna/sweep/detail/plans.h>
#include <lacuna/sweep/detail/second_order.h>
#include <lacuna/sweep/detail/shares.h>
#include <lacuna/sweep/detail/source_quads.h>
#include <lacuna/sweep/detail/sweep_between.h>
#include <lacuna/sweep/detail/volume_share.h>
#include <lacuna/sweep/detail/words.h>
#include <lacuna/sweep/shared/layer_plan.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace lacuna::sweep {

using namespace topology;

namespace {

/// Add middle nodes and prove the mesh.
void raise_order(const OpenVolume& shape, ProvedSweep& result, const SweepOptions& options,
                 const RunContext& context)
{
    report_progress(context, "order 2", share::order_2);
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
        throw NotSweepable(Message("quality.below_limit",
                                   "at order 2 the smallest scaled Jacobian is {}, below the limit of {}",
                                   found(quality.min_scaled_jacobian), needed(options.min_scaled_jacobian))
                               .remedy("use a smaller 'size', or order = 1"));
    }
}

/// Mesh a volume by a plan, prove the mesh, and compare it with the sealed shape. Every hexahedral mesh of a
/// sweep is made here.
/// @throw NotSweepable  the volume cannot be meshed by the plan, the proof fails, or the shape differs.
Swept mesh_candidate(const OpenVolume& volume, const Plan& plan, const SweepOptions& asked, KnownLinks& links,
                     const RunContext& context)
{
    const OpenVolume& way = plan.turned ? links.turned() : volume;
    SweepOptions options = asked;
    options.curvature = plan.per_turn;
    options.wedges = plan.wedges;
    const bool counted = options.layers.count > 0 || !options.layers.heights.empty();
    std::vector<double> heights = counted ? layer_heights(options.layers) : std::vector<double>{};
    if (way.turned_round) reverse_heights(heights);
    report_progress(context, "linking surfaces", share::links);
    ProvedSweep result = sweep_between(way, links.of(way, context, plan.turning), heights,
                                       source_size(way, options, links, context), options, plan.outline,
                                       context);
    quality::require(result.proof);
    Swept& swept = result.swept;
    // Quads copied from a neighbour are compared too, because the sealed shape does not have them.
    const OpenVolume& shape = shape_of(volume, options);
    const std::set<FaceId> kept = options.beside.shape != nullptr ? std::set<FaceId>{} : result.kept;
    if (options.order == 2) raise_order(shape, result, options, context);
    report_progress(context, "shape of the skin", share::skin);
    // A quad of order 2 is compared as four straight quads. Their error is at most a quarter of the error of
    // one straight quad.
    swept.fidelity = compare(shape, swept.mesh, result.faces, kept, swept.quality.volume,
                             {options.max_deviation, options.beside.between}, context, swept.skin().layers);
    swept.report.push_back(in_words(swept.fidelity));
    swept.faces = std::move(result.faces);
    const std::optional<Message> misfit = sweep::misfit(
        swept.fidelity, swept.mesh.layers, {options.max_deviation, options.beside.between, options.size});
    if (misfit) throw NotSweepable(*misfit);
    // At order 2, given middle nodes may bulge from straight facets.
    if (options.max_deviation <= 0 && options.order == 1) require_volume(swept.fidelity, swept.mesh.layers);
    return std::move(swept);
}

/// Error code for given triangles on an end. No plan may remesh them unless the user requests it.
constexpr std::string_view kOwnTriangles = "surface.given_triangles";

/// Meshes the plans in order until a mesh is good enough, and returns the best mesh that is valid and has the
/// right shape.
class Search {
public:
    Search(const OpenVolume& volume, const SweepOptions& options, KnownLinks& links,
           const RunContext& context)
        : volume_(volume), options_(options), links_(links), context_(context)
    {
    }

    /// The mesh of the best plan. Its report names the plan and the results of the plans before it.
    /// @throw NotSweepable  no plan works. This is the error of the first plan, with the errors of the others
    ///         attached.
    Swept run(const std::vector<Plan>& plans)
    {
        for (const Plan& plan : plans) {
            if (left_[plan.wedges] == 0) continue;
            if (best_ && (plan_->keeps_end || plan_->wedges != plan.wedges ||
                          best_->min_scaled_jacobian >= plan.below))
                continue;
            if (!is_like_each(plan)) mesh(plan);
        }
        if (!best_) throw NotSweepable(std::move(*refusal_));
        if (plan_->wedges && !options_.wedges)
            best_->report.push_back(formatted("fallback: meshed with wedges, because {}", refusal_->text()));
        if (tried_.size() > 1)
            tried_.insert(tried_.begin(), formatted("taken: {}", in_words(*plan_, volume_)));
        if (tried_.size() == 1) tried_ = {plan_->why};
        std::erase(tried_, "");
        best_->report.insert(best_->report.begin(), tried_.begin(), tried_.end());
        return std::move(*best_);
    }

private:
    /// Whether a common rotation of all loops is the same as the rotation that each loop gets from its own
    /// walls.
    [[nodiscard]] bool is_like_each(const Plan& plan)
    {
        if (plan.turning == surface::Turning::each) return false;
        const OpenVolume& way = plan.turned ? links_.turned() : volume_;
        return std::ranges::equal(links_.of(way, context_), links_.of(way, context_, plan.turning), {},
                                  &surface::LinkingSurface::branch, &surface::LinkingSurface::branch);
    }

    void mesh(const Plan& plan)
    {
        const std::string words = in_words(plan, volume_);
        --left_[plan.wedges];
        auto swept = attempt<NotSweepable>(
            [&] { return mesh_candidate(volume_, plan, options_, links_, context_); });
        if (swept) {
            const double least = swept->min_scaled_jacobian;
            tried_.push_back(formatted("{}: least scaled Jacobian {:.2g}", words, least));
            if (best_ && best_->min_scaled_jacobian >= least) return;
            best_ = std::move(*swept);
            plan_ = &plan;
        } else {
            const Message why = swept.why->about(words);
            tried_.push_back(why.text());
            // No plan without wedges can keep the given triangles.
            const bool own = why.code() == kOwnTriangles;
            if (own) left_[plan.wedges] = 0;
            refusal_ = refusal_ && !own ? refusal_->attempt(why) : *swept.why;
        }
        log_line(context_, tried_.back());
    }

    const OpenVolume& volume_;
    const SweepOptions& options_;
    KnownLinks& links_;
    const RunContext& context_;
    std::optional<Swept> best_;
    const Plan* plan_ = nullptr; ///< the best plan so far
    std::optional<Message> refusal_;
    std::vector<std::string> tried_; ///< a line for each plan
    /// Number of plans that may still be tried, without wedges and with wedges.
    std::array<std::size_t, 2> left_{kMostTrials, kMostTrials}; ///< trials left, without and with wedges
};

/// The options, with intervals requested on side lines added as layers.
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
                               .remedy("leave one of them out"));
    }
    spec.count = layers->count;
    // The bias of an edge counts from the end where the sweep starts. The bias of layers counts from the
    // source that the user named.
    const bool turn = volume.turned_round && !layers->from_named_source;
    spec.bias = turn ? 1 / layers->bias : layers->bias;
    return options;
}

/// Plan the numbers of sides and layers, then search for the best plan.
Swept search(const OpenVolume& volume, const SweepOptions& asked, const RunContext& context)
{
    check_cancelled(context);
    report_progress(context, "size");
    check(asked, context);
    if (!closure::is_watertight(volume)) {
        throw NotSweepable(Message("sweep.not_closed", "the volume is not sealed")
                               .remedy("close it first with volume:close()"));
    }
    KnownLinks links(volume);
    SweepOptions options = with_layer_intervals(volume, asked, links, context);
    const surface::SizeField size = options.size ? surface::checked_size(options.size, "size")
                                                 : surface::even_size(surface::default_size(volume).length);
    links.plan = plan_volume(volume, links.of(volume, context), options, size, context);
    options.curvature = links.plan.per_turn;
    // For an assembly, the caller checks the number of cells of all volumes together.
    if (!asked.beside.settle) check_cells(source_size(volume, options, links, context).expected, context);
    return Search(volume, options, links, context).run(plans(volume, options, links, context));
}

} // namespace

Swept sweep(const OpenVolume& volume, const SweepOptions& asked, const RunContext& context)
{
    SweepOptions options = asked;
    options.improving = with_shared_limits(options.improving);
    Swept swept = search(volume, options, context);
    for (const FaceId face : volume.faces(Role::wall))
        if (const auto wall = matching::continued_wall(volume.model, face))
            swept.notes.push_back(
                formatted("{} continues over {}: the border of their groups follows the quads, not the rim",
                          entity_of(volume.model, *wall), entity_of(volume.model, face)));
    for (const std::string& note : swept.notes) swept.report.push_back("note: " + note);
    if (asked.beside.settle) return swept;
    note_poor_cells(swept);
    note_lost_volume(swept, volume, options);
    for (const std::string& line : swept.defaults) log_line(context, line);
    for (const std::string& note : swept.notes) log_line(context, "note: " + note);
    return swept;
}

} // namespace lacuna::sweep
