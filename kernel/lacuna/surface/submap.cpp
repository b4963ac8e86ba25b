// SPDX-License-Identifier: MIT
#include <lacuna/surface/submap.h>

#include <lacuna/surface/measure_plane.h>
#include <lacuna/surface/pave_draft.h>
#include <lacuna/surface/smooth_plane.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lacuna::surface {
namespace {

using paving::cross;
using paving::kRightAngle;
using paving::turn_between;

/// A node's place in the grid.
using Spot = std::array<int, 2>;
constexpr std::array<Spot, 4> kSteps{{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};

/// A loop with grid coordinates from (0, 0) on, its first side along the first axis.
struct GridLoop {
    std::vector<Index> nodes;
    std::vector<Spot> spots;
};

/// @param turns  right angles a loop turns in all: 4 round an outer loop, -4 round a hole.
std::optional<GridLoop> walk(const PlanarRegion& region, const std::vector<Index>& loop, int turns)
{
    GridLoop grid{loop, {}};
    const std::size_t n = loop.size();
    const auto at = [&](std::size_t i) { return region.points[static_cast<std::size_t>(loop[i % n])]; };
    Spot spot{0, 0};
    int heading = 0, sum = 0;
    for (std::size_t i = 0; i < n; ++i) {
        const int quads = grid_quads(turn_between(at(i + 1) - at(i), at(i + n - 1) - at(i)));
        if (quads == 0) return std::nullopt;
        sum += 2 - quads;
        // The first side's heading is what the axes are named after.
        if (i > 0) heading = (heading + 2 - quads + 8) % 4;
        grid.spots.push_back(spot);
        const Spot& step = kSteps[static_cast<std::size_t>(heading)];
        spot = {spot[0] + step[0], spot[1] + step[1]};
    }
    if (sum != turns || spot != Spot{0, 0}) return std::nullopt;
    return grid;
}

/// How many nodes the grid's outline turns at.
std::size_t corner_count(const GridLoop& loop)
{
    std::size_t count = 0;
    for (std::size_t i = 0, n = loop.spots.size(); i < n; ++i) {
        const Spot &before = loop.spots[(i + n - 1) % n], &here = loop.spots[i], &after = loop.spots[(i + 1) % n];
        count += after[0] - here[0] != here[0] - before[0] || after[1] - here[1] != here[1] - before[1] ? 1U : 0U;
    }
    return count;
}

/// Grid coordinates at a point inside the outer loop, by mean values.
Vec2 carried_inward(const PlanarRegion& region, const GridLoop& outer, const Vec2& p)
{
    const std::size_t n = outer.nodes.size();
    const auto to = [&](std::size_t i) -> Vec2 {
        return region.points[static_cast<std::size_t>(outer.nodes[i % n])] - p;
    };
    const auto half_tangent = [](const Vec2& a, const Vec2& b) {
        return std::tan(std::atan2(cross(a, b), a.dot(b)) / 2);
    };
    Vec2 sum = Vec2::Zero();
    double weights = 0;
    for (std::size_t i = 0; i < n; ++i) {
        const double weight = (half_tangent(to(i + n - 1), to(i)) + half_tangent(to(i), to(i + 1))) / to(i).norm();
        sum += weight * Vec2(outer.spots[i][0], outer.spots[i][1]);
        weights += weight;
    }
    return sum / weights;
}

Spot rotated(Spot spot, int quarters)
{
    for (; quarters > 0; --quarters) spot = {-spot[1], spot[0]};
    return spot;
}

/// Turn and move a hole's coordinates to where the outline's say it is.
void settle(const PlanarRegion& region, const GridLoop& outer, GridLoop& hole)
{
    std::vector<Vec2> goal;
    Vec2 middle = Vec2::Zero();
    for (const Index p : hole.nodes) {
        goal.push_back(carried_inward(region, outer, region.points[static_cast<std::size_t>(p)]));
        middle += goal.back() / static_cast<double>(hole.nodes.size());
    }
    double best_error = std::numeric_limits<double>::infinity();
    std::vector<Spot> best;
    for (int quarter = 0; quarter < 4; ++quarter) {
        std::vector<Spot> spots;
        Vec2 mean = Vec2::Zero();
        for (const Spot& spot : hole.spots) {
            spots.push_back(rotated(spot, quarter));
            mean += Vec2(spots.back()[0], spots.back()[1]) / static_cast<double>(hole.spots.size());
        }
        const Vec2 move = middle - mean;
        const Spot by{static_cast<int>(std::lround(move.x())), static_cast<int>(std::lround(move.y()))};
        double error = 0;
        for (std::size_t i = 0; i < spots.size(); ++i) {
            spots[i] = {spots[i][0] + by[0], spots[i][1] + by[1]};
            error += (Vec2(spots[i][0], spots[i][1]) - goal[i]).squaredNorm();
        }
        if (error >= best_error) continue;
        best_error = error;
        best = std::move(spots);
    }
    hole.spots = std::move(best);
}

/// The grid a region's loops enclose: which cells are in, and the node at every grid point.
class Grid {
public:
    explicit Grid(const std::vector<GridLoop>& loops)
    {
        low_ = loops.front().spots.front();
        Spot high = low_;
        for (const GridLoop& loop : loops) {
            for (const Spot& s : loop.spots) {
                for (std::size_t k = 0; k < 2; ++k) {
                    low_[k] = std::min(low_[k], s[k]);
                    high[k] = std::max(high[k], s[k]);
                }
            }
        }
        width_ = high[0] - low_[0] + 1;
        height_ = high[1] - low_[1] + 1;
    }

    /// @return false where the loops touch or overlap in the grid.
    bool enclose(const std::vector<GridLoop>& loops)
    {
        node_.assign(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_), -1);
        // How often each cell is gone round: summed along its row over the sides that run up or down.
        std::vector<int> change(node_.size(), 0);
        for (const GridLoop& loop : loops) {
            for (std::size_t i = 0, n = loop.spots.size(); i < n; ++i) {
                const Spot &a = loop.spots[i], &b = loop.spots[(i + 1) % n];
                Index& here = node_[place(a)];
                if (here >= 0) return false;
                here = loop.nodes[i];
                // The region lies left of a side: leaving it to the right of one that runs up.
                if (b[1] > a[1]) --change[place(a)];
                if (b[1] < a[1]) ++change[place(b)];
            }
        }
        in_.assign(node_.size(), 0);
        for (int y = 0; y < height_; ++y) {
            int around = 0;
            for (int x = 0; x < width_; ++x) {
                const std::size_t c = index(x, y);
                around += change[c];
                if (around != 0 && around != 1) return false;
                in_[c] = static_cast<char>(around);
            }
        }
        return true;
    }

    /// Number the inner grid points from `first` on. @return how many there are.
    Index number_inner(Index first)
    {
        const Index start = first;
        for (int y = 0; y + 1 < height_; ++y) {
            for (int x = 0; x + 1 < width_; ++x) {
                if (!in_[index(x, y)]) continue;
                for (const std::size_t c : {index(x, y), index(x + 1, y), index(x + 1, y + 1), index(x, y + 1)})
                    if (node_[c] < 0) node_[c] = first++;
            }
        }
        return first - start;
    }

    [[nodiscard]] std::vector<Quad> quads() const
    {
        std::vector<Quad> result;
        for (int y = 0; y + 1 < height_; ++y) {
            for (int x = 0; x + 1 < width_; ++x) {
                if (in_[index(x, y)])
                    result.push_back({node_[index(x, y)], node_[index(x + 1, y)], node_[index(x + 1, y + 1)],
                                      node_[index(x, y + 1)]});
            }
        }
        return result;
    }

    /// Put each inner node between the boundary nodes of its row and of its column, the nearer pair counting more.
    void place_inner(std::vector<Vec2>& points, Index fixed) const
    {
        std::vector<double> weight(points.size(), 0);
        std::vector<Vec2> sum(points.size(), Vec2::Zero());
        const auto along = [&](int lines, int length, const auto& at) {
            for (int l = 0; l < lines; ++l) {
                for (int a = 0; a < length; ++a) {
                    if (at(l, a) < 0 || at(l, a) >= fixed) continue;
                    int b = a + 1;
                    while (b < length && at(l, b) >= fixed) ++b;
                    if (b == length || at(l, b) < 0) continue;
                    const Vec2 &from = points[static_cast<std::size_t>(at(l, a))],
                               &to = points[static_cast<std::size_t>(at(l, b))];
                    for (int k = a + 1; k < b; ++k) {
                        const double t = static_cast<double>(k - a) / (b - a), w = 1.0 / ((b - a) * (b - a));
                        const auto p = static_cast<std::size_t>(at(l, k));
                        sum[p] += w * ((1 - t) * from + t * to);
                        weight[p] += w;
                    }
                }
            }
        };
        along(height_, width_, [&](int y, int x) { return node_[index(x, y)]; });
        along(width_, height_, [&](int x, int y) { return node_[index(x, y)]; });
        for (auto p = static_cast<std::size_t>(fixed); p < points.size(); ++p) {
            if (weight[p] > 0) points[p] = sum[p] / weight[p];
        }
    }

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

} // namespace

int grid_quads(double angle)
{
    constexpr double kOff = kRightAngle * 4 / 9; // 40°: a sine of 0.77 left at a corner
    const int quads = paving::quads_in(angle);
    // A side is whatever no right angle is near to: outlines of few nodes bend by up to 45° at each.
    if (quads == 2) return 2;
    return quads <= 4 && std::abs(angle - quads * kRightAngle) <= kOff ? quads : 0;
}

std::optional<PlanarQuads> submap(const PlanarRegion& region, const RunContext& context)
{
    std::vector<GridLoop> loops;
    for (std::size_t l = 0; l < region.loops.size(); ++l) {
        auto loop = walk(region, region.loops[l], l == 0 ? 4 : -4);
        if (!loop) return std::nullopt;
        if (l > 0) settle(region, loops.front(), *loop);
        loops.push_back(std::move(*loop));
    }
    Grid grid(loops);
    if (!grid.enclose(loops)) return std::nullopt;
    const bool four_sided = loops.size() == 1 && corner_count(loops.front()) == 4;
    PlanarQuads mesh{region.points, {}, four_sided ? "mapped" : "submapped"};
    const auto fixed = static_cast<Index>(region.points.size());
    mesh.points.resize(mesh.points.size() + static_cast<std::size_t>(grid.number_inner(fixed)), Vec2::Zero());
    mesh.quads = grid.quads();
    grid.place_inner(mesh.points, fixed);
    smooth_plane(mesh.points, mesh.quads, region.points.size(), {.size = region.size}, context);
    if (!find_fault(mesh, region).empty()) return std::nullopt;
    return mesh;
}

} // namespace lacuna::surface
