// SPDX-License-Identifier: MIT
#include <lacuna/core/shared/criteria.h>
#include <lacuna/quality/detail/cell_columns.h>
#include <lacuna/quality/detail/worst_list.h>
#include <lacuna/quality/quality.h>
#include <lacuna/quality/shared/second_order.h>

#include <algorithm>
#include <optional>

namespace lacuna::quality {
namespace {

struct Partial {
    double sum = 0;
    double volume = 0;
    std::size_t inverted = 0;
    std::size_t uncertified = 0;
    std::array<std::size_t, 4> count{};      ///< number of cells of each kind except hexahedra
    std::array<double, 4> least{1, 1, 1, 1}; ///< smallest scaled Jacobian of each kind
    std::array<std::uint32_t, 20> histogram{};
    WorstList worst;
};

int bin_of(double scaled) { return std::clamp(static_cast<int>((scaled + 1) * 10), 0, 19); }

using Values = CellValues<kLanes>;
using Signs = std::array<Sign, kLanes>;

/// Replace the values of a lane, for a cell that is not a straight hexahedron.
void put_cell(Values& values, Signs& signs, int lane, double scaled, double volume, bool positive)
{
    values.scaled[lane] = scaled;
    values.volume[lane] = volume;
    values.smallest[lane] = 0; // only its sign is used
    signs[static_cast<std::size_t>(lane)] = positive ? Sign::positive : Sign::not_positive;
}

/// Count the cells that are not positive everywhere.
void count_bad(Partial& partial, const Values& values, const Signs& signs, int filled)
{
    for (int lane = 0; lane < filled; ++lane) {
        const Sign sign = signs[static_cast<std::size_t>(lane)];
        const bool upright = values.scaled[lane] > kRoundoff;
        if (!upright) ++partial.inverted;
        if (upright && (values.smallest[lane] > 0 || sign == Sign::positive)) continue;
        if (!upright || sign == Sign::not_positive ||
            !positive_everywhere(view_of(values, lane), kCertifyDepth))
            ++partial.uncertified;
    }
}

/// Add the cells of a batch; `first` is the number of its first cell. The whole batch is tested first. Single
/// cells are tested only if some cell of the batch fails.
/// @param hexes  whether all cells of the batch are hexahedra
template <class Cells>
void add_batch(Partial& partial, const Cells& cells, const Values& values, const Signs& signs,
               std::size_t first, int filled, bool hexes)
{
    double sum = partial.sum, volume = partial.volume;
    double least = values.scaled[0], most = values.scaled[0];
    bool positive = true;
    for (int lane = 0; lane < filled; ++lane) {
        const double scaled = values.scaled[lane];
        sum += scaled;
        volume += values.volume[lane];
        least = std::min(least, scaled);
        most = std::max(most, scaled);
        positive = positive && scaled > kRoundoff && values.smallest[lane] > 0;
    }
    partial.sum = sum;
    partial.volume = volume;
    const int low = bin_of(least), high = bin_of(most);
    if (low == high) partial.histogram[static_cast<std::size_t>(low)] += static_cast<std::uint32_t>(filled);
    for (int lane = 0; lane < filled && low != high; ++lane)
        ++partial.histogram[static_cast<std::size_t>(bin_of(values.scaled[lane]))];
    const std::size_t end = first + static_cast<std::size_t>(filled);
    for (std::size_t c = first; c < end && partial.worst.takes(least); ++c)
        partial.worst.offer({.cell = c, .scaled_jacobian = values.scaled[c - first]}, cells.column_of(c));
    if (!positive) count_bad(partial, values, signs, filled);
    if (hexes) {
        double& of_hexes = partial.least[static_cast<std::size_t>(CellKind::hex)];
        of_hexes = std::min(of_hexes, least);
        return;
    }
    for (std::size_t c = first; c < end; ++c) {
        double& of_kind = partial.least[static_cast<std::size_t>(cells.kind(c % cells.columns()))];
        of_kind = std::min(of_kind, values.scaled[c - first]);
    }
}

/// For meshes of order 1: no cell is curved.
constexpr auto kNoneCurved = [](std::size_t /*cell*/) { return std::optional<CurvedCell>(); };

/// The judgement of a hexahedron of order 2, if it is curved.
std::optional<CurvedCell> judge_curved(const std::array<Vec3, 27>& nodes)
{
    return is_straight(nodes) ? std::optional<CurvedCell>() : judge(nodes);
}

/// @param curved  returns the judgement of a cell, if it is curved.
/// @param kept    null, or memory for the scaled Jacobian of every cell, if no cell is curved.
template <class Cells, class Curved>
Quality measure_all(const Cells& cells, const Curved& curved, const RunContext& context,
                    float* kept = nullptr)
{
    const std::size_t count = cells.columns() * cells.layers();
    const Chunks chunks{cells, kLanes};
    std::vector<Partial> partials(chunks.count);
    chunks.for_each(context, [&](std::size_t c, std::size_t begin, std::size_t end) {
        Values values;
        for_each_batch<kLanes>(
            cells, begin, end, [&](const CellBatch<kLanes>& batch, std::size_t first, int filled) {
                evaluate(batch, values);
                Signs signs = signs_after_cut(values);
                bool hexes = true;
                for_each_other(cells, first, filled,
                               [&](int lane, CellKind kind, const CellCorners& corners) {
                                   const OtherValues other = evaluate_other(kind, corners);
                                   put_cell(values, signs, lane, other.scaled, other.volume, other.positive);
                                   ++partials[c].count[static_cast<std::size_t>(kind)];
                                   hexes = false;
                               });
                for (int lane = 0; lane < filled; ++lane)
                    if (const auto cell = curved(first + static_cast<std::size_t>(lane)))
                        put_cell(values, signs, lane, cell->scaled_jacobian, cell->volume, cell->positive);
                add_batch(partials[c], cells, values, signs, first, filled, hexes);
                if (kept == nullptr) return;
                std::transform(values.scaled, values.scaled + filled, kept + first,
                               [](double scaled) { return static_cast<float>(scaled); });
            });
    });
    Quality quality;
    quality.hexes = count;
    if (count == 0) return quality;
    double sum = 0;
    WorstList worst;
    for (const Partial& partial : partials) {
        sum += partial.sum;
        quality.volume += partial.volume;
        quality.wedges += partial.count[static_cast<std::size_t>(CellKind::wedge)];
        quality.pyramids += partial.count[static_cast<std::size_t>(CellKind::pyramid)];
        quality.tets += partial.count[static_cast<std::size_t>(CellKind::tet)];
        for (std::size_t k = 0; k < partial.least.size(); ++k)
            quality.least_by_kind[k] = std::min(quality.least_by_kind[k], partial.least[k]);
        quality.inverted += partial.inverted;
        quality.uncertified += partial.uncertified;
        for (std::size_t b = 0; b < quality.histogram.size(); ++b)
            quality.histogram[b] += partial.histogram[b];
        for (const auto& [cell, column] : partial.worst.entries) worst.offer(cell, column);
    }
    quality.hexes -= quality.wedges + quality.pyramids + quality.tets;
    quality.mean_scaled_jacobian = sum / static_cast<double>(count);
    for (const auto& [cell, column] : worst.entries)
        quality.worst.push_back({cell.cell, -1, centre_of(cells, cell.cell), cell.scaled_jacobian});
    quality.min_scaled_jacobian = quality.worst.front().scaled_jacobian;
    return quality;
}

} // namespace

Quality measure(const mesh::HexMesh& mesh, const RunContext& context, Keep keep)
{
    const bool keeps = keep == Keep::of_cells && mesh.order() == 1;
    const auto kept = std::make_shared<std::vector<float>>(keeps ? mesh.cell_count() : 0);
    const auto curved = [&mesh](std::size_t cell) { return judge_curved(hex27_of(mesh, cell)); };
    Quality quality = mesh.order() == 1 ? measure_all(SweptCells{mesh}, kNoneCurved, context,
                                                      keeps ? kept->data() : nullptr)
                                        : measure_all(SweptCells{mesh}, curved, context);
    if (keeps) quality.of_cells = kept;
    for (WorstCell& worst : quality.worst) worst.layer = static_cast<int>(worst.cell / mesh.quads.size());
    return quality;
}

Quality measure_cells(std::span<const Vec3> nodes, std::span<const Hex> hexes, const RunContext& context,
                      std::span<const Index> columns)
{
    return measure_all(ListedCells{nodes, hexes, columns}, kNoneCurved, context);
}

Quality measure_cells(std::span<const Vec3> nodes, std::span<const mesh::CellNodes> cells,
                      const RunContext& context, std::span<const Index> columns)
{
    std::vector<Hex> corners(cells.size());
    for (std::size_t c = 0; c < cells.size(); ++c) std::copy_n(cells[c].node.begin(), 8, corners[c].begin());
    const auto curved = [&](std::size_t cell) { return judge_listed(nodes, cells[cell]); };
    return measure_all(ListedCells{nodes, corners, columns}, curved, context);
}

} // namespace lacuna::quality
