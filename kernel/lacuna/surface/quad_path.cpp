// SPDX-License-Identifier: MIT
#include <lacuna/surface/detail/quad_path.h>

#include <lacuna/core/shared/constants.h>
#include <lacuna/core/shared/criteria.h>
#include <lacuna/core/shared/edge_key.h>
#include <lacuna/geometry/shared/plane.h>
#include <lacuna/geometry/shared/signed_area.h>
#include <lacuna/mesh/quad_mesh.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <map>
#include <optional>
#include <unordered_map>
#include <utility>

namespace lacuna::surface {

using namespace topology;

namespace {

using Place = std::pair<int, int>; ///< column and row

/// Columns and rows of the nodes around a quad, as far as the mesh is a grid there and away from its border.
class GridAround {
public:
    /// @param reach  highest column and row, in both directions.
    /// @param taken  nodes that are on no border of a block.
    GridAround(std::span<const Quad> quads, std::size_t middle, int reach,
               const std::unordered_set<Index>& taken)
        : quads_(quads), reach_(reach), taken_(taken)
    {
        for (std::size_t q = 0; q < quads.size(); ++q)
            for (std::size_t k = 0; k < 4; ++k) side_[side_of(q, k)] = {q, k};
        spread(middle);
    }

    /// The mean of a block's corners. Empty if one of them does not belong to the grid.
    [[nodiscard]] std::optional<Vec2> middle(std::span<const Vec2> place, Place low, Place high) const
    {
        Vec2 mean = Vec2::Zero();
        for (const Place& corner :
             {low, Place{high.first, low.second}, high, Place{low.first, high.second}}) {
            const auto node = nodes_.find(corner);
            if (node == nodes_.end()) return std::nullopt;
            mean += place[static_cast<std::size_t>(node->second)] / 4;
        }
        return mean;
    }

    /// The nodes of a block's border, counter-clockwise. Empty if one of them lies on the border of the mesh.
    [[nodiscard]] std::vector<Index> border(Place low, Place high) const
    {
        std::vector<Index> nodes;
        for (int a = low.first; a < high.first; ++a) nodes.push_back(inside({a, low.second}));
        for (int b = low.second; b < high.second; ++b) nodes.push_back(inside({high.first, b}));
        for (int a = high.first; a > low.first; --a) nodes.push_back(inside({a, high.second}));
        for (int b = high.second; b > low.second; --b) nodes.push_back(inside({low.first, b}));
        if (std::ranges::find(nodes, -1) != nodes.end()) nodes.clear();
        return nodes;
    }

private:
    /// A quad, and which of its corners has the lowest column and row.
    struct Cell {
        std::size_t quad = 0, first = 0;
    };
    /// The corner with the lowest column and row, then counter-clockwise.
    static constexpr std::array<Place, 4> kCorners{Place{0, 0}, Place{1, 0}, Place{1, 1}, Place{0, 1}};

    [[nodiscard]] std::uint64_t side_of(std::size_t quad, std::size_t k) const
    {
        return directed_key(quads_[quad][k % 4], quads_[quad][(k + 1) % 4]);
    }

    void spread(std::size_t middle)
    {
        std::vector<Place> front;
        if (add({0, 0}, {middle, 0})) front.push_back({0, 0});
        for (std::size_t next = 0; next < front.size(); ++next) {
            const Cell cell = cells_.at(front[next]);
            for (std::size_t k = 0; k < 4; ++k) {
                // Side k of a cell is side k + 2 of the cell next to it.
                constexpr std::array<Place, 4> kSteps{Place{0, -1}, Place{1, 0}, Place{0, 1}, Place{-1, 0}};
                const Place to{front[next].first + kSteps[k].first, front[next].second + kSteps[k].second};
                const Index from = quads_[cell.quad][(cell.first + k) % 4],
                            on = quads_[cell.quad][(cell.first + k + 1) % 4];
                const auto beside = side_.find(directed_key(on, from));
                if (beside == side_.end()) continue;
                const auto& [quad, side] = beside->second;
                if (add(to, {quad, (side + 6 - k) % 4})) front.push_back(to);
            }
        }
    }

