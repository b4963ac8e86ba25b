// SPDX-License-Identifier: MIT
#include <lacuna/quads/detail/quad_repair.h>
#include <lacuna/quads/detail/quad_sides.h>

#include <functional>
#include <limits>
#include <tuple>

namespace lacuna::quads {

namespace {

/// The cell path from a triangle to the nearest other one, both included; empty where there is none.
std::vector<Index> path_to_triangle(const MixedMesh& mesh, const Sides& sides, Index start)
{
    std::unordered_map<Index, Index> from{{start, -1}};
    std::vector<Index> queue{start};
    for (std::size_t i = 0; i < queue.size(); ++i) {
        const Index c = queue[i];
        const Quad& cell = mesh.cells[static_cast<std::size_t>(c)];
        if (c != start && MixedMesh::is_triangle(cell)) {
            std::vector<Index> path;
            for (Index step = c; step >= 0; step = from.at(step)) path.push_back(step);
            std::reverse(path.begin(), path.end());
            return path;
        }
        for (std::size_t k = 0, n = corner_count(cell); k < n; ++k) {
            const Index other = sides.across(cell[k], cell[(k + 1) % n], c);
            if (other >= 0 && from.try_emplace(other, c).second) queue.push_back(other);
        }
    }
    return {};
}

/// Corners of a triangle and a neighbour as one counter-clockwise ring. @pre they share a side.
std::vector<Index> ring_of(const Quad& triangle, const Quad& cell)
{
    const std::size_t n = corner_count(cell);
    for (std::size_t k = 0; k < 3; ++k) {
        const Index a = triangle[k];
        const Index b = triangle[(k + 1) % 3];
        for (std::size_t i = 0; i < n; ++i) {
            if (cell[i] != b || cell[(i + 1) % n] != a) continue;
            std::vector<Index> ring{a};
            for (std::size_t j = 2; j < n; ++j) ring.push_back(cell[(i + j) % n]);
            ring.push_back(b);
            ring.push_back(triangle[(k + 2) % 3]);
            return ring;
        }
    }
    return {};
}

double triangle_quality(const MixedMesh& mesh, const Quad& t)
{
    double worst = 1;
    for (std::size_t k = 0; k < 3; ++k) {
        const Vec2 u = mesh.at(t[(k + 1) % 3]) - mesh.at(t[k]);
        const Vec2 v = mesh.at(t[(k + 2) % 3]) - mesh.at(t[k]);
        worst = std::min(worst, (u.x() * v.y() - u.y() * v.x()) / std::max(u.norm() * v.norm(), 1e-300));
    }
    return worst;
}

/// Divide the pentagon of a triangle and a quad so that the triangle lies at the side to `next`.
void step_triangle(MixedMesh& mesh, Sides& sides, Index triangle, Index quad, Index next)
{
    const Quad t = mesh.cells[static_cast<std::size_t>(triangle)];
    const Quad q = mesh.cells[static_cast<std::size_t>(quad)];
    const std::vector<Index> ring = ring_of(t, q);
    Quad best_triangle{}, best_quad{};
    double best = -std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < 5; ++i) {
        const Index a = ring[i];
        const Index b = ring[(i + 1) % 5];
        if (sides.across(a, b, quad) != next && sides.across(a, b, triangle) != next) continue;
        for (const std::size_t first : {i, (i + 4) % 5}) {
            const auto at = [&](std::size_t k) { return ring[(first + k) % 5]; };
            const Quad cut{at(0), at(1), at(2), -1};
            const Quad rest{at(2), at(3), at(4), at(0)};
            const double quality = std::min(triangle_quality(mesh, cut), scaled_jacobian(mesh, rest));
            if (quality <= best) continue;
            best = quality;
            best_triangle = cut;
            best_quad = rest;
        }
    }
    sides.remove(t, triangle);
    sides.remove(q, quad);
    // The quad's place takes the triangle, so that the path's next step finds it there.
    replace(mesh, sides, quad, best_triangle);
    replace(mesh, sides, triangle, best_quad);
}

/// Pairs of neighbouring triangles that make quads.
class Matching {
public:
    explicit Matching(const MixedMesh& mesh)
        : mesh_(mesh), neighbours_(mesh.cells.size()), mate_(mesh.cells.size(), -1)
    {
        const Sides sides(mesh);
        for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
            const Quad& cell = mesh.cells[c];
            if (!MixedMesh::is_triangle(cell)) continue;
            for (std::size_t k = 0; k < 3; ++k) {
                const Index other = sides.across(cell[k], cell[(k + 1) % 3], static_cast<Index>(c));
                if (other < 0 || !MixedMesh::is_triangle(mesh.cells[static_cast<std::size_t>(other)]))
                    continue;
                const double quality = scaled_jacobian(mesh, merged(static_cast<Index>(c), other));
                if (quality > kLeast) neighbours_[c].emplace_back(quality, other);
            }
            std::sort(neighbours_[c].begin(), neighbours_[c].end(), std::greater<>());
        }
    }

    /// The best pairs first.
    void greedy()
    {
        std::vector<std::tuple<double, Index, Index>> pairs;
        for (std::size_t c = 0; c < neighbours_.size(); ++c) {
            for (const auto& [quality, other] : neighbours_[c]) {
                if (static_cast<Index>(c) < other) pairs.emplace_back(-quality, static_cast<Index>(c), other);
            }
        }
        std::sort(pairs.begin(), pairs.end());
        for (const auto& [quality, a, b] : pairs) {
            if (mate(a) >= 0 || mate(b) >= 0) continue;
            mate(a) = b;
            mate(b) = a;
        }
    }

