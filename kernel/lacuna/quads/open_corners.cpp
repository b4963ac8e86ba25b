// SPDX-License-Identifier: MIT
#include <lacuna/quads/detail/open_corners.h>

#include <lacuna/core/shared/criteria.h>
#include <lacuna/quads/detail/corner_sine.h>
#include <lacuna/quads/detail/quad_net.h>
#include <lacuna/quads/detail/region_loops.h>
#include <lacuna/quads/shared/measure_plane.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

namespace lacuna::quads::paving {
namespace {

/// Four nodes inside a quad that is not convex. The quad that they form and the four quads around it are
/// convex. Empty if no point is known from which all corners of the given quad are visible.
std::optional<std::array<Vec2, 4>> small_within(const std::array<Vec2, 4>& outer)
{
    // All corners are visible from the diagonal through the reflex corner.
    std::size_t inward = 0;
    double least = kInfinity;
    for (std::size_t k = 0; k < 4; ++k) {
        const Vec2 out = outer[(k + 1) % 4] - outer[k], back = outer[(k + 3) % 4] - outer[k];
        const double sine = corner_sine(cross(out, back), out.norm() * back.norm());
        if (sine < least) {
            least = sine;
            inward = k;
        }
    }
    const Vec2 centre = (outer[inward] + outer[(inward + 2) % 4]) / 2;
    double room = kInfinity;
    for (std::size_t k = 0; k < 4; ++k) {
        const Vec2 side = outer[(k + 1) % 4] - outer[k];
        room = std::min(room, corner_sine(cross(side, centre - outer[k]), side.norm()));
    }
    if (!(room > 0)) return std::nullopt;
    // The corners of the inner quad are half way to the circle that touches the nearest side.
    std::array<Vec2, 4> inner;
    for (std::size_t k = 0; k < 4; ++k) inner[k] = centre + room / 2 * (outer[k] - centre).normalized();
    return inner;
}

/// Put a smaller quad inside a quad, and four quads around it. The four new nodes are added to the points.
std::array<Quad, 5> pillow(std::vector<Vec2>& points, const Quad& outer)
{
    std::array<Vec2, 4> corner;
    for (std::size_t k = 0; k < 4; ++k) corner[k] = points[index(outer[k])];
    const Vec2 centre = (corner[0] + corner[1] + corner[2] + corner[3]) / 4;
    std::array<Vec2, 4> place;
    for (std::size_t k = 0; k < 4; ++k) place[k] = (corner[k] + centre) / 2;
    if (least_sine(corner[0], corner[1], corner[2], corner[3]) < kFoldedQuad)
        place = small_within(corner).value_or(place);
    const auto first = static_cast<Index>(points.size());
    points.insert(points.end(), place.begin(), place.end());
    std::array<Quad, 5> quads{Quad{first, first + 1, first + 2, first + 3}};
    for (std::size_t k = 0; k < 4; ++k)
        quads[k + 1] = {outer[k], outer[(k + 1) % 4], quads[0][(k + 1) % 4], quads[0][k]};
    return quads;
}

class CornerOpener {
public:
    CornerOpener(PlanarQuads& mesh, const PlanarRegion& region)
        : mesh_(mesh), fixed_(region.points.size()), net_(mesh.points.size(), mesh.quads)
    {
        // In a wider corner a quad is poor.
        const double widest = std::numbers::pi - std::asin(kPoorQuad), wide = kCornerBelow * kDegree;
        needed_.assign(fixed_, 0);
        better_.assign(fixed_, 0);
        for (const Cycle& loop : region.loops) {
            for (std::size_t i = 0; i < loop.size(); ++i) {
                const double angle = corner_angle(mesh.points, loop, i);
                needed_[index(loop[i])] = static_cast<int>(std::ceil(angle / widest));
                better_[index(loop[i])] = static_cast<int>(std::ceil(angle / wide));
            }
        }
    }

