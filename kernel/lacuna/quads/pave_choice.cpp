// SPDX-License-Identifier: MIT
#include <lacuna/quads/detail/pave_choice.h>

#include <lacuna/core/message.h>
#include <lacuna/core/shared/criteria.h>
#include <lacuna/core/shared/limits.h>
#include <lacuna/quads/detail/face_pattern.h>
#include <lacuna/quads/detail/marks.h>
#include <lacuna/quads/detail/mirror_counts.h>
#include <lacuna/quads/detail/pave_coarse.h>
#include <lacuna/quads/detail/pave_size.h>
#include <lacuna/quads/detail/plane_stars.h>
#include <lacuna/quads/detail/row_heights.h>
#include <lacuna/quads/detail/smooth_plane.h>
#include <lacuna/quads/shared/measure_plane.h>
#include <lacuna/quads/shared/pattern_counts.h>
#include <lacuna/quads/shared/submap.h>
#include <lacuna/quads/shared/symmetry.h>

#include <algorithm>
#include <array>
#include <bit>

namespace lacuna::quads::paving {
namespace {

/// A region with at most this many quads is paved in several ways. This takes at most 0.5 s for 3000 quads,
/// measured on the named outlines.
constexpr std::size_t kSmall = 4000;

/// The first seven rows that `choose_weights choose 1 240` prints (`benchmarks/pave/`): chosen greedily from
/// 48 candidates to maximise the mean score of the best attempt over 220 generated outlines. Each further row
/// would gain less than 0.001.
constexpr std::array<CutWeights, 7> kCutWeights{{
    {.corners = 0.5, .added = 0.75, .bent = 0.375, .least_patch = 0.5},
    {.added = 0.5, .mismatch = 0.5, .bent = 0.375, .least_patch = 0.5},
    {.corners = 0.5, .added = 0.75, .mismatch = 2, .bent = 0.375},
    {.corners = 0.5, .length = 1.35, .mismatch = 0.75, .bent = 1},
    {.corners = 0.75, .length = 1.35, .mismatch = 0.5, .least_patch = 0.7},
    {.added = 0.5, .length = 0.75, .mismatch = 1.35, .bent = 0.25},
    {.corners = 0.75, .added = 0.75, .length = 0.5, .bent = 0.675},
}};

/// Weights for few quads without rows along the boundary: the first rows that `choose_weights few 101 120`
/// prints (`benchmarks/pave/`), chosen greedily from 64 candidates on 355 generated outlines of 60 to 400
/// quads. A fourth row would gain less than 0.01.
constexpr std::array<CutWeights, 3> kFewWeights{{
    {.corners = 0.5, .added = 0.5, .mismatch = 2, .least_patch = 0.5},
    {.added = 0.5, .length = 0.75, .mismatch = 1.35, .bent = 0.25},
    {.corners = 0.75, .added = 0.5, .length = 2, .mismatch = 2, .bent = 0.375, .least_patch = 0.7},
}};

/// A mesh is kept without further trials if it satisfies these bounds for the scaled Jacobian of its worst
/// quad, and for the share of rows with the requested height. Its number of irregular nodes must also be at
/// most kNearLeast times the topological minimum, plus kFewMore.
constexpr double kFineWorst = 0.82, kFineRows = 0.9, kNearLeast = 1.25, kFewMore = 2;

double irregular_in(const PlaneQuality& quality)
{
    return static_cast<double>(quality.irregular + quality.boundary_irregular);
}

bool is_near_least(const PlaneQuality& quality, int least)
{
    return irregular_in(quality) <= kNearLeast * least + kFewMore && quality.size_share() > kPromisedShare &&
           quality.row_share() > kFineRows;
}

/// A region with fewer than kFewWeighted quads is paved only with `kFewWeights` and once with rows along the
/// boundary, unless the result is poor. Only the kFinished attempts with the fewest initial irregular nodes
/// are finished. On the outlines used for choosing these weights, the score is 0.01 lower than with all other
/// rows of weights together, but there are a fifth fewer irregular nodes and it takes a quarter of the time.
/// With a third finished attempt, the score would be the same.
constexpr std::size_t kFewWeighted = 1500, kFinished = 2;
/// The other attempts are finished too if the worst quad is below kFair and also below kNearly times the best
/// value that the boundary's corners permit. With higher bounds, more time is spent for a better worst quad.
constexpr double kFair = 0.75, kNearly = 0.97;

/// The scaled Jacobian of the worst boundary corner, if each corner is divided equally into the number of
/// quads that suits its angle.
double best_at_corners(const PlanarRegion& region)
{
    double worst = 1;
    for (const double angle : boundary_angles(region))
        worst = std::min(worst, std::sin(angle / quads_in(angle)));
    return worst;
}

/// An identifier of a mesh: a hash of its points and quads in their order.
std::uint64_t name_of(const PlanarQuads& mesh)
{
    std::uint64_t name = mesh.points.size();
    const auto add = [&](std::uint64_t x) { name = mixed(name + mixed(x)); };
    for (const Vec2& p : mesh.points) {
        add(std::bit_cast<std::uint64_t>(p.x()));
        add(std::bit_cast<std::uint64_t>(p.y()));
    }
    for (const Quad& quad : mesh.quads) {
        for (const Index p : quad) add(static_cast<std::uint64_t>(p));
    }
    return name;
}

/// An attempt before it is finished.
struct Begun {
    std::size_t irregular; ///< number of irregular nodes
    Attempt attempt;
};

/// A grid over the whole region, as an attempt.
Attempt grid_attempt(std::optional<PlanarQuads> mesh, const AttemptSetting& setting)
{
    Attempt attempt;
    if (!mesh) return attempt;
    attempt.mesh = std::move(*mesh);
    attempt.report.used = attempt.mesh.how;
    correct_row_heights(attempt.mesh, setting.region, setting.size);
    judge(attempt);
    return attempt;
}

/// Lower bounds that a mesh must reach to be accepted.
struct Limits {
    double least, mean; ///< least and mean scaled Jacobian
    double of_size;     ///< share of sides with the requested size
};

bool reaches(const Limits& limits, const Attempt& attempt, const PlanarRegion& region)
{
    if (attempt.worst < limits.least) return false;
    const PlaneQuality quality = measure_plane(attempt.mesh, region);
    return quality.min_scaled_jacobian > limits.least && quality.mean_scaled_jacobian > limits.mean &&
           quality.size_share() > limits.of_size;
}

/// Whether a grid is so good that no further attempt is needed. Meshes that are not a grid would have more
/// irregular nodes.
bool is_good_grid(const Attempt& attempt, const PlanarRegion& region, double of_size)
{
    // With these bounds, the worst quad may still get worse in a sweep without being folded, and nearly all
    // quads are square and have the requested size. Lower bounds would save time and accept worse grids.
    return reaches({0.72, 0.92, of_size}, attempt, region);
}

/// Whether the images of a part are so good that no further attempt is needed. Because it is symmetric, the
/// mesh may have a few more irregular nodes than others.
/// @param asked  the size from which the requested number of quads follows.
/// @param few    whether there are so few quads that the given sides determine their sizes.
bool is_good_part(const Attempt& attempt, const PlanarRegion& region, const SizeField& asked, bool few)
{
    // Lower bounds for the least and mean scaled Jacobian and the share of edges of the requested size; not
    // measured.
    constexpr Limits kGood{0.7, 0.9, 0.93}, kGoodFew{0.75, 0.87, 0};
    const Limits& limits = few ? kGoodFew : kGood;
    if (attempt.worst < limits.least || !find_fault(attempt.mesh, region).empty()) return false;
    // At nodes where images meet, on an axis or at the centre, each image may add one quad too many.
    constexpr Index kMostQuads = 6;
    if (std::ranges::max(valences(attempt.mesh.quads, attempt.mesh.points.size())) > kMostQuads) return false;
    return reaches(limits, attempt, region) && has_quads_asked(attempt.mesh, asked);
}

/// Whether a mesh of a coarse region, with its quads cut in four, is so good that no further attempt is
/// needed.
bool is_good_cut(const Attempt& attempt, const PlanarRegion& region)
{
    // With a stricter bound, the region would be paved again at full size more often.
    constexpr Limits kGood{0.65, 0.97, 0.95};
    return attempt.worst >= kGood.least && find_fault(attempt.mesh, region).empty() &&
           reaches(kGood, attempt, region) && has_quads_asked(attempt.mesh, region.size);
}

} // namespace

double score_of(const PlaneQuality& quality)
{
    constexpr double kGood = 0.6, kBest = 0.85, kFewNodes = 300;
    const double least = quality.min_scaled_jacobian;
    const double irregular = static_cast<double>(quality.irregular + quality.boundary_irregular) /
                             std::max(static_cast<double>(quality.interior), kFewNodes);
    return quality.mean_scaled_jacobian + 2 * std::min(least, kGood) +
           (std::clamp(least, kGood, kBest) - kGood) / 2 + quality.size_share() / 2 +
           quality.row_share() / 2 - 2 * irregular;
}

std::string position_text(const Vec2& p) { return formatted("({:.6g}, {:.6g})", p.x(), p.y()); }

std::span<const CutWeights> cut_weight_rows() { return kCutWeights; }

double flat_below(const PlanarRegion& region)
{
    // The quad in the outline's sharpest corner is not flat. With higher values, more flat quads are replaced
    // by cavities, which have more irregular nodes.
    double sharpest = 1;
    for (const double angle : boundary_angles(region))
        if (angle < kRightAngle) sharpest = std::min(sharpest, std::sin(angle));
    return std::min(kParallel, kPoorQuad * sharpest);
}

AttemptChooser::AttemptChooser(const PlanarRegion& region, const PaveOptions& options,
                               const RunContext& context, bool cut)
    : region_(region),
      judged_(region),
      grids_(options.grids),
      context_(context),
      cut_(cut),
      least_irregular_(least_irregular(region)),
      is_few_(quads_within(region) < kFewWeighted),
      few_graded_(quads_within(region) < kFewQuads && region.size),
      setting_{region_, {}, flat_below(region)}
{
    BoundarySizes sizes = sizes_with_boundary(region);
    setting_.size = std::move(sizes.usual);
    judged_.size = std::move(sizes.ring);
}

AttemptChooser::Judged AttemptChooser::judge_score(Attempt& made) const
{
    if (made.worst > 0 && !find_fault(made.mesh, region_).empty()) made.worst = -1;
    if (!(made.worst > setting_.flat)) return {made.worst, {}};
    const PlaneQuality quality = measure_plane(made.mesh, judged_);
    return {score_of(quality), quality};
}

void AttemptChooser::consider(Attempt made)
{
    const auto [score, quality] = judge_score(made);
    if (score <= best_score_) return;
    best_score_ = score;
    is_near_least_ = made.worst > kFineWorst && is_near_least(quality, least_irregular_);
    is_set_by_outline_ = irregular_in(quality) <= kNearLeast * least_irregular_;
    best_ = std::move(made);
}

Attempt AttemptChooser::begin(RowStyle style, const CutWeights& weights) const
{
    return begin_attempt(setting_, style, weights, context_);
}

void AttemptChooser::complete(Attempt& attempt) const
{
    finish_attempt(attempt, setting_, !is_few_, context_);
    if (attempt.worst > setting_.flat || attempt.mesh.quads.empty()) return;
    log_line(context_, "quads fold near " + position_text(attempt.where) + ": paving differently");
}

void AttemptChooser::finish(Attempt begun)
{
    const std::uint64_t name = name_of(begun.mesh);
    if (std::ranges::find(finished_, name) != finished_.end()) return;
    finished_.push_back(name);
    complete(begun);
    consider(std::move(begun));
}

void AttemptChooser::pave_in(RowStyle style) { finish(begin(style)); }

bool AttemptChooser::is_small() const { return best_.mesh.quads.size() <= kSmall; }

void AttemptChooser::try_grids()
{
    // Share of edges that must have the requested size: nearly all if some grid achieves this, otherwise
    // most. Rings whose loops differ strongly reach a lower share.
    constexpr double kNearlyAll = 0.93, kMost = 0.85;
    std::vector<Attempt> grids{grid_attempt(submap(region_, context_), setting_)};
    // A grid over a part of a symmetric region (`cut_` is false) is rejected if it has too many or too few
    // quads. The part is then filled in another way.
    const auto is_good = [&](const Attempt& grid, double of_size) {
        return is_good_grid(grid, judged_, of_size) && (cut_ || has_quads_asked(grid.mesh, judged_.size));
    };
    is_good_grid_ = is_good(grids[0], kNearlyAll);
    if (is_good_grid_) {
        consider(std::move(grids[0]));
        return;
    }
    const std::optional<MirrorPart> part = cut_ && quads_within(region_) < kManyQuads ? part_of_region()
                                                                                      : std::nullopt;
    // The grid of a disc, or around a single central hole, has more symmetries than the images of a part
    // have.
    const bool whole_first = part && (part->has_centre ? region_.loops.size() == 1 && part->is_some
                                                       : region_.loops.size() == 2);
    if (part && !whole_first) {
        // With fewer quads than this, one grid often fills a quarter of the region and gives the same
        // symmetry.
        constexpr double kFewForGrid = 600;
        const bool blocks = part->has_centre && part->is_some && quads_within(region_) < kSmall;
        const bool blocks_first = blocks && quads_within(region_) >= kFewForGrid;
        if (blocks_first && try_blocks()) return;
        if (try_part(*part, few_graded_, grids)) {
            if (blocks && !blocks_first) try_blocks();
            return;
        }
    }
    if (quads_within(region_) < kSmall) {
        for (PlanarQuads& mesh : fill_patterns(region_, context_))
            grids.push_back(grid_attempt(std::move(mesh), setting_));
    }
    for (const double of_size : {kNearlyAll, kMost}) {
        for (Attempt& grid : grids) {
            if (!is_good(grid, of_size)) continue;
            is_good_grid_ = true;
            consider(grid);
        }
        if (is_good_grid_) break;
    }
    if (whole_first) {
        if (is_good_grid_) {
            PlanarQuads made = best_.mesh;
            if (symmetrise(made, region_) >= part->images.size()) return;
        }
        if (try_part(*part, false, grids)) return;
    }
    if (is_good_grid_) return;
    for (Attempt& grid : grids) consider(std::move(grid));
}

bool AttemptChooser::try_coarse()
{
    if (!cut_ || quads_within(region_) < kManyQuads) return false;
    std::optional<Paved> paved = pave_in_four(region_, judged_.size, context_);
    if (!paved) return false;
    Attempt attempt{std::move(paved->mesh), std::move(paved->report)};
    judge(attempt);
    is_good_grid_ = is_good_cut(attempt, judged_);
    if (is_good_grid_)
        best_ = std::move(attempt);
    else
        consider(std::move(attempt));
    return is_good_grid_;
}

bool AttemptChooser::try_part(const MirrorPart& part, bool few, std::vector<Attempt>& grids)
{
    Attempt attempt = fill_part(part);
    const bool is_good = is_good_part(attempt, judged_, judged_.size, false) ||
                         (few && is_good_part(attempt, judged_, setting_.size, true));
    if (is_good) {
        is_good_grid_ = true;
        best_ = std::move(attempt);
    } else {
        grids.push_back(std::move(attempt));
    }
    return is_good;
}

bool AttemptChooser::try_blocks()
{
    // Number of quads along a side of the block, divided by the number that the size requires. If a side of
    // the block has as many quads as the boundary opposite to this side, rows run around the block. Of the
    // values from 0.7 to 1.5, this was the best on flanges of 1,000 and 3,000 quads.
    constexpr double kFiner = 1.5;
    const std::vector<Symmetry> symmetries = outline_symmetries(region_);
    double best = -2;
    if (is_good_grid_) {
        PlanarQuads made = best_.mesh;
        if (symmetrise(made, region_) > symmetries.size()) return true;
        best = score_of(measure_plane(best_.mesh, judged_));
    }
    const auto size = [&](const Vec2& p) { return setting_.size(p) / kFiner; };
    bool kept = false;
    for (const int choice : {0, 1}) {
        const auto block = central_block(region_, symmetries, size, choice);
        if (!block) return kept;
        Attempt attempt = fill_about(*block);
        if (!is_good_part(attempt, judged_, judged_.size, false)) continue;
        const double score = score_of(measure_plane(attempt.mesh, judged_));
        if (score < best) continue;
        best = score;
        best_ = std::move(attempt);
        is_good_grid_ = kept = true;
    }
    return kept;
}

Attempt AttemptChooser::fill_about(const CentralBlock& block) const
{
    const AttemptChooser chooser(block.around, {}, context_);
    const std::optional<MirrorPart> part = chooser.part_of_region();
    if (!part) return {};
    Attempt attempt = chooser.fill_part(*part);
    if (attempt.worst <= 0) return {};
    attempt.mesh = with_block(block, std::move(attempt.mesh));
    smooth_plane(attempt.mesh.points, attempt.mesh.quads, region_.points.size(), {.size = setting_.size},
                 context_);
    symmetrise(attempt.mesh, region_);
    attempt.report.used += " about a block";
    judge(attempt);
    return attempt;
}

std::optional<MirrorPart> AttemptChooser::part_of_region() const
{
    const std::vector<Symmetry> symmetries = outline_symmetries(region_);
    std::vector<SizeField> sizes{setting_.size};
    if (few_graded_) sizes.insert(sizes.begin(), region_.size);
    struct Priced {
        MirrorPart part;
        double cost;
    };
    auto best = cheapest_of_parts(region_, symmetries, sizes, [&](MirrorPart part) {
        const double cost = count_axes(part, setting_.size, few_graded_, context_);
        return Priced{std::move(part), cost};
    });
    return best ? std::optional(std::move(best->part)) : std::nullopt;
}

Attempt AttemptChooser::fill_part(const MirrorPart& part) const
{
    AttemptChooser chooser(part.region, {}, context_, false);
    chooser.run();
    Attempt attempt = chooser.take_best();
    if (attempt.worst <= 0) return {};
    attempt.mesh = unfold(part, attempt.mesh, region_);
    attempt.report.used += formatted(", {} alike", part.images.size());
    judge(attempt);
    return attempt;
}

void AttemptChooser::run()
{
    try_default_weights();
    if (is_good_grid_) return;
    try_all_weights();
    try_triangles();
}

void AttemptChooser::try_few_weights()
{
    const double fair = std::min(kFair, kNearly * best_at_corners(region_));
    std::vector<Begun> begun;
    const auto begin_one = [&](RowStyle style, const CutWeights& weights) {
        Attempt attempt = begin(style, weights);
        if (attempt.worst < -1) return;
        const PlaneQuality quality = measure_plane(attempt.mesh, region_);
        // Irregular boundary nodes count twice, because cleaning removes fewer of them.
        begun.push_back({quality.irregular + 2 * quality.boundary_irregular, std::move(attempt)});
    };
    for (const CutWeights& weights : kFewWeights) begin_one(RowStyle::no_rows, weights);
    begin_one(RowStyle::by_shape, cut_weight_rows().front());
    std::ranges::stable_sort(begun, [](const Begun& a, const Begun& b) { return a.irregular < b.irregular; });
    for (std::size_t i = 0; i < begun.size() && !is_near_least_; ++i) {
        if (i >= kFinished && best_.worst > fair) return;
        finish(std::move(begun[i].attempt));
    }
}

void AttemptChooser::try_default_weights()
{
    if (grids_) try_grids();
    if (is_good_grid_ || try_coarse()) return;
    if (is_few_) {
        try_few_weights();
        if (best_.worst > kPoorQuad) return;
    }
    pave_in(RowStyle::by_shape);
    if (best_.worst <= 0 || (is_small() && !is_near_least_)) pave_in(RowStyle::no_rows);
}

double AttemptChooser::score_with(RowStyle style, const CutWeights& weights) const
{
    Attempt made = begin(style, weights);
    complete(made);
    return judge_score(made).score;
}

void AttemptChooser::try_all_weights()
{
    if (best_.worst <= setting_.flat || !is_small() || is_near_least_) return;
    if ((is_few_ || is_set_by_outline_) && best_.worst > kPoorQuad) return;
    int idle = 0; // if other cuts do not help, the outline is the cause
    for (const CutWeights& weights : cut_weight_rows()) {
        if (idle == kIdleRounds || is_near_least_) return;
        const double before = best_score_;
        finish(begin(best_.style, weights));
        idle = best_score_ > before ? 0 : idle + 1;
    }
}

void AttemptChooser::try_triangles()
{
    // Triangles are the last resort. They are also tried if the worst quad is poor and the region is small,
    // where they take little time.
    if (best_.worst <= setting_.flat || (is_small() && best_.worst < kPoorQuad)) pave_in(RowStyle::triangles);
}

} // namespace lacuna::quads::paving
