// SPDX-License-Identifier: MIT
#include <lacuna/matching/detail/arrange.h>

#include <lacuna/core/shared/constants.h>
#include <lacuna/matching/detail/assignment.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace lacuna::matching {

namespace {

double relative(double a, double b)
{
    const double most = std::max(std::abs(a), std::abs(b));
    return most > 0 ? std::abs(a - b) / most : 0;
}

/// Distance between the centroids of two loops after the source is moved by `fit`, relative to `reach`.
double misfit(const Problem& problem, std::size_t s, std::size_t t, const geometry::RigidFit& fit,
              double reach)
{
    return (fit(problem.source[s].centroid) - problem.target[t].centroid).norm() / reach;
}

/// Cost of pairing source loop s with target loop t after the source is moved by `fit`.
/// @param scale  expected ratio of loop sizes: that of the lengths of the anchor loops. The scale of the fit
///         is not used, because it depends on the quality of the fit: it is smaller for worse fits.
double loop_cost(const Problem& problem, std::size_t s, std::size_t t, const geometry::RigidFit& fit,
                 double scale, double reach)
{
    if (problem.forced[s] >= 0 && problem.forced[s] != static_cast<int>(t)) return kInfinity;
    const double place = misfit(problem, s, t, fit, reach);
    if (problem.forced[s] >= 0) return place;
    const LoopShape& a = problem.source[s];
    const LoopShape& b = problem.target[t];
    const double counts = relative(static_cast<double>(a.vertices.size()),
                                   static_cast<double>(b.vertices.size()));
    return place + relative(a.length * scale, b.length) +
           relative(a.area.norm() * scale * scale, b.area.norm()) + counts;
}

/// Finds the cheapest target loop for a source loop. Target loops are tried in the order of their distance
/// along one axis. The search ends when this distance alone costs more than the cheapest target found so far.
class CheapestTarget {
public:
    CheapestTarget(const Problem& problem, double reach) : problem_(problem), reach_(reach)
    {
        Eigen::AlignedBox3d box;
        for (const LoopShape& shape : problem.target) box.extend(shape.centroid);
        if (!box.isEmpty()) box.sizes().maxCoeff(&axis_);
        for (std::size_t t = 0; t < problem.target.size(); ++t)
            along_.emplace_back(problem.target[t].centroid[axis_], t);
        std::ranges::sort(along_);
        for (const LoopShape& shape : problem.target) lengths_.push_back(shape.length);
        std::ranges::sort(lengths_);
    }

    /// Lower bound of a source loop's cost, from the lengths of the target loops.
    [[nodiscard]] double by_length(std::size_t s, double scale) const
    {
        const double length = problem_.source[s].length * scale;
        if (problem_.forced[s] >= 0) return 0;
        const auto above = std::ranges::lower_bound(lengths_, length);
        return std::min(above == lengths_.end() ? kInfinity : relative(length, *above),
                        above == lengths_.begin() ? kInfinity : relative(length, *std::prev(above)));
    }