    void run()
    {
        for (Index p = 0; index(p) < fixed_; ++p) {
            if (!net_.is_used(p)) continue;
            for (int tries = 0; tries < needed(p) && net_.valence(p) < needed(p); ++tries)
                if (!swap_edge(p, 0)) pillow_widest(p);
            // A wide node gets another quad if the quads around it stay good.
            if (net_.valence(p) < better_[index(p)]) swap_edge(p, kPoorQuad);
        }
        for (std::size_t q = 0; q < net_.quad_slots(); ++q) {
            if (q == mesh_.quads.size()) mesh_.quads.emplace_back();
            mesh_.quads[q] = net_.quad(static_cast<Index>(q));
        }
    }

private:
    [[nodiscard]] const Vec2& at(Index p) const { return mesh_.points[index(p)]; }
    /// Minimum number of quads at a node; inner nodes need three.
    [[nodiscard]] int needed(Index p) const { return index(p) < fixed_ ? needed_[index(p)] : 3; }
    [[nodiscard]] double sine(const Quad& q) const { return scaled_jacobian(mesh_.points, q); }

    /// Choose an edge that is opposite to the node in one of its quads, and swap it so that the new edge
    /// starts at the node.
    /// @param least  the smallest sine of each of the two new quads must exceed this
    bool swap_edge(Index p, double least)
    {
        double best = least;
        std::array<Index, 2> pair{-1, -1};
        std::array<Quad, 2> made{};
        net_.for_sides(p, [&](Index side) {
            const Index second = QuadNet::after(side), third = QuadNet::after(second);
            const Index v1 = net_.to(side), v2 = net_.to(second), v3 = net_.to(third);
            for (const bool first : {true, false}) {
                const Index a = first ? v1 : v2, b = first ? v2 : v3;
                if (net_.valence(a) <= needed(a) || net_.valence(b) <= needed(b)) continue;
                const Index other = net_.opposite(first ? second : third);
                if (other < 0) continue;
                const Index c = net_.to(QuadNet::after(other)),
                            d = net_.to(QuadNet::after(QuadNet::after(other)));
                // Without the edge, both quads form one outline: p, v1, v2, v3 with c and d inserted between
                // a and b.
                if (c == p || d == p) continue;
                const std::array<Quad, 2> swapped =
                    first ? std::array<Quad, 2>{Quad{p, v1, c, d}, Quad{p, d, v2, v3}}
                          : std::array<Quad, 2>{Quad{p, v1, v2, c}, Quad{p, c, d, v3}};
                const double quality = std::min(sine(swapped[0]), sine(swapped[1]));
                if (quality <= best) continue;
                best = quality;
                pair = {other / 4, side / 4};
                made = swapped;
            }
        });
        if (pair[0] < 0) return false;
        net_.replace(pair, made);
        return true;
    }

    void pillow_widest(Index p)
    {
        Index widest = -1;
        double most = -1;
        net_.for_sides(p, [&](Index side) {
            const double angle = turn_between(at(net_.to(side)) - at(p),
                                              at(net_.from(QuadNet::before(side))) - at(p));
            if (angle <= most) return;
            most = angle;
            widest = side / 4;
        });
        const std::array<Quad, 5> made = pillow(mesh_.points, net_.quad(widest));
        while (net_.points() < mesh_.points.size()) net_.add_point();
        net_.replace(std::array{widest}, made);
    }

    PlanarQuads& mesh_; ///< its quads are replaced by those of `net_` at the end
    std::size_t fixed_;
    QuadNet net_;
    /// For each boundary node: the minimum number of quads, and the number that suits its angle better.
    std::vector<int> needed_, better_;
};

} // namespace

void open_corners(PlanarQuads& mesh, const PlanarRegion& region) { CornerOpener(mesh, region).run(); }

void pillow_folds(PlanarQuads& mesh, double least)
{
    for (std::size_t q = 0, n = mesh.quads.size(); q < n; ++q) {
        if (scaled_jacobian(mesh.points, mesh.quads[q]) > least) continue;
        const std::array<Quad, 5> made = pillow(mesh.points, mesh.quads[q]);
        mesh.quads[q] = made[0];
        mesh.quads.insert(mesh.quads.end(), made.begin() + 1, made.end());
    }
}

} // namespace lacuna::quads::paving
