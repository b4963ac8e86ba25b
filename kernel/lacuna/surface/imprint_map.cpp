// SPDX-License-Identifier: MIT
#include <lacuna/surface/detail/imprint_map.h>

#include <lacuna/core/shared/criteria.h>
#include <lacuna/geometry/shared/harmonic.h>
#include <lacuna/geometry/shared/plane.h>
#include <lacuna/geometry/shared/polyline.h>
#include <lacuna/surface/detail/linking_map.h>
#include <lacuna/topology/shared/use_places.h>

#include <algorithm>
#include <cmath>

namespace lacuna::surface {

using namespace topology;

EndsMap::EndsMap(const OpenVolume& volume, std::span<const LinkingSurface> links,
                 std::span<const KnownLine> known)
    : volume_(volume)
{
    // The target's harmonic map may fold at concave places of the source's outline. It does not fold in a
    // circle (Tutte 1963, Floater 1997), but there the distances along the rims and between the lines differ
    // more from those in space.
    for (const bool disc : {false, true}) {
        lay_source(disc);
        if (one_to_one_) lay_target(links, known);
        if (one_to_one_) return;
    }
}

void EndsMap::lay_source(bool disc)
{
    const Model& model = volume_.model;
    source_facets_ = facet_set(model, volume_.faces(Role::source));
    const geometry::Flattened flat = geometry::flatten(model.points, source_facets_.triangles,
                                                       {.disc = disc});
    one_to_one_ = !flat.folded;
    source_.assign(model.points.size(), Vec2::Zero());
    for (std::size_t i = 0; i < flat.used.size(); ++i)
        source_[static_cast<std::size_t>(flat.used[i])] = flat.position[i];
    locator_ = geometry::PlanarLocator(flat);
    for (const FaceId face : volume_.faces(Role::source))
        face_locator_[face] = geometry::PlanarLocator(source_, model[face].triangles);
}

void EndsMap::lay_target(std::span<const LinkingSurface> links, std::span<const KnownLine> known)
{
    const Model& model = volume_.model;
    geometry::HarmonicProblem problem;
    const std::vector<Triangle> triangles = topology::facets_of(model, volume_.faces(Role::target));
    std::map<Index, Vec2> fixed;
    const auto arc_of = [&](const std::vector<Index>& line) {
        return geometry::arc_lengths(places_at(model, line));
    };
    // The plane position at a share of the length of a line on the source.
    const auto place_on = [&](const std::vector<Index>& line, const std::vector<double>& arc, double share) {
        const geometry::PolylinePlace at = geometry::place_at(arc, share * arc.back());
        return Vec2((1 - at.fraction) * source(line[at.segment]) +
                    at.fraction * source(line[at.segment + 1]));
    };
    for (const LinkingSurface& link : links) {
        const std::vector<Index> low = use_points(model, link.source.uses()),
                                 high = use_points(model, link.target.uses());
        const std::vector<double> low_at = arc_of(low), high_at = arc_of(high);
        for (std::size_t i = 0; i + 1 < high.size(); ++i) // the last point is the first
            fixed[high[i]] = place_on(low, low_at, target_coordinate(link, high_at[i]));
    }
    for (const KnownLine& line : known) {
        const std::vector<double> low = arc_of(line.source), high = arc_of(line.target);
        for (std::size_t i = 0; i < line.target.size(); ++i) {
            const double share = (high[i] / high.back() - line.target_from) /
                                 (line.target_to - line.target_from);
            if (!(share >= 0 && share <= 1)) continue;
            const double at = line.source_from + share * (line.source_to - line.source_from);
            fixed.emplace(line.target[i], place_on(line.source, low, at));
        }
    }
    problem.points = model.points;
    problem.triangles = triangles;
    problem.fix(fixed);
    const Eigen::MatrixXd places = geometry::solve_harmonic(problem);
    target_.clear();
    for (Eigen::Index i = 0; i < places.rows(); ++i) target_.emplace_back(places(i, 0), places(i, 1));
    // A facet that has no area in space has no area in the plane either, and does not count as inverted.
    double extent = 0;
    for (const auto& [point, place] : fixed)
        extent = std::max(extent, (place - fixed.begin()->second).squaredNorm());
    for (const Triangle& t : triangles) {
        const double area = geometry::cross(target(t[1]) - target(t[0]), target(t[2]) - target(t[0])) / 2;
        if (area > kRoundoff * extent) one_to_one_ = false;
    }
}

SourcePlace EndsMap::on_source(const Vec2& place) const
{
    const auto found = locator_.locate(place);
    const FaceId face = source_facets_.face[index(found.triangle)];
    const Index number = source_facets_.number[index(found.triangle)];
    return {face, point_on_facets(volume_.model, face, {number, found.barycentric})};
}

FacetPosition EndsMap::on_face(FaceId face, const Vec2& place) const
{
    const auto found = face_locator_.at(face).locate(place);
    return {found.triangle, found.barycentric};
}

} // namespace lacuna::surface
