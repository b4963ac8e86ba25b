// SPDX-License-Identifier: MIT
#include <lacuna/surface/shared/projector.h>

#include <lacuna/core/shared/criteria.h>
#include <lacuna/core/shared/parallel.h>
#include <lacuna/surface/detail/trimming.h>

#include <array>

namespace lacuna::surface {

using namespace topology;

FacetSet facet_set(const Model& model, std::span<const FaceId> faces)
{
    FacetSet facets;
    for (const FaceId face : faces) {
        for (std::size_t t = 0; t < model[face].triangles.size(); ++t) {
            facets.triangles.push_back(model[face].triangles[t]);
            facets.face.push_back(face);
            facets.number.push_back(static_cast<Index>(t));
        }
    }
    return facets;
}

std::vector<Vec3> points_at(const FacetView& facets, std::span<const FacetPosition> places)
{
    std::vector<Vec3> points(places.size());
    const auto at = [&](Index p) -> const Vec3& { return facets.points[static_cast<std::size_t>(p)]; };
    for (std::size_t i = 0; i < places.size(); ++i) {
        const Triangle& t = facets.triangles[static_cast<std::size_t>(places[i].triangle)];
        const Vec3& w = places[i].barycentric;
        points[i] = w[0] * at(t[0]) + w[1] * at(t[1]) + w[2] * at(t[2]);
    }
    if (facets.surface == nullptr) return points;
    std::vector<Vec2> uv(places.size());
    for (std::size_t i = 0; i < places.size(); ++i) {
        const std::array<Vec2, 3>& c = facets.uv[static_cast<std::size_t>(places[i].triangle)];
        const Vec3& w = places[i].barycentric;
        uv[i] = w[0] * c[0] + w[1] * c[1] + w[2] * c[2];
    }
    facets.surface->project(points, uv);
    return points;
}

std::vector<Vec3> points_at(const Model& model, FaceId face, std::span<const FacetPosition> places)
{
    const Face& f = model[face];
    return points_at({model.points, f.triangles, f.uv, f.surface.get()}, places);
}

Vec3 point_on_facets(const Model& model, FaceId face, const FacetPosition& place)
{
    return points_at({model.points, model[face].triangles, {}, nullptr}, std::array{place}).front();
}

Projector::Projector(const Model& model, std::vector<FaceId> faces)
    : model_(&model), facets_(facet_set(model, faces)), tree_(model.points, facets_.triangles)
{
    for (const FaceId face : faces) {
        if (model[face].surface != nullptr) trimmed_.try_emplace(face, model, face);
    }
}

Projector::Projector(Projector&&) noexcept = default;
Projector& Projector::operator=(Projector&&) noexcept = default;
Projector::~Projector() = default;

std::vector<FaceId> Projector::project(std::span<Vec3> points, const RunContext& context) const
{
    std::vector<geometry::FacetTree::Hit> hits(points.size());
    const auto hit_on = [&](Index facet, const Vec3& p) {
        const Triangle& t = facets_.triangles[index(facet)];
        const std::array<Vec3, 3> corners{model_->at(t[0]), model_->at(t[1]), model_->at(t[2])};
        geometry::FacetTree::Hit hit = geometry::closest_on_triangle(p, corners);
        hit.triangle = facet;
        return hit;
    };
    // A point within `rounding` of a facet lies on the facet. If all its weights are above kFileAccuracy,
    // it is not on the facet's border, so no other facet is closer, and the search ends.
    const double rounding = 1e-15 * tree_.bounds().diagonal().norm();
    parallel_for(context, points.size(), 512, [&](std::size_t begin, std::size_t end) {
        // Consecutive points are close to each other. The distance to the last point's facet therefore limits
        // the search for the next point.
        for (std::size_t i = begin; i < end; ++i) {
            if (i > begin) {
                hits[i] = hit_on(hits[i - 1].triangle, points[i]);
                const bool inside = hits[i].barycentric.minCoeff() > kFileAccuracy;
                if (inside && hits[i].distance2 <= rounding * rounding) continue;
                hits[i] = tree_.closest(points[i], hits[i].distance2);
            }
            // Because of rounding, the limited search may find no facet.
            if (hits[i].triangle < 0) hits[i] = tree_.closest(points[i]);
        }
    });
    std::map<FaceId, std::vector<std::size_t>> on_face;
    std::vector<FaceId> faces(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
        faces[i] = facets_.face[index(hits[i].triangle)];
        on_face[faces[i]].push_back(i);
    }
    // One call for each face, because exact surfaces project points in bulk.
    for (const auto& [face, members] : on_face) {
        const Face& f = (*model_)[face];
        if (f.surface == nullptr) {
            for (const std::size_t i : members) points[i] = hits[i].point;
            continue;
        }
        std::vector<Vec3> moved;
        std::vector<Vec2> uv;
        for (const std::size_t i : members) {
            const auto& c = f.uv[index(facets_.number[index(hits[i].triangle)])];
            const Vec3& w = hits[i].barycentric;
            moved.push_back(points[i]);
            uv.emplace_back(w[0] * c[0] + w[1] * c[1] + w[2] * c[2]);
        }
        f.surface->project(moved, uv, context);
        std::vector<Projected> now(members.size());
        for (std::size_t k = 0; k < members.size(); ++k) {
            const geometry::FacetTree::Hit& hit = hits[members[k]];
            now[k] = {&hit, facets_.number[index(hit.triangle)], &moved[k]};
        }
        trimmed_.at(face).keep_inside(now, context);
        for (std::size_t k = 0; k < members.size(); ++k) points[members[k]] = moved[k];
    }
    return faces;
}

} // namespace lacuna::surface
