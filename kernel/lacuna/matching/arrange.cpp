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

/// Distance between the centroids of two loops after the source is moved by `fit`.
double misfit(const Problem& problem, std::size_t s, std::size_t t, const geometry::RigidFit& fit,
              double reach)
{
    return (fit(problem.source[s].centroid) - problem.target[t].centroid).norm() / reach;
}

/// Cost of pairing loop s with loop t after the source is moved by `fit`.
/// @param scale  expected ratio of loop sizes, from the lengths of the anchor loops. The scale of the fit
///               would not do: it shrinks with the quality of the fit, so the size of another loop would
///               decide the anchor's alignment.
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

/// The arrangement that an alignment of the anchor leads to; empty if no complete one is cheaper than
/// `limit`.
std::optional<Arrangement> arrangement_of(const Problem& problem, std::size_t anchor, std::size_t t,
                                          const Alignment& alignment, double scale, double reach,
                                          double limit)
{
    const std::size_t n = problem.source.size();
    const auto at = [](std::size_t i) { return static_cast<Eigen::Index>(i); };
    Eigen::MatrixXd cost(at(n), at(n));
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t j = 0; j < n; ++j) {
            const bool fixed = (i == anchor) != (j == t);
            cost(at(i), at(j)) = fixed ? kInfinity : loop_cost(problem, i, j, alignment.fit, scale, reach);
        }
    }
    // Lower bound: each row's least cost. Most alignments are rejected before the assignment is solved.
    if (!(alignment.score + cost.rowwise().minCoeff().sum() / static_cast<double>(n) < limit))
        return std::nullopt;
    Arrangement result{assign(cost), static_cast<int>(anchor), alignment, {}, alignment.score};
    for (std::size_t i = 0; i < n; ++i) {
        if (result.target[i] < 0) return std::nullopt;
        result.score += cost(at(i), result.target[i]) / static_cast<double>(n);
        result.alignment.score += misfit(problem, i, static_cast<std::size_t>(result.target[i]),
                                         alignment.fit, reach) /
                                  static_cast<double>(n);
    }
    return result.score < limit ? std::optional(result) : std::nullopt;
}

/// Keep the two best arrangements with different pairs and, for each, the two best alignments that differ.
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
    std::vector<Arrangement> best;
    for (std::size_t t = 0; t < n; ++t) {
        if (problem.forced[anchor] >= 0 && problem.forced[anchor] != static_cast<int>(t)) continue;
        for (const bool with_scale : {false, true}) {
            const double low = problem.source[anchor].length, high = problem.target[t].length;
            const double scale = with_scale && low > 0 ? high / low : 1;
            for (const Alignment& alignment : alignments_of(problem, anchor, t, with_scale)) {
                check_cancelled(problem.context);
                // With three loops or more, only arrangements better than the second best matter.
                const double limit = n > 2 && best.size() > 1 ? best.back().score : kInfinity;
                auto found = arrangement_of(problem, anchor, t, alignment, scale, reach, limit);
                if (found) keep(problem, std::move(*found), best);
            }
        }
    }
    return best;
}

} // namespace lacuna::matching
