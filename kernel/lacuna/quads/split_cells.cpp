// SPDX-License-Identifier: MIT
#include <lacuna/quads/detail/split_cells.h>

#include <lacuna/geometry/shared/union_find.h>
#include <lacuna/mesh/quad_mesh.h>
#include <lacuna/quads/detail/corner_sine.h>

#include <algorithm>
#include <array>
#include <tuple>
#include <unordered_map>

namespace lacuna::quads {
namespace {

/// Finds the inner edges that stay whole: the edges crossed by the T-join of `split_cells()`.
///
/// An odd cell (a terminal) has an odd number of boundary edges. Breadth-first trees grow from all odd cells
/// at once; the cells of a tree form a group. Where two trees meet, their groups can be linked; the shortest
/// links form a tree of groups. In this tree, every branch with an odd number of odd cells is joined to its
/// parent group: the edges along the link's path stay whole.
class WholeEdges {
public:
    explicit WholeEdges(const MixedMesh& mesh)
        : opposite_(mesh::opposite_sides(mesh.cells, static_cast<Index>(mesh.points.size()))),
          root_(mesh.cells.size(), -1),
          from_(mesh.cells.size(), -1),
          steps_(mesh.cells.size(), 0),
          whole_(opposite_.size(), 0)
    {
        grow();
        join();
    }

    /// Whether a side stays whole. Side i of cell c has the number 4c + i. Boundary sides always stay whole.
    [[nodiscard]] bool is_whole(Index side) const
    {
        return opposite_[index(side)] < 0 || whole_[index(side)] != 0;
    }
    /// The same side in the neighbour.
    [[nodiscard]] Index opposite(Index side) const { return opposite_[index(side)]; }

private:
    struct Meeting {
        int steps;
        Index one, two; ///< adjacent cells of different groups
    };

    /// Call `visit(side, neighbour)` for every side of a cell; the neighbour is -1 on the boundary.
    template <class Visit>
    void around(Index c, const Visit& visit) const
    {
        for (Index side = 4 * c; side < 4 * c + 4; ++side) {
            const Index other = opposite_[index(side)];
            if (other != mesh::kNoSide) visit(side, other < 0 ? -1 : other / 4);
        }
    }

    void grow()
    {
        std::vector<Index> queue;
        for (std::size_t c = 0; c < root_.size(); ++c) {
            int boundary = 0;
            around(static_cast<Index>(c), [&](Index, Index other) { boundary += other < 0 ? 1 : 0; });
            if (boundary % 2 == 0) continue;
            root_[c] = static_cast<Index>(c);
            queue.push_back(static_cast<Index>(c));
        }
        for (std::size_t i = 0; i < queue.size(); ++i) {
            const Index here = queue[i];
            around(here, [&](Index, Index other) {
                if (other < 0 || root_[index(other)] >= 0) return;
                root_[index(other)] = root_[index(here)];
                from_[index(other)] = here;
                steps_[index(other)] = steps_[index(here)] + 1;
                queue.push_back(other);
            });
        }
    }

    void join()
    {
        std::vector<Meeting> meetings;
        for (std::size_t c = 0; c < root_.size(); ++c) {
            const auto one = static_cast<Index>(c);
            around(one, [&](Index, Index two) {
                if (two > one && root_[c] >= 0 && root_[index(two)] != root_[c])
                    meetings.push_back({steps_[c] + steps_[index(two)], one, two});
            });
        }
        std::ranges::sort(meetings, [](const Meeting& a, const Meeting& b) {
            return std::tie(a.steps, a.one, a.two) < std::tie(b.steps, b.one, b.two);
        });
        // Build the minimum spanning tree of the groups (Kruskal).
        geometry::UnionFind groups(root_.size());
        std::vector<std::vector<Meeting>> tree(root_.size());
        for (const Meeting& m : meetings) {
            const Index a = root_[index(m.one)], b = root_[index(m.two)];
            if (!groups.unite(b, a)) continue;
            tree[index(a)].push_back(m);
            tree[index(b)].push_back({m.steps, m.two, m.one});
        }
        std::vector<bool> seen(root_.size(), false);
        for (std::size_t c = 0; c < root_.size(); ++c) {
            if (root_[c] == static_cast<Index>(c) && !seen[c]) send_up(static_cast<Index>(c), tree, seen);
        }
    }

