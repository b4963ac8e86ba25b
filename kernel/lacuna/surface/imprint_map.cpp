// SPDX-License-Identifier: MIT
#include <lacuna/surface/detail/imprint_map.h>

#include <lacuna/geometry/shared/harmonic.h>
#include <lacuna/geometry/shared/polyline.h>
#include <lacuna/surface/detail/linking_map.h>

#include <algorithm>
#include <cmath>

namespace lacuna::surface {

using namespace topology;

namespace {

double signed_area(const Vec2& a, const Vec2& b, const Vec2& c)
{
    return ((b - a).x() * (c - a).y() - (b - a).y() * (c - a).x()) / 2;
}

std::vector<double> running_lengths(const Model& model, const std::vector<Index>& chain)
{
    std::vector<Vec3> line;
    for (const Index p : chain) line.push_back(model.at(p));
    return geometry::arc_lengths(line);
}

/// Points of a closed chain (the first not repeated) and their running lengths, followed by the total length.
struct Rim {
    std::vector<Index> points;
    std::vector<double> at;
};

Rim rim_of(const Model& model, const Chain& chain)
{
    Rim rim;
    double at = 0;
    for (const EdgeUse& use : chain.uses()) {
        const std::vector<Index> points = use_points(model, use);
        for (std::size_t i = 0; i + 1 < points.size(); ++i) {
            rim.points.push_back(points[i]);
            rim.at.push_back(at);
            at += (model.at(points[i + 1]) - model.at(points[i])).norm();
        }
    }
    rim.at.push_back(at);
    return rim;
}

} // namespace

EndsMap::EndsMap(const OpenVolume& volume, std::span<const LinkingSurface> links,
                 std::span<const ClosedPair> closed, std::span<const KnownLine> known)
    : volume_(volume)
{
    lay_source();
    if (one_to_one_) lay_target(links, closed, known);
}

void EndsMap::lay_source()
{
    const Model& model = volume_.model;
    std::vector<Triangle> triangles;
    for (const FaceId face : volume_.faces(Role::source)) {
        for (std::size_t t = 0; t < model[face].triangles.size(); ++t) {
            triangles.push_back(model[face].triangles[t]);
            face_of_.push_back(face);
            number_.push_back(static_cast<Index>(t));
        }
    }
    const geometry::Flattened flat = geometry::flatten(model.points, triangles);
    one_to_one_ = !flat.folded;
    source_.assign(model.points.size(), Vec2::Zero());
    for (std::size_t i = 0; i < flat.used.size(); ++i)
        source_[static_cast<std::size_t>(flat.used[i])] = flat.position[i];
    locator_ = geometry::PlanarLocator(flat);
    for (const FaceId face : volume_.faces(Role::source))
        face_locator_[face] = geometry::PlanarLocator(source_, model[face].triangles);
}

void EndsMap::lay_target(std::span<const LinkingSurface> links, std::span<const ClosedPair> closed,
                         std::span<const KnownLine> known)
{
    const Model& model = volume_.model;
    geometry::HarmonicProblem problem;
    std::vector<Triangle> triangles;
    for (const FaceId face : volume_.faces(Role::target))
        triangles.insert(triangles.end(), model[face].triangles.begin(), model[face].triangles.end());
    std::map<Index, Vec2> fixed;
    for (const LinkingSurface& link : links) {
        const Rim low = rim_of(model, link.source), high = rim_of(model, link.target);
        for (std::size_t i = 0; i < high.points.size(); ++i) {
            const double s = target_coordinate(link, high.at[i]) * low.at.back();
            const geometry::PolylinePlace at = geometry::place_at(low.at, s);
            const Vec2& a = source(low.points[at.segment]);
            const Vec2& b = source(low.points[(at.segment + 1) % low.points.size()]);
            fixed[high.points[i]] = (1 - at.fraction) * a + at.fraction * b;
        }
    }
    for (const ClosedPair& pair : closed) {
        const std::vector<Index>&low = model[pair.source].points, &high = model[pair.target].points;
        const std::vector<double> low_at = geometry::arc_lengths(edge_line(model, pair.source));
        const std::vector<double> high_at = geometry::arc_lengths(edge_line(model, pair.target));
        for (std::size_t i = 0; i < high.size(); ++i) {
            double share = (high_at[i] / high_at.back() - pair.from) / (pair.to - pair.from);
            share -= std::floor(share);
            const geometry::PolylinePlace at = geometry::place_at(low_at, share * low_at.back());
            fixed[high[i]] = (1 - at.fraction) * source(low[at.segment]) +
                             at.fraction * source(low[at.segment + 1]);
        }
    }
    for (const KnownLine& line : known) {
        const std::vector<double> low = running_lengths(model, line.source),
                                  high = running_lengths(model, line.target);
        for (std::size_t i = 0; i < line.target.size(); ++i) {
            const double share = (high[i] / high.back() - line.target_from) /
                                 (line.target_to - line.target_from);
            if (!(share >= 0 && share <= 1)) continue;
            const double at = line.source_from + share * (line.source_to - line.source_from);
            const geometry::PolylinePlace place = geometry::place_at(low, at * low.back());
            fixed.emplace(line.target[i], (1 - place.fraction) * source(line.source[place.segment]) +
                                              place.fraction * source(line.source[place.segment + 1]));
        }
    }
    problem.points = model.points;
    problem.triangles = triangles;
    problem.fixed_values.resize(static_cast<Eigen::Index>(fixed.size()), 2);
    for (const auto& [point, place] : fixed) {
        problem.fixed_values.row(static_cast<Eigen::Index>(problem.fixed.size())) = place.transpose();
        problem.fixed.push_back(point);
    }
    const Eigen::MatrixXd places = geometry::solve_harmonic(problem);
    target_.reserve(model.points.size());
    for (Eigen::Index i = 0; i < places.rows(); ++i) target_.emplace_back(places(i, 0), places(i, 1));
    // Facets without area in space have none in the plane and cannot be inverted.
    double extent = 0;
    for (const auto& [point, place] : fixed)
        extent = std::max(extent, (place - fixed.begin()->second).squaredNorm());
    constexpr double kNoArea = 1e-12; ///< of the squared extent: rounding
    for (const Triangle& t : triangles) {
        if (signed_area(target(t[0]), target(t[1]), target(t[2])) > kNoArea * extent) one_to_one_ = false;
    }
}

SourcePlace EndsMap::on_source(const Vec2& place) const
{
    const auto found = locator_.locate(place);
    const auto facet = static_cast<std::size_t>(found.triangle);
    const FaceId face = face_of_[facet];
    const Triangle& t = volume_.model[face].triangles[static_cast<std::size_t>(number_[facet])];
    const Vec3& w = found.barycentric;
    const auto at = [&](std::size_t k) { return volume_.model.at(t[k]); };
    return {face, {number_[facet], w}, w[0] * at(0) + w[1] * at(1) + w[2] * at(2)};
}

SourcePlace EndsMap::on_face(FaceId face, const Vec2& place) const
{
    const auto found = face_locator_.at(face).locate(place);
    const Triangle& t = volume_.model[face].triangles[static_cast<std::size_t>(found.triangle)];
    const Vec3& w = found.barycentric;
    const auto at = [&](std::size_t k) { return volume_.model.at(t[k]); };
    return {face, {found.triangle, w}, w[0] * at(0) + w[1] * at(1) + w[2] * at(2)};
}

} // namespace lacuna::surface