    /// Add a cell. @return  false if there is one, it is too far away, or it has other nodes than its place.
    bool add(Place at, Cell cell)
    {
        if (std::max(std::abs(at.first), std::abs(at.second)) > reach_ || cells_.contains(at)) return false;
        const auto corner = [&](std::size_t k) {
            return std::pair(Place{at.first + kCorners[k].first, at.second + kCorners[k].second},
                             quads_[cell.quad][(cell.first + k) % 4]);
        };
        for (std::size_t k = 0; k < 4; ++k) {
            const auto [place, node] = corner(k);
            const auto there = nodes_.find(place);
            const auto same = place_.find(node);
            if ((there != nodes_.end() && there->second != node) ||
                (same != place_.end() && same->second != place))
                return false;
        }
        for (std::size_t k = 0; k < 4; ++k) {
            const auto [place, node] = corner(k);
            nodes_.emplace(place, node);
            place_.emplace(node, place);
        }
        cells_.emplace(at, cell);
        return true;
    }

    /// A node with four quads of the grid that is not taken; -1 if there is none.
    [[nodiscard]] Index inside(Place at) const
    {
        const bool all = std::ranges::all_of(kCorners, [&](const Place& step) {
            return cells_.contains({at.first - step.first, at.second - step.second});
        });
        return all && !taken_.contains(nodes_.at(at)) ? nodes_.at(at) : -1;
    }