    /// Visit a tree of groups from its leaves to its root, and join each odd branch to its parent.
    void send_up(Index top, const std::vector<std::vector<Meeting>>& tree, std::vector<bool>& seen)
    {
        // For each group, its odd cell and the link to its parent group, starting with the root group.
        std::vector<std::pair<Index, Meeting>> order{{top, {0, -1, -1}}};
        std::unordered_map<Index, int> odd{{top, 1}};
        seen[index(top)] = true;
        for (std::size_t i = 0; i < order.size(); ++i) {
            for (const Meeting& m : tree[index(order[i].first)]) {
                const Index next = root_[index(m.two)];
                if (seen[index(next)]) continue;
                seen[index(next)] = true;
                odd[next] = 1;
                order.emplace_back(next, m);
            }
        }
        for (std::size_t i = order.size(); i-- > 1;) {
            const auto& [root, way] = order[i];
            if (odd[root] % 2 == 0) continue;
            ++odd[root_[index(way.one)]];
            turn_back(way.one);
            turn_back(way.two);
            toggle(way.one, way.two);
        }
    }

    void turn_back(Index c)
    {
        for (; from_[index(c)] >= 0; c = from_[index(c)]) toggle(c, from_[index(c)]);
    }

    /// Make an edge between two cells whole if it is halved, and halved if it is whole.
    void toggle(Index one, Index two)
    {
        around(one, [&](Index side, Index other) {
            if (other == two) whole_[index(side)] = whole_[index(opposite(side))] ^= 1;
        });
    }

    std::vector<Index> opposite_;
    /// For each cell: the odd cell from which it was reached, and the cell before it on this path.
    std::vector<Index> root_, from_;
    std::vector<int> steps_;
    std::vector<char> whole_; ///< for each side, whether it stays whole
};

class Splitter {
public:
    explicit Splitter(const MixedMesh& mesh) : mesh_(mesh), whole_(mesh), middle_(4 * mesh.cells.size(), -1)
    {
        made_.points = mesh.points;
        made_.fixed = mesh.fixed;
    }

    MixedMesh run()
    {
        for (std::size_t c = 0; c < mesh_.cells.size(); ++c) split(static_cast<Index>(c));
        return std::move(made_);
    }

private:
    [[nodiscard]] const Vec2& at(Index p) const { return made_.at(p); }

    Index add(const Vec2& p)
    {
        made_.points.push_back(p);
        return static_cast<Index>(made_.points.size()) - 1;
    }

    /// The node in the middle of a side. Both cells at the side share it.
    Index middle(Index side, Index a, Index b)
    {
        Index& own = middle_[index(side)];
        if (own < 0) own = middle_[index(whole_.opposite(side))] = add((at(a) + at(b)) / 2);
        return own;
    }

    void split(Index c)
    {
        const Quad& cell = mesh_.cells[index(c)];
        const std::size_t n = mesh::corner_count(cell);
        std::array<Index, 4> corner{}, half{-1, -1, -1, -1};
        std::size_t whole = 0;
        for (std::size_t k = 0; k < n; ++k) {
            // A triangle stores its last corner twice, so its third side has the number 3.
            const Index side = 4 * c + static_cast<Index>(n == 3 && k == 2 ? 3 : k);
            corner[k] = cell[k];
            if (whole_.is_whole(side))
                ++whole;
            else
                half[k] = middle(side, cell[k], cell[(k + 1) % n]);
        }
        if (whole == 0)
            split_all(corner, half, n);
        else if (n == 3)
            split_triangle(corner, half);
        else if (whole == 4)
            made_.cells.push_back(cell);
        else
            split_quad(corner, half);
    }