    /// @return  the least cost, and the first target that has this cost; infinite cost if no target is
    ///         allowed
    template <class Cost>
    std::pair<double, std::size_t> find(std::size_t s, const geometry::RigidFit& fit, const Cost& cost) const
    {
        std::pair<double, std::size_t> best{kInfinity, 0};
        const auto take = [&](std::size_t t) { best = std::min(best, {cost(s, t), t}); };
        if (problem_.forced[s] >= 0) {
            take(static_cast<std::size_t>(problem_.forced[s]));
            return best;
        }
        const double at = fit(problem_.source[s].centroid)[axis_];
        auto above = std::ranges::lower_bound(along_, std::pair(at, std::size_t{0})), below = above;
        while (below != along_.begin() || above != along_.end()) {
            const double down = below == along_.begin() ? kInfinity : at - std::prev(below)->first;
            const double up = above == along_.end() ? kInfinity : above->first - at;
            if (std::min(down, up) > best.first * reach_) break;
            take(down < up ? (--below)->second : (above++)->second);
        }
        return best;
    }

private:
    const Problem& problem_;
    double reach_;
    Eigen::Index axis_ = 0;
    std::vector<std::pair<double, std::size_t>> along_; ///< positions of the target loops on the axis, with
                                                        ///< their numbers; ascending
    std::vector<double> lengths_;                       ///< lengths of the target loops, ascending
};

/// The arrangement that follows from an alignment of the anchor; empty if it is incomplete or not cheaper
/// than `limit`.
std::optional<Arrangement> arrangement_of(const Problem& problem, std::size_t anchor, std::size_t t,
                                          const Alignment& alignment, double scale, double reach,
                                          const CheapestTarget& targets, double limit)
{
    const std::size_t n = problem.source.size();
    const auto cost = [&](std::size_t i, std::size_t j) {
        if ((i == anchor) != (j == t)) return kInfinity;
        return loop_cost(problem, i, j, alignment.fit, scale, reach);
    };
    // Compare two lower bounds of the score with `limit` before the assignment is solved; most alignments are
    // rejected here.
    double least = alignment.score;
    for (std::size_t i = 0; i < n && least < limit; ++i)
        if (i != anchor) least += targets.by_length(i, scale) / static_cast<double>(n);
    if (!(least < limit)) return std::nullopt;
    least = alignment.score;
    std::vector<std::size_t> cheapest;
    for (std::size_t i = 0; i < n; ++i) {
        const auto [own, at] = i == anchor ? std::pair(cost(i, t), t) : targets.find(i, alignment.fit, cost);
        least += own / static_cast<double>(n);
        if (!(least < limit)) return std::nullopt;
        cheapest.push_back(at);
    }
    Arrangement result{assign(cost, cheapest), static_cast<int>(anchor), alignment, {}, alignment.score};
    for (std::size_t i = 0; i < n; ++i) {
        if (result.target[i] < 0) return std::nullopt;
        const auto at = static_cast<std::size_t>(result.target[i]);
        result.score += cost(i, at) / static_cast<double>(n);
        result.alignment.score += misfit(problem, i, at, alignment.fit, reach) / static_cast<double>(n);
    }
    return result.score < limit ? std::optional(result) : std::nullopt;
}

/// Keep the two best arrangements with different pairs and, for each of them, the two best alignments that
/// `differ()`.
void keep(const Problem& problem, Arrangement candidate, std::vector<Arrangement>& best)
{
    const auto same = std::ranges::find(best, candidate.target, &Arrangement::target);
    if (same == best.end()) {
        best.push_back(std::move(candidate));
    } else {
        const auto s = static_cast<std::size_t>(candidate.anchor);
        const auto t = static_cast<std::size_t>(candidate.target[s]);
        std::vector<Alignment> others{candidate.alignment, same->alignment};
        if (same->next) others.push_back(*same->next);
        if (candidate.score < same->score) std::swap(*same, candidate);
        same->next.reset();
        for (const Alignment& alignment : others) {
            if (differ(problem, s, t, alignment, same->alignment) &&
                (!same->next || alignment.score < same->next->score))
                same->next = alignment;
        }
    }
    std::ranges::stable_sort(best, {}, &Arrangement::score);
    if (best.size() > 2) best.pop_back();
}

} // namespace

std::vector<Arrangement> arrange(const Problem& problem)
{
    const std::size_t n = problem.source.size();
    double reach = 0;
    for (const LoopShape& shape : problem.target) reach = std::max(reach, shape.length);
    const auto first_forced = std::ranges::find_if(problem.forced, [](int t) { return t >= 0; });
    const auto anchor = first_forced == problem.forced.end()
                            ? std::size_t{0}
                            : static_cast<std::size_t>(first_forced - problem.forced.begin());
    const CheapestTarget targets(problem, reach);
    std::vector<Arrangement> best;
    for (std::size_t t = 0; t < n; ++t) {
        if (problem.forced[anchor] >= 0 && problem.forced[anchor] != static_cast<int>(t)) continue;
        for (const bool with_scale : {false, true}) {
            const double low = problem.source[anchor].length, high = problem.target[t].length;
            const double scale = with_scale && low > 0 ? high / low : 1;
            for (const Alignment& alignment :
                 alignments_of(problem, anchor, t, with_scale, problem.backward)) {
                check_cancelled(problem.context);
                // With three loops or more, only arrangements better than the second best matter.
                const double limit = n > 2 && best.size() > 1 ? best.back().score : kInfinity;
                auto found = arrangement_of(problem, anchor, t, alignment, scale, reach, targets, limit);
                if (found) keep(problem, std::move(*found), best);
            }
        }
    }
    return best;
}

} // namespace lacuna::matching
