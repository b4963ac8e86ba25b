// SPDX-License-Identifier: MIT
#include <lacuna/quads/detail/quad_repair.h>

#include <lacuna/quads/detail/quad_sides.h>

#include <cmath>
#include <numbers>

namespace lacuna::quads {

namespace {

/// Quads around every point.
std::vector<std::vector<Index>> cells_around(const MixedMesh& mesh)
{
    std::vector<std::vector<Index>> around(mesh.points.size());
    for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
        for (const Index p : mesh.cells[c])
            around[static_cast<std::size_t>(p)].push_back(static_cast<Index>(c));
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

    /// Where quads around an inner point are bad, move it to where the worst is best, by trial in eight
    /// directions.
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
                const double lack = std::max(
                    0.0, kGood - corner_sine(mesh_, mesh_.cells[static_cast<std::size_t>(c)], k));
                sum += lack * lack;
            }
        }
        return sum;
    }

private:
    static constexpr double kGood = 0.7; ///< a quad from which smoothness counts more than the worst corner

    [[nodiscard]] double worst_around(std::size_t p) const
    {
        double worst = 1;
        for (const Index c : around_[p])
            worst = std::min(worst, scaled_jacobian(mesh_, mesh_.cells[static_cast<std::size_t>(c)]));
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
    const std::array<Index, 6> ring{a, two[(m + 2) % 4], two[(m + 3) % 4],
                                    b, one[(k + 2) % 4], one[(k + 3) % 4]};
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

/// Gives boundary points that lie flat in one quad alone a second one, taken over from the nearest point
/// along the boundary that can spare one, point by point.
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
        const auto step = [&](const Quad& q, std::size_t k, std::size_t i) {
            return forward ? q[(k + i) % 4] : q[(k + 4 - i) % 4];
        };
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

} // namespace lacuna::quads
