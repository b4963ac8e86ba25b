// SPDX-License-Identifier: MIT
#include <lacuna/geometry/cut.h>
#include <lacuna/geometry/detail/flatten_maps.h>
#include <lacuna/geometry/harmonic.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

namespace lacuna::geometry::flat {
namespace {

/// Running lengths of a loop's points, and its whole.
struct Lengths {
    std::vector<double> at;
    double whole = 0;
};

Lengths lengths_of(const Facets& facets, const std::vector<Index>& loop)
{
    Lengths lengths;
    for (std::size_t i = 0; i < loop.size(); ++i) {
        lengths.at.push_back(lengths.whole);
        lengths.whole +=
            (facets.points[index(loop[(i + 1) % loop.size()])] - facets.points[index(loop[i])]).norm();
    }
    return lengths;
}

double share(double turns) { return turns - std::floor(turns); }

/// Where on the inner loop the coordinate round the strip is 0, so that the strip is sheared least: a mean on
/// the circle of what the facets say that lead there.
double start_of_inner(const std::vector<Index>& inner, const Lengths& lengths, const Eigen::MatrixXd& natural)
{
    Vec2 sum = Vec2::Zero();
    for (std::size_t i = 0; i < inner.size(); ++i) {
        const double off = 2 * std::numbers::pi * (natural(inner[i], 0) + lengths.at[i] / lengths.whole);
        sum += Vec2(std::cos(off), std::sin(off));
    }
    return std::atan2(sum.y(), sum.x()) / (2 * std::numbers::pi);
}

} // namespace

Positions ring(const Facets& facets)
{
    const std::vector<Index>&outer = facets.loops[0], &inner = facets.loops[1];
    const Lengths round = lengths_of(facets, outer), within = lengths_of(facets, inner);
    const std::vector<Index> cut = shortest_way(facets.points, facets.triangles, outer.front(),
                                                {outer.begin(), outer.end()}, {inner.begin(), inner.end()});
    if (cut.empty()) return {};

    HarmonicProblem problem;
    problem.points = facets.points;
    problem.triangles = facets.triangles;
    problem.corner_turns = turns_along(facets.triangles, cut);
    // The loop has the facets on its left, so that it leaves the cut to the right, where a turn less is seen.
    problem.period = -Eigen::RowVectorXd::Ones(1);
    problem.fixed = outer;
    const auto round_at = [&](std::size_t i) { return i == 0 ? 1 : round.at[i] / round.whole; };
    problem.fixed_values.resize(static_cast<Eigen::Index>(outer.size()), 1);
    for (std::size_t i = 0; i < outer.size(); ++i)
        problem.fixed_values(static_cast<Eigen::Index>(i), 0) = round_at(i);
    const Eigen::MatrixXd natural = solve_harmonic(problem);

    // The inner loop runs the other way. Its points are seen on the branch that the cut's end is on.
    const double start = start_of_inner(inner, within, natural);
    const auto end = static_cast<std::size_t>(std::find(inner.begin(), inner.end(), cut.back()) -
                                              inner.begin());
    const double at_end = start - within.at[end] / within.whole;
    const double branch = at_end + std::round(natural(cut.back(), 0) - at_end);
    problem.period = Eigen::RowVector2d(-1, 0);
    problem.fixed.insert(problem.fixed.end(), inner.begin(), inner.end());
    const auto rows = static_cast<Eigen::Index>(problem.fixed.size());
    problem.fixed_values.resize(rows, 2);
    for (std::size_t i = 0; i < outer.size(); ++i)
        problem.fixed_values.row(static_cast<Eigen::Index>(i)) << round_at(i), 0;
    for (std::size_t i = 0; i < inner.size(); ++i) {
        const double s = start - within.at[i] / within.whole;
        // Back from the cut, up to a turn.
        const double own = i == end ? branch : branch - share(branch - s);
        problem.fixed_values.row(static_cast<Eigen::Index>(outer.size() + i)) << own, 1;
    }
    const Eigen::MatrixXd strip = solve_harmonic(problem);

    double energy = 0;
    for (std::size_t t = 0; t < facets.triangles.size(); ++t) {
        Vec2 slope = Vec2::Zero();
        for (std::size_t k = 0; k < 3; ++k)
            slope += facets.shapes[t].gradient[k] * strip(facets.triangles[t][k], 1);
        energy += facets.shapes[t].area * slope.squaredNorm();
    }
    const double decay = 2 * std::numbers::pi / energy;
    constexpr double kMostDecay = 8; // of the radii: wider rings have no size that the paver can work with
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
