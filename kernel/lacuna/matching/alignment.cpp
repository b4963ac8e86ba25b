// SPDX-License-Identifier: MIT
#include <lacuna/matching/detail/alignment.h>

#include <lacuna/core/shared/criteria.h>
#include <lacuna/core/shared/limits.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <numbers>

namespace lacuna::matching {

namespace {

/// Score of a rotation by 180°, where a residual as large as the loop's length has the score 1. The value is
/// small, so that rotation only decides between fits with about the same residual.
constexpr double kTurnWeight = 0.1;

using Hard = std::map<VertexId, VertexId>;

/// Whether an alignment of two loops with equal numbers of vertices keeps their hard pairs.
bool allowed(const Hard& hard, const LoopShape& source, const LoopShape& target, std::size_t shift,
             bool backward)
{
    const std::size_t n = source.vertices.size();
    for (std::size_t i = 0; i < n; ++i) {
        const auto pair = hard.find(source.vertices[i]);
        if (pair == hard.end()) continue;
        if (target.vertices[partner_place(i, n, shift, backward)] != pair->second) return false;
    }
    return true;
}

/// 0 if the normals of two aligned loops point in the same direction along the line between the loops, as in
/// a plain sweep. Otherwise up to 1: the smaller cosine of the angles between a normal and the line.
double overturned(const LoopShape& source, const LoopShape& target, bool backward)
{
    const Vec3 way = (target.centroid - source.centroid).stableNormalized();
    const double low = source.area.stableNormalized().dot(way);
    const double high = (backward ? -1 : 1) * target.area.stableNormalized().dot(way);
    return low * high < 0 ? std::min(std::abs(low), std::abs(high)) : 0;
}

/// Fit an alignment and set its score. Rotation adds to the score only if no wall determines the rotation.
void rate(Alignment& alignment, const Problem& problem, const LoopShape& source, const LoopShape& target,
          const std::vector<Vec3>& from, std::vector<Vec3> to, const PointPairs& known, bool with_scale)
{
    to.insert(to.end(), known.to.begin(), known.to.end());
    alignment.fit = geometry::fit_rigid(from, to, with_scale);
    alignment.score = alignment.fit.rms / std::max(source.length, target.length);
    if (!problem.led.from.empty()) return;
    alignment.score += kTurnWeight * (turn_of(alignment) + overturned(source, target, alignment.backward));
}

std::vector<Vec3> with(std::vector<Vec3> points, const std::vector<Vec3>& more)
{
    points.insert(points.end(), more.begin(), more.end());
    return points;
}

/// Number of possible starts on a loop paired by length: that of its given nodes or samples.
std::size_t places_of(const LoopShape& target) { return target.by_sides ? given_sides(target) : kFineChords; }

/// The samples of a target under an alignment, in the order of the corresponding `source_samples()`.
std::vector<Vec3> target_samples(const LoopShape& target, const Alignment& alignment, bool by_length)
{
    return by_length ? even_samples(target, target.length * alignment.offset, alignment.backward)
                     : edge_samples(target, alignment.shift, alignment.backward);
}

std::vector<Vec3> source_samples(const LoopShape& source, bool by_length)
{
    return by_length ? even_samples(source, 0, false) : edge_samples(source, 0, false);
}

/// The start on a target paired by length that the first hard pair of the loops gives. Empty if there is no
/// hard pair between them.
std::optional<std::size_t> hard_start(const Problem& problem, const LoopShape& source,
                                      const LoopShape& target, std::size_t places, bool backward)
{
    for (std::size_t i = 0; i < source.vertices.size(); ++i) {
        const auto pair = problem.hard.find(source.vertices[i]);
        if (pair == problem.hard.end()) continue;
        const auto j = index(std::ranges::find(target.vertices, pair->second) - target.vertices.begin());
        if (j == target.vertices.size()) continue;
        const double start = target.vertex_arc[j] / target.length -
                             (backward ? -1 : 1) * source.vertex_arc[i] / source.length;
        return index(std::lround(static_cast<double>(places) * (start - std::floor(start)))) % places;
    }
    return std::nullopt;
}

/// Every alignment, best first. Of loops paired by length, a hard pair leaves one start.
/// @param hard  pairs to keep; null: pair by length.
/// @param only_backward  the direction; empty: both directions.
std::vector<Alignment> rated(const Problem& problem, const Hard* hard, const LoopShape& source,
                             const LoopShape& target, bool with_scale, std::optional<bool> only_backward,
                             const PointPairs& known)
{
    const bool by_length = hard == nullptr;
    const std::vector<Vec3> from = with(source_samples(source, by_length), known.from);
    const std::size_t places = by_length ? places_of(target) : target.vertices.size();
    std::vector<Alignment> result;
    for (const bool backward : {true, false}) {
        if (only_backward && *only_backward != backward) continue;
        const auto start = by_length ? hard_start(problem, source, target, places, backward) : std::nullopt;
        for (std::size_t shift = 0; shift < places; ++shift) {
            check_cancelled(problem.context);
            if (start && shift != *start) continue;
            if (!by_length && !allowed(*hard, source, target, shift, backward)) continue;
            const double offset = by_length ? static_cast<double>(shift) / static_cast<double>(places) : 0;
            Alignment& alignment = result.emplace_back(Alignment{shift, offset, backward, 0, {}});
            rate(alignment, problem, source, target, from, target_samples(target, alignment, by_length),
                 known, with_scale);
        }
    }
    std::ranges::stable_sort(result, {}, &Alignment::score);
    return result;
}

Alignment slid(const Problem& problem, const LoopShape& source, const LoopShape& target,
               const Alignment& alignment, const PointPairs& known)
{
    const std::vector<Vec3> from = with(even_samples(source, 0, false), known.from);
    const auto at = [&](double offset) {
        Alignment moved = alignment;
        moved.offset = offset - std::floor(offset);
        rate(moved, problem, source, target, from, target_samples(target, moved, true), known, true);
        return moved;
    };
    const double golden = (std::sqrt(5.0) - 1) / 2, step = 1.0 / kFineChords;
    double low = alignment.offset - step, high = alignment.offset + step;
    Alignment a = at(high - golden * (high - low)), b = at(low + golden * (high - low));
    while (high - low > kFileAccuracy * step) {
        if (a.score <= b.score) {
            high = low + golden * (high - low);
            b = a;
            a = at(high - golden * (high - low));
        } else {
            low = high - golden * (high - low);
            a = b;
            b = at(low + golden * (high - low));
        }
    }
    const Alignment& best = a.score <= b.score ? a : b;
    // Keep the start at a sample unless another start improves the fit.
    const Alignment start = at(alignment.offset);
    return best.score < start.score ? best : start;
}

/// Mean distance along the loop between the partners of vertices under two alignments: one by vertices and
/// one by length. As a share of the loop.
double mean_twist(const LoopShape& source, const LoopShape& target, const Alignment& by_vertices,
                  const Alignment& by_length)
{
    const std::size_t n = source.vertices.size();
    const double sign = by_length.backward ? -1 : 1;
    double sum = 0;
    for (std::size_t i = 0; i < n; ++i) {
        const std::size_t j = partner_place(i, n, by_vertices.shift, by_vertices.backward);
        const double apart = sign * (target.vertex_arc[j] / target.length - by_length.offset) -
                             source.vertex_arc[i] / source.length;
        sum += apart - std::round(apart);
    }
    return std::abs(sum) / static_cast<double>(n);
}

bool goes_by_length(const Problem& problem, std::size_t s, std::size_t t)
{
    const LoopShape& source = problem.source[s];
    const LoopShape& target = problem.target[t];
    const std::size_t n = source.vertices.size();
    if (n != target.vertices.size() || n == 1) return true;
    const auto corners = [](const LoopShape& shape) {
        return std::count(shape.corner.begin(), shape.corner.end(), true);
    };
    const auto low = corners(source), high = corners(target);
    const auto all = static_cast<std::ptrdiff_t>(n);
    if (problem.hard.empty() && low == all && high == all) return false;
    const std::vector<Alignment> found = rated(problem, &problem.hard, source, target, true, problem.backward,
                                               problem.led_near(s));
    // No alignment keeps all hard pairs. If no alignment keeps even the pairs from the walls, the loops are
    // paired by length, which splits edges. Otherwise the user's pairs contradict each other or the walls,
    // and are refused later.
    if (found.empty())
        return rated(problem, &problem.walls, source, target, true, problem.backward, {}).empty();
    if (low == all && high == all) return false;
    std::ptrdiff_t unlike = 0, met = 0;
    for (std::size_t i = 0; i < n; ++i) {
        const Alignment& alignment = found.front();
        const std::size_t j = partner_place(i, n, alignment.shift, alignment.backward);
        unlike += source.corner[i] != target.corner[j] ? 1 : 0;
        met += source.corner[i] && target.corner[j] ? 1 : 0;
    }
    if (unlike > std::abs(low - high)) return true;
    if (met > 0 || problem.has_hard(s)) return false;
    const PointPairs led = problem.led_near(s);
    const Alignment straight = slid(
        problem, source, target, rated(problem, nullptr, source, target, true, problem.backward, led).front(),
        led);
    return straight.backward != found.front().backward ||
           mean_twist(source, target, found.front(), straight) > most_twist();
}

PointPairs with_led(const Problem& problem, std::size_t s, PointPairs known)
{
    known.add(problem.led_near(s));
    return known;
}

} // namespace

double turn_of(const Alignment& alignment)
{
    return std::abs(Eigen::AngleAxisd(alignment.fit.rotation).angle()) / std::numbers::pi;
}

std::vector<Alignment> alignments_of(const Problem& problem, std::size_t s, std::size_t t, bool with_scale,
                                     std::optional<bool> backward, const PointPairs& known)
{
    return rated(problem, problem.paired_by_length(s, t) ? nullptr : &problem.hard, problem.source[s],
                 problem.target[t], with_scale, backward, with_led(problem, s, known));
}

Alignment refined(const Problem& problem, std::size_t s, std::size_t t, const Alignment& alignment,
                  const PointPairs& known)
{
    return slid(problem, problem.source[s], problem.target[t], alignment, with_led(problem, s, known));
}

PointPairs samples(const Problem& problem, std::size_t s, std::size_t t, const Alignment& alignment)
{
    const bool by_length = problem.paired_by_length(s, t);
    return {source_samples(problem.source[s], by_length),
            target_samples(problem.target[t], alignment, by_length)};
}

bool differ(const Problem& problem, std::size_t s, std::size_t t, const Alignment& a, const Alignment& b)
{
    if (a.backward != b.backward || !problem.paired_by_length(s, t))
        return a.backward != b.backward || a.shift != b.shift;
    const std::size_t places = places_of(problem.target[t]);
    const std::size_t apart = (a.shift + places - b.shift) % places;
    const std::size_t most = std::max(problem.source[s].vertices.size(), problem.target[t].vertices.size());
    return 2 * std::min(apart, places - apart) * most >= places;
}

std::size_t unlike_sides(const Problem& problem, std::size_t s, std::size_t t, const Alignment& alignment)
{
    const LoopShape& source = problem.source[s];
    const LoopShape& target = problem.target[t];
    const std::size_t n = source.vertices.size();
    std::size_t unlike = 0;
    if (problem.paired_by_length(s, t)) {
        if (!target.by_sides) return 0;
        const std::size_t all = given_sides(target);
        const std::vector<std::size_t> nodes = first_sides(target);
        std::size_t met = 0;
        for (const std::size_t node : first_sides(source)) {
            const std::size_t at = partner_place(node, all, alignment.shift, alignment.backward);
            met += std::ranges::binary_search(nodes, at) ? 1 : 0;
        }
        return std::min(n, nodes.size()) - met;
    }
    for (std::size_t i = 0; i < n; ++i) {
        const std::size_t j = alignment.backward ? (alignment.shift + 2 * n - i - 1) % n
                                                 : (alignment.shift + i) % n;
        const std::size_t here = source.sides[i], there = target.sides[j];
        unlike += here > 0 && there > 0 && here != there ? 1 : 0;
    }
    return unlike;
}

bool Problem::paired_by_length(std::size_t s, std::size_t t) const
{
    if (forced[s] >= 0 && forced[s] != static_cast<int>(t)) return false;
    const auto [known, fresh] = by_length.try_emplace(s * target.size() + t, false);
    if (fresh) known->second = goes_by_length(*this, s, t);
    return known->second;
}

} // namespace lacuna::matching
