// SPDX-License-Identifier: GPL-2.0-or-later
#include <lacuna/cad/quad_repair.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <numbers>
#include <tuple>
#include <unordered_map>

namespace lacuna::cad {

namespace {

std::uint64_t side_key(Index a, Index b)
{
    const auto [low, high] = std::minmax(a, b);
    return (static_cast<std::uint64_t>(static_cast<std::uint32_t>(low)) << 32) | static_cast<std::uint32_t>(high);
}

std::size_t corner_count(const Quad& cell) { return MixedMesh::is_triangle(cell) ? 3 : 4; }

std::size_t place_of(const Quad& cell, Index point)
{
    std::size_t k = 0;
    while (cell[k] != point) ++k;
    return k;
}

/// The one or two cells at every side.
class Sides {
public:
    explicit Sides(const MixedMesh& mesh)
    {
        for (std::size_t c = 0; c < mesh.cells.size(); ++c) add(mesh.cells[c], static_cast<Index>(c));
    }
    void add(const Quad& cell, Index c)
    {
        for (std::size_t k = 0, n = corner_count(cell); k < n; ++k) {
            auto& both = cells_.try_emplace(side_key(cell[k], cell[(k + 1) % n]), std::array<Index, 2>{-1, -1}).first->second;
            both[both[0] < 0 ? 0 : 1] = c;
        }
    }
    void remove(const Quad& cell, Index c)
    {
        for (std::size_t k = 0, n = corner_count(cell); k < n; ++k) {
            auto& both = cells_.at(side_key(cell[k], cell[(k + 1) % n]));
            if (both[0] == c) both[0] = both[1];
            else if (both[1] != c) continue;
            both[1] = -1;
        }
    }
    [[nodiscard]] Index across(Index a, Index b, Index c) const
    {
        const auto found = cells_.find(side_key(a, b));
        if (found == cells_.end()) return -1;
        return found->second[0] == c ? found->second[1] : found->second[0];
    }

private:
    std::unordered_map<std::uint64_t, std::array<Index, 2>> cells_;
};

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

void replace(MixedMesh& mesh, Sides& sides, Index c, const Quad& cell)
{
    sides.add(cell, c);
    mesh.cells[static_cast<std::size_t>(c)] = cell;
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

/// Quads around every point.
std::vector<std::vector<Index>> cells_around(const MixedMesh& mesh)
{
    std::vector<std::vector<Index>> around(mesh.points.size());
    for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
        for (const Index p : mesh.cells[c]) around[static_cast<std::size_t>(p)].push_back(static_cast<Index>(c));
    }
    return around;
}

/// Merge the two quads at every inner point that has no more. @return whether there were any.
bool remove_doublets(MixedMesh& mesh)
{
    auto around = cells_around(mesh);
    std::vector<bool> gone(mesh.cells.size(), false);
    bool any = false;
    for (std::size_t p = mesh.fixed; p < mesh.points.size(); ++p) {
        std::erase_if(around[p], [&](Index c) { return gone[static_cast<std::size_t>(c)]; });
        if (around[p].size() != 2) continue;
        Quad& one = mesh.cells[static_cast<std::size_t>(around[p][0])];
        const Quad two = mesh.cells[static_cast<std::size_t>(around[p][1])];
        const Index far = two[(place_of(two, static_cast<Index>(p)) + 2) % 4];
        const std::size_t k = place_of(one, static_cast<Index>(p));
        if (one[(k + 2) % 4] == far) continue;
        one[k] = far;
        gone[static_cast<std::size_t>(around[p][1])] = true;
        around[static_cast<std::size_t>(far)].push_back(around[p][0]);
        around[p].clear();
        any = true;
    }
    if (!any) return false;
    std::vector<Quad> kept;
    for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
        if (!gone[c]) kept.push_back(mesh.cells[c]);
    }
    mesh.cells = std::move(kept);
    // Points without quads go, the boundary's stay first.
    std::vector<bool> used(mesh.points.size(), false);
    for (const Quad& q : mesh.cells) {
        for (const Index p : q) used[static_cast<std::size_t>(p)] = true;
    }
    std::vector<Index> place(mesh.points.size(), -1);
    std::vector<Vec2> points;
    for (std::size_t p = 0; p < mesh.points.size(); ++p) {
        if (p >= mesh.fixed && !used[p]) continue;
        place[p] = static_cast<Index>(points.size());
        points.push_back(mesh.points[p]);
    }
    for (Quad& q : mesh.cells) {
        for (Index& p : q) p = place[static_cast<std::size_t>(p)];
    }
    mesh.points = std::move(points);
    return true;
}

/// A quad below it is worth work on its connections; half the sine of a right angle.
constexpr double kWorthWork = 0.5;

double corner_sine(const MixedMesh& mesh, const Quad& q, std::size_t k)
{
    const Vec2 u = mesh.at(q[(k + 1) % 4]) - mesh.at(q[k]);
    const Vec2 v = mesh.at(q[(k + 3) % 4]) - mesh.at(q[k]);
    const double product = u.norm() * v.norm();
    return product > 0 ? (u.x() * v.y() - u.y() * v.x()) / product : -1;
}

/// Pairs of neighbouring triangles that make quads.
class Matching {
public:
    explicit Matching(const MixedMesh& mesh) : mesh_(mesh), neighbours_(mesh.cells.size()), mate_(mesh.cells.size(), -1)
    {
        const Sides sides(mesh);
        for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
            const Quad& cell = mesh.cells[c];
            if (!MixedMesh::is_triangle(cell)) continue;
            for (std::size_t k = 0; k < 3; ++k) {
                const Index other = sides.across(cell[k], cell[(k + 1) % 3], static_cast<Index>(c));
                if (other < 0 || !MixedMesh::is_triangle(mesh.cells[static_cast<std::size_t>(other)])) continue;
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

    /// Join two unpaired triangles by a path of pairs that all change partners. Odd rings of triangles are not
    /// looked into, so a few may be left that could be paired.
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
            if (mate_[c] < 0) cells.push_back(mesh_.cells[c]);
            else if (static_cast<Index>(c) < mate_[c]) cells.push_back(merged(static_cast<Index>(c), mate_[c]));
        }
        return cells;
    }

private:
    static constexpr double kLeast = 0.15;  ///< a flatter quad is no pair: smoothing cannot mend it at a boundary

