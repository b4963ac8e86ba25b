// SPDX-License-Identifier: MIT
#include <lacuna/closure/detail/round_walls.h>

#include <lacuna/closure/detail/guesses.h>
#include <lacuna/closure/detail/outline.h>
#include <lacuna/closure/detail/void_entities.h>
#include <lacuna/closure/detail/void_faces.h>
#include <lacuna/core/shared/criteria.h>
#include <lacuna/geometry/newell.h>
#include <lacuna/geometry/shared/predicates.h>
#include <lacuna/topology/shared/cone_shape.h>
#include <lacuna/topology/shared/names_of.h>
#include <lacuna/topology/shared/use_places.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <ranges>

namespace lacuna::closure {

using namespace topology;

namespace {

/// The given faces at a loop. There are none at the void edges between missing faces.
std::vector<FaceId> given_beside(const Model& model, const Loop& loop)
{
    std::vector<FaceId> beside;
    for (const EdgeUse& use : loop.uses)
        for (const FaceUse& by : model.uses_of_edge(use.edge)) beside.push_back(by.face);
    return beside;
}

/// Whether there are given faces at a rim, and all are parallel to the direction `way`. If they are inclined,
/// a missing wall may be inclined as well.
bool is_square_to_walls(const Model& model, const Loop& loop, const Vec3& way)
{
    const std::vector<FaceId> beside = given_beside(model, loop);
    return !beside.empty() && std::ranges::all_of(beside, [&](FaceId face) {
        return std::ranges::all_of(facet_normals(model, face).normals,
                                   [&](const Vec3& n) { return std::abs(n.dot(way)) <= kParallel; });
    });
}

/// Add the image of a flat rim in a parallel plane, and the walls up to it. @return  the image.
Loop add_walls_to(FlatFilling& filling, const Loop& rim, const geometry::Plane& plane,
                  const RunContext& context)
{
    Model& model = filling.volume.model;
    const auto moved = [&](const Vec3& p) -> Vec3 { return p - geometry::height(plane, p) * plane.normal; };
    const std::size_t sides = rim.uses.size();
    ModelBuilder builder(std::move(model));
    std::vector<VertexId> foot, top;
    for (const EdgeUse& use : rim.uses) {
        foot.push_back(use.reversed ? builder[use.edge].to : builder[use.edge].from);
        builder.points.push_back(moved(builder.points[static_cast<std::size_t>(builder[foot.back()].point)]));
        top.push_back(builder.add_void_vertex(static_cast<Index>(builder.points.size()) - 1));
    }
    model = std::move(builder).finish();
    Loop image;
    std::vector<EdgeId> rungs;
    for (std::size_t i = 0; i < sides; ++i) {
        std::vector<Vec3> between;
        for (const Vec3& p : use_places(model, rim.uses[i])) between.push_back(moved(p));
        between.pop_back();
        between.erase(between.begin());
        image.uses.push_back({add_void_edge_through(model, top[i], top[(i + 1) % sides], between), false});
        rungs.push_back(add_void_edge_through(model, foot[i], top[i]));
    }
    for (std::size_t i = 0; i < sides; ++i) {
        const std::size_t next = (i + 1) % sides;
        add_wall(filling,
                 {{rim.uses[i]}, {{rungs[next], false}}, {{image.uses[i].edge, true}}, {{rungs[i], true}}},
                 context);
        filling.closure.void_edges.push_back(image.uses[i].edge);
        filling.closure.void_edges.push_back(rungs[i]);
    }
    return image;
}

} // namespace

std::vector<Loop> add_straight_walls(FlatFilling& filling, std::vector<Loop> loops, const RunContext& context)
{
    const Model model = filling.volume.model;
    std::vector<std::size_t> needy, other;
    std::vector<geometry::Plane> plane;
    std::vector<std::vector<Vec3>> places;
    for (const Loop& loop : loops) {
        places.push_back(loop_places(model, loop.uses));
        plane.push_back(geometry::newell_plane({&places.back(), 1}));
    }
    for (std::size_t l = 0; l < loops.size(); ++l) {
        if (continues_given_planes(model, {loops[l].uses}))
            needy.push_back(l);
        else if (is_square_to_walls(model, loops[l], plane[l].normal))
            other.push_back(l);
    }
    for (const std::size_t l : needy) {
        check_cancelled(context);
        // The nearest rim of `other` such that the image of rim `l` lies inside it or encloses it.
        std::optional<std::size_t> end;
        const auto distance = [&](std::size_t o) {
            return std::abs(geometry::height(plane[o], places[l].front()));
        };
        for (const std::size_t o : other) {
            if (plane[l].normal.cross(plane[o].normal).norm() > kParallel || distance(o) <= model.tolerance ||
                (end && distance(*end) <= distance(o)))
                continue;
            const std::vector<Vec2> image = flat_places(plane[o], places[l]),
                                    outline = flat_places(plane[o], places[o]);
            if (geometry::lies_inside(outline, image.front()) ||
                geometry::lies_inside(image, outline.front()))
                end = o;
        }
        if (!end) continue;
        const std::vector<FaceId> at{given_beside(model, loops[l]).front()},
            beyond{given_beside(model, loops[*end]).front()};
        loops[l] = add_walls_to(filling, loops[l], plane[*end], context);
        assume(filling.closure,
               {"closure.straight_wall",
                "the missing walls at the rim of {} are assumed to be straight, up to the plane of the "
                "missing face beside {}",
                entities_of(model, at), entities_of(model, beyond)},
               1, Assumed::straight);
    }
    return loops;
}

} // namespace lacuna::closure
