// SPDX-License-Identifier: MIT
#include <lacuna/sweep/detail/plan_heights.h>

#include <lacuna/core/error.h>
#include <lacuna/core/shared/criteria.h>
#include <lacuna/core/shared/limits.h>
#include <lacuna/geometry/shared/angle.h>
#include <lacuna/surface/shared/swept_motion.h>
#include <lacuna/surface/shared/wall_columns.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

namespace lacuna::sweep {

using namespace topology;

namespace {

/// Values averaged over the columns between both rims.
struct Columns {
    double length = 0;
    double turning = 0; ///< total turning from the source to the target [radian]
    double sides = 0;   ///< number of layers required by the size in the middle of each column
    /// For evenly spaced positions, the number of layers that the size requires between the source and this
    /// position; empty: the size is constant along the sweep.
    std::vector<double> wanted;
};

/// Turning angle of a column [radian]: the sum of the bends between chords. The bends at both ends are
/// estimated from their neighbours.
double turning_of(const std::vector<Vec3>& points)
{
    const std::size_t step = (points.size() - 1) / kChords;
    double sum = 0;
    for (std::size_t i = step; i + step < points.size(); i += step) {
        const Vec3 in = points[i] - points[i - step], out = points[i + step] - points[i];
        sum += geometry::angle_between(in, out);
    }
    return sum * kChords / (kChords - 1);
}

/// @param middle  size in the middle of a column. @param size  size along the columns; null: constant.
Columns columns_of(const OpenVolume& volume, const std::vector<surface::LinkingSurface>& links,
                   const surface::SizeField& middle, const surface::SizeField& size,
                   const RunContext& context)
{
    Columns mean;
    mean.wanted.assign(kFineChords + 1, 0.0);
    std::vector<std::vector<Vec3>> columns;
    for (const surface::LinkingSurface& link : links)
        std::ranges::move(surface::wall_columns(volume, link, kFineChords, context),
                          std::back_inserter(columns));
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
        mean.sides += share * length / middle(points[kFineChords / 2]);
    }
    double least = mean.wanted.back(), most = 0;
    for (std::size_t i = 1; i < mean.wanted.size(); ++i) {
        least = std::min(least, mean.wanted[i] - mean.wanted[i - 1]);
        most = std::max(most, mean.wanted[i] - mean.wanted[i - 1]);
    }
    if (!(most > least * (1 + kVisible))) mean.wanted.clear();
    return mean;
}

/// Number of layers that the bends of the columns require, with `curvature` layers for a full turn.
int bend_layers(const Columns& columns, const SweepOptions& options)
{
    return static_cast<int>(std::ceil(columns.turning * options.curvature / kFullTurn - kFileAccuracy));
}

/// Heights of at least `least` layers that are about as high as the quads are wide. @throw InvalidInput
/// there are more layers than node numbers allow.
std::vector<double> default_heights(const Columns& columns, LayerSpec spec, int least)
{
    if (!(columns.sides < std::numeric_limits<Index>::max() / 16.0)) {
        throw InvalidInput(Message("sweep.too_many",
                                   "this size needs about {:.2g} layers, more than node numbers allow",
                                   needed(columns.sides))
                               .remedy("give 'layers' or a larger 'size'"));
    }
    spec.count = std::max(least, static_cast<int>(std::lround(columns.sides)));
    return layer_heights(spec);
}

/// Number of layers that the size requires between the source and a share of the columns' length.
double wanted_at(const Columns& columns, double share)
{
    const double at = share * kFineChords;
    const auto i = std::min(static_cast<std::size_t>(at), columns.wanted.size() - 2);
    return columns.wanted[i] + (at - static_cast<double>(i)) * (columns.wanted[i + 1] - columns.wanted[i]);
}

/// Heights of layers between two shares of the columns' length. Their spacing follows the size.
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
                          kFineChords);
    }
    heights.push_back(to);
    return heights;
}

/// Boundary layers of an end as heights; empty: none.
std::vector<double> end_table(const OpenVolume& volume, const surface::LayerTables& tables, Role end)
{
    for (const auto& [face, table] : tables.of) {
        if (volume.role[face.index()] == end) return tables.heights[index(table)];
    }
    return {};
}

/// Whether the heights given by meshes of walls already contain the boundary layers of the ends.
bool has_rows(const std::vector<double>& heights, const std::vector<double>& low,
              const std::vector<double>& high, double length)
{
    if (heights.size() < low.size() + high.size() + 2) return false;
    const auto has = [&](const std::vector<double>& rows, const auto& at) {
        for (std::size_t j = 0; j < rows.size(); ++j) {
            const double thick = rows[j] - (j > 0 ? rows[j - 1] : 0);
            if (std::abs(at(j + 1) * length - rows[j]) > kVolumeNoted * thick) return false;
        }
        return true;
    };
    return has(low, [&](std::size_t j) { return heights[j]; }) &&
           has(high, [&](std::size_t j) { return 1 - heights[heights.size() - 1 - j]; });
}

