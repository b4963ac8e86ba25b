// SPDX-License-Identifier: MIT
#include <lacuna/quads/detail/raise_flat_quads.h>

#include <lacuna/core/shared/criteria.h>
#include <lacuna/core/shared/limits.h>
#include <lacuna/geometry/shared/pattern_search.h>
#include <lacuna/quads/detail/plane_stars.h>
#include <lacuna/quads/shared/measure_plane.h>

#include <algorithm>

namespace lacuna::quads::paving {
namespace {

/// Move a point to a position where the worst quad around it is better. @return whether there is such a
/// position
/// @param least_side  minimum length of the point's sides [length]
bool raise(std::vector<Vec2>& points, std::span<const Spoke> star, std::size_t p, double least_side)
{
    if (star.empty()) return false;
    const auto worst_at = [&](const Vec2& x) { return worst_quad(points, star, x); };
    Vec2 mean = Vec2::Zero(), x = points[p];
    double distance = 0;
    for (const Spoke& spoke : star) {
        for (const Index other : {spoke.next, spoke.across, spoke.before}) {
            mean += points[index(other)];
            distance += (points[index(other)] - x).norm();
        }
    }
    const double count = 3 * static_cast<double>(star.size());
    mean /= count;
    const double before = worst_at(x);
    double worst = before;
    // Small steps cannot bring back a point that is far outside its neighbours. Try their mean first.
    for (const Vec2& to : {mean, Vec2((mean + x) / 2)}) {
        const double found = worst_at(to);
        if (found <= worst || shortest_side(points, star, to) < least_side) continue;
        worst = found;
        points[p] = to;
    }
    worst = geometry::pattern_search(points[p], worst, {distance / count}, [&](const Vec2& to, double floor) {
        const double found = worst_at(to);
        return found > floor && shortest_side(points, star, to) < least_side ? floor : found;
    });
    return worst > before + kVisible;
}

} // namespace

void raise_flat_quads(PlanarQuads& mesh, std::size_t fixed)
{
    const auto is_flat = [&](const Quad& quad) { return scaled_jacobian(mesh.points, quad) <= kFlatQuad; };
    if (std::ranges::none_of(mesh.quads, is_flat)) return;
    const Stars stars(mesh.points.size(), mesh.quads);
    const std::vector<double> least_side = sides_to_keep(mesh.points, stars, fixed);
    for (int sweep = 0; sweep < kMostSteps; ++sweep) {
        std::vector<char> flat(mesh.points.size(), 0);
        for (const Quad& quad : mesh.quads) {
            if (!is_flat(quad)) continue;
            for (const Index p : quad) flat[index(p)] = 1;
        }
        bool moved = false;
        for (std::size_t p = fixed; p < mesh.points.size(); ++p) {
            if (flat[p] != 0 && raise(mesh.points, stars[p], p, least_side[p])) moved = true;
        }
        if (!moved) return;
    }
}

} // namespace lacuna::quads::paving
