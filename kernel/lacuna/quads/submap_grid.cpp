// SPDX-License-Identifier: MIT
#include <lacuna/quads/detail/submap_grid.h>

#include <lacuna/core/shared/constants.h>
#include <lacuna/core/shared/limits.h>
#include <lacuna/quads/shared/submap.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>

namespace lacuna::quads {
namespace {

GridPosition rotated(GridPosition position, int quarters)
{
    for (; quarters > 0; --quarters) position = {-position[1], position[0]};
    return position;
}

} // namespace

std::optional<GridLoop> walk(const std::vector<Vec2>& points, const std::vector<Index>& loop, int turns)
{
    GridLoop grid{loop, {}};
    const std::size_t n = loop.size();
    GridPosition position{0, 0};
    int heading = 0, sum = 0;
    for (std::size_t i = 0; i < n; ++i) {
        const int quads = grid_quads(corner_angle(points, loop, i));
        if (quads == 0) return std::nullopt;
        sum += 2 - quads;
        // The first side runs along the first axis, whatever the angle at its start is.
        if (i > 0) heading += 2 - quads;
        grid.positions.push_back(position);
        advance(position, heading);
    }
    if (sum != turns || position != GridPosition{0, 0}) return std::nullopt;
    return grid;
}

Vec2 mean_value_position(const std::vector<Vec2>& points, const GridLoop& outer, const Vec2& p)
{
    const std::size_t n = outer.nodes.size();
    const auto to = [&](std::size_t i) -> Vec2 { return point_of(points, outer.nodes, i) - p; };
    const auto half_tangent = [](const Vec2& a, const Vec2& b) {
        return std::tan(std::atan2(cross(a, b), a.dot(b)) / 2);
    };
    Vec2 sum = Vec2::Zero();
    double weights = 0;
    for (std::size_t i = 0; i < n; ++i) {
        const double weight = (half_tangent(to(i + n - 1), to(i)) + half_tangent(to(i), to(i + 1))) /
                              to(i).norm();
        sum += weight * Vec2(outer.positions[i][0], outer.positions[i][1]);
        weights += weight;
    }
    return sum / weights;
}

void place_hole(const std::vector<Vec2>& goal, GridLoop& hole)
{
    Vec2 middle = Vec2::Zero();
    for (const Vec2& p : goal) middle += p / static_cast<double>(goal.size());
    double best_error = kInfinity;
    std::vector<GridPosition> best;
    for (int quarter = 0; quarter < 4; ++quarter) {
        std::vector<GridPosition> positions;
        Vec2 mean = Vec2::Zero();
        for (const GridPosition& position : hole.positions) {
            positions.push_back(rotated(position, quarter));
            mean += Vec2(positions.back()[0], positions.back()[1]) /
                    static_cast<double>(hole.positions.size());
        }
        const Vec2 move = middle - mean;
        const GridPosition by{static_cast<int>(std::lround(move.x())),
                              static_cast<int>(std::lround(move.y()))};
        double error = 0;
        for (std::size_t i = 0; i < positions.size(); ++i) {
            positions[i] = {positions[i][0] + by[0], positions[i][1] + by[1]};
            error += (Vec2(positions[i][0], positions[i][1]) - goal[i]).squaredNorm();
        }
        if (error >= best_error) continue;
        best_error = error;
        best = std::move(positions);
    }
    hole.positions = std::move(best);
}

SubmapGrid::SubmapGrid(const std::vector<GridLoop>& loops, int period) : period_(period)
{
    low_ = loops.front().positions.front();
    GridPosition high = low_;
    for (const GridLoop& loop : loops) {
        for (const GridPosition& s : loop.positions) {
            for (std::size_t k = 0; k < 2; ++k) {
                low_[k] = std::min(low_[k], s[k]);
                high[k] = std::max(high[k], s[k]);
            }
        }
    }
    // Only a misplaced hole needs more grid lines than a mesh may have cells.
    for (std::size_t k = 0; k < 2; ++k) {
        if (std::int64_t{high[k]} - low_[k] > static_cast<std::int64_t>(kMostCells))
            return; // without cells, no loop fits
    }
    if (period_ > 0) low_[0] = 0;
    width_ = period_ > 0 ? period_ : high[0] - low_[0] + 1;
    height_ = high[1] - low_[1] + 1;
}

bool SubmapGrid::is_walk(const std::vector<GridLoop>& loops) const
{
    for (const GridLoop& loop : loops) {
        for (std::size_t i = 0, n = loop.positions.size(); i < n; ++i) {
            const GridPosition &a = loop.positions[i], &b = loop.positions[(i + 1) % n];
            if (period_ > 0 && (a[0] < 0 || a[0] >= period_)) return false;
            int along = std::abs(b[0] - a[0]);
            if (period_ > 0) along = std::min(along, period_ - along);
            if (along + std::abs(b[1] - a[1]) != 1) return false;
        }
    }
    return true;
}

std::optional<std::size_t> SubmapGrid::cell_at(int x, int y, std::size_t k) const
{
    if (k == 1 || k == 2) --x;
    if (k > 1) --y;
    if (period_ > 0) x = (x + period_) % period_;
    if (x < 0 || x >= columns() || y < 0 || y + 1 >= height_) return std::nullopt;
    return index(x, y);
}

bool SubmapGrid::find_cells(const std::vector<GridLoop>& loops)
{
    // The winding number of a cell is the sum of the directions (1 or -1) of the loops' horizontal sides
    // below the cell, in its column.
    std::vector<int> change(in_.size(), 0);
    for (const GridLoop& loop : loops) {
        for (std::size_t i = 0, n = loop.positions.size(); i < n; ++i) {
            const GridPosition &a = loop.positions[i], &b = loop.positions[(i + 1) % n];
            if (a[1] != b[1]) continue;
            // The region lies to the left of a side. On a loop around a periodic grid, the last step leads
            // from the highest coordinate to 0, or from 0 to the highest coordinate.
            const bool forward = slot(b) == index(a[0] - low_[0] + 1, a[1] - low_[1]);
            if (forward)
                ++change[slot(a)];
            else
                --change[slot(b)];
        }
    }
    for (int x = 0; x < width_; ++x) {
        int around = 0;
        for (int y = 0; y < height_; ++y) {
            const std::size_t c = index(x, y);
            around += change[c];
            if (around != 0 && around != 1) return false;
            in_[c] = static_cast<char>(around);
        }
        if (around != 0) return false;
    }
    return true;
}

bool SubmapGrid::give_corners(const GridLoop& loop, std::size_t i)
{
    const std::size_t n = loop.nodes.size();
    const GridPosition &at = loop.positions[i], &next = loop.positions[(i + 1) % n],
                       &last = loop.positions[(i + n - 1) % n];
    const auto direction = [&](const GridPosition& to) -> std::size_t {
        if (to[1] != at[1]) return to[1] > at[1] ? 1 : 3;
        return slot(to) == index(at[0] - low_[0] + 1, at[1] - low_[1]) ? 0 : 2;
    };
    // The region at a node lies between the side that leaves it and the side that arrives at it. If both have
    // the same direction, the region lies all around the node.
    const std::size_t out = direction(next), back = direction(last);
    const std::size_t quads = back == out ? 4 : (back + 4 - out) % 4;
    for (std::size_t q = 0; q < quads; ++q) {
        const std::size_t k = (out + q) % 4;
        const auto cell = cell_at(at[0] - low_[0], at[1] - low_[1], k);
        if (!cell || !in_[*cell] || corner_[*cell][k] >= 0) return false;
        corner_[*cell][k] = loop.nodes[i];
    }
    return true;
}

bool SubmapGrid::enclose(const std::vector<GridLoop>& loops)
{
    if (width_ <= 0 || height_ <= 0 || !is_walk(loops)) return false;
    in_.assign(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_), 0);
    corner_.assign(in_.size(), {-1, -1, -1, -1});
    if (!find_cells(loops)) return false;
    for (const GridLoop& loop : loops) {
        for (std::size_t i = 0; i < loop.nodes.size(); ++i) {
            if (!give_corners(loop, i)) return false;
        }
    }
    return true;
}

