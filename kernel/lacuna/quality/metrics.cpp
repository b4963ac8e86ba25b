// SPDX-License-Identifier: MIT
#include <lacuna/core/shared/criteria.h>
#include <lacuna/core/shared/limits.h>
#include <lacuna/core/shared/parallel.h>
#include <lacuna/quality/detail/cell_columns.h>
#include <lacuna/quality/detail/cell_metrics.h>
#include <lacuna/quality/shared/metrics.h>
#include <lacuna/quality/shared/second_order.h>

#include <array>
#include <cmath>
#include <limits>
#include <numeric>

namespace lacuna::quality {
namespace {

constexpr Range kAny{};
constexpr Range kUnit{0, 1};
constexpr Range kFromZero{0, kInfinity};
constexpr Range kFromOne{1, kInfinity};
constexpr std::optional<Range> kNone{};

constexpr std::array<MetricInfo, kMetricCount> kInfos{{
    {Metric::scaled_jacobian, "scaled_jacobian", {-1, 1}, Range{0.5, 1}, true, false},
    {Metric::scaled_jacobian_with_centre, "scaled_jacobian_with_centre", {-1, 1}, Range{0.5, 1}, true, false},
    {Metric::jacobian, "jacobian", kAny, kNone, true, false},
    {Metric::shape, "shape", kUnit, Range{0.3, 1}, true, false},
    {Metric::shear, "shear", kUnit, Range{0.3, 1}, true, false},
    {Metric::condition, "condition", kFromOne, Range{1, 8}, false, false},
    {Metric::max_aspect_frobenius, "max_aspect_frobenius", kFromOne, Range{1, 3}, false, false},
    {Metric::med_aspect_frobenius, "med_aspect_frobenius", kFromOne, Range{1, 3}, false, false},
    {Metric::oddy, "oddy", kFromZero, Range{0, 0.5}, false, false},
    {Metric::skew, "skew", kUnit, Range{0, 0.5}, false, false},
    {Metric::taper, "taper", kFromZero, Range{0, 0.4}, false, false},
    {Metric::max_edge_ratio, "max_edge_ratio", kFromOne, Range{1, 4}, false, false},
    {Metric::edge_ratio, "edge_ratio", kFromZero, kNone, false, false},
    {Metric::full_edge_ratio, "full_edge_ratio", kFromOne, kNone, false, false},
    {Metric::stretch, "stretch", kUnit, Range{0.25, 1}, true, false},
    {Metric::diagonal, "diagonal", kUnit, Range{0.65, 1}, true, false},
    {Metric::dimension, "dimension", kFromZero, kNone, true, false},
    {Metric::volume, "volume", kAny, kNone, true, false},
    {Metric::distortion, "distortion", kUnit, Range{0.6, 1}, true, false},
    {Metric::relative_size_squared, "relative_size_squared", kUnit, Range{0.5, 1}, true, true},
    {Metric::shape_and_size, "shape_and_size", kUnit, Range{0.2, 1}, true, true},
    {Metric::shear_and_size, "shear_and_size", kUnit, Range{0.2, 1}, true, true},
}};

/// Statistics of some cells; those of several parts are merged in order.
struct Tally {
    std::size_t count = 0, outside = 0, worst = 0;
    double min = kInfinity, max = -kInfinity, mean = 0;
    double squares = 0; ///< sum of squared distances from the mean
    double badness = -kInfinity;

