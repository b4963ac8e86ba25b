// SPDX-License-Identifier: MIT
#include <lacuna/geometry/shared/flatten.h>

#include <lacuna/core/error.h>
#include <lacuna/geometry/newell.h>
#include <lacuna/geometry/shared/polyline.h>
#include <lacuna/geometry/shared/predicates.h>
#include <lacuna/geometry/shared/tips.h>
#include <lacuna/geometry/shared/union_find.h>

#include <lacuna/core/shared/criteria.h>
#include <lacuna/geometry/detail/flatten_maps.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace lacuna::geometry {

namespace {

using flat::Facets;
using flat::Positions;

[[noreturn]] void fail(const Message& why) { throw InvalidInput(why.about("facets cannot be flattened")); }
template <class... Arguments>
[[noreturn]] void fail(Format<sizeof...(Arguments)> format, const Arguments&... arguments)
{
    fail(Message("geometry.not_flattenable", format, arguments...));
}

/// Number the points in use consecutively.
Facets densely(std::span<const Vec3> points, std::span<const Triangle> triangles, std::vector<Index>& used)
{
    std::vector<Index> local(points.size(), -1);
    for (const Triangle& triangle : triangles)
        for (const Index corner : triangle) {
            if (corner < 0 || index(corner) >= points.size())
                fail("a triangle uses point {}, but there are {} points", found(corner), points.size());
            local[index(corner)] = 0;
        }
    Facets facets;
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (local[i] < 0) continue;
        local[i] = static_cast<Index>(used.size());
        used.push_back(static_cast<Index>(i));
        facets.points.push_back(points[i]);
    }
    for (const Triangle& t : triangles)
        facets.triangles.push_back({local[index(t[0])], local[index(t[1])], local[index(t[2])]});
    return facets;
}

// --- the boundary ---------------------------------------------------------------------------------

/// Directed sides without an oppositely directed partner, in ascending order.
/// @param twice  set to a side that two triangles have in the same direction, if there is one.
std::vector<Segment> boundary_sides(std::span<const Triangle> triangles, std::vector<Segment>& twice)
{
    std::vector<Segment> sides, boundary;
    for (const Triangle& t : triangles)
        for (std::size_t i = 0; i < 3; ++i) sides.push_back({t[i], t[(i + 1) % 3]});
    std::sort(sides.begin(), sides.end());
    const auto again = std::adjacent_find(sides.begin(), sides.end());
    if (again != sides.end()) twice.push_back(*again);
    for (const Segment& side : sides)
        if (!std::binary_search(sides.begin(), sides.end(), Segment{side[1], side[0]}))
            boundary.push_back(side);
    return boundary;
}

/// Chain directed sides, which are sorted by their first point, into cycles.
std::vector<std::vector<Index>> cycles(const std::vector<Segment>& sides)
{
    std::vector<std::vector<Index>> loops;
    std::vector<bool> taken(sides.size(), false);
    for (std::size_t start = 0; start < sides.size(); ++start) {
        if (taken[start]) continue;
        loops.emplace_back();
        for (std::size_t next = start; next < sides.size() && !taken[next];) {
            taken[next] = true;
            loops.back().push_back(sides[next][0]);
            const Segment from{sides[next][1], -1};
            next = index(
                static_cast<Index>(std::lower_bound(sides.begin(), sides.end(), from) - sides.begin()));
            while (next < sides.size() && sides[next][0] == from[0] && taken[next]) ++next;
            if (next < sides.size() && sides[next][0] != from[0]) break;
        }
    }
    return loops;
}

void sort_longest_first(Facets& facets)
{
    std::stable_sort(facets.loops.begin(), facets.loops.end(), [&](const auto& a, const auto& b) {
        return length(flat::closed_places(facets, a)) > length(flat::closed_places(facets, b));
    });
}

// --- conditions on curved facets --------------------------------------------------------------------