    Index& mate(Index c) { return mate_[static_cast<std::size_t>(c)]; }

    [[nodiscard]] Quad merged(Index a, Index b) const
    {
        const std::vector<Index> ring = ring_of(mesh_.cells[static_cast<std::size_t>(a)], mesh_.cells[static_cast<std::size_t>(b)]);
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

class Smoother {
public:
    explicit Smoother(MixedMesh& mesh) : mesh_(mesh), around_(cells_around(mesh)) {}

    /// Towards the middle of the neighbours, where that does not spoil the worst quad.
    void laplace()
    {
        for (std::size_t p = mesh_.fixed; p < mesh_.points.size(); ++p) {
            Vec2 sum = Vec2::Zero();
            double count = 0;
            for (const Index c : around_[p]) {
                const Quad& q = mesh_.cells[static_cast<std::size_t>(c)];
                const std::size_t k = place_of(q, static_cast<Index>(p));
                // Each neighbour comes up in two quads.
                sum += mesh_.at(q[(k + 1) % 4]) + mesh_.at(q[(k + 3) % 4]);
                count += 2;
            }
            if (count == 0) continue;
            const double before = worst_around(p);
            const Vec2 old = mesh_.points[p];
            mesh_.points[p] = sum / count;
            const double after = worst_around(p);
            if (after < before && after < kGood) mesh_.points[p] = old;
        }
    }

    void optimise()
    {
        for (std::size_t p = mesh_.fixed; p < mesh_.points.size(); ++p) optimise(p);
    }

    /// Where quads around an inner point are bad, move it to where the worst is best, by trial in eight directions.
    void optimise(std::size_t p)
    {
        double best = worst_around(p);
        if (p < mesh_.fixed || best >= kGood || around_[p].empty()) return;
        double reach = 0;
        for (const Index c : around_[p]) {
            const Quad& q = mesh_.cells[static_cast<std::size_t>(c)];
            reach = std::max(reach, (mesh_.at(q[0]) - mesh_.at(q[2])).norm());
        }
        for (double step = reach / 4; step > reach / 400; step /= 2) {
            for (bool moved = true; moved;) {
                moved = false;
                const Vec2 old = mesh_.points[p];
                Vec2 place = old;
                for (int d = 0; d < 8; ++d) {
                    const double angle = d * std::numbers::pi / 4;
                    mesh_.points[p] = old + step * Vec2(std::cos(angle), std::sin(angle));
                    const double quality = worst_around(p);
                    if (quality <= best + 1e-9) continue;
                    best = quality;
                    place = mesh_.points[p];
                    moved = true;
                }
                mesh_.points[p] = place;
            }
        }
    }

    /// Put other corners in place of a quad's.
    void replace(Index c, const Quad& quad)
    {
        Quad& cell = mesh_.cells[static_cast<std::size_t>(c)];
        for (const Index p : cell) std::erase(around_[static_cast<std::size_t>(p)], c);
        cell = quad;
        for (const Index p : cell) around_[static_cast<std::size_t>(p)].push_back(c);
    }

    /// What the corners of the quads around some points lack to good ones, the worst counting most.
    [[nodiscard]] double lack_around(const std::array<Index, 6>& points) const
    {
        std::vector<Index> cells;
        for (const Index p : points) {
            const auto& around = around_[static_cast<std::size_t>(p)];
            cells.insert(cells.end(), around.begin(), around.end());
        }
        std::sort(cells.begin(), cells.end());
        cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
        double sum = 0;
        for (const Index c : cells) {
            // By corner: otherwise one quad shrunk to a line would look better than two with a flat corner.
            for (std::size_t k = 0; k < 4; ++k) {
                const double lack = std::max(0.0, kGood - corner_sine(mesh_, mesh_.cells[static_cast<std::size_t>(c)], k));
                sum += lack * lack;
            }
        }
        return sum;
    }

private:
    static constexpr double kGood = 0.7;  ///< a quad from which smoothness counts more than the worst corner

    [[nodiscard]] double worst_around(std::size_t p) const
    {
        double worst = 1;
        for (const Index c : around_[p]) worst = std::min(worst, scaled_jacobian(mesh_, mesh_.cells[static_cast<std::size_t>(c)]));
        return worst;
    }

    MixedMesh& mesh_;
    std::vector<std::vector<Index>> around_;
};

/// Turn one side of a bad quad, let the points around settle, and keep that if the quads there are better.
bool turn_side(MixedMesh& mesh, Sides& sides, Smoother& smoother, Index c, std::size_t k)
{
    const Quad one = mesh.cells[static_cast<std::size_t>(c)];
    const Index a = one[k];
    const Index b = one[(k + 1) % 4];
    const Index other = sides.across(a, b, c);
    if (other < 0) return false;
    const Quad two = mesh.cells[static_cast<std::size_t>(other)];
    const std::size_t m = place_of(two, b);
    if (two[(m + 1) % 4] != a) return false;
    // Counter-clockwise: a, two's far corners, b, one's far corners.
    const std::array<Index, 6> ring{a, two[(m + 2) % 4], two[(m + 3) % 4], b, one[(k + 2) % 4], one[(k + 3) % 4]};
    const double before = smoother.lack_around(ring);
    for (const std::size_t turn : {1, 2}) {
        const auto at = [&](std::size_t i) { return ring[(turn + i) % 6]; };
        // A chord that is a side already would give two quads two sides in common.
        if (at(0) == at(3) || sides.across(at(0), at(3), -2) >= 0) continue;
        std::array<Vec2, 6> places;
        for (std::size_t i = 0; i < 6; ++i) places[i] = mesh.at(ring[i]);
        smoother.replace(c, {at(0), at(1), at(2), at(3)});
        smoother.replace(other, {at(3), at(4), at(5), at(0)});
        for (int pass = 0; pass < 2; ++pass) {
            for (const Index p : ring) smoother.optimise(static_cast<std::size_t>(p));
        }
        if (smoother.lack_around(ring) < before - 1e-6) {
            sides.remove(one, c);
            sides.remove(two, other);
            sides.add(mesh.cells[static_cast<std::size_t>(c)], c);
            sides.add(mesh.cells[static_cast<std::size_t>(other)], other);
            return true;
        }
        smoother.replace(c, one);
        smoother.replace(other, two);
        for (std::size_t i = 0; i < 6; ++i) mesh.points[static_cast<std::size_t>(ring[i])] = places[i];
    }
    return false;
}

/// @return whether any side turned.
bool turn_sides(MixedMesh& mesh)
{
    Sides sides(mesh);
    Smoother smoother(mesh);
    bool any = false;
    for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
        for (std::size_t k = 0; k < 4; ++k) {
            if (scaled_jacobian(mesh, mesh.cells[c]) >= kWorthWork) break;
            any = turn_side(mesh, sides, smoother, static_cast<Index>(c), k) || any;
        }
    }
    return any;
}

/// Gives boundary points that lie flat in one quad alone a second one, taken over from the nearest point along the
/// boundary that can spare one, point by point.
class FlatCorners {
public:
    explicit FlatCorners(MixedMesh& mesh) : mesh_(mesh), sides_(mesh), count_(mesh.points.size(), 0)
    {
        for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
            for (std::size_t k = 0; k < 4; ++k) {
                const Index a = mesh.cells[c][k];
                const Index b = mesh.cells[c][(k + 1) % 4];
                ++count_[static_cast<std::size_t>(a)];
                if (sides_.across(a, b, static_cast<Index>(c)) >= 0) continue;
                next_[a] = b;
                before_[b] = a;
            }
        }
    }