    void add(double value, std::size_t cell, const MetricInfo& info)
    {
        if (std::isnan(value)) return;
        ++count;
        const double distance = value - mean;
        mean += distance / static_cast<double>(count);
        squares += distance * (value - mean);
        min = std::min(min, value);
        max = std::max(max, value);
        // Rounding may put a cube's metrics slightly outside their range.
        if (info.acceptable &&
            !(value >= info.acceptable->low - kRoundoff && value <= info.acceptable->high + kRoundoff))
            ++outside;
        const double bad = info.larger_is_better ? -value : value;
        if (bad > badness || (bad == badness && cell < worst)) {
            badness = bad;
            worst = cell;
        }
    }
    void add(const Tally& other)
    {
        if (other.count == 0) return;
        const auto ours = static_cast<double>(count);
        const auto theirs = static_cast<double>(other.count);
        const double distance = other.mean - mean;
        count += other.count;
        mean += distance * (theirs / (ours + theirs));
        squares += other.squares + distance * distance * (ours * theirs / (ours + theirs));
        min = std::min(min, other.min);
        max = std::max(max, other.max);
        outside += other.outside;
        if (other.badness > badness || (other.badness == badness && other.worst < worst)) {
            badness = other.badness;
            worst = other.worst;
        }
    }
};

/// Store the metrics of a cell that is not a hexahedron in a lane; NaN for a metric that only hexahedra have.
void put_other(std::span<const Metric> metrics, CellKind kind, const CellCorners& corners, double* values)
{
    const OtherValues own = evaluate_other(kind, corners);
    for (std::size_t m = 0; m < metrics.size(); ++m)
        values[m * kMetricLanes] =
            other_metric(metrics[m], own).value_or(std::numeric_limits<double>::quiet_NaN());
}

/// Call `body(chunk, first cell, filled lanes, values)` for every batch of every chunk, chunks in parallel.
template <class Cells, class Body>
void for_each_value(const Cells& cells, std::span<const Metric> metrics, double average_volume,
                    const RunContext& context, const Body& body)
{
    Chunks{cells, kMetricLanes}.for_each(context, [&](std::size_t c, std::size_t begin, std::size_t end) {
        std::vector<double> values(metrics.size() * kMetricLanes);
        for_each_batch<kMetricLanes>(
            cells, begin, end, [&](const CellBatch<kMetricLanes>& batch, std::size_t first, int filled) {
                evaluate_metrics(batch, metrics, average_volume, values.data());
                for_each_other(cells, first, filled,
                               [&](int lane, CellKind kind, const CellCorners& corners) {
                                   put_other(metrics, kind, corners, values.data() + lane);
                               });
                body(c, first, filled, values.data());
            });
    });
}

template <class Cells>
std::vector<Tally> tally(const Cells& cells, std::span<const Metric> metrics, double average_volume,
                         const RunContext& context)
{
    const std::size_t chunks = Chunks{cells, kMetricLanes}.count;
    std::vector<Tally> parts(chunks * metrics.size());
    for_each_value(cells, metrics, average_volume, context,
                   [&](std::size_t chunk, std::size_t first, int filled, const double* values) {
                       for (std::size_t m = 0; m < metrics.size(); ++m) {
                           const MetricInfo& info = metric_info(metrics[m]);
                           for (int lane = 0; lane < filled; ++lane)
                               parts[chunk * metrics.size() + m].add(
                                   values[m * kMetricLanes + static_cast<std::size_t>(lane)],
                                   first + static_cast<std::size_t>(lane), info);
                       }
                   });
    std::vector<Tally> sums(metrics.size());
    for (std::size_t c = 0; c < chunks; ++c)
        for (std::size_t m = 0; m < metrics.size(); ++m) sums[m].add(parts[c * metrics.size() + m]);
    return sums;
}

/// Consecutive cells in a layer of a swept mesh.
struct CellsInRow {
    SweptCells all;
    std::size_t first, layer, count;

