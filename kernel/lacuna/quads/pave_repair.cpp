// SPDX-License-Identifier: MIT
#include <lacuna/quads/detail/pave_repair.h>

#include <lacuna/quads/detail/partial_mesh.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

namespace lacuna::quads::paving {
namespace {

/// A small square, as seen from its corners, about a point that sees all corners of a quad that is not convex: nodes with which four
/// quads round a fifth are convex. None where no such point is known.
std::optional<std::array<Vec2, 4>> small_within(const std::array<Vec2, 4>& outer)
{
    // From the corner that turns in, the diagonal to the opposite one is seen from everywhere.
    std::size_t inward = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < 4; ++k) {
        const Vec2 out = outer[(k + 1) % 4] - outer[k], back = outer[(k + 3) % 4] - outer[k];
        const double sine = cross(out, back) / std::max(out.norm() * back.norm(), 1e-300);
        if (sine < least) {
            least = sine;
            inward = k;
        }
    }
    const Vec2 centre = (outer[inward] + outer[(inward + 2) % 4]) / 2;
    double room = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < 4; ++k) {
        const Vec2 side = outer[(k + 1) % 4] - outer[k];
        room = std::min(room, cross(side, centre - outer[k]) / std::max(side.norm(), 1e-300));
    }
    if (!(room > 0)) return std::nullopt;
    std::array<Vec2, 4> inner;
    for (std::size_t k = 0; k < 4; ++k) inner[k] = centre + 0.4 * room * (outer[k] - centre).normalized();
    return inner;
}

/// Four quads round a smaller one in the place of a quad.
void surround(PlanarQuads& mesh, std::size_t q)
{
    const Quad outer = mesh.quads[q];
    std::array<Vec2, 4> corner;
    for (std::size_t k = 0; k < 4; ++k) corner[k] = mesh.points[static_cast<std::size_t>(outer[k])];
    const Vec2 centre = (corner[0] + corner[1] + corner[2] + corner[3]) / 4;
    std::array<Vec2, 4> place;
    for (std::size_t k = 0; k < 4; ++k) place[k] = (corner[k] + centre) / 2;
    constexpr double kFlat = 0.1; // a corner straighter than this leaves no room half way to the middle
    if (least_sine(corner[0], corner[1], corner[2], corner[3]) < kFlat)
        place = small_within(corner).value_or(place);
    Quad inner{};
    for (std::size_t k = 0; k < 4; ++k) {
        inner[k] = static_cast<Index>(mesh.points.size());
        mesh.points.push_back(place[k]);
    }
    mesh.quads[q] = inner;
    for (std::size_t k = 0; k < 4; ++k)
        mesh.quads.push_back({outer[k], outer[(k + 1) % 4], inner[(k + 1) % 4], inner[k]});
}

/// Quads by node, and how many each node needs.
class CornerOpener {
public:
    CornerOpener(PlanarQuads& mesh, const PlanarRegion& region) : mesh_(mesh), fixed_(region.points.size())
    {
        needed_.assign(fixed_, 0);
        better_.assign(fixed_, 0);
        for (const auto& loop : region.loops) {
            for (std::size_t i = 0, n = loop.size(); i < n; ++i) {
                const Vec2& p = at(loop[i]);
                const double angle = turn_between(at(loop[(i + 1) % n]) - p, at(loop[(i + n - 1) % n]) - p);
                constexpr double kWidest = 0.9 * std::numbers::pi; // leaves a sine of 0.3
                constexpr double kWide = 0.78 * std::numbers::pi;  // 140°: a sine of 0.64
                needed_[index(loop[i])] = static_cast<int>(std::ceil(angle / kWidest));
                better_[index(loop[i])] = static_cast<int>(std::ceil(angle / kWide));
            }
        }
        quads_of_.resize(mesh.points.size());
        for (std::size_t q = 0; q < mesh.quads.size(); ++q) link(q);
    }

    int run()
    {
        int changes = 0;
        for (std::size_t p = 0; p < fixed_; ++p) {
            // Each change adds a quad at the node: so many at most.
            for (int tries = 0; tries < 4 && !quads_of_[p].empty() && lacking(static_cast<Index>(p));
                 ++tries) {
                if (!turn_side(static_cast<Index>(p), 0)) surround_widest(static_cast<Index>(p));
                ++changes;
            }
            // What is wide, but not too wide, gets another quad where it costs nobody much.
            constexpr double kGood = 0.5;
            if (!quads_of_[p].empty() && count(static_cast<Index>(p)) < better_[p] &&
                turn_side(static_cast<Index>(p), kGood)) {
                ++changes;
            }
        }
        return changes;
    }

private:
    [[nodiscard]] const Vec2& at(Index p) const { return mesh_.points[index(p)]; }
    [[nodiscard]] int needed(Index p) const { return index(p) < fixed_ ? needed_[index(p)] : 3; }
    [[nodiscard]] int count(Index p) const { return static_cast<int>(quads_of_[index(p)].size()); }
    [[nodiscard]] bool lacking(Index p) const { return count(p) < needed(p); }

