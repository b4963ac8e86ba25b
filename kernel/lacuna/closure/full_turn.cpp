// SPDX-License-Identifier: MIT
#include <lacuna/closure/detail/full_turn.h>

#include <lacuna/closure/shared/cut.h>
#include <lacuna/core/error.h>
#include <lacuna/core/shared/attempt.h>
#include <lacuna/core/shared/criteria.h>
#include <lacuna/core/shared/limits.h>
#include <lacuna/geometry/newell.h>
#include <lacuna/geometry/shared/affine.h>
#include <lacuna/geometry/shared/polyline.h>
#include <lacuna/geometry/shared/spread.h>
#include <lacuna/matching/shared/guides.h>
#include <lacuna/topology/shared/face_parts.h>
#include <lacuna/topology/shared/section.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace lacuna::closure {

using namespace topology;

namespace {

struct Candidate {
    geometry::Plane plane;
    double length = 0; ///< total length of the lines where it crosses walls [model length]
};

/// Centroid and second moments of the walls, by area.
geometry::Spread spread_of_walls(const Model& model)
{
    std::vector<Vec3> middles;
    std::vector<double> areas;
    for (const Face& face : model.faces) {
        for (const Triangle& t : face.triangles) {
            const Vec3 &a = model.at(t[0]), &b = model.at(t[1]), &c = model.at(t[2]);
            middles.push_back((a + b + c) / 3);
            areas.push_back((b - a).cross(c - a).norm() / 2);
        }
    }
    return geometry::spread_of(middles, areas);
}

double section_length(const Model& model, const std::vector<FaceId>& faces, const geometry::Plane& plane)
{
    double length = 0;
    const auto place = [&](const SectionPlace& at) { return place_at(model, at, plane); };
    for (const SectionWalk& walk : section_walks(model, faces, plane, model.tolerance)) {
        for (std::size_t i = walk.closed ? 0 : 1; i < walk.places.size(); ++i) {
            const std::size_t before = (i + walk.places.size() - 1) % walk.places.size();
            length += (place(walk.places[i]) - place(walk.places[before])).norm();
        }
    }
    return length;
}

/// Planes that cross the walls, ordered by the length of their section.
std::vector<Candidate> candidates_of(const Model& model, const RunContext& context)
{
    const std::vector<FaceId> faces = all_faces(model);
    const geometry::Spread walls = spread_of_walls(model);
    std::vector<Candidate> found;
    for (int a = 0; a < 3; ++a) {
        const Vec3 axis = walls.axis.col(a);
        // Start at a vertex, so that the first plane runs through a seam. On a round wall, a plane close to
        // the seam would leave a sliver.
        Vec3 first = Vec3::Zero();
        for (const Vertex& vertex : model.vertices) {
            const Vec3 out = model.at(vertex.point) - walls.centre;
            first = out - axis.dot(out) * axis;
            if (first.norm() > model.tolerance) break;
        }
        if (!(first.norm() > model.tolerance)) first = walls.axis.col((a + 1) % 3);
        first.normalize();
        // Planes so close that one cuts a polygonal ring of few sides near the middle of a side.
        for (std::size_t k = 0; k < kMostTrials; ++k) {
            check_cancelled(context);
            const double angle = std::numbers::pi * static_cast<double>(k) / kMostTrials;
            const Vec3 normal = std::cos(angle) * axis.cross(first) - std::sin(angle) * first;
            Candidate candidate{geometry::plane_across(walls.centre, normal)};
            candidate.length = section_length(model, faces, candidate.plane);
            if (candidate.length > 0) found.push_back(candidate);
        }
    }
    // Planes with equal lengths keep the order in which they were found.
    std::vector<Candidate> sorted;
    while (!found.empty()) {
        const double least = std::ranges::min_element(found, {}, &Candidate::length)->length;
        const auto next = std::ranges::find_if(
            found, [&](const Candidate& c) { return c.length <= (1 + kAlikeSizes) * least; });
        sorted.push_back(*next);
        found.erase(next);
    }
    return sorted;
}

/// Length of a piece from cut to cut, along the centroids of the sections of its walls; 0 if there are none.
double arc_length(const OpenVolume& volume, const RunContext& context)
{
    std::vector<Vec3> line;
    for (const std::vector<Vec3>& section : matching::cut_sections(volume, {}, context).levels)
        if (!section.empty()) line.push_back(geometry::mean_point(section));
    return line.empty() ? 0 : geometry::length(line);
}

/// Whether a ring was cut across: there are two pieces, and all ends of both are cut faces.
bool is_cut_across(const std::vector<StepPiece>& pieces)
{
    return pieces.size() == 2 && std::ranges::all_of(pieces, [](const StepPiece& piece) {
               const auto is_cut = [&](FaceId face) {
                   return piece.volume.model[face].origin == Origin::made_void;
               };
               const std::vector<FaceId> source = piece.volume.faces(Role::source),
                                         target = piece.volume.faces(Role::target);
               return !source.empty() && !target.empty() && std::ranges::all_of(source, is_cut) &&
                      std::ranges::all_of(target, is_cut);
           });
}

} // namespace

std::vector<StepPiece> cut_full_turn(const OpenVolume& volume, const RunContext& context)
{
    for (std::size_t f = 0; f < volume.role.size(); ++f) {
        if (volume.role[f] != Role::wall)
            throw InvalidInput(Message("closure.full_turn_ends",
                                       "a full-turn volume has no ends, but {} is named as one",
                                       entity_of(volume.model, FaceId(f)))
                                   .remedy("name walls only"));
    }
    std::optional<Message> why;
    for (const Candidate& candidate : candidates_of(volume.model, context)) {
        // A cut is refused if the plane crosses given quads.
        auto pieces = unless_refused([&] { return cut_by_plane(volume, candidate.plane, context); });
        if (!pieces) continue;
        if (is_cut_across(*pieces)) {
            StepPiece &one = pieces->front(), &other = pieces->back();
            double first = arc_length(one.volume, context), second = arc_length(other.volume, context);
            if (!(first > 0 && second > 0)) first = second = 1; // not measured: half a turn each
            one.turn_to = other.turn_from = first / (first + second);
            return std::move(*pieces);
        }
        if (!why)
            why = Message("closure.full_turn",
                          "of all planes, the one with the shortest section cuts the ring into {} pieces "
                          "instead of two",
                          found(pieces->size()));
    }
    Message message =
        Message("closure.full_turn", "no plane through the centre of the walls cuts the ring in two places")
            .remedy(
                "name exactly the walls of the ring, or use volume:cut{{ plane = … }} and lacuna.assembly");
    if (why) throw NotSweepable(message.attempt(std::move(*why)));
    throw NotSweepable(std::move(message));
}

} // namespace lacuna::closure