    void mend()
    {
        for (std::size_t p = 0; p < mesh_.fixed; ++p) {
            const auto v = static_cast<Index>(p);
            if (next_.contains(v) && count_[p] == 1 && angle(v) > kFlat) mend(v);
        }
    }

private:
    /// From this angle on a boundary point wants one more quad [radians].
    static constexpr double kFlat = 0.85 * std::numbers::pi;

    /// Inner angle of the boundary.
    [[nodiscard]] double angle(Index v) const
    {
        const Vec2 out = mesh_.at(next_.at(v)) - mesh_.at(v);
        const Vec2 back = mesh_.at(before_.at(v)) - mesh_.at(v);
        const double turn = std::atan2(out.x() * back.y() - out.y() * back.x(), out.dot(back));
        return turn > 0 ? turn : turn + 2 * std::numbers::pi;
    }

    [[nodiscard]] bool can_spare(Index v) const
    {
        const int count = count_[static_cast<std::size_t>(v)];
        return count > 1 && angle(v) / (count - 1) < kFlat;
    }

    void mend(Index v)
    {
        std::vector<Index> ahead{v}, behind{v};
        while (true) {
            ahead.push_back(next_.at(ahead.back()));
            behind.push_back(before_.at(behind.back()));
            if (ahead.back() == v) return;
            for (const auto& [way, forward] : {std::pair(&ahead, true), std::pair(&behind, false)}) {
                if (!can_spare(way->back())) continue;
                for (std::size_t i = way->size() - 1; i > 0; --i) {
                    if (!hand_over((*way)[i], (*way)[i - 1], forward)) return;
                }
                return;
            }
        }
    }