    /// Join two unpaired triangles by a path of pairs that all change partners. Odd rings of triangles are
    /// not looked into, so a few may be left that could be paired.
    void augment()
    {
        for (std::size_t c = 0; c < mate_.size(); ++c) {
            if (mate_[c] < 0 && !neighbours_[c].empty()) augment_from(static_cast<Index>(c));
        }
    }

    [[nodiscard]] std::vector<Quad> cells() const
    {
        std::vector<Quad> cells;
        for (std::size_t c = 0; c < mate_.size(); ++c) {
            if (mate_[c] < 0)
                cells.push_back(mesh_.cells[c]);
            else if (static_cast<Index>(c) < mate_[c])
                cells.push_back(merged(static_cast<Index>(c), mate_[c]));
        }
        return cells;
    }

private:
    static constexpr double kLeast =
        0.15; ///< a flatter quad is no pair: smoothing cannot mend it at a boundary

    Index& mate(Index c) { return mate_[static_cast<std::size_t>(c)]; }

    [[nodiscard]] Quad merged(Index a, Index b) const
    {
        const std::vector<Index> ring = ring_of(mesh_.cells[static_cast<std::size_t>(a)],
                                                mesh_.cells[static_cast<std::size_t>(b)]);
        return {ring[0], ring[1], ring[2], ring[3]};
    }

    void augment_from(Index start)
    {
        // Triangles reached over an even number of steps, with the one before each.
        std::unordered_map<Index, Index> before{{start, -1}};
        std::vector<Index> queue{start};
        for (std::size_t i = 0; i < queue.size(); ++i) {
            const Index here = queue[i];
            for (const auto& [quality, other] : neighbours_[static_cast<std::size_t>(here)]) {
                // Reached both ways: an odd ring.
                if (before.contains(other)) continue;
                const Index next = mate(other);
                if (next < 0) {
                    change_partners(here, other, before);
                    return;
                }
                if (next >= 0 && before.try_emplace(next, here).second) queue.push_back(next);
            }
        }
    }

    void change_partners(Index here, Index other, const std::unordered_map<Index, Index>& before)
    {
        while (here >= 0) {
            const Index left = mate(here);
            mate(here) = other;
            mate(other) = here;
            other = left;
            here = before.at(here);
        }
    }

    const MixedMesh& mesh_;
    std::vector<std::vector<std::pair<double, Index>>> neighbours_;
    std::vector<Index> mate_;
};

} // namespace

void match_triangles(MixedMesh& mesh)
{
    Matching matching(mesh);
    matching.greedy();
    matching.augment();
    mesh.cells = matching.cells();
}

void pair_triangles(MixedMesh& mesh)
{
    Sides sides(mesh);
    std::vector<Index> triangles;
    for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
        if (MixedMesh::is_triangle(mesh.cells[c])) triangles.push_back(static_cast<Index>(c));
    }
    std::vector<bool> gone(mesh.cells.size(), false);
    for (const Index start : triangles) {
        if (gone[static_cast<std::size_t>(start)] ||
            !MixedMesh::is_triangle(mesh.cells[static_cast<std::size_t>(start)]))
            continue;
        const std::vector<Index> path = path_to_triangle(mesh, sides, start);
        if (path.empty()) break;
        for (std::size_t i = 0; i + 2 < path.size(); ++i)
            step_triangle(mesh, sides, path[i], path[i + 1], path[i + 2]);
        const Index last = path[path.size() - 2];
        const Index goal = path.back();
        const Quad a = mesh.cells[static_cast<std::size_t>(last)];
        const Quad b = mesh.cells[static_cast<std::size_t>(goal)];
        const std::vector<Index> ring = ring_of(a, b);
        sides.remove(a, last);
        sides.remove(b, goal);
        replace(mesh, sides, last, {ring[0], ring[1], ring[2], ring[3]});
        gone[static_cast<std::size_t>(goal)] = true;
    }
    std::vector<Quad> kept;
    for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
        if (!gone[c]) kept.push_back(mesh.cells[c]);
    }
    mesh.cells = std::move(kept);
}

MixedMesh subdivide(const MixedMesh& mesh, const std::vector<Triangle>& middles,
                    const std::vector<Vec2>& fixed, const std::vector<Index>& points_of)
{
    MixedMesh fine;
    fine.fixed = fixed.size();
    fine.points = fixed;
    std::vector<Index> place = points_of;
    for (std::size_t p = mesh.fixed; p < mesh.points.size(); ++p) {
        place.push_back(static_cast<Index>(fine.points.size()));
        fine.points.push_back(mesh.points[p]);
    }
    std::unordered_map<std::uint64_t, Index> middle;
    for (const Triangle& m : middles) middle[side_key(m[0], m[1])] = m[2];
    const auto middle_of = [&](Index a, Index b) {
        const auto [found, fresh] = middle.try_emplace(side_key(a, b),
                                                       static_cast<Index>(fine.points.size()));
        if (fresh) fine.points.push_back((mesh.at(a) + mesh.at(b)) / 2);
        return found->second;
    };
    for (const Quad& cell : mesh.cells) {
        const std::size_t n = corner_count(cell);
        Vec2 centre = Vec2::Zero();
        for (std::size_t k = 0; k < n; ++k) centre += mesh.at(cell[k]) / static_cast<double>(n);
        const auto c = static_cast<Index>(fine.points.size());
        fine.points.push_back(centre);
        for (std::size_t k = 0; k < n; ++k) {
            fine.cells.push_back({place[static_cast<std::size_t>(cell[k])],
                                  middle_of(cell[k], cell[(k + 1) % n]), c,
                                  middle_of(cell[(k + n - 1) % n], cell[k])});
        }
    }
    return fine;
}

} // namespace lacuna::quads