Index count_parts(const Facets& facets)
{
    UnionFind sets(facets.points.size());
    auto parts = static_cast<Index>(facets.points.size());
    for (const Triangle& t : facets.triangles)
        for (std::size_t i = 1; i < 3; ++i)
            if (sets.unite(t[0], t[i])) --parts;
    return parts;
}

void check_disc(const Facets& facets, const std::vector<Segment>& boundary, const std::vector<Segment>& twice,
                const std::vector<Index>& used)
{
    if (!twice.empty())
        fail("two triangles have the side from point {} to point {} in the same direction; expected an "
             "oriented manifold",
             used[index(twice.front()[0])], used[index(twice.front()[1])]);
    if (boundary.empty())
        fail(Message("geometry.not_flattenable", "they form a closed surface without boundary")
                 .remedy("cut it open"));
    const Index parts = count_parts(facets);
    if (parts != 1)
        fail(Message("geometry.not_flattenable", "they have {} connected parts", found(parts))
                 .remedy("flatten each part separately"));
    const auto v = static_cast<long>(facets.points.size()), f = static_cast<long>(facets.triangles.size());
    const auto b = static_cast<long>(boundary.size()), loops = static_cast<long>(facets.loops.size());
    const long edges = (3 * f + b) / 2, euler = v - edges + f + loops;
    // A disc without its holes has the Euler number 2, and each handle reduces this number by 2. A boundary
    // that touches itself at a point is accepted.
    if (euler <= 0)
        fail(Message("geometry.not_flattenable", "they have {} handles", found((2 - euler) / 2))
                 .remedy("cut them open"));
}

// --- quality of a map -------------------------------------------------------------------------------

Vec3 in_space(const Vec2& p) { return {p.x(), p.y(), 0}; }

bool boundary_crosses(const std::vector<Segment>& boundary, const Positions& positions)
{
    std::vector<Vec3> points;
    std::vector<Triangle> needles;
    for (const Vec2& p : positions) points.push_back(in_space(p));
    for (const Segment& side : boundary) needles.push_back({side[0], side[1], side[1]});
    const FacetTree tree(points, needles);
    return !tree.overlaps(tree, [&](Index i, Index j) {
        const Segment& s = boundary[index(i)];
        const Segment& t = boundary[index(j)];
        if (s[0] == t[0] || s[0] == t[1] || s[1] == t[0] || s[1] == t[1]) return true;
        const Vec2 &a = positions[index(s[0])], &b = positions[index(s[1])];
        const Vec2 &c = positions[index(t[0])], &d = positions[index(t[1])];
        const bool cross = orient2d(a, b, c) * orient2d(a, b, d) < 0 &&
                           orient2d(c, d, a) * orient2d(c, d, b) < 0;
        return !cross;
    });
}

/// Compute the quality measures of a map.
void judge(const Facets& facets, const std::vector<Segment>& boundary, Flattened& flat)
{
    flat.flips = 0;
    flat.max_stretch = 1;
    for (std::size_t t = 0; t < facets.triangles.size(); ++t) {
        const auto [large, small] = flat::stretches(flat::jacobian(facets, t, flat.position));
        if (facets.shapes[t].thin) {
            // A facet without height has a determinant whose sign is only a rounding error. It counts as
            // flipped only if its image has a larger area than the facet.
            if (small * large < -1) ++flat.flips;
            continue;
        }
        if (!(small > 0)) ++flat.flips;
        const double least = std::max(std::abs(small), std::numeric_limits<double>::min());
        flat.max_stretch = std::max({flat.max_stretch, large, 1 / least});
    }
    flat.overlaps = boundary_crosses(boundary, flat.position);
    flat.folded = flat.flips > 0 || flat.overlaps;
}

// --- candidates -----------------------------------------------------------------------------------

Plane plane_of(const Facets& facets)
{
    std::vector<std::vector<Vec3>> loops;
    for (const std::vector<Index>& loop : facets.loops) {
        loops.emplace_back();
        for (const Index i : loop) loops.back().push_back(facets.points[index(i)]);
    }
    if (loops.empty()) loops.push_back(facets.points);
    return newell_plane(loops);
}