    [[nodiscard]] CellKind kind(std::size_t column) const { return all.kind(first + column); }
    [[nodiscard]] std::size_t columns() const { return count; }
    [[nodiscard]] std::size_t layers() const { return 1; }
    [[nodiscard]] LevelCorners corners(std::size_t column, std::size_t above) const
    {
        return all.corners(first + column, layer + above);
    }
};

/// Sum of the metric `volume` over cells.
template <class Cells>
double sum_of_volumes(const Cells& cells, const RunContext& context)
{
    const Metric volume = Metric::volume;
    std::vector<double> sums(Chunks{cells, kMetricLanes}.count, 0.0);
    for_each_value(cells, {&volume, 1}, 1, context,
                   [&](std::size_t chunk, std::size_t, int filled, const double* values) {
                       for (int lane = 0; lane < filled; ++lane) sums[chunk] += values[lane];
                   });
    return std::accumulate(sums.begin(), sums.end(), 0.0);
}

double average_volume(const SweptCells& cells, const RunContext& context)
{
    return mean_volume(layer_volumes(cells.mesh, context), cells.mesh.cell_count());
}

double average_volume(const ListedCells& cells, const RunContext& context)
{
    return mean_volume(std::vector<double>{sum_of_volumes(cells, context)}, cells.columns());
}

/// Mean volume of the cells if a metric needs it; otherwise 1.
template <class Cells>
double average_volume_of(const Cells& cells, std::span<const Metric> metrics, const RunContext& context)
{
    const bool needed = std::any_of(metrics.begin(), metrics.end(),
                                    [](Metric m) { return metric_info(m).needs_average_volume; });
    return needed ? average_volume(cells, context) : 1;
}

template <class Cells>
std::vector<MetricSummary> measure_all(const Cells& cells, std::span<const Metric> metrics,
                                       const RunContext& context)
{
    const double average = average_volume_of(cells, metrics, context);
    const std::vector<Tally> sums = tally(cells, metrics, average, context);
    std::vector<MetricSummary> summaries(metrics.size());
    for (std::size_t m = 0; m < metrics.size(); ++m) {
        MetricSummary& summary = summaries[m];
        const Tally& sum = sums[m];
        summary.metric = metrics[m];
        summary.cells = sum.count;
        if (sum.count == 0) continue;
        const auto count = static_cast<double>(sum.count);
        summary.min = sum.min;
        summary.mean = sum.mean;
        summary.max = sum.max;
        summary.deviation = std::sqrt(sum.squares / count);
        summary.outside = sum.outside;
        summary.outside_share = static_cast<double>(sum.outside) / count;
        summary.worst = sum.worst;
        summary.centre = centre_of(cells, sum.worst);
        summary.value = metric_info(metrics[m]).larger_is_better ? sum.min : sum.max;
    }
    return summaries;
}

/// Rounded as in `Quality::of_cells`.
double in_single_precision(double value) { return static_cast<double>(static_cast<float>(value)); }

/// Scaled Jacobians of the columns [begin, end), stored by cell number. Every written mesh has them, so this
/// fast path omits the data of other metrics.
template <class Cells>
void put_scaled_jacobians(const Cells& cells, std::size_t begin, std::size_t end, double* out)
{
    double scaled[kLanes];
    for_each_batch<kLanes>(
        cells, begin, end, [&](const CellBatch<kLanes>& batch, std::size_t first, int filled) {
            evaluate_scaled(batch, scaled);
            for_each_other(cells, first, filled, [&](int lane, CellKind kind, const CellCorners& corners) {
                scaled[lane] = evaluate_other(kind, corners).scaled;
            });
            std::transform(scaled, scaled + filled, out + first, in_single_precision);
        });
}

template <class Cells>
std::vector<double> scaled_jacobians(const Cells& cells, const RunContext& context)
{
    std::vector<double> result(cells.columns() * cells.layers());
    Chunks{cells, kLanes}.for_each(context, [&](std::size_t, std::size_t begin, std::size_t end) {
        put_scaled_jacobians(cells, begin, end, result.data());
    });
    return result;
}

/// Selected cells of a swept mesh as a list.
struct PickedCells {
    SweptCells all;
    std::span<const std::uint32_t> cells;
    std::uint32_t width = static_cast<std::uint32_t>(all.columns());

