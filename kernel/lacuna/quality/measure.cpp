// SPDX-License-Identifier: MIT
#include <lacuna/quality/detail/cell_columns.h>
#include <lacuna/quality/quality.h>
#include <lacuna/quality/second_order.h>

#include <lacuna/core/parallel.h>

#include <algorithm>
#include <cmath>

namespace lacuna::quality {
namespace {

constexpr int kDepth = 6;          ///< as `certified_positive()`
constexpr std::size_t kWorst = 10; ///< as `Quality::worst` promises

struct Ranked {
    double scaled_jacobian;
    std::size_t cell;

    bool operator<(const Ranked& other) const
    {
        return scaled_jacobian != other.scaled_jacobian ? scaled_jacobian < other.scaled_jacobian
                                                        : cell < other.cell;
    }
};

/// The worst few cells, in order.
struct WorstList {
    std::array<Ranked, kWorst> cells{};
    std::size_t count = 0;

    void offer(const Ranked& candidate)
    {
        if (count == kWorst && !(candidate < cells[kWorst - 1])) return;
        if (count < kWorst) ++count;
        std::size_t i = count - 1;
        for (; i > 0 && candidate < cells[i - 1]; --i) cells[i] = cells[i - 1];
        cells[i] = candidate;
    }
};

struct Partial {
    double sum = 0;
    double volume = 0;
    std::size_t inverted = 0;
    std::size_t uncertified = 0;
    std::size_t wedges = 0;
    std::array<std::uint32_t, 20> histogram{};
    WorstList worst;
};

void add_values(Partial& partial, double scaled, double volume, std::size_t cell)
{
    partial.sum += scaled;
    partial.volume += volume;
    const int bin = std::clamp(static_cast<int>((scaled + 1) * 10), 0, 19);
    ++partial.histogram[static_cast<std::size_t>(bin)];
    partial.worst.offer({scaled, cell});
}

/// @param positive  tells whether the cell is, where the smallest coefficient leaves the question open.
template <class Positive>
void add_cell(Partial& partial, double scaled, double smallest, double volume, std::size_t cell,
              const Positive& positive)
{
    add_values(partial, scaled, volume, cell);
    if (scaled > 0 && smallest > 0) return;
    if (!(scaled > 0)) ++partial.inverted;
    if (!(scaled > 0) || !positive()) ++partial.uncertified;
}

void add_hex(Partial& partial, const CellValues<kLanes>& values, int lane, Sign sign, std::size_t cell)
{
    add_cell(partial, values.scaled[lane], values.smallest[lane], values.volume[lane], cell, [&] {
        return sign == Sign::positive ||
               (sign == Sign::open && positive_everywhere(view_of(values, lane), kDepth));
    });
}

/// @return  the scaled Jacobian.
double add_wedge(Partial& partial, const WedgeCorners& corners, std::size_t cell)
{
    const WedgeValues values = evaluate_wedge(corners);
    ++partial.wedges;
    add_cell(partial, values.scaled, values.smallest, values.volume, cell,
             [&] { return positive_everywhere(view_of(over_cube(values)), kDepth); });
    return values.scaled;
}

void add_cell(Partial& partial, const CurvedCell& curved, std::size_t cell)
{
    add_values(partial, curved.scaled_jacobian, curved.volume, cell);
    if (!(curved.scaled_jacobian > 0)) ++partial.inverted;
    if (!curved.positive) ++partial.uncertified;
}

/// Of cells that are all of order 1.
bool none_curved(std::size_t /*cell*/, std::array<Vec3, 27>& /*nodes*/) { return false; }

/// @param curved  tells whether a cell is curved, and sets its nodes if it is.
/// @param kept    null, or room for the scaled Jacobian of every cell, none of which is curved.
template <class Cells, class Curved>
Quality measure_all(const Cells& cells, const Curved& curved, const RunContext& context,
                    float* kept = nullptr)
{
    const std::size_t count = cells.columns() * cells.layers();
    const std::size_t width = chunk_width(cells, kLanes);
    const std::size_t chunks = (cells.columns() + width - 1) / width;
    std::vector<Partial> partials(chunks);
    parallel_for(context, chunks, 1, [&](std::size_t begin, std::size_t end) {
        CellValues<kLanes> values;
        for (std::size_t c = begin; c < end; ++c)
            for_each_batch<kLanes>(
                cells, c * width, std::min((c + 1) * width, cells.columns()),
                [&](const CellBatch<kLanes>& batch, std::size_t first, int filled) {
                    evaluate(batch, values);
                    const std::array<Sign, kLanes> sign = signs_after_cut(values);
                    const std::size_t column = first % cells.columns();
                    std::array<Vec3, 27> nodes;
                    for (int lane = 0; lane < filled; ++lane) {
                        const auto k = static_cast<std::size_t>(lane);
                        if (cells.is_wedge(column + k)) continue;
                        if (curved(first + k, nodes))
                            add_cell(partials[c], judge(nodes), first + k);
                        else
                            add_hex(partials[c], values, lane, sign[k], first + k);
                    }
                    for_each_wedge(cells, first, filled, [&](int lane, const WedgeCorners& corners) {
                        values.scaled[lane] = add_wedge(partials[c], corners,
                                                        first + static_cast<std::size_t>(lane));
                    });
                    if (kept == nullptr) return;
                    for (int lane = 0; lane < filled; ++lane)
                        kept[first + static_cast<std::size_t>(lane)] = static_cast<float>(
                            values.scaled[lane]);
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
        quality.wedges += partial.wedges;
        quality.inverted += partial.inverted;
        quality.uncertified += partial.uncertified;
        for (std::size_t b = 0; b < quality.histogram.size(); ++b)
            quality.histogram[b] += partial.histogram[b];
        for (std::size_t i = 0; i < partial.worst.count; ++i) worst.offer(partial.worst.cells[i]);
    }
    quality.hexes -= quality.wedges;
    quality.mean_scaled_jacobian = sum / static_cast<double>(count);
    quality.min_scaled_jacobian = worst.cells[0].scaled_jacobian;
    for (std::size_t i = 0; i < worst.count; ++i) {
        WorstCell cell;
        cell.cell = worst.cells[i].cell;
        cell.scaled_jacobian = worst.cells[i].scaled_jacobian;
        cell.centre = centre_of(cells, cell.cell);
        quality.worst.push_back(cell);
    }
    return quality;
}

} // namespace

Quality measure(const mesh::HexMesh& mesh, const RunContext& context, Keep keep)
{
    const bool keeps = keep == Keep::of_cells && mesh.order() == 1;
    const auto kept = std::make_shared<std::vector<float>>(keeps ? mesh.cell_count() : 0);
    const auto curved = [&mesh](std::size_t cell, std::array<Vec3, 27>& nodes) {
        nodes = hex27_of(mesh, cell);
        return !is_straight(nodes);
    };
    Quality quality = mesh.order() == 1 ? measure_all(SweptCells{mesh}, none_curved, context,
                                                      keeps ? kept->data() : nullptr)
                                        : measure_all(SweptCells{mesh}, curved, context);
    if (keeps) quality.of_cells = kept;
    for (WorstCell& worst : quality.worst) worst.layer = static_cast<int>(worst.cell / mesh.quads.size());
    return quality;
}

Quality measure_cells(std::span<const Vec3> nodes, std::span<const Hex> hexes, const RunContext& context)
{
    return measure_all(ListedCells{nodes, hexes}, none_curved, context);
}

Quality measure_cells(std::span<const Vec3> nodes, std::span<const mesh::CellNodes> cells,
                      const RunContext& context)
{
    std::vector<Hex> corners(cells.size());
    for (std::size_t c = 0; c < cells.size(); ++c) std::copy_n(cells[c].node.begin(), 8, corners[c].begin());
    const auto curved = [&](std::size_t cell, std::array<Vec3, 27>& places) {
        const std::span<const Index> all = cells[cell].all();
        if (all.size() == 8) return false;
        for (std::size_t n = 0; n < 8; ++n) places[n] = nodes[index(all[n])];
        const std::array<Vec3, 27> straight = mesh::as_hex27(std::span(places).first<8>());
        for (std::size_t n = 8; n < all.size(); ++n)
            places[n] = all[n] < 0 ? straight[n] : nodes[index(all[n])];
        if (all.size() < 27) places = mesh::as_hex27(std::span<const Vec3>(places).first(all.size()));
        return !is_straight(places);
    };
    return measure_all(ListedCells{nodes, corners}, curved, context);
}

} // namespace lacuna::quality
