// SPDX-License-Identifier: MIT
#include <lacuna/closure/detail/close_class.h>

#include <lacuna/closure/detail/class_five.h>
#include <lacuna/closure/detail/flat_fill.h>
#include <lacuna/closure/detail/void_edges.h>
#include <lacuna/closure/detail/void_entities.h>
#include <lacuna/closure/detail/void_faces.h>
#include <lacuna/closure/shared/piece_ends.h>
#include <lacuna/core/error.h>
#include <lacuna/geometry/newell.h>
#include <lacuna/topology/shared/face_parts.h>
#include <lacuna/topology/shared/facet_area.h>
#include <lacuna/topology/shared/gaps.h>
#include <lacuna/topology/shared/hollows.h>
#include <lacuna/topology/shared/use_places.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <optional>
#include <ranges>
#include <set>
#include <utility>

namespace lacuna::closure {

using namespace topology;

namespace {

void note(Closure& closure, const std::string& algorithm)
{
    auto& list = closure.algorithms;
    if (std::ranges::find(list, algorithm) == list.end()) list.push_back(algorithm);
}

/// A missing target with the shape of the source, moved to the walls' free rim by an affine map. The map is
/// fitted to the sections of the walls (`Follower`).
VoidFilling parallel_cap(const OpenVolume& volume, const std::vector<Loop>& loops, const Subject& face,
                         const RunContext& context)
{
    const Model& model = volume.model;
    OpenVolume capped = volume; // the walls define a motion only between two ends
    add_void_face(capped, fill(volume, loops, nullptr, face, context), Role::target);
    const Follower follower(capped, matching::side_lines(capped, context), context);
    if (!follower.leads()) {
        throw NotClosed(Message("closure.nothing_parallel",
                                "{}{} cannot be parallel to the given end: the walls do not determine the "
                                "motion that takes the given end to their other rim",
                                face.words, face.entity)
                            .remedy("use cap = \"flat\""));
    }
    std::vector<Vec3> points;
    for (const Vec3& p : model.points) points.push_back(follower.carried(p));
    const std::vector<Triangle> triangles = facets_of(model, volume.faces(Role::source));
    double sides = 0;
    for (const Triangle& t : triangles)
        for (std::size_t i = 0; i < 3; ++i)
            sides += (points[index(t[(i + 1) % 3])] - points[index(t[i])]).norm();
    return fill_as(volume, loops, geometry::FacetTree(points, triangles),
                   sides / static_cast<double>(3 * triangles.size()), face, context);
}

/// Add void faces of one role, each within its loops.
void add_faces(OpenVolume& volume, Closure& closure, const std::vector<std::vector<Loop>>& faces, Role role,
               const Tools& tools)
{
    std::vector<VoidFilling> fillings;
    for (const std::vector<Loop>& loops : faces) {
        const std::size_t before = closure.void_faces.size() + fillings.size();
        const Subject face{"", {{"void face", static_cast<long long>(before) + 1}}};
        fillings.push_back(role == Role::target && tools.way.cap == Cap::parallel
                               ? parallel_cap(volume, loops, face, tools.context)
                               : fill(volume, loops, tools.bending(), face, tools.context));
        note(closure, fillings.back().algorithm);
    }
    const std::vector<FaceId> made = add_void_faces(volume, std::move(fillings), role);
    closure.void_faces.insert(closure.void_faces.end(), made.begin(), made.end());
}

/// Flip the target and the walls that touch only the target, if the match traverses the target's loops
/// against their direction. Without walls between the ends, only the match determines their orientation to
/// each other.
void turn_target_to_source(OpenVolume& volume, const matching::Match& match)
{
    if (match.loops.empty() || !match.loops.front().flipped) return;
    for (const std::vector<FaceId>& part : connected_parts(volume.model, all_faces(volume.model))) {
        const auto holds = [&](Role role) {
            return std::ranges::any_of(part, [&](FaceId face) { return volume.role[face.index()] == role; });
        };
        if (holds(Role::target) && !holds(Role::source)) flip_faces(volume.model, part);
    }
}

/// Add a void wall for each free loop: eq. (2) of the paper, V = ∪(Fs, Ft) + ∪ Fi + ∪ Fvi (source, target,
/// given walls, void walls). Departure: a flat loop that lies within another loop of the same plane, such as
/// the mouth of a bore, becomes a hole of the outer loop's wall.
void add_void_walls(OpenVolume& volume, const Tools& tools, Closure& closure)
{
    const std::vector<Loop> loops = void_loops(volume, closure.void_edges);
    std::vector<std::vector<Loop>> walls;
    for (const Loop& loop : loops) walls.push_back({loop});
    for (const FlatRegion& region : flat_regions(volume.model, loops))
        for (const std::size_t hole : region.loops | std::views::drop(1))
            std::ranges::move(std::exchange(walls[hole], {}),
                              std::back_inserter(walls[region.loops.front()]));
    std::erase_if(walls, [](const std::vector<Loop>& wall) { return wall.empty(); });
    add_faces(volume, closure, walls, Role::wall, tools);
    note(closure, "Algorithm 3");
}

/// @throw NotClosed  a loop of the source has neither a wall nor a matched vertex, so nothing would connect
///         it to the target.
void check_matched(const OpenVolume& volume, const matching::Match& match)
{
    for (std::size_t l = 0; l < match.source_loops.size(); ++l) {
        const std::vector<EdgeUse>& rim = match.source_loops[l].uses;
        const bool bare = std::ranges::all_of(
            rim, [&](const EdgeUse& use) { return volume.model.uses_of_edge(use.edge).size() == 1; });
        const bool matched = std::ranges::any_of(rim, [&](const EdgeUse& use) {
            return std::ranges::any_of(
                match.vertices, [&](const auto& pair) { return pair.first == use_from(volume.model, use); });
        });
        if (!bare || matched) continue;
        throw NotClosed(Message("closure.unmatched_loop",
                                "{}, which contains {}, has no wall and no vertex matched to the target",
                                NamedEntity{"source loop", static_cast<long long>(l) + 1},
                                entity_of(volume.model, rim.front().edge))
                            .remedy("pair some by hand with match{{ vertices = … }}"));
    }
}

/// Close classes I to III. The paper has no algorithm for class I; it is closed as class II without given
/// walls. In class III every vertex is on a wall. Void edges are added only where a wall does not reach the
/// other end.
void close_between_ends(OpenVolume& volume, matching::Match match, const Tools& tools, Closure& closure)
{
    if (closure.value == VolumeClass::II) note(closure, "Algorithm 8");
    if (closure.value == VolumeClass::III) note(closure, "Algorithm 9");
    turn_target_to_source(volume, match);
    if (closure.value != VolumeClass::III) {
        matching::Matched split = matching::apply_splits(std::move(volume), std::move(match));
        volume = std::move(split.volume);
        match = std::move(split.match);
        check_matched(volume, match);
    }
    const bool smooth = tools.way.edges == EdgeShape::smooth;
    closure.void_edges = make_void_edges(volume, match, tools.by_hand,
                                         {tools.bending(), smooth, smooth ? tools.follower : nullptr},
                                         tools.context);
    if (!closure.void_edges.empty() || closure.value != VolumeClass::III) note(closure, "Algorithm 2");
    add_void_walls(volume, tools, closure);
}

/// Whether a rim is a hole in walls: the facets of the walls at the rim lie about in the rim's plane. At the
/// free rim of a tube they are about perpendicular to it.
bool is_hole_of_walls(const OpenVolume& volume, const Rim& rim)
{
    const double kBetween = std::numbers::sqrt2 / 2; // 45°, halfway between walls in the plane and walls
                                                     // square to it
    const Model& model = volume.model;
    const std::vector<Index> around = loop_points(model, rim.uses);
    const std::set<Index> on_rim(around.begin(), around.end());
    const Vec3 normal = geometry::newell_vector(loop_places(model, rim.uses)).stableNormalized();
    double beside = 0, all = 0;
    for (const FaceId wall : volume.faces(Role::wall)) {
        for (const Triangle& t : model[wall].triangles) {
            if (std::ranges::count_if(t, [&](Index p) { return on_rim.contains(p); }) != 2) continue;
            const Vec3 area = facet_area_vector(model, t);
            beside += std::abs(area.dot(normal));
            all += area.norm();
        }
    }
    return beside > kBetween * all;
}

/// The vector from the source up a side of its walls; empty: no edge of a wall leads away from the source.
std::optional<Vec3> up_a_wall(const OpenVolume& volume)
{
    const Model& model = volume.model;
    std::set<VertexId> on_source;
    for (const FaceId face : volume.faces(Role::source))
        for (const EdgeUse& use : uses_of(model[face])) on_source.insert(use_from(model, use));
    for (const FaceId wall : volume.faces(Role::wall)) {
        for (const EdgeUse& use : uses_of(model[wall])) {
            if (!on_source.contains(use_from(model, use)) || on_source.contains(use_to(model, use))) continue;
            const std::vector<Index> side = use_points(model, use);
            return model.at(side.back()) - model.at(side.front());
        }
    }
    return std::nullopt;
}

/// Refuse an edge of the source that has no wall. If only a narrow gap separates a wall from the edge, the
/// remedy names the tolerance that closes the gap.
[[noreturn]] void refuse_bare_edge(const OpenVolume& volume, EdgeId edge, const RunContext& context)
{
    const Model& model = volume.model;
    for (const topology::Gap& gap : gaps(model, context)) {
        if (gap.own != edge && gap.other != edge) continue;
        throw NotClosed(Message("closure.wall_missing",
                                "{} of the source has no wall: {} is {:.3g} away from it",
                                entity_of(model, edge),
                                entity_of(model, gap.own == edge ? gap.other : gap.own), found(gap.width))
                            .remedy("lacuna.load(…, {{ tolerance = {0:.3g} }}) or lacuna.model{{ tolerance = "
                                    "{0:.3g} }} joins them",
                                    needed(sewing_tolerance(model, gap))));
    }
    const std::optional<Vec3> way = up_a_wall(volume);
    throw NotClosed(
        Message("closure.wall_missing",
                "{} of the source has no wall, and the tops of the given walls do not determine the "
                "missing target there",
                entity_of(model, edge))
            .remedy("name the wall or the target, or let open_volume{{ …, along = {{ vector = {{{}}} }} }} "
                    "make both",
                    way ? formatted("{:.9g}, {:.9g}, {:.9g}", way->x(), way->y(), way->z()) : "x, y, z"));
}

/// Whether some loops are flat and their planes are inclined to each other by more than 70°, such as the rims
/// of nozzles on several sides of a vessel. No single face joins them.
bool look_apart(const Model& model, const std::vector<Loop>& loops)
{
    std::vector<Vec3> normals;
    for (const Loop& loop : loops) {
        if (!is_flat(model, {loop.uses})) return false;
        normals.push_back(geometry::newell_vector(loop_places(model, loop.uses)).stableNormalized());
    }
    return std::ranges::any_of(normals, [&](const Vec3& a) {
        return std::ranges::any_of(normals, [&](const Vec3& b) { return std::abs(a.dot(b)) < kFacesEnd; });
    });
}

/// Close class IV by eq. (3) and (4) of the paper: the free loops of source and walls bound the target.
/// Departures: holes in walls are closed by void walls; flat loops that look apart get a face each.
void close_class_four(OpenVolume& volume, const Tools& tools, Closure& closure)
{
    note(closure, "Algorithm 10");
    const Model& model = volume.model;
    std::vector<Loop> loops;
    std::vector<std::vector<Loop>> holes;
    const std::size_t wanted = rims(model, volume.faces(Role::source)).size();
    const std::vector<Rim> open = free_loops(volume);
    for (const Rim& rim : open) {
        for (const EdgeUse& use : rim.uses) {
            if (volume.role[model.uses_of_edge(use.edge).front().face.index()] != Role::source) continue;
            refuse_bare_edge(volume, use.edge, tools.context);
        }
        if (open.size() > wanted && is_hole_of_walls(volume, rim))
            holes.push_back({reversed(rim)});
        else
            loops.push_back(reversed(rim));
    }
    add_faces(volume, closure, holes, Role::wall, tools);
    if (loops.size() != wanted) {
        throw NotClosed(Message("closure.loop_counts",
                                "both ends need the same number of loops, but the number is {} for the "
                                "source, and the walls leave {} for the target",
                                needed(wanted), found(loops.size()))
                            .remedy("check the walls, or name the target"));
    }
    if (tools.way.planes) {
        if (auto filled = fill_missing_end(volume, tools.context)) {
            volume.model = std::move(filled->volume.model);
            volume.role = std::move(filled->volume.role);
            closure.void_edges = std::move(filled->closure.void_edges);
            std::ranges::copy(filled->closure.void_faces, std::back_inserter(closure.void_faces));
            note(closure, "Algorithm 4");
            return;
        }
    }
    std::vector<std::vector<Loop>> targets{loops};
    if (look_apart(model, loops)) {
        targets.clear();
        for (const Loop& loop : loops) targets.push_back({loop});
    }
    add_faces(volume, closure, targets, Role::target, tools);
}

/// Close class V by eq. (5) to (8) of the paper: the free loops, sorted into two sets, bound source and
/// target. Departure: a flat wall that surrounds a loop (a floor) becomes part of the loop's end, because as
/// a wall it would get cells of zero thickness.
void close_class_five(OpenVolume& volume, const Tools& tools, Closure& closure)
{
    note(closure, "Algorithm 11");
    const EndLoops ends = group_loops(volume);
    for (const Role role : {Role::source, Role::target}) {
        const std::vector<Loop>& end = role == Role::source ? ends.source : ends.target;
        const std::vector<FaceId> floors = floors_round(volume, end);
        add_faces(volume, closure, {end}, role, tools);
        for (const FaceId floor : floors) {
            volume.role[floor.index()] = role;
            closure.notes.push_back(
                {"closure.floor_in_end", "{} lies in the plane of the {} and becomes part of it",
                 entity_of(volume.model, floor), role == Role::source ? "source" : "target"});
        }
    }
}

} // namespace

Closure close_as(OpenVolume& volume, const matching::Match& match, VolumeClass value, const Tools& tools)
{
    Closure closure;
    closure.value = value;
    switch (value) {
    case VolumeClass::closed:
    case VolumeClass::zero: // sealed by close_along()
        break;
    case VolumeClass::I:
    case VolumeClass::II:
    case VolumeClass::III:
        close_between_ends(volume, match, tools, closure);
        break;
    case VolumeClass::IV:
        close_class_four(volume, tools, closure);
        break;
    case VolumeClass::V:
        close_class_five(volume, tools, closure);
        break;
    }
    orient_skin(volume.model, tools.context);
    return closure;
}

} // namespace lacuna::closure
