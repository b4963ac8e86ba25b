// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/shared/constants.h>
#include <lacuna/core/shared/parallel.h>
#include <lacuna/mesh/hex_mesh.h>
#include <lacuna/quality/detail/cell_batch.h>
#include <lacuna/quality/detail/other_cells.h>

#include <algorithm>
#include <cstddef>
#include <span>

/// Access to the cells of a swept mesh, or of a list of cells, as columns. Each level of nodes is loaded once
/// for the cells below and above it. Cell (column, layer) has the number layer · columns + column. Internal
/// to this folder.
namespace lacuna::quality {

using LevelCorners = std::array<const Vec3*, 4>;

/// Cells of a swept mesh: one column for each source quad.
struct SweptCells {
    const mesh::HexMesh& mesh;
    std::size_t hex_columns = mesh.quads.size() - mesh.triangle_count();

    [[nodiscard]] CellKind kind(std::size_t column) const
    {
        return column >= hex_columns ? CellKind::wedge : CellKind::hex;
    }

    [[nodiscard]] std::size_t columns() const { return mesh.quads.size(); }
    [[nodiscard]] std::size_t column_of(std::size_t cell) const { return cell % mesh.quads.size(); }
    [[nodiscard]] std::size_t layers() const { return static_cast<std::size_t>(mesh.layers); }
    /// Corners 0..3 of the cell on `layer`; they are corners 4..7 of the cell below.
    [[nodiscard]] LevelCorners corners(std::size_t column, std::size_t layer) const
    {
        const Quad& q = mesh.quads[column];
        const Vec3* level = mesh.nodes.data() + layer * static_cast<std::size_t>(mesh.nodes_per_layer);
        return {level + q[0], level + q[1], level + q[2], level + q[3]};
    }
};

/// Cells of a list: columns with one cell each.
struct ListedCells {
    std::span<const Vec3> nodes;
    std::span<const Hex> hexes;
    std::span<const Index> swept{}; ///< column of the sweep for each cell; empty: each cell is a column

    [[nodiscard]] std::size_t column_of(std::size_t c) const { return swept.empty() ? c : index(swept[c]); }
    [[nodiscard]] CellKind kind(std::size_t column) const { return kind_of(hexes[column]); }

    [[nodiscard]] std::size_t columns() const { return hexes.size(); }
    [[nodiscard]] std::size_t layers() const { return 1; }
    [[nodiscard]] LevelCorners corners(std::size_t column, std::size_t layer) const
    {
        const Index* corner = hexes[column].data() + 4 * layer;
        const Vec3* first = nodes.data();
        return {first + corner[0], first + corner[1], first + corner[2], first + corner[3]};
    }
};

/// Division of the columns into chunks, one for each partial result. Each has a multiple of `lanes` columns,
/// except the last. Partial results are added in order, so that sums do not depend on the threads.
template <class Cells>
struct Chunks {
    const Cells& cells;
    std::size_t width, count;

    Chunks(const Cells& of, std::size_t lanes)
        : cells(of),
          width(lanes *
                std::max<std::size_t>(1, kBetweenPolls / lanes / std::max<std::size_t>(1, of.layers()))),
          count((of.columns() + width - 1) / width)
    {
    }

    /// Call `body(chunk, first column, last column + 1)` for each chunk, in parallel.
    template <class Body>
    void for_each(const RunContext& context, const Body& body) const
    {
        parallel_each(context, count, 1,
                      [&](std::size_t c) { body(c, c * width, std::min((c + 1) * width, cells.columns())); });
    }
};

/// Load the corners of one level of up to N columns; unused lanes repeat the last column.
template <int N, class Cells>
void load_level(const Cells& cells, std::size_t first, int filled, std::size_t layer, LevelBatch<N>& corner)
{
    for (int lane = 0; lane < N; ++lane) {
        const LevelCorners corners = cells.corners(
            first + static_cast<std::size_t>(std::min(lane, filled - 1)), layer);
        for (std::size_t c = 0; c < 4; ++c)
            for (int d = 0; d < 3; ++d) corner[c][d][lane] = (*corners[c])[d];
    }
}

/// Prefetch the next level while a batch is processed. The levels of a column are far apart in memory, so the
/// processor cannot predict the access.
template <int N, class Cells>
void fetch_after(const Cells& cells, std::size_t first, std::size_t end, std::size_t layer)
{
    const auto fetch = [&](std::size_t begin, std::size_t level) {
        for (std::size_t column = begin; column < std::min(begin + N, end); ++column) {
            const LevelCorners corners = cells.corners(column, level);
            for (const std::size_t c : {0, 2})
                __builtin_prefetch(corners[c]); // the other two corners are loaded for neighbours
        }
    };
    if (layer + 1 < cells.layers()) return fetch(first, layer + 2);
    for (const std::size_t level : {0, 1}) fetch(first + N, level);
}

/// Call `body(batch, first cell, filled lanes)` for the columns [begin, end), from the source upwards: the
/// upper corners of a cell are reused as the lower corners of the next.
template <int N, class Cells, class Body>
void for_each_batch(const Cells& cells, std::size_t begin, std::size_t end, const Body& body)
{
    CellBatch<N> batch;
    for (std::size_t first = begin; first < end; first += N) {
        const int filled = static_cast<int>(std::min<std::size_t>(N, end - first));
        load_level<N>(cells, first, filled, 0, batch.level[batch.low]);
        for (std::size_t layer = 0; layer < cells.layers(); ++layer) {
            if (layer > 0) batch.low = 1 - batch.low;
            load_level<N>(cells, first, filled, layer + 1, batch.level[1 - batch.low]);
            fetch_after<N>(cells, first, end, layer);
            body(batch, layer * cells.columns() + first, filled);
        }
    }
}

template <class Cells>
CellCorners corners_of(const Cells& cells, std::size_t cell)
{
    const std::size_t column = cell % cells.columns(), layer = cell / cells.columns();
    const LevelCorners low = cells.corners(column, layer), high = cells.corners(column, layer + 1);
    return {*low[0], *low[1], *low[2], *low[3], *high[0], *high[1], *high[2], *high[3]};
}

/// Call `body(lane, kind, corners)` for the cells of a batch that are not hexahedra. Their values, computed
/// as for hexahedra, must be replaced.
template <class Cells, class Body>
void for_each_other(const Cells& cells, std::size_t first, int filled, const Body& body)
{
    const std::size_t column = first % cells.columns();
    for (int lane = 0; lane < filled; ++lane) {
        const auto k = static_cast<std::size_t>(lane);
        if (const CellKind kind = cells.kind(column + k); kind != CellKind::hex)
            body(lane, kind, corners_of(cells, first + k));
    }
}

/// Average of the corners of cell `cell`.
template <class Cells>
Vec3 centre_of(const Cells& cells, std::size_t cell)
{
    Vec3 centre(0, 0, 0);
    const CellCorners corners = corners_of(cells, cell);
    const std::span<const std::uint8_t> different = corners_of(cells.kind(cell % cells.columns()));
    for (const std::size_t corner : different) centre += corners[corner] / double(different.size());
    return centre;
}

} // namespace lacuna::quality
