// SPDX-License-Identifier: MIT
#include <lacuna/closure/detail/guesses.h>

#include <lacuna/core/shared/criteria.h>
#include <lacuna/geometry/newell.h>
#include <lacuna/topology/shared/cone_shape.h>
#include <lacuna/topology/shared/face_parts.h>
#include <lacuna/topology/shared/face_plane.h>
#include <lacuna/topology/shared/face_radius.h>
#include <lacuna/topology/shared/facet_area.h>
#include <lacuna/topology/shared/names_of.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <utility>

namespace lacuna::closure {

using namespace topology;

namespace {

/// Whether some void face has no vertex in common with a given face.
bool is_end_away_from(const Model& model, const std::vector<FaceId>& void_faces, FaceId face)
{
    const std::set<VertexId> own = vertices_of(model, std::vector{face});
    return std::ranges::any_of(void_faces, [&](FaceId other) {
        return std::ranges::none_of(uses_of(model[other]),
                                    [&](const EdgeUse& use) { return own.contains(use_from(model, use)); });
    });
}

/// Whether the normals of all given faces point into the sealed volume, like those of a hollow in a solid.
bool look_inward(const Model& model, const std::vector<FaceId>& given, const Model& sealed)
{
    const auto normal = [](const Model& of, FaceId face) {
        const Triangle& t = of[face].triangles.front();
        return (of.at(t[1]) - of.at(t[0])).cross(of.at(t[2]) - of.at(t[0]));
    };
    for (std::size_t f = 0; f < given.size(); ++f)
        if (normal(model, given[f]).dot(normal(sealed, FaceId(f))) > 0) return false;
    return true;
}

/// A hole of a given face that a void face closes in its plane.
struct ClosedHole {
    FaceId round, filler;
};

/// The closed holes of the first `given` faces.
std::vector<ClosedHole> closed_holes(std::size_t given, const Model& own,
                                     const std::vector<FaceId>& void_faces)
{
    std::vector<ClosedHole> holes;
    for (const FaceId face : void_faces) {
        const auto round = face_round_hole(own, face);
        if (round && round->index() < given) holes.push_back({*round, face});
    }
    return holes;
}

/// Whether a volume lies outside the ball around a centre on which a face of its skin lies.
bool is_hollow(const Model& sealed, FaceId face, const Vec3& centre)
{
    double outward = 0;
    for (const Triangle& t : sealed[face].triangles)
        outward += (sealed.at(t[0]) - centre).dot(facet_area_vector(sealed, t));
    return outward < 0;
}

/// Largest distance of the centroids of the other void faces from the mean plane of `face` [model length].
double reach_of_others(const Model& model, const std::vector<FaceId>& void_faces, FaceId face)
{
    const geometry::Plane plane = mean_plane(model, face);
    double reach = 0;
    for (const FaceId other : void_faces)
        reach = std::max(reach, std::abs(geometry::height(plane, face_centroid(model, other))));
    return reach;
}

} // namespace

std::optional<FaceId> face_round_hole(const Model& model, FaceId filler)
{
    const std::set<FaceId> round = faces_beside(model, filler);
    if (round.size() != 1 || model[*round.begin()].loops.size() < 2) return std::nullopt;
    const auto plane = plane_of(model, *round.begin());
    if (!plane || !lies_in_plane(model, filler, *plane)) return std::nullopt;
    return *round.begin();
}

FaceId open_hole(const Model& model, const std::vector<FaceId>& given, const OpenVolume& sealed,
                 const Closure& closure)
{
    if (look_inward(model, given, sealed.model)) return {};
    for (const auto& [round, filler] : closed_holes(given.size(), sealed.model, closure.void_faces))
        if (is_end_away_from(sealed.model, closure.void_faces, round)) return given[round.index()];
    return {};
}

Message guess_of_hole(const Model& model, FaceId face)
{
    return {"topology.shape_open",
            "it is ambiguous whether the hole of {} ends at this face or goes through: its walls and an "
            "opposite end are missing",
            entity_of(model, face)};
}

void note_closed_holes(const Model& model, const std::vector<FaceId>& given, const OpenVolume& sealed,
                       RolesBy by, Closure& closure)
{
    const bool inward = look_inward(model, given, sealed.model);
    for (const FaceId face : closure.void_faces) {
        const auto shape = round_shape(sealed.model, face);
        if (!shape || !shape->is_sphere()) continue;
        const bool hollow = is_hollow(sealed.model, face, shape->centre);
        if (!inward && !hollow) continue;
        assume(closure,
               Message("closure.ball_part", "{} is the smaller part of the ball through its rim, although {}",
                       entity_of(sealed.model, face),
                       inward ? "the faces beside this rim are oriented into the volume"
                              : "the volume then lies outside this ball")
                   .remedy("if the other part bounds the volume, give it"),
               1);
    }
    for (const auto& [round, filler] : closed_holes(given.size(), sealed.model, closure.void_faces)) {
        const bool wall = sealed.role[filler.index()] == Role::wall;
        if (wall == inward && (wall || by == RolesBy::person)) continue;
        const double area = face_area(sealed.model, filler);
        const NamedEntity face = entity_of(model, given[round.index()]);
        if (!inward)
            assume(closure,
                   Message("closure.hole_closed",
                           "a hole of {} is closed in its plane, which fills any pocket behind it", face)
                       .remedy("if there is a pocket, give its faces"),
                   area * std::sqrt(area) / enclosed_volume(sealed));
        else
            assume(
                closure,
                Message("closure.hole_covered",
                        "a hole of {} is covered, because the given faces are oriented into the void", face)
                    .remedy("with this face as source, close{{ holes = \"through\" }} extends the hole to "
                            "the missing end"),
                area * reach_of_others(sealed.model, closure.void_faces, filler) / enclosed_volume(sealed));
    }
}

} // namespace lacuna::closure