    /// Turn the side at `from` next to the boundary side it shares with `to`, so that it starts at `to`.
    bool hand_over(Index from, Index to, bool forward)
    {
        const Index c = forward ? sides_.across(to, from, -2) : sides_.across(from, to, -2);
        const Quad one = mesh_.cells[static_cast<std::size_t>(c)];
        // Going round from the boundary side: from, then away from `to`.
        const auto step = [&](const Quad& q, std::size_t k, std::size_t i) { return forward ? q[(k + i) % 4] : q[(k + 4 - i) % 4]; };
        const std::size_t k = place_of(one, from);
        const Index far = step(one, k, 1);
        const Index last = step(one, k, 2);
        const Index other = sides_.across(from, far, c);
        if (other < 0) return false;
        const Quad two = mesh_.cells[static_cast<std::size_t>(other)];
        const std::size_t m = place_of(two, from);
        const Index y = step(two, m, 1);
        const Index z = step(two, m, 2);
        if (z == to || z == last || sides_.across(to, z, -2) >= 0) return false;
        Quad first{to, from, y, z};
        Quad second{z, far, last, to};
        if (!forward) {
            std::reverse(first.begin(), first.end());
            std::reverse(second.begin(), second.end());
        }
        sides_.remove(one, c);
        sides_.remove(two, other);
        replace(mesh_, sides_, c, first);
        replace(mesh_, sides_, other, second);
        --count_[static_cast<std::size_t>(from)];
        --count_[static_cast<std::size_t>(far)];
        ++count_[static_cast<std::size_t>(to)];
        ++count_[static_cast<std::size_t>(z)];
        return true;
    }