    void split_all(const std::array<Index, 4>& corner, const std::array<Index, 4>& half, std::size_t n)
    {
        Vec2 sum = Vec2::Zero();
        for (std::size_t k = 0; k < n; ++k) sum += at(corner[k]);
        const Index centre = add(sum / static_cast<double>(n));
        for (std::size_t k = 0; k < n; ++k)
            made_.cells.push_back({corner[k], half[k], centre, half[(k + n - 1) % n]});
    }

    /// Split a triangle with two whole sides. Together with the node in the middle of the third side, the
    /// triangle is a quad with a straight corner. A smaller quad is placed inside, with its corners on rays
    /// from the centre of the incircle, and four quads surround the smaller quad.
    void split_triangle(const std::array<Index, 4>& corner, const std::array<Index, 4>& half)
    {
        std::size_t k = 0;
        while (half[k] < 0) ++k;
        const Index b = corner[k], c = corner[(k + 1) % 3], a = corner[(k + 2) % 3];
        const double to_a = (at(c) - at(b)).norm(), to_b = (at(a) - at(c)).norm(),
                     to_c = (at(b) - at(a)).norm(), around = to_a + to_b + to_c;
        const Vec2 centre = (to_a * at(a) + to_b * at(b) + to_c * at(c)) / around;
        const double radius = cross(at(b) - at(a), at(c) - at(a)) / around;
        const std::array<Index, 4> outer{a, b, half[k], c};
        std::array<Index, 4> inner{};
        for (std::size_t i = 0; i < 4; ++i)
            inner[i] = add(centre + radius / 2 * (at(outer[i]) - centre).normalized());
        made_.cells.push_back(inner);
        for (std::size_t i = 0; i < 4; ++i)
            made_.cells.push_back({outer[i], outer[(i + 1) % 4], inner[(i + 1) % 4], inner[i]});
    }

    /// Split a quad with two whole sides. If these are opposite, there are two quads. Otherwise there are
    /// three quads around a point on a diagonal, which runs from the corner between the halved sides to the
    /// corner between the whole sides.
    void split_quad(const std::array<Index, 4>& corner, const std::array<Index, 4>& half)
    {
        std::size_t k = 0;
        while (half[k] < 0) ++k;
        if (half[(k + 2) % 4] >= 0) {
            const Index a = half[k], b = half[(k + 2) % 4];
            made_.cells.push_back({corner[k], a, b, corner[(k + 3) % 4]});
            made_.cells.push_back({a, corner[(k + 1) % 4], corner[(k + 2) % 4], b});
            return;
        }
        if (half[(k + 1) % 4] < 0) k = (k + 3) % 4;
        // Sides k and k + 1 are halved; d is the corner between them, and b is the opposite corner.
        const Index c = corner[k], d = corner[(k + 1) % 4], a = corner[(k + 2) % 4], b = corner[(k + 3) % 4];
        const Index m = half[k], n = half[(k + 1) % 4];
        // The point where the line through both middles crosses the diagonal, as a share of the length from b
        // to d.
        const Vec2 line = at(n) - at(m), diagonal = at(d) - at(b);
        const double most = cross(at(m) - at(b), line) / cross(diagonal, line);
        const Index x = add(at(b) + most / 1.5 * diagonal);
        made_.cells.push_back({d, n, x, m});
        made_.cells.push_back({n, a, b, x});
        made_.cells.push_back({x, b, c, m});
    }

    const MixedMesh& mesh_;
    WholeEdges whole_;
    MixedMesh made_;
    std::vector<Index> middle_; ///< for each side, its middle node; -1: not made yet
};

} // namespace

MixedMesh split_cells(const MixedMesh& mesh) { return Splitter(mesh).run(); }

} // namespace lacuna::quads