Index SubmapGrid::number_inner(Index first)
{
    const Index start = first;
    for (int y = 0; y + 1 < height_; ++y) {
        for (int x = 0; x < columns(); ++x) {
            if (!in_[index(x, y)]) continue;
            for (std::size_t k = 0; k < 4; ++k) {
                if (corner_[index(x, y)][k] >= 0) continue;
                const int right = k == 1 || k == 2 ? 1 : 0, up = k > 1 ? 1 : 0;
                for (std::size_t around = 0; around < 4; ++around)
                    corner_[*cell_at(x + right, y + up, around)][around] = first;
                ++first;
            }
        }
    }
    return first - start;
}

void SubmapGrid::add_cells(PlanarQuads& mesh)
{
    const auto first = static_cast<Index>(mesh.points.size());
    const Index inner = number_inner(first);
    mesh.points.resize(static_cast<std::size_t>(first + inner), Vec2::Zero());
    place_inner(mesh.points, first);
    for (std::size_t c = 0; c < in_.size(); ++c)
        if (in_[c]) mesh.quads.push_back(corner_[c]);
}

Index SubmapGrid::node_at(int x, int y, const Sides& corners) const
{
    for (const std::size_t k : corners) {
        const auto cell = cell_at(x, y, k);
        if (cell && in_[*cell]) return corner_[*cell][k];
    }
    return -1;
}

void SubmapGrid::place_inner(std::vector<Vec2>& points, Index fixed) const
{
    std::vector<double> weight(points.size(), 0);
    std::vector<Vec2> sum(points.size(), Vec2::Zero());
    // At a grid point, the cells ahead on the line and the cells behind may have different nodes, namely at a
    // slit.
    const auto along = [&](int lines, int length, const auto& node, const Sides& far, const Sides& near) {
        const auto ahead = [&](int l, int i) { return node(l, i, far); };
        const auto behind = [&](int l, int i) { return node(l, i, near); };
        for (int l = 0; l < lines; ++l) {
            for (int a = 0; a < length; ++a) {
                const Index start = ahead(l, a);
                if (start < 0 || start >= fixed) continue;
                int b = a + 1;
                while (b < length && behind(l, b) >= fixed) ++b;
                if (b == length || behind(l, b) < 0) continue;
                const Vec2 &from = points[static_cast<std::size_t>(start)],
                           &to = points[static_cast<std::size_t>(behind(l, b))];
                for (int k = a + 1; k < b; ++k) {
                    const double t = static_cast<double>(k - a) / (b - a), w = 1.0 / ((b - a) * (b - a));
                    const auto p = static_cast<std::size_t>(behind(l, k));
                    sum[p] += w * ((1 - t) * from + t * to);
                    weight[p] += w;
                }
            }
        }
    };
    // In a periodic grid, rows are interrupted at the seam, so only columns are used.
    if (period_ == 0) {
        along(height_, width_, [&](int y, int x, const Sides& side) { return node_at(x, y, side); }, {0, 3},
              {1, 2});
    }
    along(width_, height_, [&](int x, int y, const Sides& side) { return node_at(x, y, side); }, {0, 1},
          {2, 3});
    for (auto p = static_cast<std::size_t>(fixed); p < points.size(); ++p) {
        if (weight[p] > 0) points[p] = sum[p] / weight[p];
    }
}

} // namespace lacuna::quads
