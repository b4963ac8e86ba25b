// SPDX-License-Identifier: MIT
#include <lacuna/closure/detail/class_five.h>

#include <lacuna/closure/detail/outline.h>
#include <lacuna/closure/detail/void_faces.h>
#include <lacuna/core/error.h>
#include <lacuna/core/shared/criteria.h>
#include <lacuna/geometry/newell.h>
#include <lacuna/geometry/shared/affine.h>
#include <lacuna/geometry/shared/predicates.h>
#include <lacuna/topology/shared/face_parts.h>
#include <lacuna/topology/shared/face_plane.h>
#include <lacuna/topology/shared/names_of.h>
#include <lacuna/topology/shared/use_places.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace lacuna::closure {

using namespace topology;

namespace {

/// A connected part of the walls with its two open ends.
struct Tube {
    std::vector<FaceId> walls;
    std::array<Rim, 2> rim;
    std::array<std::vector<Vec3>, 2> points;
};

std::vector<Tube> tubes_of(const OpenVolume& volume)
{
    const Model& model = volume.model;
    std::vector<Tube> tubes;
    for (std::vector<FaceId>& part : connected_parts(model, volume.faces(Role::wall))) {
        const std::vector<Rim> open = rims(model, part);
        if (open.size() != 2) {
            throw NotClosed(
                Message("closure.tube_loops",
                        "the walls {} have {} free {}, but in class V each connected part of the walls needs "
                        "exactly {}",
                        entities_of(model, part), found(open.size()), open.size() == 1 ? "loop" : "loops",
                        needed(2))
                    .remedy("name the source or the target, or add the missing walls"));
        }
        tubes.push_back({std::move(part),
                         {open[0], open[1]},
                         {loop_places(model, open[0].uses), loop_places(model, open[1].uses)}});
    }
    std::ranges::stable_sort(tubes, std::greater{}, [](const Tube& tube) {
        return geometry::newell_vector(tube.points[0]).norm() +
               geometry::newell_vector(tube.points[1]).norm();
    });
    return tubes;
}

/// Distance between the centres of two loops, measured along the normal of `to`: the sweep direction at that
/// loop.
double distance(const std::vector<Vec3>& from, const std::vector<Vec3>& to)
{
    const Vec3 normal = geometry::newell_vector(to).stableNormalized();
    return std::abs((geometry::mean_point(from) - geometry::mean_point(to)).dot(normal));
}

/// Order the two loops of each tube like those of the first tube, by their distances to these.
void sort_ends(const Model& model, std::vector<Tube>& tubes)
{
    const Tube& first = tubes.front();
    for (std::size_t i = 1; i < tubes.size(); ++i) {
        Tube& tube = tubes[i];
        const double as_is = distance(tube.points[0], first.points[0]) +
                             distance(tube.points[1], first.points[1]);
        const double turned = distance(tube.points[1], first.points[0]) +
                              distance(tube.points[0], first.points[1]);
        const double apart =
            (geometry::mean_point(first.points[0]) - geometry::mean_point(first.points[1])).norm();
        if (std::abs(as_is - turned) <= kFileAccuracy * apart) {
            throw NotClosed(Message("closure.ambiguous_loops",
                                    "the two free loops of {} are equally close to both ends of the walls at "
                                    "{}, so source and target are ambiguous",
                                    entities_of(model, tube.walls), entity_of(model, first.walls.front()))
                                .remedy("name the source"));
        }
        if (turned < as_is) {
            std::swap(tube.rim[0], tube.rim[1]);
            std::swap(tube.points[0], tube.points[1]);
        }
    }
}

/// Reverse each tube that lies inside another tube, so that all walls face the void.
void face_the_void(OpenVolume& volume, std::vector<Tube>& tubes)
{
    const geometry::Plane plane = geometry::newell_plane({&tubes.front().points[0], 1});
    std::vector<std::vector<Vec2>> flat;
    for (const Tube& tube : tubes) flat.push_back(flat_places(plane, tube.points[0]));
    for (std::size_t i = 1; i < tubes.size(); ++i) {
        std::size_t depth = 0;
        for (std::size_t j = 0; j < tubes.size(); ++j)
            depth += j != i && geometry::encloses(flat[j], flat[i]) ? 1 : 0;
        if (depth != 1) {
            throw NotClosed(Message("closure.nested_loops",
                                    "the walls {} {} the walls at {}, so they bound several volumes",
                                    entities_of(volume.model, tubes[i].walls),
                                    depth == 0 ? "lie beside" : "are nested more than once in",
                                    entity_of(volume.model, tubes.front().walls.front()))
                                .remedy("make an open volume of each"));
        }
        // If the void lies between two tubes, the loop of the inner one runs opposite to that of the outer
        // one.
        const double along =
            geometry::newell_vector(tubes[i].points[0]).dot(geometry::newell_vector(tubes.front().points[0]));
        if (along > 0) {
            flip_faces(volume.model, tubes[i].walls);
            for (Rim& rim : tubes[i].rim) rim.uses = reversed(rim).uses;
        }
    }
}

} // namespace

std::vector<FaceId> no_tube(const OpenVolume& volume)
{
    for (std::vector<FaceId>& part : connected_parts(volume.model, volume.faces(Role::wall)))
        if (rims(volume.model, part).size() != 2) return std::move(part);
    return {};
}

EndLoops group_loops(OpenVolume& volume)
{
    std::vector<Tube> tubes = tubes_of(volume);
    if (tubes.empty())
        throw NotClosed(Message("closure.no_walls", "class V needs walls, and the volume has none")
                            .remedy("name the walls"));
    sort_ends(volume.model, tubes);
    face_the_void(volume, tubes);
    EndLoops ends;
    for (const Tube& tube : tubes) {
        ends.source.push_back(reversed(tube.rim[0]));
        ends.target.push_back(reversed(tube.rim[1]));
    }
    return ends;
}

std::vector<FaceId> floors_round(const OpenVolume& volume, const std::vector<Loop>& end)
{
    const Model& model = volume.model;
    std::vector<FaceId> floors;
    for (const Loop& loop : end) {
        const auto is_of_loop = [&](const EdgeUse& use) {
            return std::ranges::any_of(loop.uses, [&](const EdgeUse& own) { return own.edge == use.edge; });
        };
        const std::vector<Vec3> rim = loop_places(model, loop.uses);
        const geometry::Plane plane = geometry::newell_plane({&rim, 1});
        for (const FaceId wall : volume.faces(Role::wall)) {
            const Face& face = model[wall];
            std::size_t around = 0;
            bool goes_on = face.loops.size() > 1;
            for (const EdgeUse& use : uses_of(face)) {
                if (is_of_loop(use))
                    ++around;
                else
                    goes_on = goes_on && model.uses_of_edge(use.edge).size() == 2;
            }
            if (goes_on && around == loop.uses.size() && lies_in_plane(model, wall, plane))
                floors.push_back(wall);
        }
    }
    return floors;
}

} // namespace lacuna::closure
