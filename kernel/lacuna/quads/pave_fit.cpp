// SPDX-License-Identifier: MIT
#include <lacuna/quads/detail/pave_fit.h>

#include <lacuna/core/shared/criteria.h>
#include <lacuna/geometry/shared/transfinite.h>
#include <lacuna/quads/detail/patch_template.h>

#include <array>

namespace lacuna::quads::paving {
namespace {

/// A side of a block, sampled at even steps along its edges.
struct Sampled {
    std::vector<Vec2> points;
    double edges = 0; ///< number of mesh edges of the whole side
};

/// Number of sample cells along a side of a patch. They are used to estimate its quality.
constexpr std::size_t kSamples = 6;

/// The quality of a block of a patch. It is the smallest sine in its worst sample cell, reduced if the cells
/// do not have the requested size.
double judge_block(const PartialMesh& partial, const std::array<Sampled, 4>& side)
{
    const std::size_t n = side[0].points.size() - 1, m = side[1].points.size() - 1;
    const auto& [b, r, t, l] = side;
    // Samples are evenly spaced by the number of the edge, not by arc length, so that every cell represents
    // the same number of quads.
    const std::vector<Vec2> grid = geometry::transfinite(b.points, r.points, t.points, l.points,
                                                         {.by_arc_length = false});
    double worst = 1, stray = 0, weight = 0;
    for (std::size_t j = 0; j < m; ++j) {
        for (std::size_t i = 0; i < n; ++i) {
            const Vec2 &p0 = grid[j * (n + 1) + i], &p1 = grid[j * (n + 1) + i + 1];
            const Vec2 &p3 = grid[(j + 1) * (n + 1) + i], &p2 = grid[(j + 1) * (n + 1) + i + 1];
            worst = std::min(worst, least_sine(p0, p1, p2, p3));
            const double size = partial.size((p0 + p1 + p2 + p3) / 4);
            const double across = std::max(b.edges, t.edges) / static_cast<double>(n);
            const double along = std::max(l.edges, r.edges) / static_cast<double>(m);
            const double w = ((p1 - p0).norm() + (p2 - p3).norm()) / 2 / across / size;
            const double h = ((p3 - p0).norm() + (p2 - p1).norm()) / 2 / along / size;
            for (const double ratio : {w, h}) {
                stray += std::abs(std::log2(std::max(ratio, 1e-9)));
                weight += 1;
            }
        }
    }
    // If all sizes deviate from the requested size by a factor of two, the quality is halved.
    return worst > 0 ? worst / (1 + stray / weight) : worst;
}

Sampled sample(const PartialMesh& partial, const Cycle& cycle, std::size_t from, std::size_t edges,
               std::size_t cells)
{
    Sampled side{{}, static_cast<double>(edges)};
    for (std::size_t k = 0; k <= cells; ++k)
        side.points.push_back(partial.at(cycle[(from + k * edges / cells) % cycle.size()]));
    return side;
}

Sampled reversed(Sampled side)
{
    std::ranges::reverse(side.points);
    return side;
}

double judge_four(const PartialMesh& partial, const Cycle& cycle, const std::vector<std::size_t>& corners)
{
    const SideCounts counts = side_counts(cycle.size(), corners);
    if (!can_fill(counts)) return -1;
    std::array<std::size_t, 4> edges{};
    for (std::size_t i = 0; i < 4; ++i) edges[i] = index(counts.side[i]);
    const std::size_t n = std::min({kSamples, edges[0], edges[2]}),
                      m = std::min({kSamples, edges[1], edges[3]});
    const std::array<Sampled, 4> side{sample(partial, cycle, corners[0], edges[0], n),
                                      sample(partial, cycle, corners[1], edges[1], m),
                                      reversed(sample(partial, cycle, corners[2], edges[2], n)),
                                      reversed(sample(partial, cycle, corners[3], edges[3], m))};
    const double quality = judge_block(partial, side);
    // Columns that turn towards a neighbouring side bend the grid. The larger their share is, the lower is
    // the quality.
    const auto excess = [](std::size_t a, std::size_t c) {
        return static_cast<double>(std::max(a, c) - std::min(a, c)) / static_cast<double>(std::max(a, c));
    };
    return quality * (1 - std::max(excess(edges[0], edges[2]), excess(edges[1], edges[3])));
}

/// The quality of a patch of 3 or 5 sides, which is the quality of its worst block.
double judge_star(const PartialMesh& partial, const Cycle& cycle, const std::vector<std::size_t>& corners)
{
    const SideCounts counts = side_counts(cycle.size(), corners);
    std::array<int, kMostSides> feet{};
    if (!spoke_feet(counts, false, feet)) return -1;
    const std::size_t n = corners.size(), size = cycle.size();
    const auto foot = [&](std::size_t i) { return index(feet[i]); };
    std::vector<Vec2> at;
    Vec2 centre = Vec2::Zero();
    for (std::size_t i = 0; i < n; ++i) {
        at.push_back(partial.at(cycle[(corners[i] + foot(i)) % size]));
        centre += at.back() / static_cast<double>(n);
    }
    const auto straight = [&](const Vec2& from, std::size_t count, std::size_t cells) {
        Sampled line{{}, static_cast<double>(count)};
        for (std::size_t k = 0; k < cells; ++k)
            line.points.push_back(from +
                                  static_cast<double>(k) / static_cast<double>(cells) * (centre - from));
        line.points.push_back(centre);
        return line;
    };
    double quality = 1;
    for (std::size_t i = 0; i < n; ++i) {
        const std::size_t before = (i + n - 1) % n, rest = index(counts.side[before]) - foot(before);
        const std::size_t a = std::min(kSamples / 2, foot(i)), b = std::min(kSamples / 2, rest);
        const std::array<Sampled, 4> side{
            sample(partial, cycle, corners[i], foot(i), a), straight(at[i], rest, b),
            straight(at[before], foot(i), a),
            reversed(sample(partial, cycle, (corners[before] + foot(before)) % size, rest, b))};
        quality = std::min(quality, judge_block(partial, side));
    }
    return quality;
}

} // namespace

PatchFit fit_patch(const PartialMesh& partial, const Cycle& cycle, const std::vector<double>& angles)
{
    PatchFit fit;
    for (std::size_t i = 0; i < cycle.size(); ++i) {
        if (angles[i] > kReversalAbove * kDegree) return {};
        if (angles[i] < kCornerBelow * kDegree) fit.corners.push_back(i);
    }
    if (fit.corners.size() == 4)
        fit.quality = judge_four(partial, cycle, fit.corners);
    else if (fit.corners.size() == 3 || fit.corners.size() == 5)
        fit.quality = judge_star(partial, cycle, fit.corners);
    else
        return {};
    if (fit.quality <= 0) fit.corners.clear();
    return fit;
}

} // namespace lacuna::quads::paving