    std::span<const Quad> quads_;
    int reach_;
    const std::unordered_set<Index>& taken_;
    std::unordered_map<std::uint64_t, std::pair<std::size_t, std::size_t>> side_; ///< quad and number
    std::map<Place, Cell> cells_;
    std::map<Place, Index> nodes_;
    std::unordered_map<Index, Place> place_;
};

/// Whether a point lies inside a closed line.
bool is_inside(const Vec2& p, std::span<const Vec2> line)
{
    bool inside = false;
    for (std::size_t i = 0; i < line.size(); ++i) {
        const Vec2 &a = line[i], &b = line[(i + 1) % line.size()];
        if ((a.y() > p.y()) == (b.y() > p.y())) continue;
        if (p.x() < a.x() + (p.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x())) inside = !inside;
    }
    return inside;
}

/// The quad whose mean is nearest to a point.
std::size_t nearest_quad(std::span<const Quad> quads, std::span<const Vec2> place, const Vec2& p)
{
    const auto off = [&](const Quad& q) {
        Vec2 mean = Vec2::Zero();
        for (const Index node : q) mean += place[static_cast<std::size_t>(node)] / 4;
        return (mean - p).squaredNorm();
    };
    return static_cast<std::size_t>(std::ranges::min_element(quads, {}, off) - quads.begin());
}

} // namespace

std::vector<Index> path_around(const std::vector<Quad>& quads, std::span<const Vec2> place,
                               std::span<const Vec2> line, const std::unordered_set<Index>& taken)
{
    const std::size_t count = line.size();
    if (quads.empty() || count < 4 || count % 2 != 0) return {};
    Vec2 middle = Vec2::Zero();
    for (const Vec2& p : line) middle += p / static_cast<double>(count);
    const int half = static_cast<int>(count / 2);
    const GridAround grid(quads, nearest_quad(quads, place, middle), half + 1, taken);
    std::vector<Index> best;
    double least = kInfinity;
    const bool clockwise = geometry::signed_area(line) < 0;
    std::vector<Vec2> rims;
    for (const mesh::BoundarySide& side : mesh::boundary_sides(quads))
        rims.push_back(place[static_cast<std::size_t>(side.from)]);
    const auto compare = [&](Place low, Place high) {
        const std::optional<Vec2> at = grid.middle(place, low, high);
        if (!at || static_cast<double>(count) * (*at - middle).squaredNorm() >= least) return;
        std::vector<Index> border = grid.border(low, high);
        if (border.empty()) return;
        if (clockwise) std::ranges::reverse(border);
        // Holes of the mesh inside the line are inside the block too.
        std::vector<Vec2> round;
        for (const Index node : border) round.push_back(place[static_cast<std::size_t>(node)]);
        if (std::ranges::any_of(rims,
                                [&](const Vec2& p) { return is_inside(p, line) != is_inside(p, round); }))
            return;
        for (std::size_t shift = 0; shift < count; ++shift) {
            double sum = 0;
            for (std::size_t k = 0; k < count && sum < least; ++k)
                sum += (round[(k + shift) % count] - line[k]).squaredNorm();
            if (sum >= least) continue;
            least = sum;
            best = border;
            std::ranges::rotate(best, best.begin() + static_cast<std::ptrdiff_t>(shift));
        }
    };
    for (int columns = 1; columns < half; ++columns) {
        const int rows = half - columns;
        for (int a = -columns; a <= 0; ++a) // the quad nearest to the line's middle lies in the block
            for (int b = -rows; b <= 0; ++b) compare({a, b}, {a + columns, b + rows});
    }
    return best;
}

namespace {

/// The position of a share of an edge's length in the plane.
Vec2 place_at(const FlatEdge& edge, double share)
{
    std::size_t i = 1;
    while (i + 1 < edge.at.size() && edge.at[i] < share) ++i;
    const double f = (share - edge.at[i - 1]) / (edge.at[i] - edge.at[i - 1]);
    return edge.line[i - 1] + f * (edge.line[i] - edge.line[i - 1]);
}

/// Shares of an edge's length at which it has nodes.
/// @param side  length of the sides of an edge without given nodes, in the plane.
std::vector<double> node_shares(const Model& model, const FlatEdge& edge, double side)
{
    if (model[edge.edge].keeps_nodes) return edge.at;
    double length = 0;
    for (std::size_t i = 0; i + 1 < edge.line.size(); ++i) length += (edge.line[i + 1] - edge.line[i]).norm();
    const int sides = std::max(1, static_cast<int>(std::lround(length / side)));
    std::vector<double> at;
    for (int k = 0; k <= sides; ++k) at.push_back(static_cast<double>(k) / sides);
    return at;
}

} // namespace

std::vector<PathSide> path_along(const Model& model, const EndsMap& map, const std::vector<Quad>& quads,
                                 std::span<const Vec2> place, std::span<const EdgeUse> line,
                                 const std::unordered_set<Index>& taken)
{
    double area = 0;
    for (const Quad& q : quads) {
        const auto at = [&](std::size_t k) -> const Vec2& { return place[static_cast<std::size_t>(q[k])]; };
        area += std::abs(geometry::cross(at(2) - at(0), at(3) - at(1))) / 2;
    }
    const double side = std::sqrt(area / static_cast<double>(quads.size()));
    std::vector<PathSide> sides;
    std::vector<Vec2> nodes;
    for (const EdgeUse& use : line) {
        const FlatEdge flat = flat_edge(model, map, use.edge, true);
        std::vector<double> at = node_shares(model, flat, side);
        if (use.reversed) std::ranges::reverse(at);
        for (std::size_t k = 0; k + 1 < at.size(); ++k) {
            sides.push_back({-1, -1, {use.edge, at[k], at[k + 1]}});
            nodes.push_back(place_at(flat, at[k]));
        }
    }
    const std::vector<Index> path = path_around(quads, place, nodes, taken);
    if (path.empty()) return {};
    for (std::size_t k = 0; k < path.size(); ++k) {
        sides[k].from = path[k];
        sides[k].to = path[(k + 1) % path.size()];
    }
    return sides;
}

} // namespace lacuna::surface
