// SPDX-License-Identifier: MIT
#include <lacuna/closure/detail/flat_fill.h>

#include <lacuna/closure/detail/four_corners.h>
#include <lacuna/closure/detail/guesses.h>
#include <lacuna/closure/detail/outline.h>
#include <lacuna/closure/detail/pieces.h>
#include <lacuna/closure/detail/round_walls.h>
#include <lacuna/closure/detail/sealing.h>
#include <lacuna/closure/detail/touching_faces.h>
#include <lacuna/closure/detail/void_entities.h>
#include <lacuna/core/shared/attempt.h>
#include <lacuna/core/shared/criteria.h>
#include <lacuna/geometry/newell.h>
#include <lacuna/geometry/shared/polyline.h>
#include <lacuna/topology/shared/face_parts.h>
#include <lacuna/topology/shared/hollows.h>
#include <lacuna/topology/shared/names_of.h>
#include <lacuna/topology/shared/use_places.h>

#include <algorithm>
#include <cmath>

namespace lacuna::closure {

using namespace topology;

namespace {

/// Divide loops that pass a vertex twice into loops that do not. If two missing faces touch in a vertex, one
/// free loop runs around both of them.
std::vector<Rim> simple_loops(const Model& model, const std::vector<Rim>& loops)
{
    std::vector<Rim> simple;
    for (const Rim& loop : loops) {
        std::vector<EdgeUse> path;
        for (const EdgeUse& use : loop.uses) {
            path.push_back(use);
            const auto start = std::ranges::find(path, use_to(model, use),
                                                 [&](const EdgeUse& u) { return use_from(model, u); });
            if (start == path.end()) continue;
            simple.push_back({{start, path.end()}});
            path.erase(start, path.end());
        }
    }
    return simple;
}

/// Whether the given sides of a flat face include a bent one between two that are not parallel, as in the
/// sector of a ring. A missing face opposite may then be bent in the same way.
bool is_of_ring(const Model& model, const Loop& loop)
{
    std::vector<EdgeUse> uses = loop.uses;
    std::erase_if(uses, [&](const EdgeUse& use) { return model[use.edge].origin != Origin::given; });
    const auto way = [&](const EdgeUse& use) {
        const std::vector<Vec3> chain = use_places(model, use);
        return (chain.back() - chain.front()).stableNormalized();
    };
    std::optional<std::size_t> corner;
    for (std::size_t k = 1; k < uses.size(); ++k) {
        if (!turns_sharply(model, uses[k - 1], uses[k])) continue;
        if (corner && way(uses[*corner - 1]).cross(way(uses[k])).norm() > kParallel) {
            const auto first = uses.begin() + static_cast<std::ptrdiff_t>(*corner);
            if (!is_straight(model, {first, uses.begin() + static_cast<std::ptrdiff_t>(k)})) return true;
        }
        corner = k;
    }
    return false;
}

/// The free loops to fill. Loops in several planes are already split.
struct ToFill {
    std::vector<Loop> flat, bent;
};

std::optional<ToFill> loops_to_fill(FlatFilling& filling, Missing missing, const RunContext& context)
{
    Model& model = filling.volume.model;
    ToFill result;
    std::vector<Rim> loops = free_loops(filling.volume);
    if (missing == Missing::any) {
        loops = add_tubes(filling, simple_loops(model, loops), context);
    }
    for (const Rim& rim : loops) {
        if (is_flat(model, rim)) {
            result.flat.push_back({rim.uses});
            continue;
        }
        if (missing == Missing::any && tells_face(model, {rim.uses})) {
            result.bent.push_back({rim.uses});
            continue;
        }
        const std::size_t edges = model.edges.size(), vertices = model.vertices.size();
        auto parts = split_touching(model, rim, context);
        if (!parts) parts = std::vector<Loop>{{rim.uses}};
        for (std::size_t e = edges; e < model.edges.size(); ++e) filling.closure.void_edges.emplace_back(e);
        const bool may_bend = std::ranges::any_of(*parts, [&](const Loop& part) {
            // One edge in a plane, such as the rim of a tube with a spike, may be that of a bent face.
            return parts->size() == 2 ? part.uses.size() < 3 : is_of_ring(model, part);
        });
        for (Loop& part : *parts)
            (is_flat(model, {part.uses}) ? result.flat : result.bent).push_back(std::move(part));
        if (missing == Missing::flat &&
            (may_bend || !result.bent.empty() || model.vertices.size() > vertices))
            return std::nullopt;
        filling.each_alone = false;
    }
    if (missing == Missing::any) result.flat = add_straight_walls(filling, std::move(result.flat), context);
    return result;
}

void fill_flat(FlatFilling& filling, const std::vector<Loop>& loops, const RunContext& context)
{
    Model& model = filling.volume.model;
    for (const FlatRegion& region : flat_regions(model, loops)) {
        check_cancelled(context);
        std::vector<std::vector<EdgeUse>> bounds;
        for (const std::size_t loop : region.loops) bounds.push_back(loops[loop].uses);
        filling.each_alone = filling.each_alone && region.loops.size() == 1;
        const FaceId face = add_partition(model, bounds, region.plane, "", context);
        filling.volume.role.push_back(Role::wall);
        filling.closure.void_faces.push_back(face);
    }
}

/// Fill the free loops of some faces. The result may be open or cross itself; the caller checks the result
/// with `prove()`.
std::optional<FlatFilling> fill_loops(const Model& model, const std::vector<FaceId>& faces, Missing missing,
                                      const RunContext& context)
{
    FlatFilling result;
    OpenVolume& volume = result.volume;
    volume.model = extract(model, faces);
    orient_consistently(volume.model);
    volume.role.assign(faces.size(), Role::wall);
    // Filling fails if a straight edge across a notch lies outside the rim, or if a bent face folds.
    return unless_refused([&]() -> std::optional<FlatFilling> {
               const std::optional<ToFill> loops = loops_to_fill(result, missing, context);
               if (!loops) return std::nullopt;
               fill_flat(result, loops->flat, context);
               for (const Loop& loop : loops->bent) {
                   result.closure.void_faces.push_back(add_void_face(
                       volume, fill(volume, {loop}, nullptr, {"the missing wall"}, context), Role::wall));
               }
               return std::move(result);
           })
        .value_or(std::nullopt);
}

/// Whether a filling is sealed and does not cross itself.
bool prove(FlatFilling& filling, const RunContext& context)
{
    OpenVolume& volume = filling.volume;
    volume.model = with_loops(std::move(volume.model), context);
    for (std::size_t e = 0; e < volume.model.edges.size(); ++e)
        if (volume.model.uses_of_edge(EdgeId(e)).size() > 2) return false; // no skin, and not to be oriented
    orient_faces(volume.model, context);
    filling.closure.watertight = is_watertight(volume) && !first_crossing(volume, context);
    return filling.closure.watertight;
}

/// Make the new faces that are inclined to the source by at most 90° less `kCreaseAngle` the target; if there
/// are none, the least inclined ones. The other new faces stay walls.
void part_end_from_walls(FlatFilling& filling, const std::vector<FaceId>& source)
{
    const Model& model = filling.volume.model;
    const Vec3 way = -area_vector_of(model, source).stableNormalized();
    const auto facing = [&](FaceId face) {
        return face_area_vector(model, face).stableNormalized().dot(way);
    };
    double most = -1;
    for (const FaceId face : filling.closure.void_faces) most = std::max(most, facing(face));
    // Chamfers and roof slopes are less inclined; steeper new faces, such as the risers of steps, are walls.
    const double enough = std::min(most - kFileAccuracy, std::sin(kCreaseAngle * kDegree));
    for (const FaceId face : filling.closure.void_faces)
        if (facing(face) >= enough) filling.volume.role[face.index()] = Role::target;
}

/// Whether the source can be swept to the target: both have the same number of loops, or the target has
/// several connected parts (a stepped end).
bool can_be_swept_to(const OpenVolume& volume, const std::vector<FaceId>& source)
{
    const std::vector<FaceId> target = volume.faces(Role::target);
    return rims(volume.model, target).size() == rims(volume.model, source).size() ||
           connected_parts(volume.model, target).size() > 1;
}

} // namespace

bool is_flat(const Model& model, const Rim& rim)
{
    Vec3 mean = Vec3::Zero(), area = Vec3::Zero();
    const std::vector<Vec3> chain = use_places(model, rim.uses);
    const double length = geometry::length(chain);
    const std::span<const Vec3> points = std::span(chain).first(chain.size() - 1);
    for (const Vec3& p : points) mean += p / static_cast<double>(points.size());
    for (std::size_t i = 0; i < points.size(); ++i)
        area += (points[i] - mean).cross(points[(i + 1) % points.size()] - mean);
    const Vec3 normal = area.stableNormalized();
    return std::ranges::all_of(
        points, [&](const Vec3& p) { return std::abs((p - mean).dot(normal)) <= kFileAccuracy * length; });
}

bool has_flat_loops(const Model& model, FaceId face)
{
    return std::ranges::all_of(model[face].loops,
                               [&](const Loop& loop) { return is_flat(model, {loop.uses}); });
}

std::vector<FlatRegion> flat_regions(const Model& model, const std::vector<Loop>& loops)
{
    std::vector<FlatRegion> planes; // the loops of each plane
    for (std::size_t i = 0; i < loops.size(); ++i) {
        if (!is_flat(model, {loops[i].uses})) continue;
        const std::vector<Vec3> points = loop_places(model, loops[i].uses);
        const auto own = std::ranges::find_if(planes, [&](const FlatRegion& other) {
            return std::ranges::all_of(points, [&](const Vec3& p) {
                return std::abs(geometry::height(other.plane, p)) <= model.tolerance;
            });
        });
        if (own != planes.end())
            own->loops.push_back(i);
        else
            planes.push_back({geometry::newell_plane({&points, 1}), {i}});
    }
    std::vector<FlatRegion> regions;
    for (const FlatRegion& one : planes) {
        std::vector<std::vector<Vec2>> flat;
        for (const std::size_t loop : one.loops)
            flat.push_back(flat_places(one.plane, loop_places(model, loops[loop].uses)));
        for (const std::vector<std::size_t>& region : regions_of(flat)) {
            FlatRegion& added = regions.emplace_back(one.plane);
            for (const std::size_t loop : region) added.loops.push_back(one.loops[loop]);
        }
    }
    return regions;
}

std::optional<FlatFilling> fill_free_loops(const Model& model, const std::vector<FaceId>& faces,
                                           Missing missing, const RunContext& context)
{
    auto filled = fill_loops(model, faces, missing, context);
    if (!filled || !prove(*filled, context)) return std::nullopt;
    note_closed_holes(model, faces, filled->volume, RolesBy::finding, filled->closure);
    note_open_rims(filled->volume, RolesBy::finding, filled->closure);
    return filled;
}

std::optional<FlatFilling> fill_missing_end(const OpenVolume& volume, const RunContext& context)
{
    if (std::ranges::any_of(free_loops(volume), [&](const Rim& rim) {
            return lies_on_quadric(volume.model, {rim.uses}, is_round);
        }))
        return std::nullopt;
    auto filled = fill_loops(volume.model, all_faces(volume.model), Missing::flat, context);
    if (!filled || filled->each_alone || !prove(*filled, context)) return std::nullopt;
    const std::vector<FaceId> source = volume.faces(Role::source);
    std::ranges::copy(volume.role, filled->volume.role.begin());
    part_end_from_walls(*filled, source);
    if (!can_be_swept_to(filled->volume, source)) return std::nullopt;
    return filled;
}

} // namespace lacuna::closure