bool is_planar(const Facets& facets, const Plane& plane)
{
    Eigen::AlignedBox3d box;
    for (const Vec3& point : facets.points) box.extend(point);
    const double tolerance = kSamePlace * box.diagonal().norm();
    return std::all_of(facets.points.begin(), facets.points.end(),
                       [&](const Vec3& p) { return std::abs(height(plane, p)) <= tolerance; });
}

/// Rotate and translate the map to agree best with `model`.
void align(Positions& positions, const Positions& model)
{
    const auto count = static_cast<double>(positions.size());
    Vec2 mean = Vec2::Zero(), model_mean = Vec2::Zero();
    for (std::size_t i = 0; i < positions.size(); ++i) {
        mean += positions[i] / count;
        model_mean += model[i] / count;
    }
    double c = 0, s = 0;
    for (std::size_t i = 0; i < positions.size(); ++i) {
        const Vec2 p = positions[i] - mean, q = model[i] - model_mean;
        c += p.dot(q);
        s += p.x() * q.y() - p.y() * q.x();
    }
    const double size = std::hypot(c, s);
    const Eigen::Rotation2Dd turn(size > 0 ? std::atan2(s, c) : 0.0);
    for (Vec2& p : positions) p = model_mean + turn * (p - mean);
}

/// Whether facets form a tube between two loops: the total geodesic curvature of the outer loop is less than
/// π. The curvature is 0 for a cylinder, π for a cone whose wall is inclined by 60° to its base, and 2π for a
/// flat ring. A rolled-up sheet with a hole is not a tube.
bool is_tube(const Facets& facets)
{
    if (facets.loops.size() != 2) return false;
    const std::vector<double> angle = angles_at_points(facets.points, facets.triangles);
    double turning = 0;
    for (const Index p : facets.loops[0]) turning += std::numbers::pi - angle[index(p)];
    return turning < std::numbers::pi;
}

/// Compute maps in the order that `flatten()` states until one is one-to-one. If none is, keep the one with
/// the fewest flips.
void choose_map(const Facets& facets, const std::vector<Segment>& boundary, double settled, Flattened& flat)
{
    bool any = false;
    const auto good = [&](FlatMap map, const Positions& positions) {
        Flattened trial;
        trial.position = positions;
        trial.map = map;
        judge(facets, boundary, trial);
        if (any && trial.flips >= flat.flips && trial.folded) return false;
        any = true;
        trial.used = std::move(flat.used);
        trial.triangles = std::move(flat.triangles);
        flat = std::move(trial);
        return !flat.folded;
    };
    if (is_tube(facets)) {
        const Positions ring = flat::ring(facets);
        if (!ring.empty() && good(FlatMap::ring, ring)) return;
    }
    const Positions conformal = flat::conformal(facets);
    if (good(FlatMap::rigid, flat::as_rigid_as_possible(facets, conformal, settled))) return;
    if (good(FlatMap::injective, flat::injective(facets, conformal, settled))) return;
    good(FlatMap::injective, flat::injective(facets, flat::convex(facets), settled));
}

} // namespace

Flattened flatten(std::span<const Vec3> points, std::span<const Triangle> triangles,
                  const FlattenOptions& options)
{
    if (triangles.empty()) fail("there are no triangles");
    Flattened flat;
    Facets facets = densely(points, triangles, flat.used);
    flat.triangles = facets.triangles;
    flat::measure_shapes(facets);
    std::vector<Segment> twice;
    const std::vector<Segment> boundary = boundary_sides(facets.triangles, twice);
    facets.loops = cycles(boundary);
    sort_longest_first(facets);

    const Plane plane = plane_of(facets);
    Positions projected;
    for (const Vec3& point : facets.points) projected.push_back(to_plane(plane, point));
    if (!options.disc && is_planar(facets, plane)) {
        flat.position = projected;
        judge(facets, boundary, flat);
        // Planar facets that fold over each other are unfolded like curved ones.
        if (!flat.folded) return flat;
    }
    check_disc(facets, boundary, twice, flat.used);
    if (options.disc) {
        flat.position = flat::convex(facets);
        flat.map = FlatMap::disc;
        judge(facets, boundary, flat);
        return flat;
    }
    choose_map(facets, boundary, options.settled, flat);
    align(flat.position, projected);
    return flat;
}

