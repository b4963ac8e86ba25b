// SPDX-License-Identifier: MIT
#pragma once

/// The grid that submapping fills a region with. Only sources of this folder include it.

#include <lacuna/quads/region.h>

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

namespace lacuna::quads {

/// A node's place in the grid.
using Spot = std::array<int, 2>;

/// A loop with grid coordinates.
struct GridLoop {
    std::vector<Index> nodes;
    std::vector<Spot> spots;
};

/// Does a loop have sides alone: no right angle that would be an end or a corner of a grid?
bool is_round(const std::vector<Vec2>& points, const std::vector<Index>& loop);

/// Walk along a loop from (0, 0), its first side along the first axis.
/// @param turns  right angles a loop turns in all: 4 round an outer loop, -4 round a hole.
/// @return nothing where the loop does not turn so or does not close.
std::optional<GridLoop> walk(const std::vector<Vec2>& points, const std::vector<Index>& loop, int turns);

/// A loop with a corner at each of four places, a quarter of it apart or as near as goes; from `start`, along the first axis.
/// @pre  an even number of nodes, 8 or more.
GridLoop with_corners(const std::vector<Index>& loop, std::size_t start, bool outer);

/// Grid coordinates at a point inside the outer loop, by mean values (Floater 2003).
Vec2 carried_inward(const std::vector<Vec2>& points, const GridLoop& outer, const Vec2& p);

/// Turn and move a hole's coordinates to where the outline's, carried inward, say it is. @return how far off it is then, squared and
/// summed over its nodes.
double settle(const std::vector<Vec2>& goal, GridLoop& hole);

/// The grid loops enclose: which cells are in, and the node at every grid point.
class Grid {
public:
    explicit Grid(const std::vector<GridLoop>& loops);

    /// @return false where the loops touch or overlap in the grid.
    bool enclose(const std::vector<GridLoop>& loops);
    /// Number the inner grid points from `first` on. @return how many there are.
    Index number_inner(Index first);
    [[nodiscard]] std::vector<Quad> quads() const;
    /// Put each inner node between the boundary nodes of its row and of its column, the nearer pair counting more.
    void place_inner(std::vector<Vec2>& points, Index fixed) const;

private:
    [[nodiscard]] std::size_t index(int x, int y) const
    {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
    }
    [[nodiscard]] std::size_t place(const Spot& s) const { return index(s[0] - low_[0], s[1] - low_[1]); }

    Spot low_{};
    int width_ = 0, height_ = 0;
    std::vector<Index> node_; ///< at each grid point, -1: none
    std::vector<char> in_;    ///< whether the cell up and right of each grid point is in
};

} // namespace lacuna::quads
