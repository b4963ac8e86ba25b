// SPDX-License-Identifier: MIT
#include <lacuna/geometry/detail/flatten_maps.h>
#include <lacuna/geometry/shared/cut.h>
#include <lacuna/geometry/shared/harmonic.h>
#include <lacuna/geometry/shared/polyline.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lacuna::geometry::flat {
namespace {

double share(double turns) { return turns - std::floor(turns); }

/// The rotation of the inner loop relative to the outer loop that minimises the shear of the strip [turns].
/// If this multiple of the coordinate across the strip is added to the coordinate around the strip, the sum
/// has the least Dirichlet energy.
double least_shear(const Facets& facets, const HarmonicProblem& problem, const Eigen::MatrixXd& strip)
{
    double both = 0, across = 0;
    for (std::size_t t = 0; t < facets.triangles.size(); ++t) {
        Vec2 round = Vec2::Zero(), up = Vec2::Zero();
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec2& gradient = facets.shapes[t].gradient[k];
            const Index p = facets.triangles[t][k];
            round += gradient * (strip(p, 0) + problem.corner_turns[t][k] * problem.period[0]);
            up += gradient * strip(p, 1);
        }
        both += facets.shapes[t].area * round.dot(up);
        across += facets.shapes[t].area * up.squaredNorm();
    }
    return across > 0 ? -both / across : 0;
}

} // namespace

Positions ring(const Facets& facets)
{
    const std::vector<Index>&outer = facets.loops[0], &inner = facets.loops[1];
    const std::vector<double> round = arc_lengths(closed_places(facets, outer)),
                              within = arc_lengths(closed_places(facets, inner));
    const std::vector<Index> cut = shortest_way(facets.points, facets.triangles, outer.front(),
                                                {outer.begin(), outer.end()}, {inner.begin(), inner.end()});
    if (cut.empty()) return {};

    HarmonicProblem problem;
    problem.points = facets.points;
    problem.triangles = facets.triangles;
    problem.corner_turns = turns_along(facets.triangles, cut);
    // The facets lie on the left of the outer loop. The loop therefore starts on the right side of the cut,
    // where the values around the strip are one turn less.
    problem.period = Eigen::RowVector2d(-1, 0);
    const auto round_at = [&](std::size_t i) { return i == 0 ? 1 : round[i] / round.back(); };
    // The inner loop runs in the opposite direction, so its values decrease. They start at the end of the cut
    // with -1 · (share of the loop up to there). The rotation of the inner loop is added later.
    const auto end = static_cast<std::size_t>(std::find(inner.begin(), inner.end(), cut.back()) -
                                              inner.begin());
    const double branch = -within[end] / within.back();
    problem.fixed = outer;
    problem.fixed.insert(problem.fixed.end(), inner.begin(), inner.end());
    const auto rows = static_cast<Eigen::Index>(problem.fixed.size());
    problem.fixed_values.resize(rows, 2);
    for (std::size_t i = 0; i < outer.size(); ++i)
        problem.fixed_values.row(static_cast<Eigen::Index>(i)) << round_at(i), 0;
    for (std::size_t i = 0; i < inner.size(); ++i) {
        const double s = -within[i] / within.back();
        // Count back from the cut, by up to one turn.
        const double own = i == end ? branch : branch - share(branch - s);
        problem.fixed_values.row(static_cast<Eigen::Index>(outer.size() + i)) << own, 1;
    }
    Eigen::MatrixXd strip = solve_harmonic(problem);
    strip.col(0) += least_shear(facets, problem, strip) * strip.col(1);

    double energy = 0;
    for (std::size_t t = 0; t < facets.triangles.size(); ++t) {
        Vec2 slope = Vec2::Zero();
        for (std::size_t k = 0; k < 3; ++k)
            slope += facets.shapes[t].gradient[k] * strip(facets.triangles[t][k], 1);
        energy += facets.shapes[t].area * slope.squaredNorm();
    }
    const double decay = 2 * std::numbers::pi / energy;
    constexpr double kMostDecay = 8; // limit of log(outer / inner radius): the paver cannot mesh a ring with
                                     // a smaller hole
    if (!(decay <= kMostDecay)) return {};
    Positions positions;
    for (Eigen::Index p = 0; p < strip.rows(); ++p) {
        const double angle = 2 * std::numbers::pi * strip(p, 0), radius = std::exp(-decay * strip(p, 1));
        positions.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
    }
    scale_to_area(facets, positions);
    return positions;
}

} // namespace lacuna::geometry::flat