// --- from the plane back to the surface -----------------------------------------------------------

PlanarLocator::PlanarLocator(std::span<const Vec2> points, std::span<const Triangle> triangles)
{
    std::vector<Vec3> lifted;
    lifted.reserve(points.size());
    for (const Vec2& p : points) lifted.push_back(in_space(p));
    tree_ = FacetTree(lifted, triangles);
    if (triangles.empty()) return;

    std::vector<Eigen::AlignedBox2d> boxes(triangles.size());
    Eigen::AlignedBox2d all;
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        for (const Index p : triangles[t]) boxes[t].extend(points[index(p)]);
        all.extend(boxes[t]);
        const Vec2 &o = points[index(triangles[t][0])], a = points[index(triangles[t][1])] - o,
                   b = points[index(triangles[t][2])] - o;
        // A degenerate triangle has infinite or undefined weights, so it contains no point.
        const double area = a.x() * b.y() - a.y() * b.x();
        weights_.push_back({o, Vec2(b.y(), -b.x()) / area, Vec2(-a.y(), a.x()) / area});
    }
    // About two bins per triangle.
    const Vec2 sides = all.sizes();
    const double most = static_cast<double>(2 * triangles.size());
    bin_ = std::max(std::sqrt(sides.prod() / most), sides.maxCoeff() / most);
    if (!(bin_ > 0) || !std::isfinite(bin_)) bin_ = 1;
    low_ = all.min();
    across_ = static_cast<Index>(sides.x() / bin_) + 1;
    up_ = static_cast<Index>(sides.y() / bin_) + 1;
    const auto bin = [&](double offset, Index count) {
        return std::min(static_cast<Index>(offset / bin_), count - 1);
    };
    bins_ = incidence(index(across_ * up_), [&](const auto& visit) {
        for (std::size_t t = 0; t < boxes.size(); ++t) {
            const Vec2 from = boxes[t].min() - low_, to = boxes[t].max() - low_;
            for (Index j = bin(from.y(), up_); j <= bin(to.y(), up_); ++j)
                for (Index i = bin(from.x(), across_); i <= bin(to.x(), across_); ++i)
                    visit(index(j * across_ + i), static_cast<Index>(t));
        }
    });
}

PlanarLocator::FacetPosition PlanarLocator::in_bins(const Vec2& place) const
{
    const double x = (place.x() - low_.x()) / bin_, y = (place.y() - low_.y()) / bin_;
    if (!(x >= 0 && x < across_ && y >= 0 && y < up_)) return {};
    for (const Index t : bins_.of(index(static_cast<Index>(y) * across_ + static_cast<Index>(x)))) {
        const Weights& w = weights_[index(t)];
        const Vec2 from = place - w.corner;
        const double first = w.first.dot(from), second = w.second.dot(from), rest = 1 - first - second;
        if (first >= 0 && second >= 0 && rest >= 0) return {t, {rest, first, second}, 0};
    }
    return {};
}

PlanarLocator::PlanarLocator(const Flattened& flat) : PlanarLocator(flat.position, flat.triangles) {}

PlanarLocator::FacetPosition PlanarLocator::locate(const Vec2& place) const
{
    if (const FacetPosition inside = in_bins(place); inside.triangle >= 0) return inside;
    const FacetTree::Hit hit = tree_.closest(in_space(place));
    return {hit.triangle, hit.barycentric, hit.triangle >= 0 ? std::sqrt(hit.distance2) : 0.0};
}

} // namespace lacuna::geometry
