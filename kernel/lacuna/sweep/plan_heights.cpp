// SPDX-License-Identifier: MIT
#include <lacuna/sweep/detail/plan_heights.h>

#include <lacuna/core/error.h>
#include <lacuna/surface/wall_columns.h>
#include <lacuna/sweep/detail/words.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>
#include <string>
#include <utility>

namespace lacuna::sweep {

using namespace topology;

namespace {

/// Places along each column at which the size is asked: a choice, not a measurement.
constexpr int kSamples = 32;
/// Sizes along the sweep that differ by a smaller share are one, and layers are even: less than can be seen.
constexpr double kSameSize = 1e-3;
/// Heights that walls give are those of an end's rows where each is off by less than this part of its
/// thickness: what rows keep to.
constexpr double kSameRow = 0.02;

/// Chords that say how far a column turns: what bends on less is no bend of the sweep. A choice.
constexpr std::size_t kTurnChords = 8;

/// Steps of a column that show where it bends: 90° on one part in 30 of the way are 22° a step.
constexpr int kBendSteps = 128;
/// What turns further than this in one step is a corner, which no layer rounds [radian]. A choice.
constexpr double kCorner = 40 * std::numbers::pi / 180;
/// Side lines that say where the middle between them is: the fewest that can go round it.
constexpr std::size_t kMiddle = 3;
/// Columns go apart, round the edge of an end, where their middle moves by less than this part of what they
/// do in the mean. A choice, not a measurement.
constexpr double kSlow = 0.7;
/// What all turns may count as beside the whole length, where layers are drawn to bends. A choice: from where
/// they are almost even to where three quarters of them go to the bends.
constexpr std::array<double, 6> kPulls{0.25, 0.5, 1, 1.5, 2, 3};
/// Layers leave their even heights where they then lose and turn less than this share of what they did, in
/// the mean of both. A choice, not a measurement.
constexpr double kWorthMoving = 0.85;

/// What is known of the columns between both rims, in the mean.
struct Columns {
    double length = 0;
    double turning = 0; ///< from the source to the target [radian]
    double sides = 0;   ///< that the size in the middle of each asks for
    /// Sides the size asks for from the source to each of some even steps; empty: it is one along the sweep.
    std::vector<double> wanted;
};

/// How far a column turns on the way: bends between chords, those at both ends like the others [radian].
double turning_of(const std::vector<Vec3>& points)
{
    const std::size_t step = (points.size() - 1) / kTurnChords;
    double sum = 0;
    for (std::size_t i = step; i + step < points.size(); i += step) {
        const Vec3 in = points[i] - points[i - step], out = points[i + step] - points[i];
        sum += std::atan2(in.cross(out).norm(), in.dot(out));
    }
    return sum * kTurnChords / (kTurnChords - 1);
}

/// @param middle  size at the middle of a column. @param size  size all along; null: not asked for.
Columns columns_of(const OpenVolume& volume, const std::vector<surface::LinkingSurface>& links,
                   const surface::SizeField& middle, const surface::SizeField& size)
{
    Columns mean;
    mean.wanted.assign(kSamples + 1, 0.0);
    std::vector<std::vector<Vec3>> columns;
    for (const surface::LinkingSurface& link : links)
        std::ranges::move(surface::wall_columns(volume, link, kSamples), std::back_inserter(columns));
    const auto share = 1 / static_cast<double>(std::max<std::size_t>(columns.size(), 1));
    for (const std::vector<Vec3>& points : columns) {
        double sides = 0, length = 0;
        for (std::size_t i = 1; i < points.size(); ++i) {
            const double step = (points[i] - points[i - 1]).norm();
            length += step;
            if (size) sides += step / size((points[i] + points[i - 1]) / 2);
            mean.wanted[i] += share * sides;
        }
        mean.length += share * length;
        mean.turning += share * turning_of(points);
        mean.sides += share * length / middle(points[kSamples / 2]);
    }
    double least = mean.wanted.back(), most = 0;
    for (std::size_t i = 1; i < mean.wanted.size(); ++i) {
        least = std::min(least, mean.wanted[i] - mean.wanted[i - 1]);
        most = std::max(most, mean.wanted[i] - mean.wanted[i - 1]);
    }
    if (!(most > least * (1 + kSameSize))) mean.wanted.clear();
    return mean;
}

/// How the middle of the columns turns on its way. Columns that round the edge of an end turn each its own
/// way, and their middle does not.
struct Bends {
    double turning = 0;                                  ///< in all, corners left out [radian]
    std::array<double, kBendSteps + 1> turned{};         ///< shares of it up to each even step
    std::vector<std::vector<std::vector<Vec3>>> columns; ///< of each linking surface, in walking order
};

Bends bends_of(const OpenVolume& volume, const std::vector<surface::LinkingSurface>& links)
{
    std::vector<Vec3> middle(kBendSteps + 1, Vec3::Zero());
    double columns = 0, length = 0;
    Bends bends;
    for (const surface::LinkingSurface& own : links) {
        surface::LinkingSurface link = own;
        if (link.lines.size() < kMiddle) link.lines.clear(); // one seam says nothing of the middle
        bends.columns.push_back(surface::wall_columns(volume, link, kBendSteps));
        for (const std::vector<Vec3>& points : bends.columns.back()) {
            ++columns;
            for (std::size_t i = 0; i < middle.size(); ++i) middle[i] += points[i];
            for (std::size_t i = 1; i < middle.size(); ++i) length += (points[i] - points[i - 1]).norm();
        }
    }
    for (Vec3& point : middle) point /= columns;
    const double slow = kSlow * length / columns / kBendSteps;
    for (std::size_t i = 1; i < kBendSteps; ++i) {
        const Vec3 in = middle[i] - middle[i - 1], out = middle[i + 1] - middle[i];
        const double turn = std::atan2(in.cross(out).norm(), in.dot(out));
        if (turn > kCorner || in.norm() < slow || out.norm() < slow) continue;
        bends.turned[i] += turn / 2; // it is spread over the steps beside it
        bends.turned[i + 1] += turn / 2;
        bends.turning += turn;
    }
    for (std::size_t i = 1; i < bends.turned.size(); ++i) bends.turned[i] += bends.turned[i - 1];
    if (bends.turning > 0)
        for (double& turned : bends.turned) turned /= bends.turning;
    return bends;
}

double turned_at(const Bends& bends, double share)
{
    const double at = share * kBendSteps;
    const auto i = std::min(static_cast<std::size_t>(at), static_cast<std::size_t>(kBendSteps - 1));
    return bends.turned[i] + (at - static_cast<double>(i)) * (bends.turned[i + 1] - bends.turned[i]);
}

/// Heights that share out the length and `pull` times the turns.
std::vector<double> drawn_heights(const Bends& bends, std::size_t layers, double pull)
{
    const auto passed = [&](std::size_t step) {
        return static_cast<double>(step) / kBendSteps + pull * bends.turned[step];
    };
    std::vector<double> heights{0};
    std::size_t step = 1;
    for (std::size_t k = 1; k < layers; ++k) {
        const double goal = (1 + pull) * static_cast<double>(k) / static_cast<double>(layers);
        while (passed(step) < goal) ++step;
        const double part = (goal - passed(step - 1)) / (passed(step) - passed(step - 1));
        heights.push_back((static_cast<double>(step - 1) + part) / kBendSteps);
    }
    heights.push_back(1);
    return heights;
}

/// The most that a layer turns [radian].
double most_turn(const Bends& bends, const std::vector<double>& heights)
{
    double most = 0;
    for (std::size_t k = 1; k < heights.size(); ++k)
        most = std::max(most, turned_at(bends, heights[k]) - turned_at(bends, heights[k - 1]));
    return most * bends.turning;
}

/// Volume between the columns where layers have straight sides, but for what the ends add, which is the same
/// for all heights.
double volume_between(const Bends& bends, const std::vector<double>& heights)
{
    const auto place = [](const std::vector<Vec3>& column, double share) -> Vec3 {
        const double at = share * kBendSteps;
        const auto i = std::min(static_cast<std::size_t>(at), static_cast<std::size_t>(kBendSteps - 1));
        return column[i] + (at - static_cast<double>(i)) * (column[i + 1] - column[i]);
    };
    double volume = 0;
    for (const std::vector<std::vector<Vec3>>& columns : bends.columns) {
        const Vec3 origin = columns.front().front();
        for (std::size_t c = 0; c < columns.size(); ++c) {
            const std::vector<Vec3>&left = columns[c], &right = columns[(c + 1) % columns.size()];
            for (std::size_t k = 1; k < heights.size(); ++k) {
                const Vec3 a = place(left, heights[k - 1]) - origin,
                           b = place(right, heights[k - 1]) - origin;
                const Vec3 e = place(right, heights[k]) - origin, d = place(left, heights[k]) - origin;
                // A ruled side: the mean of both ways to halve it.
                volume += (a.dot(b.cross(e)) + a.dot(e.cross(d)) + b.dot(e.cross(d)) + a.dot(b.cross(d))) /
                          12;
            }
        }
    }
    return volume;
}

std::vector<double> even_shares(int count)
{
    std::vector<double> shares;
    for (int i = 0; i <= count; ++i) shares.push_back(static_cast<double>(i) / count);
    return shares;
}

/// Even layers of which some would turn by more than `curvature` sides of a full turn do, moved to the bends
/// where less volume is lost so and none turns by more; else as they are.
std::vector<double> moved_to_bends(const OpenVolume& volume,
                                   const std::vector<surface::LinkingSurface>& links,
                                   const std::vector<double>& even, int curvature)
{
    if (curvature == 0 || even.size() < 3) return even;
    const Bends bends = bends_of(volume, links);
    const double turn = most_turn(bends, even);
    if (!(turn > 2 * std::numbers::pi / curvature)) return even;
    const double whole = volume_between(bends, even_shares(kBendSteps));
    const auto loss_of = [&](const std::vector<double>& heights) {
        return std::abs(whole - volume_between(bends, heights));
    };
    const double loss = loss_of(even);
    double least = 2 * kWorthMoving;
    std::vector<double> best = even;
    for (const double pull : kPulls) {
        std::vector<double> heights = drawn_heights(bends, even.size() - 1, pull);
        const double own_loss = loss_of(heights), own_turn = most_turn(bends, heights);
        const double share = own_loss / loss + own_turn / turn;
        if (own_loss > loss || own_turn > turn || !(share < least)) continue;
        least = share;
        best = std::move(heights);
    }
    return best;
}

/// Layers that the bends of the columns ask for, at `curvature` a full turn.
int bend_layers(const Columns& columns, const SweepOptions& options)
{
    constexpr double kRounding = 1e-6;
    return static_cast<int>(
        std::ceil(columns.turning * options.curvature / (2 * std::numbers::pi) - kRounding));
}

/// Layers about as high as the quads are wide, `least` at least. @throw InvalidInput  more than can be
/// numbered.
std::vector<double> default_heights(const Columns& columns, LayerSpec spec, int least)
{
    if (!(columns.sides < std::numeric_limits<Index>::max() / 16.0)) {
        throw InvalidInput("sweep.too_many", "about " + in_short(columns.sides) +
                                                 " layers would be needed at the size; give 'layers'");
    }
    spec.count = std::max(least, static_cast<int>(std::lround(columns.sides)));
    return layer_heights(spec);
}

/// Sides wanted up to a share of the columns.
double wanted_at(const Columns& columns, double share)
{
    const double at = share * kSamples;
    const auto i = std::min(static_cast<std::size_t>(at), columns.wanted.size() - 2);
    return columns.wanted[i] + (at - static_cast<double>(i)) * (columns.wanted[i + 1] - columns.wanted[i]);
}

/// Heights between two shares of the columns that follow the size.
std::vector<double> following_heights(const Columns& columns, double from, double to, int least)
{
    const double low = wanted_at(columns, from), high = wanted_at(columns, to);
    const int count = std::max({1, least, static_cast<int>(std::lround(high - low))});
    std::vector<double> heights{from};
    std::size_t i = 0;
    for (int k = 1; k < count; ++k) {
        const double sides = low + (high - low) * k / count;
        while (i + 2 < columns.wanted.size() && columns.wanted[i + 1] < sides) ++i;
        heights.push_back((static_cast<double>(i) +
                           (sides - columns.wanted[i]) / (columns.wanted[i + 1] - columns.wanted[i])) /
                          kSamples);
    }
    heights.push_back(to);
    return heights;
}

/// Table of an end, or null.
const std::vector<double>* end_table(const OpenVolume& volume, const surface::LayerTables& tables, Role end)
{
    for (const auto& [face, table] : tables.of) {
        if (volume.role[face.index()] == end) return &tables.heights[static_cast<std::size_t>(table)];
    }
    return nullptr;
}

/// Whether heights that walls give have the rows of the ends already.
bool has_rows(const std::vector<double>& heights, const std::vector<double>* low,
              const std::vector<double>* high, double length)
{
    const std::size_t below = low != nullptr ? low->size() : 0, above = high != nullptr ? high->size() : 0;
    if (heights.size() < below + above + 2) return false;
    const auto has = [&](const std::vector<double>* rows, const auto& at) {
        for (std::size_t j = 0; rows != nullptr && j < rows->size(); ++j) {
            const double thick = (*rows)[j] - (j > 0 ? (*rows)[j - 1] : 0);
            if (std::abs(at(j + 1) * length - (*rows)[j]) > kSameRow * thick) return false;
        }
        return true;
    };
    return has(low, [&](std::size_t j) { return heights[j]; }) &&
           has(high, [&](std::size_t j) { return 1 - heights[heights.size() - 1 - j]; });
}

/// The layers between those of the ends, over the whole of what these leave: from 0 to 1.
std::vector<double> layers_between(const OpenVolume& volume, const SweepOptions& options, int taken)
{
    LayerSpec spec = options.layers;
    if (!spec.heights.empty()) {
        throw InvalidInput("sweep.layers",
                           "sweep: option 'layers' gives heights, and boundary layers of an end give others; "
                           "leave out one of them");
    }
    if (spec.count == 0) {
        throw NotSweepable("sweep.layers",
                           "quads that walls came with give the heights of layers, and boundary layers of an "
                           "end give others; leave the end out of 'boundary_layers', or load with "
                           "keep_mesh = false");
    }
    if (spec.count <= taken) {
        throw InvalidInput("sweep.layers", "sweep: option 'layers' asks for " + std::to_string(spec.count) +
                                               ", and boundary layers of the ends take " +
                                               std::to_string(taken) + " of them; ask for " +
                                               std::to_string(taken + 1) + " or more, or leave it out");
    }
    spec.count -= taken;
    std::vector<double> heights = layer_heights(spec);
    if (volume.turned_round) {
        std::reverse(heights.begin(), heights.end());
        for (double& h : heights) h = 1 - h;
    }
    return heights;
}

} // namespace

PlannedHeights plan_heights(const OpenVolume& volume, const std::vector<surface::LinkingSurface>& links,
                            const surface::LayerTables& tables, const std::vector<double>& asked,
                            const surface::SizeField& size, const SweepOptions& options, int least, bool even)
{
    const std::vector<double>* const low = end_table(volume, tables, Role::source);
    const std::vector<double>* const high = end_table(volume, tables, Role::target);
    if (low == nullptr && high == nullptr && !asked.empty()) {
        if (!even) return {asked, false};
        return {moved_to_bends(volume, links, asked, options.curvature), false};
    }
    const Columns columns = columns_of(volume, links, size, options.size);
    const int bends = asked.empty() ? bend_layers(columns, options) : 0;
    const bool by_bends = bends > std::max(least, static_cast<int>(std::lround(columns.sides)));
    least = std::max(least, bends);
    if (low == nullptr && high == nullptr) {
        if (columns.wanted.empty()) return {default_heights(columns, options.layers, least), by_bends};
        return {following_heights(columns, 0, 1, least), by_bends};
    }
    const double below = low != nullptr ? low->back() : 0, above = high != nullptr ? high->back() : 0;
    if (!(below + above < columns.length)) {
        throw NotSweepable("sweep.layers_room",
                           "the boundary layers of the ends are " + in_short(below + above) +
                               " high in all, and source and target " + in_short(columns.length) +
                               " apart; ask for fewer or thinner ones");
    }
    const double from = below / columns.length, to = 1 - above / columns.length;
    const int taken = static_cast<int>((low != nullptr ? low->size() : 0) +
                                       (high != nullptr ? high->size() : 0));
    if (!asked.empty() && options.layers.heights.empty() && has_rows(asked, low, high, columns.length))
        return {asked, false};
    std::vector<double> between;
    if (!asked.empty()) {
        between = layers_between(volume, options, taken);
    } else if (columns.wanted.empty()) {
        LayerSpec spec = options.layers;
        const std::size_t all = default_heights(columns, spec, 1).size() - 1;
        spec.count = std::max(
            {1, least - taken, static_cast<int>(std::lround((to - from) * static_cast<double>(all)))});
        between = layer_heights(spec);
    } else {
        between = following_heights(columns, from, to, least - taken);
        for (double& h : between) h = (h - from) / (to - from);
    }
    std::vector<double> heights{0};
    for (std::size_t j = 0; low != nullptr && j + 1 < low->size(); ++j)
        heights.push_back((*low)[j] / columns.length);
    for (std::size_t k = low != nullptr ? 0 : 1; k < between.size(); ++k)
        heights.push_back(from + between[k] * (to - from));
    for (std::size_t j = high != nullptr ? high->size() - 1 : 0; j-- > 0;)
        heights.push_back(1 - (*high)[j] / columns.length);
    if (high != nullptr) heights.push_back(1);
    return {std::move(heights), by_bends};
}

} // namespace lacuna::sweep