/// Layers between the boundary layers of both ends, as heights from 0 to 1 over the remaining length.
std::vector<double> layers_between(const OpenVolume& volume, const SweepOptions& options, int taken)
{
    LayerSpec spec = options.layers;
    if (!spec.heights.empty()) {
        throw InvalidInput(
            Message("sweep.layers",
                    "sweep: option 'layers' gives heights, and so do the boundary layers of an end")
                .remedy("leave one of them out"));
    }
    if (spec.count == 0) {
        throw NotSweepable(Message("sweep.layers", "given quads of walls determine the heights of layers, "
                                                   "and so do the boundary layers of an end")
                               .remedy("leave the end out of 'boundary_layers'{}",
                                       options.beside.own_mesh ? ", or load with keep_mesh = false" : ""));
    }
    if (spec.count <= taken) {
        throw InvalidInput(
            Message("sweep.layers",
                    "sweep: option 'layers' asks for {}, but the boundary layers of the ends already take {}",
                    found(spec.count), taken)
                .remedy("ask for {} or more, or leave it out", needed(taken + 1)));
    }
    spec.count -= taken;
    std::vector<double> heights = layer_heights(spec);
    if (volume.turned_round) reverse_heights(heights);
    return heights;
}

/// For each corner of a path, move the layer nearest to it onto the corner. Layers between corners are moved
/// in proportion.
/// @throw NotSweepable  the path has more parts than there are layers.
std::vector<double> through_corners(const std::vector<double>& heights, const std::vector<double>& levels)
{
    const std::size_t layers = heights.size() - 1, parts = levels.size() - 1;
    if (layers < parts)
        throw NotSweepable(
            Message("sweep.path_layers",
                    "every part of the path, from corner to corner, needs a layer: at least {} are "
                    "needed, found {}",
                    needed(parts), found(layers))
                .remedy("leave out 'layers', or give a smooth path as a function"));
    std::vector<double> moved{0};
    std::size_t below = 0;
    for (std::size_t j = 1; j <= parts; ++j) {
        const auto above = std::ranges::lower_bound(heights, levels[j]) - heights.begin();
        auto at = static_cast<std::size_t>(above);
        if (at > 0 && at < layers && levels[j] - heights[at - 1] < heights[at] - levels[j]) --at;
        at = j == parts ? layers : std::clamp(at, below + 1, layers - (parts - j));
        for (std::size_t k = below + 1; k < at; ++k)
            moved.push_back(levels[j - 1] + (heights[k] - heights[below]) / (heights[at] - heights[below]) *
                                                (levels[j] - levels[j - 1]));
        moved.push_back(levels[j]);
        below = at;
    }
    return moved;
}

/// As `plan_heights()`, but the corners of a path are ignored.
PlannedHeights planned_heights(const OpenVolume& volume, const std::vector<surface::LinkingSurface>& links,
                               const surface::LayerTables& tables, const std::vector<double>& asked,
                               const SourceSize& sizes, const SweepOptions& options, int least,
                               const RunContext& context)
{
    const std::vector<double> low = end_table(volume, tables, Role::source);
    const std::vector<double> high = end_table(volume, tables, Role::target);
    const bool rows = !low.empty() || !high.empty();
    if (!rows && !asked.empty()) return {asked, false};
    const Columns columns = columns_of(volume, links, sizes.along, options.size, context);
    const int bends = asked.empty() ? bend_layers(columns, options) : 0;
    const int by_size = std::max(least, static_cast<int>(std::lround(columns.sides)));
    least = std::max(least, bends);
    if (asked.empty() && sizes.layers) least = std::max(least, sizes.layers(std::max(least, by_size)));
    const bool by_bends = least > by_size;
    if (!rows) {
        if (columns.wanted.empty()) return {default_heights(columns, options.layers, least), by_bends};
        return {following_heights(columns, 0, 1, least), by_bends};
    }
    const double below = low.empty() ? 0 : low.back(), above = high.empty() ? 0 : high.back();
    if (!(below + above < columns.length)) {
        throw NotSweepable(Message("sweep.layers_room",
                                   "the boundary layers of the ends are {:.2g} high in total, but source and "
                                   "target are only {:.2g} apart",
                                   needed(below + above), found(columns.length))
                               .remedy("use fewer or thinner ones"));
    }
    const double from = below / columns.length, to = 1 - above / columns.length;
    const int taken = static_cast<int>(low.size() + high.size());
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
    for (std::size_t j = 0; j + 1 < low.size(); ++j) heights.push_back(low[j] / columns.length);
    for (std::size_t k = low.empty() ? 1 : 0; k < between.size(); ++k)
        heights.push_back(from + between[k] * (to - from));
    for (std::size_t j = high.size(); j > 1; --j) heights.push_back(1 - high[j - 2] / columns.length);
    if (!high.empty()) heights.push_back(1);
    return {std::move(heights), by_bends};
}

} // namespace

void reverse_heights(std::vector<double>& heights)
{
    std::ranges::reverse(heights);
    for (double& height : heights) height = 1 - height;
}

PlannedHeights plan_heights(const OpenVolume& volume, const std::vector<surface::LinkingSurface>& links,
                            const surface::LayerTables& tables, const std::vector<double>& asked,
                            const SourceSize& sizes, const SweepOptions& options, int least,
                            const RunContext& context)
{
    const geometry::MotionPointer motion = surface::swept_motion(volume);
    const std::size_t parts = motion ? motion->levels.size() - 1 : 1;
    PlannedHeights planned = planned_heights(volume, links, tables, asked, sizes, options,
                                             std::max(least, static_cast<int>(parts)), context);
    if (parts > 1) planned.heights = through_corners(planned.heights, motion->levels);
    return planned;
}

} // namespace lacuna::sweep
