// SPDX-License-Identifier: MIT
#include <lacuna/quads/detail/split_cells.h>

#include <lacuna/quads/detail/quad_sides.h>

#include <numeric>
#include <tuple>
#include <unordered_set>

namespace lacuna::quads {
namespace {

/// Which inner sides stay whole, so that every cell has an even number of whole sides: a join of the cells
/// that are odd in the mesh's dual graph, near the shortest. Ways grow from all of them at once; where two
/// meet, their groups are joined, the nearest first, and in the tree of groups every odd branch sends its
/// way up.
class WholeSides {
public:
    explicit WholeSides(const MixedMesh& mesh)
        : mesh_(mesh),
          sides_(mesh),
          root_(mesh.cells.size(), -1),
          from_(mesh.cells.size(), -1),
          steps_(mesh.cells.size(), 0)
    {
        grow();
        join();
    }

    [[nodiscard]] bool is_whole(Index a, Index b) const { return whole_.contains(side_key(a, b)); }
    [[nodiscard]] bool is_boundary(Index a, Index b, Index cell) const
    {
        return sides_.across(a, b, cell) < 0;
    }

private:
    struct Meeting {
        int steps;
        Index one, two; ///< neighbours of different groups
    };

    template <class Visit>
    void around(Index c, const Visit& visit) const
    {
        const Quad& cell = mesh_.cells[index(c)];
        for (std::size_t k = 0, n = corner_count(cell); k < n; ++k)
            visit(cell[k], cell[(k + 1) % n], sides_.across(cell[k], cell[(k + 1) % n], c));
    }

    void grow()
    {
        std::vector<Index> queue;
        for (std::size_t c = 0; c < mesh_.cells.size(); ++c) {
            int boundary = 0;
            around(static_cast<Index>(c), [&](Index, Index, Index other) { boundary += other < 0 ? 1 : 0; });
            if (boundary % 2 == 0) continue;
            root_[c] = static_cast<Index>(c);
            queue.push_back(static_cast<Index>(c));
        }
        for (std::size_t i = 0; i < queue.size(); ++i) {
            const Index here = queue[i];
            around(here, [&](Index, Index, Index other) {
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
        for (std::size_t c = 0; c < mesh_.cells.size(); ++c) {
            const auto one = static_cast<Index>(c);
            around(one, [&](Index, Index, Index two) {
                if (two > one && root_[c] >= 0 && root_[index(two)] != root_[c])
                    meetings.push_back({steps_[c] + steps_[index(two)], one, two});
            });
        }
        std::sort(meetings.begin(), meetings.end(), [](const Meeting& a, const Meeting& b) {
            return std::tie(a.steps, a.one, a.two) < std::tie(b.steps, b.one, b.two);
        });
        // The least tree over the groups (Kruskal).
        std::vector<Index> group(mesh_.cells.size());
        std::iota(group.begin(), group.end(), Index{0});
        const auto find = [&](Index c) {
            while (group[index(c)] != c) c = group[index(c)] = group[index(group[index(c)])];
            return c;
        };
        std::vector<std::vector<Meeting>> tree(mesh_.cells.size());
        for (const Meeting& m : meetings) {
            const Index a = root_[index(m.one)], b = root_[index(m.two)];
            if (find(a) == find(b)) continue;
            group[index(find(a))] = find(b);
            tree[index(a)].push_back(m);
            tree[index(b)].push_back({m.steps, m.two, m.one});
        }
        std::vector<bool> seen(mesh_.cells.size(), false);
        for (std::size_t c = 0; c < mesh_.cells.size(); ++c) {
            if (root_[c] == static_cast<Index>(c) && !seen[c]) send_up(static_cast<Index>(c), tree, seen);
        }
    }

    /// From the leaves of a tree of groups to its root: an odd branch is joined to what is above it.
    void send_up(Index top, const std::vector<std::vector<Meeting>>& tree, std::vector<bool>& seen)
    {
        std::vector<std::pair<Index, Meeting>> order{{top, {0, -1, -1}}}; // a root and the way up from it
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

    void toggle(Index one, Index two)
    {
        around(one, [&](Index a, Index b, Index other) {
            if (other != two) return;
            const std::uint64_t key = side_key(a, b);
            if (!whole_.erase(key)) whole_.insert(key);
        });
    }

    const MixedMesh& mesh_;
    Sides sides_;
    std::vector<Index> root_, from_; ///< the odd cell a cell was reached from, and the cell before it
    std::vector<int> steps_;
    std::unordered_set<std::uint64_t> whole_;
};

double cross(const Vec2& u, const Vec2& v) { return u.x() * v.y() - u.y() * v.x(); }

class Splitter {
public:
    explicit Splitter(const MixedMesh& mesh) : mesh_(mesh), whole_(mesh)
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

    Index middle(Index a, Index b)
    {
        const auto [found, fresh] = middles_.try_emplace(side_key(a, b), -1);
        if (fresh) found->second = add((at(a) + at(b)) / 2);
        return found->second;
    }

    void split(Index c)
    {
        const Quad& cell = mesh_.cells[index(c)];
        const std::size_t n = corner_count(cell);
        std::array<Index, 4> corner{}, half{-1, -1, -1, -1};
        std::size_t whole = 0;
        for (std::size_t k = 0; k < n; ++k) {
            const Index a = cell[k], b = cell[(k + 1) % n];
            corner[k] = a;
            if (whole_.is_boundary(a, b, c) || whole_.is_whole(a, b))
                ++whole;
            else
                half[k] = middle(a, b);
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

    /// Two whole sides: a quad with a flat corner, filled by a smaller one on rays from the middle of the inner
    /// circle, and four around.
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

    /// Two whole sides: two quads where they are opposite, three round a point between the corner of the
    /// halved ones and that of the others.
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
        // Sides k and k + 1 are halved: their corner is d, the opposite one b.
        const Index c = corner[k], d = corner[(k + 1) % 4], a = corner[(k + 2) % 4], b = corner[(k + 3) % 4];
        const Index m = half[k], n = half[(k + 1) % 4];
        // Where the line through both middles crosses the diagonal, as a share of the way from b to d.
        const Vec2 line = at(n) - at(m), diagonal = at(d) - at(b);
        const double most = cross(at(m) - at(b), line) / cross(diagonal, line);
        const Index x = add(at(b) + most / 1.5 * diagonal);
        made_.cells.push_back({d, n, x, m});
        made_.cells.push_back({n, a, b, x});
        made_.cells.push_back({x, b, c, m});
    }

    const MixedMesh& mesh_;
    WholeSides whole_;
    MixedMesh made_;
    std::unordered_map<std::uint64_t, Index> middles_;
};

} // namespace

MixedMesh split_cells(const MixedMesh& mesh) { return Splitter(mesh).run(); }

} // namespace lacuna::quads
