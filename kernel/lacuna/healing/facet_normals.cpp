// SPDX-License-Identifier: MIT
#include <lacuna/healing/detail/facet_normals.h>

#include <lacuna/core/shared/constants.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <utility>

namespace lacuna::healing {
namespace {

/// kRough: a point on a crease is rough if facets meet convexly at some of its sides and concavely at others.
/// Only sides whose angle is between kRough times the feature angle and the feature angle are considered.
/// kNoisy: the surface is noisy if more than this share of the points on creases is rough. In tessellated CAD
/// models the share is 0 %, or up to 13 % where branches of coarse facets meet at about the feature angle.
/// With noise of 5 to 40 % of the facets' sides, the share is 41 to 85 %.
/// kStray: it is not noisy if a smaller share of its creases lies within a face or beside a face of less than
/// kPatch facets. The share is 4 % on sawn bones with noise of 6 %, whose faces are right, and 12 % or more
/// where noise makes edges ragged.
/// kAlike: it is not noisy if neighbouring points stand out of their surroundings alike (`likeness()`), as on
/// coarse facets of bent tubes. There the likeness is 0.68 or more. With noise of 10 % of the sides or more
/// it is at most 0.52, also on coarse facets; on fine ones it is at most 0.33 with noise of 5 %.
constexpr double kRough = 0.125, kNoisy = 0.25, kStray = 0.08, kAlike = 0.6;

/// Whether two facets, or the quads that contain them, have the same corners.
bool on_each_other(const Facets& facets, Index f, Index g)
{
    const Index p = facets.quad[index(f)];
    const Index q = facets.quad[index(g)];
    if ((p < 0) != (q < 0)) return false;
    const auto same = [](auto a, auto b) {
        std::sort(a.begin(), a.end());
        std::sort(b.begin(), b.end());
        return a == b;
    };
    return p < 0 ? same(facets.corner[index(f)], facets.corner[index(g)])
                 : same(facets.quads[index(p)], facets.quads[index(q)]);
}

/// The sides of a facet, the longest first.
std::array<Index, 3> sides_by_length(const Facets& facets, const FacetSides& sides, Index f)
{
    std::array<Index, 3> own = {3 * f, 3 * f + 1, 3 * f + 2};
    std::ranges::stable_sort(own, std::greater{}, [&](Index side) {
        return (facets.points[index(sides.to(side))] - facets.points[index(sides.from(side))]).norm();
    });
    return own;
}

/// How alike neighbouring points stand out of the planes through the points around them: the correlation of
/// their mean slopes. It is 1 on a ball and -0.2 if points are moved at random.
double likeness(const Facets& facets, const std::vector<bool>& flipped)
{
    const std::size_t count = facets.points.size();
    std::vector<Vec3> normal(count, Vec3::Zero()), slope(count, Vec3::Zero());
    const auto for_sides = [&](const auto& visit) {
        for (const Triangle& corner : facets.corner)
            for (std::size_t i = 0; i < 3; ++i) visit(index(corner[i]), index(corner[(i + 1) % 3]));
    };
    for (std::size_t f = 0; f < facets.count(); ++f)
        for (const Index p : facets.corner[f])
            normal[index(p)] += (flipped[f] ? -1 : 1) * area_vector(facets.points, facets.corner[f]);
    std::vector<double> sides(count, 0), height(count, 0);
    for_sides([&](std::size_t a, std::size_t b) {
        const Vec3 way = (facets.points[b] - facets.points[a]).stableNormalized();
        slope[a] += way, slope[b] -= way;
        ++sides[a], ++sides[b];
    });
    for (std::size_t p = 0; p < count; ++p)
        if (sides[p] > 0) height[p] = slope[p].dot(normal[p].stableNormalized()) / sides[p];
    double alike = 0, all = 0;
    for_sides([&](std::size_t a, std::size_t b) {
        alike += 2 * height[a] * height[b];
        all += height[a] * height[a] + height[b] * height[b];
    });
    return all > 0 ? alike / all : 1;
}

} // namespace

Index partner(const Facets& facets, const FacetSides& sides, Index side)
{
    Index found = -1;
    const auto here = sides.on(sides.segment(side));
    for (const Index other : here) {
        if (other == side || facets.label[index(other) / 3] != facets.label[index(side) / 3]) continue;
        if (found >= 0) return -1;
        found = other;
    }
    if (found < 0 || here.size() == 2) return found;
    for (const Index other : here)
        if (other != side && other != found && !on_each_other(facets, other / 3, side / 3) &&
            !on_each_other(facets, other / 3, found / 3))
            return -1;
    return found;
}

void borrow_normals(const Facets& facets, const FacetSides& sides, std::vector<Index> without,
                    std::vector<Vec3>& normal, const RunContext& context)
{
    // Facets without a normal may be adjacent, so this is repeated as long as some facet gets a normal. If no
    // facet gets one across its longest side, shorter sides are tried too: two facets without a normal may
    // share their longest side.
    bool across_any = false;
    for (bool learnt = true; learnt && !without.empty();) {
        check_cancelled(context);
        std::vector<std::pair<Index, Vec3>> found;
        for (const Index f : without) {
            for (const Index side : sides_by_length(facets, sides, f)) {
                const Index other = partner(facets, sides, side);
                if (other < 0) continue;
                const Vec3& known = normal[index(other) / 3];
                const bool agree = sides.from(other) != sides.from(side);
                if (!known.isZero(0)) found.emplace_back(f, agree ? known : Vec3(-known));
                if (!known.isZero(0) || !across_any) break;
            }
        }
        for (const auto& [f, n] : found) normal[index(f)] = n;
        learnt = !found.empty() || !std::exchange(across_any, true);
        std::erase_if(without, [&](Index f) { return !normal[index(f)].isZero(0); });
    }
}

std::vector<Vec3> own_normals(const Facets& facets, const FacetSides& sides, double feature,
                              const RunContext& context)
{
    const double least_height = facets.tolerance / std::sin(std::min(feature, std::numbers::pi / 2));
    std::vector<Vec3> normal(facets.count(), Vec3::Zero());
    std::vector<Index> thin;
    for (Index f = 0; index(f) < facets.count(); ++f) {
        const Index side = sides_by_length(facets, sides, f).front();
        const double length =
            (facets.points[index(sides.to(side))] - facets.points[index(sides.from(side))]).norm();
        const Vec3 area = area_vector(facets.points, facets.corner[index(f)]);
        if (2 * area.norm() > least_height * length)
            normal[index(f)] = area.normalized();
        else
            thin.push_back(f);
    }
    borrow_normals(facets, sides, std::move(thin), normal, context);
    return normal;
}

bool is_noisy(const Facets& facets, const FacetSides& sides, const std::vector<Vec3>& normal,
              const std::vector<Index>& face, const std::vector<bool>& flipped, double feature,
              const RunContext& context)
{
    const double crease = std::cos(feature), even = std::cos(kRough * feature);
    std::vector<std::size_t> size(facets.count(), 0);
    for (const Index f : face) ++size[index(f)];
    const auto is_stray = [&](Index f, Index g) {
        return f == g || std::min(size[index(f)], size[index(g)]) < kPatch;
    };
    std::size_t creases = 0, strays = 0;
    std::vector<char> on_crease(facets.points.size(), 0), turns_up(on_crease), turns_down(on_crease);
    for (Index side = 0; index(side) < 3 * facets.count(); ++side) {
        if (index(side) % kBetweenPolls == 0) check_cancelled(context);
        const Index other = partner(facets, sides, side), f = side / 3, g = other / 3;
        if (other < side || (facets.quad[index(f)] >= 0 && facets.quad[index(f)] == facets.quad[index(g)]))
            continue;
        const double agree = sides.from(other) != sides.from(side) ? 1 : -1;
        const double cosine = agree * normal[index(f)].dot(normal[index(g)]);
        if (cosine >= even) continue;
        creases += cosine < crease ? 1 : 0;
        strays += cosine < crease && is_stray(face[index(f)], face[index(g)]) ? 1 : 0;
        const Index apex = sides.to(3 * g + (other + 1) % 3);
        const double rise = normal[index(f)].dot(facets.points[index(apex)] -
                                                 facets.points[index(sides.from(side))]);
        const bool up = (rise > 0) != flipped[index(f)];
        for (const Index p : {sides.from(side), sides.to(side)}) {
            if (cosine < crease)
                on_crease[index(p)] = 1;
            else
                (up ? turns_up : turns_down)[index(p)] = 1;
        }
    }
    std::size_t creased = 0, rough = 0;
    for (std::size_t p = 0; p < on_crease.size(); ++p) {
        creased += on_crease[p] != 0 ? 1 : 0;
        rough += on_crease[p] != 0 && turns_up[p] != 0 && turns_down[p] != 0 ? 1 : 0;
    }
    return static_cast<double>(strays) > kStray * static_cast<double>(creases) &&
           static_cast<double>(rough) > kNoisy * static_cast<double>(creased) &&
           likeness(facets, flipped) < kAlike;
}

std::vector<Vec3> patch_normals(const Facets& facets, const FacetSides& sides, const RunContext& context)
{
    std::vector<Vec3> area, best(facets.count(), Vec3::Zero());
    for (const Triangle& corners : facets.corner) area.push_back(area_vector(facets.points, corners));
    std::vector<double> flattest(facets.count(), -1);
    std::vector<Index> seen(facets.count(), -1);
    // Facets in the order in which they were reached from the seed, and whether each is reversed.
    std::vector<std::pair<Index, bool>> patch;
    for (Index seed = 0; index(seed) < facets.count(); ++seed) {
        if (index(seed) % kBetweenPolls == 0) check_cancelled(context);
        patch.assign(1, {seed, false});
        seen[index(seed)] = seed;
        Vec3 sum = Vec3::Zero();
        double size = 0;
        for (std::size_t i = 0; i < patch.size(); ++i) {
            const auto [f, reversed] = patch[i];
            sum += (reversed ? -1 : 1) * area[index(f)];
            size += area[index(f)].norm();
            for (Index side = 3 * f; side < 3 * f + 3 && patch.size() < kPatch; ++side) {
                const Index other = partner(facets, sides, side);
                if (other < 0 || seen[index(other) / 3] == seed) continue;
                seen[index(other) / 3] = seed;
                const bool agree = sides.from(other) != sides.from(side);
                patch.emplace_back(other / 3, agree ? reversed : !reversed);
            }
        }
        if (!(size > 0 && sum.norm() > 0)) continue;
        const double flat = sum.norm() / size;
        for (const auto& [f, reversed] : patch) {
            if (flat <= flattest[index(f)]) continue;
            flattest[index(f)] = flat;
            best[index(f)] = (reversed ? -1 : 1) * sum.normalized();
        }
    }
    return best;
}

} // namespace lacuna::healing