    [[nodiscard]] CellKind kind(std::size_t column) const { return all.kind(cells[column] % width); }
    [[nodiscard]] std::size_t columns() const { return cells.size(); }
    [[nodiscard]] std::size_t layers() const { return 1; }
    [[nodiscard]] LevelCorners corners(std::size_t column, std::size_t layer) const
    {
        return all.corners(cells[column] % width, cells[column] / width + layer);
    }
};

template <class Cells>
std::vector<double> values_of(const Cells& cells, Metric metric, std::optional<double> average_volume,
                              const RunContext& context)
{
    if (metric == Metric::scaled_jacobian) return scaled_jacobians(cells, context);
    const double average = average_volume ? *average_volume : average_volume_of(cells, {&metric, 1}, context);
    std::vector<double> result(cells.columns() * cells.layers());
    for_each_value(cells, {&metric, 1}, average, context,
                   [&](std::size_t, std::size_t first, int filled, const double* values) {
                       std::transform(values, values + filled, result.data() + first,
                                      [](double value) { return std::isnan(value) ? 0 : value; });
                   });
    return result;
}

} // namespace

const MetricInfo& metric_info(Metric metric) { return kInfos[static_cast<std::size_t>(metric)]; }

std::span<const MetricInfo, kMetricCount> metric_infos() { return kInfos; }

std::vector<MetricSummary> measure_metrics(const mesh::HexMesh& mesh, std::span<const Metric> metrics,
                                           const RunContext& context)
{
    std::vector<MetricSummary> summaries = measure_all(SweptCells{mesh}, metrics, context);
    if (mesh.cell_count() > 0)
        for (MetricSummary& summary : summaries)
            summary.layer = static_cast<int>(summary.worst / mesh.quads.size());
    return summaries;
}

std::vector<MetricSummary> measure_metrics(std::span<const Vec3> nodes, std::span<const Hex> hexes,
                                           std::span<const Metric> metrics, const RunContext& context)
{
    return measure_all(ListedCells{nodes, hexes}, metrics, context);
}

std::vector<double> layer_volumes(const mesh::HexMesh& mesh, const RunContext& context)
{
    const SweptCells all{mesh};
    std::vector<double> sums;
    for (std::size_t layer = 0; layer < all.layers(); ++layer)
        sums.push_back(sum_of_volumes(CellsInRow{all, 0, layer, all.columns()}, context));
    return sums;
}

double mean_volume(std::span<const double> layers, std::size_t cells)
{
    return cells > 0 ? std::accumulate(layers.begin(), layers.end(), 0.0) / static_cast<double>(cells) : 0;
}

std::vector<double> metric_values(const mesh::HexMesh& mesh, Metric metric, const RunContext& context,
                                  std::optional<double> average_volume)
{
    std::vector<double> values = values_of(SweptCells{mesh}, metric, average_volume, context);
    if (mesh.order() == 1 || metric != Metric::scaled_jacobian) return values;
    parallel_each(context, values.size(), kPerTask, [&](std::size_t c) {
        const std::array<Vec3, 27> nodes = hex27_of(mesh, c);
        if (!is_straight(nodes)) values[c] = in_single_precision(judge(nodes, 0).scaled_jacobian);
    });
    return values;
}

void scaled_jacobians(const mesh::HexMesh& mesh, std::span<const std::uint32_t> cells, double* out)
{
    const SweptCells all{mesh};
    const bool in_row = std::adjacent_find(cells.begin(), cells.end(), [](std::uint32_t a, std::uint32_t b) {
                            return b != a + 1;
                        }) == cells.end();
    if (!in_row) return put_scaled_jacobians(PickedCells{all, cells}, 0, cells.size(), out);
    for (std::size_t done = 0; done < cells.size();) {
        const std::size_t first = cells[done] % all.columns(), layer = cells[done] / all.columns();
        const std::size_t count = std::min(cells.size() - done, all.columns() - first);
        put_scaled_jacobians(CellsInRow{all, first, layer, count}, 0, count, out + done);
        done += count;
    }
}

std::vector<double> metric_values(std::span<const Vec3> nodes, std::span<const Hex> hexes, Metric metric,
                                  const RunContext& context)
{
    return values_of(ListedCells{nodes, hexes}, metric, std::nullopt, context);
}

} // namespace lacuna::quality
