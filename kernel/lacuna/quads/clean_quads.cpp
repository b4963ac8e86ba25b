// SPDX-License-Identifier: MIT
#include <lacuna/quads/detail/clean_quads.h>

#include <lacuna/quads/detail/clean_mesh.h>
#include <lacuna/quads/detail/clean_patch.h>
#include <lacuna/quads/detail/clean_trial.h>
#include <lacuna/quads/detail/marks.h>

#include <algorithm>
#include <array>
#include <span>
#include <unordered_set>

namespace lacuna::quads {

namespace cleaning {

namespace {

/// Limits of the search for a patch and its filling.
struct SearchLimits {
    std::size_t growths;  ///< maximum number of irregular points to which a patch is grown
    std::size_t largest;  ///< maximum number of quads in a patch
    std::size_t fillings; ///< maximum number of fillings that are tried for each patch
    int sweeps;           ///< smoothing sweeps over a filling before its second test (`Trial::run()`)
    double hopeless; ///< a filling is rejected early if its loss exceeds this multiple of the allowed loss
};
/// Stages of the search. Small patches come first, because they are cheap and remove most irregular points.
/// Larger patches follow as long as the budget lasts. With larger limits, slightly more irregular points are
/// removed, but in much more time.
constexpr std::array<SearchLimits, 3> kStages{
    {{3, 60, 2, 1, 1.8}, {12, 100'000, 2, 1, 1.8}, {12, 100'000, 4, 2, 3}}};
/// Base budget of quads in fillings, for a thorough and for a quick search. The budget of the quick search
/// was measured on the named outlines and 40 of the held family (`benchmarks/pave/`). On meshes below 1,000
/// quads, three times this budget removes no more irregular nodes. The thorough search needs more for larger
/// meshes.
constexpr long kLeastBudget = 50'000, kQuickBudget = 15'000;

class Cleaner {
public:
    Cleaner(CleanMesh& mesh, const CleanOptions& options, std::size_t quads)
        : mesh_(mesh), options_(options), grower_(mesh), trial_(mesh, options)
    {
        budget_ = (options.thorough ? kLeastBudget : kQuickBudget) +
                  static_cast<long>(options.effort * static_cast<double>(quads));
    }

    /// Prepare to visit all points again, within these limits.
    void begin(const SearchLimits& limits)
    {
        if (limits.hopeless > limits_.hopeless) tried_.clear();
        limits_ = limits;
        due_.assign(mesh_.points().size(), 1);
    }
    /// @return whether patches were refilled
    bool pass(const RunContext& context);

private:
    bool improve(Index seed);
    bool refill(const QuadPatch& patch);

    CleanMesh& mesh_;
    const CleanOptions& options_;
    PatchGrower grower_;
    Trial trial_;
    SearchLimits limits_ = kStages[0];
    long budget_ = 0;
    std::vector<char> due_;                   ///< for each point, whether to visit it if it is irregular
    std::unordered_set<std::uint64_t> tried_; ///< patches already tried with at least the same effort
    /// Fillings that were smoothed completely but were not good enough.
    std::unordered_set<std::uint64_t> poor_;
    std::vector<Vec2> loop_;
};

bool Cleaner::refill(const QuadPatch& patch)
{
    if (fewest_irregular(patch.loop.size(), patch.corners) >= patch.irregular) return false;
    std::uint64_t key = 0;
    for (const Index q : patch.quads) key += mixed(mesh_.name(q));
    if (!tried_.insert(key).second) return false;
    loop_.clear();
    for (const Index p : patch.loop) loop_.push_back(mesh_.at(p));
    const std::vector<TemplateCut> cuts = find_cuts(loop_, patch.corners, limits_.fillings);
    if (cuts.empty()) return false;
    const std::vector<Index>& around = grower_.rings(kRings);
    trial_.set_patch(patch, around);
    for (const TemplateCut& cut : cuts) {
        const std::uint64_t filled = key + mixed(cut.from) +
                                     mixed((cut.to << 32) + static_cast<std::size_t>(cut.edges));
        if (poor_.contains(filled)) continue;
        const TemplateMesh filling = fill_template(loop_, patch.corners, cut);
        budget_ -= static_cast<long>(filling.quads.size() + around.size());
        const Verdict verdict = trial_.run(filling, limits_.sweeps, limits_.hopeless);
        if (verdict == Verdict::poor) poor_.insert(filled);
        if (verdict != Verdict::good) continue;
        due_.resize(mesh_.points().size(), 1);
        return true;
    }
    return false;
}

/// Grow a patch from an irregular point to further irregular points, until one of its fillings improves the
/// mesh.
bool Cleaner::improve(Index seed)
{
    grower_.start(seed, limits_.growths);
    const std::size_t largest = std::min(limits_.largest, static_cast<std::size_t>(options_.largest_patch));
    for (std::size_t growth = 0; growth <= grower_.others().size(); ++growth) {
        if (growth > 0 && !grower_.grow_to(grower_.others()[growth - 1])) continue;
        const PatchState outline = grower_.close(largest);
        if (outline == PatchState::too_large) return false;
        if (outline == PatchState::fine && refill(grower_.patch())) return true;
        if (budget_ < 0) return false;
    }
    return false;
}

bool Cleaner::pass(const RunContext& context)
{
    bool improved = false;
    for (Index p = 0; p < static_cast<Index>(mesh_.points().size()) && budget_ >= 0; ++p) {
        if (due_[index(p)] == 0 || !mesh_.is_irregular(p)) continue;
        check_cancelled(context);
        due_[index(p)] = 0;
        if (!improve(p)) continue;
        improved = true;
        // The patch has changed the quads near the points that the search has seen. So these points are
        // visited again, even if they were tried without success.
        for (const Index q : grower_.seen_points()) due_[index(q)] = 1;
    }
    return improved;
}

} // namespace

} // namespace cleaning

void clean_quads(PlanarQuads& mesh, std::size_t fixed, const CleanOptions& options, const RunContext& context)
{
    cleaning::CleanMesh work(mesh, fixed, options);
    if (!work.is_sound()) return;
    work.remove_doublets();
    cleaning::Cleaner cleaner(work, options, mesh.quads.size());
    const std::span stages(cleaning::kStages);
    for (const cleaning::SearchLimits& limits : options.thorough ? stages : stages.first(stages.size() - 1)) {
        cleaner.begin(limits);
        for (int pass = 0; pass < options.passes; ++pass) {
            if (!cleaner.pass(context)) break;
        }
    }
    PlanarQuads cleaned = work.result();
    mesh.points = std::move(cleaned.points);
    mesh.quads = std::move(cleaned.quads);
}

} // namespace lacuna::quads