    void link(std::size_t q)
    {
        for (const Index p : mesh_.quads[q]) quads_of_[index(p)].push_back(q);
    }
    void unlink(std::size_t q)
    {
        for (const Index p : mesh_.quads[q]) {
            auto& list = quads_of_[index(p)];
            list.erase(std::find(list.begin(), list.end(), q));
        }
    }

    [[nodiscard]] std::optional<std::size_t> across(std::size_t q, Index a, Index b) const
    {
        for (const std::size_t other : quads_of_[index(a)]) {
            const Quad& quad = mesh_.quads[other];
            if (other != q && std::find(quad.begin(), quad.end(), b) != quad.end()) return other;
        }
        return std::nullopt;
    }

    /// Turn a side opposite the node, so that it runs from the node.
    bool turn_side(Index p, double least)
    {
        double best = least;
        std::optional<std::array<std::size_t, 2>> pair;
        std::array<Quad, 2> made{};
        for (const std::size_t q : quads_of_[index(p)]) {
            const Quad quad = mesh_.quads[q];
            const auto k = static_cast<std::size_t>(std::find(quad.begin(), quad.end(), p) - quad.begin());
            const Index v1 = quad[(k + 1) % 4], v2 = quad[(k + 2) % 4], v3 = quad[(k + 3) % 4];
            for (const bool first : {true, false}) {
                const Index a = first ? v1 : v2, b = first ? v2 : v3;
                if (count(a) <= needed(a) || count(b) <= needed(b)) continue;
                const auto other = across(q, a, b);
                if (!other) continue;
                const Quad far = mesh_.quads[*other];
                const auto m = static_cast<std::size_t>(std::find(far.begin(), far.end(), b) - far.begin());
                if (far[(m + 1) % 4] != a) continue;
                const Index c = far[(m + 2) % 4], d = far[(m + 3) % 4];
                // The ring of both: p, v1, (c, d) between a and b, v3.
                if (c == p || d == p) continue;
                const std::array<Quad, 2> turned =
                    first ? std::array<Quad, 2>{Quad{p, v1, c, d}, Quad{p, d, v2, v3}}
                          : std::array<Quad, 2>{Quad{p, v1, v2, c}, Quad{p, c, d, v3}};
                const double quality = std::min(sine(turned[0]), sine(turned[1]));
                if (quality <= best) continue;
                best = quality;
                pair = {q, *other};
                made = turned;
            }
        }
        if (!pair) return false;
        for (const std::size_t q : *pair) unlink(q);
        for (std::size_t i = 0; i < 2; ++i) {
            mesh_.quads[(*pair)[i]] = made[i];
            link((*pair)[i]);
        }
        return true;
    }

    [[nodiscard]] double sine(const Quad& q) const
    {
        return least_sine(at(q[0]), at(q[1]), at(q[2]), at(q[3]));
    }

    void surround_widest(Index p)
    {
        std::size_t widest = quads_of_[index(p)].front();
        double most = -1;
        for (const std::size_t q : quads_of_[index(p)]) {
            const Quad& quad = mesh_.quads[q];
            const auto k = static_cast<std::size_t>(std::find(quad.begin(), quad.end(), p) - quad.begin());
            const double angle = turn_between(at(quad[(k + 1) % 4]) - at(p), at(quad[(k + 3) % 4]) - at(p));
            if (angle <= most) continue;
            most = angle;
            widest = q;
        }
        unlink(widest);
        const std::size_t first = mesh_.quads.size();
        surround(mesh_, widest);
        quads_of_.resize(mesh_.points.size());
        link(widest);
        for (std::size_t q = first; q < mesh_.quads.size(); ++q) link(q);
    }

    PlanarQuads& mesh_;
    std::size_t fixed_;
    std::vector<int> needed_, better_; ///< quads at a boundary node: what must be, and what would be good
    std::vector<std::vector<std::size_t>> quads_of_;
};

/// Moves single nodes where the worst quad around them gets better.
class Easer {
public:
    Easer(PlanarQuads& mesh, std::size_t fixed) : mesh_(mesh), fixed_(fixed)
    {
        first_.assign(mesh.points.size() + 1, 0);
        for (const Quad& q : mesh.quads) {
            for (const Index p : q) ++first_[static_cast<std::size_t>(p) + 1];
        }
        for (std::size_t p = 0; p < mesh.points.size(); ++p) first_[p + 1] += first_[p];
        around_.resize(4 * mesh.quads.size());
        std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
        for (std::size_t q = 0; q < mesh.quads.size(); ++q) {
            for (const Index p : mesh.quads[q]) around_[next[static_cast<std::size_t>(p)]++] = q;
        }
    }

