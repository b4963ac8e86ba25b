// SPDX-License-Identifier: MIT
#include <lacuna/quality/cell_batch.h>
#include <lacuna/quality/quality.h>

#include <lacuna/core/parallel.h>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace lacuna::quality {
namespace {

/// Cells of one partial result, about. Partial results are added up in order, so that sums do not depend on
/// which thread did what.
constexpr std::size_t kChunk = 4096;
constexpr std::size_t kWorst = 10;

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
    std::array<std::uint32_t, 20> histogram{};
    WorstList worst;
};

using Corners = std::array<const Vec3*, 4>;

/// Cells of a swept mesh: columns of cells on the source quads.
struct SweptCells {
    const mesh::HexMesh& mesh;

    [[nodiscard]] std::size_t columns() const { return mesh.quads.size(); }
    [[nodiscard]] std::size_t layers() const { return static_cast<std::size_t>(mesh.layers); }
    /// Corners 0..3 of the cell on `layer`, which are 4..7 of the one below.
    [[nodiscard]] Corners corners(std::size_t column, std::size_t layer) const
    {
        const Quad& q = mesh.quads[column];
        const Vec3* level = mesh.nodes.data() + layer * static_cast<std::size_t>(mesh.nodes_per_layer);
        return {level + q[0], level + q[1], level + q[2], level + q[3]};
    }
};

/// Cells of a list: columns of one.
struct ListedCells {
    std::span<const Vec3> nodes;
    std::span<const Hex> hexes;

    [[nodiscard]] std::size_t columns() const { return hexes.size(); }
    [[nodiscard]] std::size_t layers() const { return 1; }
    [[nodiscard]] Corners corners(std::size_t column, std::size_t layer) const
    {
        const Index* corner = hexes[column].data() + 4 * layer;
        const Vec3* first = nodes.data();
        return {first + corner[0], first + corner[1], first + corner[2], first + corner[3]};
    }
};

void add_cell(Partial& partial, const CellValues<kLanes>& values, int lane, std::size_t cell)
{
    const double scaled = values.scaled[lane];
    partial.sum += scaled;
    partial.volume += values.volume[lane];
    const int bin = std::clamp(static_cast<int>((scaled + 1) * 10), 0, 19);
    ++partial.histogram[static_cast<std::size_t>(bin)];
    partial.worst.offer({scaled, cell});

    if (scaled > 0 && values.smallest[lane] > 0) return;
    if (!(scaled > 0)) ++partial.inverted;
    double bezier[27];
    for (int c = 0; c < 27; ++c) bezier[c] = values.bezier[c][lane];
    constexpr int kDepth = 6; // as `certified_positive()`
    if (!(scaled > 0) || !positive_everywhere(bezier, kDepth)) ++partial.uncertified;
}

/// Corners of a level of up to a batch of columns, into `corner[0..3]`; idle lanes repeat the last column.
template <class Cells>
void load_level(const Cells& cells, std::size_t first, int filled, std::size_t layer,
                double (*corner)[3][kLanes])
{
    for (int lane = 0; lane < kLanes; ++lane) {
        const Corners corners = cells.corners(first + static_cast<std::size_t>(std::min(lane, filled - 1)),
                                              layer);
        for (std::size_t c = 0; c < 4; ++c)
            for (int d = 0; d < 3; ++d) corner[c][d][lane] = (*corners[c])[d];
    }
}

/// Columns [begin, end) from the source up: the upper corners of a cell are the lower ones of the next.
template <class Cells>
void measure_columns(const Cells& cells, std::size_t begin, std::size_t end, Partial& partial)
{
    CellBatch<kLanes> batch;
    CellValues<kLanes> values;
    for (std::size_t first = begin; first < end; first += kLanes) {
        const int filled = static_cast<int>(std::min<std::size_t>(kLanes, end - first));
        load_level(cells, first, filled, 0, batch.corner);
        for (std::size_t layer = 0; layer < cells.layers(); ++layer) {
            if (layer > 0) std::memcpy(batch.corner, batch.corner + 4, sizeof batch.corner / 2);
            load_level(cells, first, filled, layer + 1, batch.corner + 4);
            evaluate(batch, values);
            const std::size_t cell = layer * cells.columns() + first;
            for (int lane = 0; lane < filled; ++lane)
                add_cell(partial, values, lane, cell + static_cast<std::size_t>(lane));
        }
    }
}

template <class Cells>
Quality measure_all(const Cells& cells, const RunContext& context)
{
    const std::size_t count = cells.columns() * cells.layers();
    const std::size_t batches = std::max<std::size_t>(1, kChunk / kLanes /
                                                             std::max<std::size_t>(1, cells.layers()));
    const std::size_t width = batches * kLanes; // columns of a partial result
    const std::size_t chunks = (cells.columns() + width - 1) / width;
    std::vector<Partial> partials(chunks);
    parallel_for(context, chunks, 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t c = begin; c < end; ++c)
            measure_columns(cells, c * width, std::min((c + 1) * width, cells.columns()), partials[c]);
    });

    Quality quality;
    quality.hexes = count;
    if (count == 0) return quality;
    double sum = 0;
    WorstList worst;
    for (const Partial& partial : partials) {
        sum += partial.sum;
        quality.volume += partial.volume;
        quality.inverted += partial.inverted;
        quality.uncertified += partial.uncertified;
        for (std::size_t b = 0; b < quality.histogram.size(); ++b)
            quality.histogram[b] += partial.histogram[b];
        for (std::size_t i = 0; i < partial.worst.count; ++i) worst.offer(partial.worst.cells[i]);
    }
    quality.mean_scaled_jacobian = sum / static_cast<double>(count);
    quality.min_scaled_jacobian = worst.cells[0].scaled_jacobian;
    for (std::size_t i = 0; i < worst.count; ++i) {
        WorstCell cell;
        cell.cell = worst.cells[i].cell;
        cell.scaled_jacobian = worst.cells[i].scaled_jacobian;
        const std::size_t layer = cell.cell / cells.columns();
        for (const std::size_t level : {layer, layer + 1})
            for (const Vec3* corner : cells.corners(cell.cell % cells.columns(), level))
                cell.centre += 0.125 * *corner;
        quality.worst.push_back(cell);
    }
    return quality;
}

} // namespace

Quality measure(const mesh::HexMesh& mesh, const RunContext& context)
{
    Quality quality = measure_all(SweptCells{mesh}, context);
    for (WorstCell& worst : quality.worst) worst.layer = static_cast<int>(worst.cell / mesh.quads.size());
    return quality;
}

Quality measure_cells(std::span<const Vec3> nodes, std::span<const Hex> hexes, const RunContext& context)
{
    return measure_all(ListedCells{nodes, hexes}, context);
}

} // namespace lacuna::quality
