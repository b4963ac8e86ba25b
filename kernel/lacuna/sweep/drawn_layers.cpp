// SPDX-License-Identifier: MIT
#include <lacuna/sweep/detail/drawn_layers.h>

#include <lacuna/core/message.h>
#include <lacuna/core/shared/criteria.h>
#include <lacuna/geometry/shared/angle.h>
#include <lacuna/surface/shared/boundary_layers.h>
#include <lacuna/surface/shared/wall_columns.h>
#include <lacuna/sweep/detail/plan_heights.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

namespace lacuna::sweep {

using namespace topology;

namespace {

/// Number of steps along the axis. With 64, a bend of 90° over a twentieth of the axis turns by 29° per step.
constexpr std::size_t kSteps = 64;
/// A turn above this within one step counts as a corner, which layers cannot resolve, and not as a tight bend
/// [radian]. Not measured.
constexpr double kCorner = 40 * kDegree;
/// Minimum number of side lines whose mean is used as the axis: a single line is not in the middle.
constexpr std::size_t kMiddle = 2;
/// If the mean of the columns moves by less than this share of their mean length in a step, the columns
/// diverge there, as around the edge of an end, and turns are ignored. A higher value ignores more turns. Not
/// measured.
constexpr double kSlow = 0.7;
/// Maximum ratio between the heights of neighbouring layers, and between the heights of any two layers. Both
/// limit the elongation of cells. Not measured.
constexpr double kMostBeside = 2, kMostInAll = 4;
/// Weights of the turning relative to the length of the axis, in increasing order. The lowest gives nearly
/// uniform layers, the highest puts most layers in the bends.
constexpr std::array<double, 6> kPulls{0.25, 0.5, 1, 2, 4, 8};
/// A stronger concentration must reduce the volume error by at least this share of the volume, about as much
/// as one more layer does. Not measured.
constexpr double kWorth = 2e-3;

/// The axis: the mean of the columns, sampled at even steps.
struct Way {
    std::array<Vec3, kSteps + 1> points{};
    std::array<Vec3, kSteps + 1> along{};    ///< unit vectors
    std::array<double, kSteps + 1> turned{}; ///< total turning up to each step, without corners [radian]
    double column = 0;                       ///< mean length of a column [model length]
};

Way way_of(const OpenVolume& volume, const std::vector<surface::LinkingSurface>& links,
           const RunContext& context)
{
    std::vector<std::vector<Vec3>> columns;
    // A linking surface with a single side line, a seam, is left out if another one has several side lines.
    const bool lines = std::ranges::any_of(links,
                                           [](const auto& link) { return link.lines.size() >= kMiddle; });
    const auto add = [&](const surface::LinkingSurface& link) {
        std::ranges::move(surface::wall_columns(volume, link, kSteps, context), std::back_inserter(columns));
    };
    for (const surface::LinkingSurface& link : links) {
        if (link.lines.size() >= kMiddle) {
            add(link);
        } else if (!lines) {
            surface::LinkingSurface without = link;
            without.lines.clear();
            add(without);
        }
    }
    Way way;
    way.points.fill(Vec3::Zero());
    const auto share = 1 / static_cast<double>(columns.size());
    for (const std::vector<Vec3>& points : columns) {
        for (std::size_t i = 0; i <= kSteps; ++i) way.points[i] += share * points[i];
        for (std::size_t i = 1; i <= kSteps; ++i) way.column += share * (points[i] - points[i - 1]).norm();
    }
    const double slow = kSlow * way.column / kSteps;
    for (std::size_t i = 0; i <= kSteps; ++i)
        way.along[i] = (way.points[std::min(i + 1, kSteps)] - way.points[i > 0 ? i - 1 : 0]).normalized();
    for (std::size_t i = 1; i < kSteps; ++i) {
        const Vec3 in = way.points[i] - way.points[i - 1], out = way.points[i + 1] - way.points[i];
        const double turn = geometry::angle_between(in, out);
        if (turn > kCorner || in.norm() < slow || out.norm() < slow) continue;
        way.turned[i] += turn / 2; // a turn is divided evenly between the two adjacent steps
        way.turned[i + 1] += turn / 2;
    }
    for (std::size_t i = 1; i <= kSteps; ++i) way.turned[i] += way.turned[i - 1];
    return way;
}

/// Interpolate values given at even steps.
template <class Value>
Value at_share(const std::array<Value, kSteps + 1>& values, double share)
{
    const double at = std::clamp(share, 0.0, 1.0) * kSteps;
    const auto i = std::min(static_cast<std::size_t>(at), kSteps - 1);
    return values[i] + (at - static_cast<double>(i)) * (values[i + 1] - values[i]);
}

/// Heights from 0 to 1 that divide the sum of the axis length and `pull` times its turning evenly, within the
/// limits for ratios of heights.
std::vector<double> drawn_heights(const Way& way, int layers, double pull)
{
    const double even = 1.0 / layers;
    std::array<double, kSteps> wanted{};
    for (std::size_t i = 0; i < kSteps; ++i) {
        const double middle = (static_cast<double>(i) + 0.5) / kSteps;
        const double from = std::max(middle - even / 2, 0.0), to = std::min(middle + even / 2, 1.0);
        const double turn = at_share(way.turned, to) - at_share(way.turned, from);
        wanted[i] = 1 / (1 + pull * turn / (way.turned.back() * (to - from)));
    }
    const double highest = *std::ranges::max_element(wanted);
    for (double& height : wanted) height = std::max(height, highest / kMostInAll);
    // If layer heights grow by at most this rate per length, neighbouring layers respect their ratio limit.
    const double growth = std::log(kMostBeside) / kSteps;
    std::array<double, kSteps + 1> passed{};
    const auto count_layers = [&](double scale) {
        std::array<double, kSteps> height{};
        for (std::size_t i = 0; i < kSteps; ++i)
            height[i] = std::min(scale * wanted[i], i > 0 ? height[i - 1] + growth : scale);
        for (std::size_t i = kSteps - 1; i-- > 0;) height[i] = std::min(height[i], height[i + 1] + growth);
        for (std::size_t i = 0; i < kSteps; ++i) passed[i + 1] = passed[i] + 1 / (kSteps * height[i]);
        return passed[kSteps];
    };
    double low = even, high = even / *std::ranges::min_element(wanted);
    constexpr int kHalvings = 40;
    for (int i = 0; i < kHalvings; ++i) {
        const double scale = (low + high) / 2;
        (count_layers(scale) > layers ? low : high) = scale;
    }
    count_layers(high);
    std::vector<double> heights{0};
    std::size_t step = 1;
    for (int k = 1; k < layers; ++k) {
        const double goal = passed[kSteps] * k / layers;
        while (passed[step] < goal) ++step;
        const double part = (goal - passed[step - 1]) / (passed[step] - passed[step - 1]);
        heights.push_back((static_cast<double>(step - 1) + part) / kSteps);
    }
    heights.push_back(1);
    return heights;
}

/// The volume between flat sections of equal area, normal to the axis at the heights, divided by that area.
/// It compares with the length of the axis, and is exact if the axis turns in a plane.
double length_between(const Way& way, const std::vector<double>& heights)
{
    double length = 0;
    for (std::size_t k = 1; k < heights.size(); ++k) {
        const Vec3 chord = at_share(way.points, heights[k]) - at_share(way.points, heights[k - 1]);
        const Vec3 below = at_share(way.along, heights[k - 1]).normalized();
        length += chord.dot(below + at_share(way.along, heights[k]).normalized()) / 2;
    }
    return length;
}

/// Whether only the number of layers is given, not their heights.
bool by_count_alone(const OpenVolume& volume, const SweepOptions& options)
{
    const bool beside = options.beside.settle || options.beside.shape != nullptr;
    if (beside || options.layers.count < 2 || options.layers.bias != 1 || !options.layers.heights.empty())
        return false;
    if (std::ranges::any_of(volume.faces(Role::wall), [&](FaceId f) { return volume.model[f].keeps_nodes; }))
        return false;
    const surface::LayerTables tables = surface::layer_tables(volume, options.boundary_layers);
    return std::ranges::none_of(tables.of,
                                [&](const auto& of) { return volume.role[of.first.index()] != Role::wall; });
}

} // namespace

std::optional<DrawnLayers> drawn_layers(const OpenVolume& volume, const SweepOptions& options,
                                        KnownLinks& links, const RunContext& context)
{
    if (options.curvature == 0 || !by_count_alone(volume, options)) return std::nullopt;
    const Way way = way_of(volume, links.of(volume, context), context);
    if (!(way.turned.back() > kVisible)) return std::nullopt;
    const int layers = options.layers.count;
    const double whole = length_between(way, layer_heights({.count = kSteps}));
    const auto loss_of = [&](const std::vector<double>& heights) {
        return 1 - length_between(way, heights) / whole;
    };
    double least = loss_of(layer_heights({.count = layers}));
    std::vector<double> best;
    for (const double pull : kPulls) {
        std::vector<double> heights = drawn_heights(way, layers, pull);
        const double loss = loss_of(heights);
        if (loss > least - kWorth) continue;
        least = loss;
        best = std::move(heights);
    }
    if (best.empty()) return std::nullopt;
    double lowest = 1, highest = 0;
    for (std::size_t k = 1; k < best.size(); ++k) {
        lowest = std::min(lowest, best[k] - best[k - 1]);
        highest = std::max(highest, best[k] - best[k - 1]);
    }
    if (volume.turned_round) reverse_heights(best);
    best.erase(best.begin());
    return DrawnLayers{std::move(best),
                       formatted("layers: {0} as asked, nearer to each other in the bends, from {1:.2g} to "
                                 "{2:.2g} high; heights stay as given: layers = {{ 1/{0}, 2/{0}, …, 1 }} are "
                                 "even ones",
                                 layers, lowest * way.column, highest * way.column)};
}

} // namespace lacuna::sweep