    void run()
    {
        constexpr int kSweeps = 12;
        constexpr double kFlat = 0.15; // quads better than this are left to the smoother
        std::vector<char> mark(mesh_.points.size(), 0);
        for (int sweep = 0; sweep < kSweeps; ++sweep) {
            std::fill(mark.begin(), mark.end(), 0);
            for (std::size_t q = 0; q < mesh_.quads.size(); ++q) {
                if (sine(q) > kFlat) continue;
                for (const Index p : mesh_.quads[q]) mark[static_cast<std::size_t>(p)] = 1;
            }
            bool moved = false;
            for (std::size_t p = fixed_; p < mesh_.points.size(); ++p) {
                if (mark[p] != 0 && move(p)) moved = true;
            }
            if (!moved) return;
        }
    }

private:
    [[nodiscard]] double sine(std::size_t q) const
    {
        const Quad& quad = mesh_.quads[q];
        const auto at = [&](std::size_t k) -> const Vec2& {
            return mesh_.points[static_cast<std::size_t>(quad[k])];
        };
        return least_sine(at(0), at(1), at(2), at(3));
    }

    [[nodiscard]] double worst_at(std::size_t p) const
    {
        double worst = 1;
        for (std::size_t k = first_[p]; k < first_[p + 1]; ++k) worst = std::min(worst, sine(around_[k]));
        return worst;
    }

    bool move(std::size_t p)
    {
        const Vec2 start = mesh_.points[p];
        Vec2 mean = Vec2::Zero();
        double reach = 0, count = 0;
        for (std::size_t k = first_[p]; k < first_[p + 1]; ++k) {
            for (const Index other : mesh_.quads[around_[k]]) {
                if (static_cast<std::size_t>(other) == p) continue;
                const Vec2& x = mesh_.points[static_cast<std::size_t>(other)];
                mean += x;
                reach += (x - start).norm();
                count += 1;
            }
        }
        if (count == 0) return false;
        mean /= count;
        reach /= 2 * count;
        Vec2 best = start;
        const double before = worst_at(p);
        double worst = before;
        const auto attempt = [&](const Vec2& x) {
            mesh_.points[p] = x;
            const double now = worst_at(p);
            if (now <= worst) return;
            worst = now;
            best = x;
        };
        attempt(mean);
        attempt((mean + start) / 2);
        for (int halving = 0; halving < 4; ++halving, reach /= 2) {
            const Vec2 centre = best;
            for (const Vec2& step : {Vec2(1, 0), Vec2(0, 1), Vec2(-1, 0), Vec2(0, -1), Vec2(1, 1),
                                     Vec2(-1, 1), Vec2(-1, -1), Vec2(1, -1)})
                attempt(centre + reach * step);
        }
        mesh_.points[p] = best;
        constexpr double kGain = 1e-3;
        return worst > before + kGain;
    }

    PlanarQuads& mesh_;
    std::size_t fixed_;
    std::vector<std::size_t> first_, around_;
};

} // namespace

void ease_folds(PlanarQuads& mesh, std::size_t fixed) { Easer(mesh, fixed).run(); }

int open_corners(PlanarQuads& mesh, const PlanarRegion& region) { return CornerOpener(mesh, region).run(); }

int loosen_folds(PlanarQuads& mesh, double least)
{
    int count = 0;
    for (std::size_t q = 0, n = mesh.quads.size(); q < n; ++q) {
        const Quad& quad = mesh.quads[q];
        const auto at = [&](std::size_t k) { return mesh.points[static_cast<std::size_t>(quad[k])]; };
        if (least_sine(at(0), at(1), at(2), at(3)) > least) continue;
        surround(mesh, q);
        ++count;
    }
    return count;
}

void drop_loose_points(PlanarQuads& mesh, std::size_t fixed)
{
    std::vector<Index> number(mesh.points.size(), -1);
    std::iota(number.begin(), number.begin() + static_cast<std::ptrdiff_t>(fixed), Index{0});
    std::vector<Vec2> points(mesh.points.begin(), mesh.points.begin() + static_cast<std::ptrdiff_t>(fixed));
    for (Quad& quad : mesh.quads) {
        for (Index& p : quad) {
            Index& own = number[static_cast<std::size_t>(p)];
            if (own < 0) {
                own = static_cast<Index>(points.size());
                points.push_back(mesh.points[static_cast<std::size_t>(p)]);
            }
            p = own;
        }
    }
    mesh.points = std::move(points);
}

} // namespace lacuna::quads::paving
