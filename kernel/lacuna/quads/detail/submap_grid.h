// SPDX-License-Identifier: MIT
#pragma once

/// The grid with which submapping fills a region. Only sources of this folder include it.

#include <lacuna/quads/detail/region_loops.h>

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

namespace lacuna::quads {

/// Integer coordinates in the grid.
using GridPosition = std::array<int, 2>;

/// A heading modulo four right angles, from 0 to 3.
constexpr int quarter_of(int heading) { return ((heading % 4) + 4) % 4; }

/// The step from a grid point to the next one in the direction of a heading.
constexpr GridPosition grid_step(int heading)
{
    const int quarter = quarter_of(heading), by = quarter < 2 ? 1 : -1;
    return quarter % 2 == 0 ? GridPosition{by, 0} : GridPosition{0, by};
}

/// Move by `steps` steps along a heading.
constexpr void advance(GridPosition& position, int heading, int steps = 1)
{
    for (std::size_t k = 0; k < 2; ++k) position[k] += steps * grid_step(heading)[k];
}

/// A loop with grid coordinates.
struct GridLoop {
    std::vector<Index> nodes;
    std::vector<GridPosition> positions;
};

/// Give a loop grid coordinates by walking along it from (0, 0), its first side along the first axis.
/// @param turns  total turn of the loop in right angles: 4 for an outer loop, -4 for a hole.
/// @return empty if the loop has another total turn or does not close.
std::optional<GridLoop> walk(const std::vector<Vec2>& points, const std::vector<Index>& loop, int turns);

/// Grid coordinates of a point inside the outer loop. They are interpolated by mean values from the
/// coordinates of the loop's nodes (Floater 2003).
Vec2 mean_value_position(const std::vector<Vec2>& points, const GridLoop& outer, const Vec2& p);

/// Rotate and move the grid coordinates of a hole so that they are as close to `goal` as possible.
/// @param goal  coordinates of the outline, interpolated at the hole's nodes.
void place_hole(const std::vector<Vec2>& goal, GridLoop& hole);

/// The grid that loops enclose: the cells inside, and the nodes at their corners.
///
/// Corners are stored for each cell, because the two sides of a slit have different nodes at the same grid
/// point.
class SubmapGrid {
public:
    /// @param period  > 0: the first coordinate is periodic around a ring, and the loops' coordinates are
    ///                below the period.
    explicit SubmapGrid(const std::vector<GridLoop>& loops, int period = 0);

    /// Find the cells that the loops enclose, and give them the loops' nodes.
    /// @return false if the loops overlap in the grid, or consecutive nodes are not one grid line apart.
    bool enclose(const std::vector<GridLoop>& loops);
    /// Add the cells within the loops as quads, with their inner nodes. Each inner node is placed between the
    /// boundary nodes of its row and of its column; the closer pair has more weight.
    void add_cells(PlanarQuads& mesh);

private:
    using Corners = std::array<Index, 4>;
    using Sides = std::array<std::size_t, 2>; ///< corner numbers of the cells on one side of a node

    [[nodiscard]] std::size_t index(int x, int y) const
    {
        if (x == period_) x = 0;
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
    }
    [[nodiscard]] std::size_t slot(const GridPosition& s) const
    {
        return index(s[0] - low_[0], s[1] - low_[1]);
    }

    /// Number the inner grid points from `first` on. @return how many there are
    Index number_inner(Index first);
    void place_inner(std::vector<Vec2>& points, Index fixed) const;
    /// Whether consecutive nodes of the loops are one grid line apart.
    [[nodiscard]] bool is_walk(const std::vector<GridLoop>& loops) const;

    [[nodiscard]] int columns() const { return period_ > 0 ? width_ : width_ - 1; }

    /// The cell whose corner k is at a grid point; empty outside the grid.
    [[nodiscard]] std::optional<std::size_t> cell_at(int x, int y, std::size_t k) const;
    /// Find the cells inside, those of winding number 1. @return false if a cell has a winding number other
    /// than 0 or 1
    bool find_cells(const std::vector<GridLoop>& loops);
    /// Assign node i of a loop to the corners of the region's cells at its grid point.
    /// @return false if another node already has one of them.
    bool give_corners(const GridLoop& loop, std::size_t i);
    /// The node that is stored at a grid point for one of the two given corners of cells; -1: none.
    [[nodiscard]] Index node_at(int x, int y, const Sides& corners) const;

    GridPosition low_{};
    int period_ = 0;
    int width_ = 0, height_ = 0;
    /// For each grid point, the four corners of the cell to its upper right, starting at this point; -1: no
    /// node.
    std::vector<Corners> corner_;
    std::vector<char> in_; ///< whether that cell is inside
};

} // namespace lacuna::quads
