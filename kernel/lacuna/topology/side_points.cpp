// SPDX-License-Identifier: MIT
#include <lacuna/topology/shared/side_points.h>

#include <lacuna/core/shared/edge_key.h>
#include <lacuna/geometry/shared/facet_tree.h>

#include <algorithm>
#include <utility>

namespace lacuna::topology {

namespace {

/// Split a facet at the points of its first side that is not `whole`, then split the pieces at their other
/// sides.
/// @param whole  for each side, whether it needs no split.
void cut(std::span<const Vec3> points, const ParamFacet& facet, std::array<bool, 3> whole,
         const SidePoints& sides, std::vector<ParamFacet>& result)
{
    for (std::size_t k = 0; k < 3; ++k) {
        if (whole[k]) continue;
        whole[k] = true;
        const std::size_t l = (k + 1) % 3;
        const std::size_t m = (k + 2) % 3;
        std::vector<Index> chain = sides.on(facet.corner[k], facet.corner[l]);
        if (chain.empty()) continue;
        const Vec3& a = points[static_cast<std::size_t>(facet.corner[k])];
        const Vec3& b = points[static_cast<std::size_t>(facet.corner[l])];
        chain.push_back(facet.corner[l]);
        Index from = facet.corner[k];
        Vec2 from_uv = facet.uv[k];
        for (std::size_t i = 0; i < chain.size(); ++i) {
            const bool last = i + 1 == chain.size();
            const double f = last ? 1 : fraction_along(points[static_cast<std::size_t>(chain[i])], a, b);
            const Vec2 to_uv = last ? facet.uv[l] : Vec2(facet.uv[k] + f * (facet.uv[l] - facet.uv[k]));
            // The first piece has side m of the facet, and the last piece has side l. Sides inside the facet
            // need no split.
            cut(points, {{from, chain[i], facet.corner[m]}, {from_uv, to_uv, facet.uv[m]}},
                {true, !last || whole[l], i != 0 || whole[m]}, sides, result);
            from = chain[i];
            from_uv = to_uv;
        }
        return;
    }
    result.push_back(facet);
}

/// Surface parameters at a corner of a facet; zero without a surface.
Vec2 uv_of(const Face& face, std::size_t facet, std::size_t corner)
{
    return face.uv.empty() ? Vec2::Zero() : face.uv[facet][corner];
}

Index add_point(ModelBuilder& model, FaceId face, Vec3 place, Vec2 uv)
{
    if (model[face].surface) model[face].surface->project({&place, 1}, {&uv, 1}, {});
    model.points.push_back(place);
    return static_cast<Index>(model.points.size()) - 1;
}

/// If a side of the face lies on one of its edges (a seam), insert a point into the chain of that edge, on
/// its exact curve if there is one.
void add_to_seam(ModelBuilder& model, FaceId face, Index a, Index b, double fraction, Index point)
{
    for (const EdgeUse& use : uses_of(model[face])) {
        Edge& edge = model[use.edge];
        for (std::size_t i = 0; i + 1 < edge.points.size(); ++i) {
            if (edge_key(edge.points[i], edge.points[i + 1]) != edge_key(a, b)) continue;
            const double f = edge.points[i] == a ? fraction : 1 - fraction;
            const auto after = static_cast<std::ptrdiff_t>(i) + 1;
            if (!edge.params.empty()) {
                const double param = (1 - f) * edge.params[i] + f * edge.params[i + 1];
                Vec3& place = model.points[static_cast<std::size_t>(point)];
                if (edge.curve) edge.curve->evaluate({&param, 1}, {&place, 1}, {});
                edge.params.insert(edge.params.begin() + after, param);
            }
            edge.points.insert(edge.points.begin() + after, point);
            return;
        }
    }
}

/// Insert a point into a side as `point_on_side()` does, but at `place`, or on an exact surface at the point
/// closest to `place`.
Index add_on_side(ModelBuilder& model, FaceId id, Index a, Index b, double fraction, const Vec3& place)
{
    Face& face = model[id];
    int beside = 0;
    Vec2 uv = Vec2::Zero();
    for (std::size_t t = 0; t < face.triangles.size(); ++t) {
        for (std::size_t k = 0; k < 3; ++k) {
            if (edge_key(face.triangles[t][k], face.triangles[t][(k + 1) % 3]) != edge_key(a, b)) continue;
            ++beside;
            const double f = face.triangles[t][k] == a ? fraction : 1 - fraction;
            uv = (1 - f) * uv_of(face, t, k) + f * uv_of(face, t, (k + 1) % 3);
        }
    }
    if (beside < 2) return -1;
    const Index made = add_point(model, id, place, uv);
    add_to_seam(model, id, a, b, fraction, made);
    SidePoints sides;
    sides.add(a, b, {made});
    cut_at_sides(model.points, face, sides);
    return made;
}

} // namespace

bool erase_facets(Face& face, const std::function<bool(std::size_t facet)>& gone)
{
    std::size_t kept = 0;
    for (std::size_t t = 0; t < face.triangles.size(); ++t) {
        if (gone(t)) continue;
        if (!face.uv.empty()) face.uv[kept] = face.uv[t];
        face.triangles[kept++] = face.triangles[t];
    }
    const bool any = kept < face.triangles.size();
    face.triangles.resize(kept);
    if (!face.uv.empty()) face.uv.resize(kept);
    return any;
}

bool repeats(std::span<const Index> corners)
{
    for (std::size_t i = 0; i < corners.size(); ++i)
        for (std::size_t k = i + 1; k < corners.size(); ++k)
            if (corners[i] == corners[k]) return true;
    return false;
}

void SidePoints::add(Index a, Index b, std::vector<Index> between)
{
    if (between.empty()) return;
    if (a > b) std::reverse(between.begin(), between.end());
    between_.try_emplace(edge_key(a, b), std::move(between));
}

std::vector<Index> SidePoints::on(Index a, Index b) const
{
    const auto found = between_.find(edge_key(a, b));
    if (found == between_.end()) return {};
    std::vector<Index> points = found->second;
    if (a > b) std::reverse(points.begin(), points.end());
    return points;
}

std::vector<ParamFacet> cut_at_sides(std::span<const Vec3> points, const ParamFacet& facet,
                                     const SidePoints& sides)
{
    std::vector<ParamFacet> result;
    cut(points, facet, {false, false, false}, sides, result);
    return result;
}

void cut_at_sides(std::span<const Vec3> points, Face& face, const SidePoints& sides)
{
    std::vector<Triangle> triangles;
    std::vector<std::array<Vec2, 3>> uv;
    for (std::size_t t = 0; t < face.triangles.size(); ++t) {
        ParamFacet facet{face.triangles[t]};
        if (!face.uv.empty()) facet.uv = face.uv[t];
        for (const ParamFacet& part : cut_at_sides(points, facet, sides)) {
            triangles.push_back(part.corner);
            if (!face.uv.empty()) uv.push_back(part.uv);
        }
    }
    face.triangles = std::move(triangles);
    face.uv = std::move(uv);
}

Index point_on_side(ModelBuilder& model, FaceId face, Index a, Index b, double fraction)
{
    return add_on_side(model, face, a, b, fraction, (1 - fraction) * model.at(a) + fraction * model.at(b));
}

Index point_on_face(ModelBuilder& model, FaceId id, const Vec3& place)
{
    Face& face = model[id];
    geometry::FacetTree::Hit best;
    for (std::size_t t = 0; t < face.triangles.size(); ++t) {
        const Triangle& c = face.triangles[t];
        const geometry::FacetTree::Hit hit = geometry::closest_on_triangle(
            place, {model.at(c[0]), model.at(c[1]), model.at(c[2])});
        if (hit.distance2 >= best.distance2) continue;
        best = hit;
        best.triangle = static_cast<Index>(t);
    }
    const auto t = static_cast<std::size_t>(best.triangle);
    const Triangle corner = face.triangles[t];
    // Project the place itself: the surface point closest to a point of the facets would lie beside it.
    const Vec3 wanted = face.surface ? place : best.point;
    for (const Index c : corner)
        if ((model.at(c) - best.point).norm() <= model.tolerance) return c;
    for (std::size_t k = 0; k < 3; ++k) {
        const Index a = corner[k], b = corner[(k + 1) % 3];
        const double f = fraction_along(best.point, model.at(a), model.at(b));
        if ((best.point - ((1 - f) * model.at(a) + f * model.at(b))).norm() <= model.tolerance)
            return add_on_side(model, id, a, b, f, wanted);
    }
    std::array<Vec2, 3> uv;
    Vec2 own = Vec2::Zero();
    for (std::size_t k = 0; k < 3; ++k) {
        uv[k] = uv_of(face, t, k);
        own += best.barycentric[static_cast<int>(k)] * uv[k];
    }
    const Index made = add_point(model, id, wanted, own);
    for (std::size_t k = 1; k < 3; ++k) {
        face.triangles.push_back({corner[k], corner[(k + 1) % 3], made});
        if (!face.uv.empty() || face.surface) face.uv.push_back({uv[k], uv[(k + 1) % 3], own});
    }
    face.triangles[t] = {corner[0], corner[1], made};
    if (!face.uv.empty()) face.uv[t] = {uv[0], uv[1], own};
    return made;
}

std::vector<NearSegment> near_segments(std::span<const Vec3> points,
                                       std::span<const std::array<Vec3, 2>> segments, double reach,
                                       const RunContext& context)
{
    std::vector<Triangle> dots(points.size());
    for (std::size_t p = 0; p < dots.size(); ++p) dots[p].fill(static_cast<Index>(p));
    std::vector<Vec3> ends;
    std::vector<Triangle> lines(segments.size());
    for (std::size_t s = 0; s < segments.size(); ++s) {
        const auto a = static_cast<Index>(ends.size());
        ends.insert(ends.end(), segments[s].begin(), segments[s].end());
        lines[s] = {a, a + 1, a + 1};
    }
    std::vector<NearSegment> pairs;
    const geometry::FacetTree of_points(points, dots, context);
    const geometry::FacetTree of_segments(ends, lines, context);
    of_points.overlaps(
        of_segments,
        [&](Index point, Index segment) {
            pairs.push_back({point, segment});
            return true;
        },
        reach, context);
    std::sort(pairs.begin(), pairs.end(), [](const NearSegment& a, const NearSegment& b) {
        return std::pair(a.segment, a.point) < std::pair(b.segment, b.point);
    });
    return pairs;
}

double fraction_along(const Vec3& p, const Vec3& a, const Vec3& b)
{
    const double length2 = (b - a).squaredNorm();
    return length2 > 0 ? std::clamp((p - a).dot(b - a) / length2, 0.0, 1.0) : 0;
}

} // namespace lacuna::topology