    MixedMesh& mesh_;
    Sides sides_;
    std::vector<int> count_;
    std::unordered_map<Index, Index> next_, before_;
};

} // namespace

double scaled_jacobian(const MixedMesh& mesh, const Quad& q)
{
    double worst = 1;
    for (std::size_t k = 0; k < 4; ++k) worst = std::min(worst, corner_sine(mesh, q, k));
    return worst;
}

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
        if (gone[static_cast<std::size_t>(start)] || !MixedMesh::is_triangle(mesh.cells[static_cast<std::size_t>(start)])) continue;
        const std::vector<Index> path = path_to_triangle(mesh, sides, start);
        if (path.empty()) break;
        for (std::size_t i = 0; i + 2 < path.size(); ++i) step_triangle(mesh, sides, path[i], path[i + 1], path[i + 2]);
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

MixedMesh subdivide(const MixedMesh& mesh, const std::vector<Triangle>& middles, const std::vector<Vec2>& fixed,
                    const std::vector<Index>& points_of)
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
        const auto [found, fresh] = middle.try_emplace(side_key(a, b), static_cast<Index>(fine.points.size()));
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
            fine.cells.push_back({place[static_cast<std::size_t>(cell[k])], middle_of(cell[k], cell[(k + 1) % n]), c,
                                  middle_of(cell[(k + n - 1) % n], cell[k])});
        }
    }
    return fine;
}

void improve(MixedMesh& mesh)
{
    constexpr int kRounds = 6;
    constexpr int kSweeps = 5;
    while (remove_doublets(mesh)) {}
    FlatCorners(mesh).mend();
    while (remove_doublets(mesh)) {}
    for (int round = 0; round < kRounds; ++round) {
        Smoother smoother(mesh);
        for (int sweep = 0; sweep < kSweeps; ++sweep) smoother.laplace();
        smoother.optimise();
        bool changed = turn_sides(mesh);
        while (remove_doublets(mesh)) changed = true;
        if (!changed && round > 0) break;
    }
    Smoother(mesh).optimise();
}

} // namespace lacuna::cad
