// SPDX-License-Identifier: MIT
#include <lacuna/topology/open_volume.h>

#include <lacuna/core/error.h>
#include <lacuna/topology/shared/gaps.h>
#include <lacuna/topology/shared/hollows.h>
#include <lacuna/topology/shared/names_of.h>
#include <lacuna/topology/shared/use_places.h>

#include <algorithm>
#include <array>
#include <optional>
#include <set>
#include <utility>

namespace lacuna::topology {

namespace {

constexpr std::array<std::string_view, 7> kClassNames{"closed", "I", "II", "III", "IV", "V", "0"};
constexpr std::array<std::string_view, 3> kRoleNames{"source", "target", "wall"};

std::string_view word(Role role) { return kRoleNames[static_cast<std::size_t>(role)]; }

std::vector<VertexId> wall_free(const OpenVolume& volume, Role end)
{
    const Model& model = volume.model;
    const std::vector<bool> on_wall = volume.on_wall();
    std::vector<VertexId> result;
    std::set<VertexId> seen;
    for (const Rim& rim : rims(model, volume.faces(end))) {
        for (const EdgeUse& use : rim.uses) {
            const VertexId v = use_from(model, use);
            if (!on_wall[v.index()] && seen.insert(v).second) result.push_back(v);
        }
    }
    return result;
}

std::string count(std::size_t n, std::string_view one)
{
    return formatted("{} {}{}", n, one, n == 1 ? "" : "s");
}

/// The narrowest gap between connected walls and other faces; `Gap::own` is an edge of the walls. Empty if no
/// gap is narrow enough to be sewn.
std::optional<Gap> gap_beside(const Model& model, const std::vector<FaceId>& part)
{
    const std::set<FaceId> own(part.begin(), part.end());
    const auto is_own = [&](EdgeId edge) { return own.contains(model.uses_of_edge(edge).front().face); };
    const std::vector<Gap> all = gaps(model);
    const auto found = std::find_if(all.begin(), all.end(),
                                    [&](const Gap& gap) { return is_own(gap.own) != is_own(gap.other); });
    if (found == all.end()) return std::nullopt;
    Gap gap = *found;
    if (!is_own(gap.own)) std::swap(gap.own, gap.other);
    return gap;
}

/// Refuse walls that are not connected to an end: they are a mistake in the recipe.
void check_walls_touch(const OpenVolume& volume)
{
    const Model& model = volume.model;
    const auto is_wall = [&](FaceId face) { return volume.role[face.index()] == Role::wall; };
    if (std::ranges::all_of(all_faces(model), is_wall)) return;
    for (const std::vector<FaceId>& part : connected_parts(model, all_faces(model))) {
        if (!std::ranges::all_of(part, is_wall)) continue;
        const NamedEntity wall = entity_of(model, part.front());
        const std::optional<Gap> gap = gap_beside(model, part);
        if (!gap)
            throw InvalidInput(Message("topology.wall_apart",
                                       "{} is named as a wall but touches neither source nor target", wall)
                                   .remedy("check its tag, or name the walls between it and an end, too"));
        throw InvalidInput(
            Message("topology.wall_apart",
                    "{} is named as a wall but touches neither source nor target: its {} runs next to {}, at "
                    "most {:.3g} away, and the tolerance is {:.3g}",
                    wall, entity_of(model, gap->own), entity_of(model, gap->other), gap->width,
                    found(model.tolerance))
                .remedy("lacuna.load(…, {{ tolerance = {0:.3g} }}) or lacuna.model{{ tolerance = {0:.3g} }} "
                        "joins them",
                        needed(sewing_tolerance(model, *gap))));
    }
}

/// The walls that have a vertex, but not the given edge.
std::vector<FaceId> walls_at(const OpenVolume& volume, VertexId vertex, EdgeId edge)
{
    std::vector<FaceId> walls;
    for (const FaceId wall : volume.faces(Role::wall)) {
        bool meets = false, along = false;
        for (const EdgeUse& use : uses_of(volume.model[wall])) {
            meets = meets || use_from(volume.model, use) == vertex;
            along = along || use.edge == edge;
        }
        if (meets && !along) walls.push_back(wall);
    }
    return walls;
}

bool share_a_vertex(const Model& model, const std::vector<FaceId>& some, const std::vector<FaceId>& others)
{
    std::set<VertexId> vertices;
    for (const FaceId face : some)
        for (const EdgeUse& use : uses_of(model[face])) vertices.insert(use_from(model, use));
    return std::ranges::any_of(others, [&](FaceId face) {
        return std::ranges::any_of(uses_of(model[face]), [&](const EdgeUse& use) {
            return vertices.contains(use_from(model, use));
        });
    });
}

/// Refuse ends that share an edge, where layers would have no height. Example: two sides of a pie slice,
/// which share its axis. The slice can be swept along the axis instead.
void check_no_shared_edge(const OpenVolume& volume)
{
    const Model& model = volume.model;
    std::vector<FaceId> owner(model.edges.size());
    for (const FaceId face : volume.faces(Role::source))
        for (const EdgeUse& use : uses_of(model[face])) owner[use.edge.index()] = face;
    for (const FaceId face : volume.faces(Role::target)) {
        for (const EdgeUse& use : uses_of(model[face])) {
            if (!owner[use.edge.index()].valid()) continue;
            const std::vector<FaceId> from = walls_at(volume, model[use.edge].from, use.edge),
                                      to = walls_at(volume, model[use.edge].to, use.edge);
            Message message("topology.ends_share_edge",
                            "source {} and target {} share {}, where layers would have no height",
                            entity_of(model, owner[use.edge.index()]), entity_of(model, face),
                            entity_of(model, use.edge));
            if (from.empty() || to.empty() || from == to)
                throw InvalidInput(std::move(message).remedy(
                    "sweep along that edge: the faces at its two ends are source and target (they may be "
                    "missing), and these two are walls"));
            if (share_a_vertex(model, from, to)) // a slice of a cone, whose tip is the end of its axis
                throw InvalidInput(std::move(message).remedy(
                    "name no roles, and sweep with fallback = \"mixed\", which fills it with tetrahedra"));
            throw InvalidInput(std::move(message).remedy(
                "sweep along that edge, with {} as source and {} as target and these two as walls",
                entities_of(model, from), entities_of(model, to)));
        }
    }
}

/// Source and target must be apart: layers have no height at a common vertex or edge.
void check_ends_apart(const OpenVolume& volume)
{
    check_no_shared_edge(volume);
    const Model& model = volume.model;
    std::vector<FaceId> owner(model.vertices.size());
    for (const FaceId face : volume.faces(Role::source))
        for (const EdgeUse& use : uses_of(model[face])) owner[use_from(model, use).index()] = face;
    for (const FaceId face : volume.faces(Role::target)) {
        for (const EdgeUse& use : uses_of(model[face])) {
            const VertexId vertex = use_from(model, use);
            if (!owner[vertex.index()].valid()) continue;
            throw InvalidInput(
                Message("topology.ends_touch",
                        "source {} and target {} meet in {}; the ends of a sweep must not touch",
                        entity_of(model, owner[vertex.index()]), entity_of(model, face),
                        entity_of(model, vertex))
                    .remedy("choose other faces"));
        }
    }
}

void check_override(const OpenVolume& volume, const Classification& found)
{
    if (!volume.override_class || *volume.override_class == found.value) return;
    const VolumeClass asked = *volume.override_class;
    const bool source = !volume.faces(Role::source).empty();
    const bool target = !volume.faces(Role::target).empty();
    const bool walls = !volume.faces(Role::wall).empty();
    const auto message = [&]<class... Arguments>(Format<sizeof...(Arguments)> format,
                                                 const Arguments&... arguments) {
        return Message("topology.class_contradicted", format, arguments...)
            .about(formatted("the volume cannot be of class {} (found: class {})", to_string(asked),
                             to_string(found.value)));
    };
    const auto refuse = [&]<class... Arguments>(Format<sizeof...(Arguments)> format,
                                                const Arguments&... arguments) {
        throw InvalidInput(message(format, arguments...));
    };
    switch (asked) {
    case VolumeClass::closed:
        refuse("it must have no free loops, but has {}", count(found.free_loops.size(), "free loop"));
        break;
    case VolumeClass::I:
    case VolumeClass::II:
    case VolumeClass::III:
        if (!source || !target)
            refuse("it needs a source and a target, but has no {}", source ? "target" : "source");
        if (asked == VolumeClass::I && walls)
            throw InvalidInput(message("it must have no walls, but {} are given",
                                       count(volume.faces(Role::wall).size(), "wall"))
                                   .remedy("leave them out"));
        if (asked != VolumeClass::I && !walls) refuse("it needs at least one wall, but none is given");
        if (asked == VolumeClass::II && found.wall_free_source.empty())
            refuse("every vertex of the source is on a wall");
        if (asked == VolumeClass::II && found.wall_free_target.empty())
            refuse("every vertex of the target is on a wall");
        if (asked == VolumeClass::III &&
            (!found.wall_free_source.empty() || !found.wall_free_target.empty())) {
            std::vector<VertexId> bare = found.wall_free_source;
            bare.insert(bare.end(), found.wall_free_target.begin(), found.wall_free_target.end());
            refuse("some vertices are on no wall: {}", entities_of(volume.model, bare));
        }
        break;
    case VolumeClass::IV:
        if (!source) refuse("it needs a source, but none is given");
        if (target)
            throw InvalidInput(
                message("its target must be missing, but one is given").remedy("leave it out"));
        if (!walls) refuse("it needs all walls, but none is given");
        break;
    case VolumeClass::V:
        if (source || target)
            throw InvalidInput(
                message("it must have walls only, but a {} is given", source ? "source" : "target")
                    .remedy("leave it out"));
        break;
    case VolumeClass::zero:
        refuse("it needs a path: open_volume{{ along = … }}");
        break;
    }
}

} // namespace

std::string_view to_string(VolumeClass value) { return kClassNames[static_cast<std::size_t>(value)]; }

Model extract(const Model& model, const std::vector<FaceId>& faces)
{
    ModelBuilder part;
    part.diagonal = model.diagonal;
    part.tolerance = model.tolerance;
    part.source = model.source;
    std::vector<Index> point(model.points.size(), -1);
    std::vector<VertexId> vertex(model.vertices.size());
    std::vector<EdgeId> edge(model.edges.size());
    const auto keep_point = [&](Index& p) {
        Index& kept = point[static_cast<std::size_t>(p)];
        if (kept < 0) {
            kept = static_cast<Index>(part.points.size());
            part.points.push_back(model.at(p));
        }
        p = kept;
    };
    const auto keep_vertex = [&](VertexId& v) {
        VertexId& kept = vertex[v.index()];
        if (!kept.valid()) {
            kept = VertexId(part.vertices.size());
            part.vertices.push_back(model[v]);
            keep_point(part.vertices.back().point);
        }
        v = kept;
    };
    const auto keep_edge = [&](EdgeId& e) {
        EdgeId& kept = edge[e.index()];
        if (!kept.valid()) {
            kept = EdgeId(part.edges.size());
            part.edges.push_back(model[e]);
            Edge& copy = part.edges.back();
            keep_vertex(copy.from);
            keep_vertex(copy.to);
            std::ranges::for_each(copy.points, keep_point);
        }
        e = kept;
    };
    for (const FaceId f : faces) {
        part.faces.push_back(model[f]);
        Face& copy = part.faces.back();
        for (Loop& loop : copy.loops)
            for (EdgeUse& use : loop.uses) keep_edge(use.edge);
        for (Triangle& t : copy.triangles) std::ranges::for_each(t, keep_point);
        for (Quad& q : copy.given_quads) std::ranges::for_each(q, keep_point);
    }
    return std::move(part).finish();
}

std::vector<FaceId> OpenVolume::faces(Role wanted) const
{
    std::vector<FaceId> result;
    for (std::size_t f = 0; f < role.size(); ++f) {
        if (role[f] == wanted) result.emplace_back(f);
    }
    return result;
}

std::vector<bool> OpenVolume::on_wall() const
{
    std::vector<bool> result(model.vertices.size(), false);
    for (const FaceId wall : faces(Role::wall))
        for (const EdgeUse& use : uses_of(model[wall])) result[use_from(model, use).index()] = true;
    return result;
}

OpenVolume open_volume(const Model& model, const Roles& roles, const RunContext& context)
{
    std::vector<FaceId> faces;
    OpenVolume volume;
    std::vector<std::optional<Role>> given(model.faces.size());
    const auto take = [&](const std::vector<FaceId>& list, Role role) {
        for (const FaceId face : list) {
            std::optional<Role>& now = given[face.index()];
            if (now == role)
                throw InvalidInput(Message("topology.face_twice", "{} is named twice as {}",
                                           entity_of(model, face), word(role))
                                       .remedy("name it once"));
            if (now) {
                throw InvalidInput("topology.face_in_two_roles",
                                   "{} is named as {} and as {}; a face has one role", entity_of(model, face),
                                   word(*now), word(role));
            }
            now = role;
            faces.push_back(face);
            volume.role.push_back(role);
        }
    };
    take(roles.source, Role::source);
    take(roles.target, Role::target);
    take(roles.walls, Role::wall);
    if (faces.empty()) {
        throw InvalidInput(Message("topology.no_faces", "the volume has no faces")
                               .remedy("name a source, a target or walls"));
    }
    check_cancelled(context);
    volume.model = extract(model, faces);
    check_cancelled(context);
    orient_faces(volume.model, context);
    check_cancelled(context);
    check_walls_touch(volume);
    check_ends_apart(volume);
    if (roles.source.empty() && !roles.target.empty()) {
        // Class IV with a target only: it is swept as if it were the source. The names of the ends are
        // exchanged again when the mesh is made.
        for (Role& role : volume.role) role = role == Role::target ? Role::source : role;
        volume.turned_round = true;
    }
    return volume;
}

Classification classify(const OpenVolume& volume)
{
    Classification found;
    const std::size_t sources = volume.faces(Role::source).size();
    const std::size_t targets = volume.faces(Role::target).size();
    const std::size_t walls = volume.faces(Role::wall).size();
    found.free_loops = free_loops(volume);
    found.wall_free_source = wall_free(volume, Role::source);
    found.wall_free_target = wall_free(volume, Role::target);
    auto& why = found.reasons;
    why.push_back(formatted("{}, {}, {} given", count(sources, "source face"), count(targets, "target face"),
                            count(walls, "wall")));
    if (volume.turned_round)
        why.push_back(
            "the target is given and the source is missing: class IV reversed, swept from the target");
    if (found.free_loops.empty()) {
        found.value = VolumeClass::closed;
        why.push_back("every edge is used twice: nothing is missing");
    } else {
        why.push_back(formatted("{} in {}", count(free_edges(volume).size(), "free edge"),
                                count(found.free_loops.size(), "free loop")));
        if (sources > 0 && targets > 0 && walls == 0) {
            found.value = VolumeClass::I;
            why.push_back("source and target and no wall between them");
        } else if (sources > 0 && targets > 0) {
            const bool both = !found.wall_free_source.empty() && !found.wall_free_target.empty();
            found.value = both ? VolumeClass::II : VolumeClass::III;
            const auto on_no_wall = [&](std::string_view end, const std::vector<VertexId>& list) {
                const Argument vertices = list.empty() ? Argument("none")
                                                       : Argument(entities_of(volume.model, list));
                why.push_back(formatted("vertices of the {} on no wall: {}", end, vertices));
            };
            on_no_wall("source", found.wall_free_source);
            on_no_wall("target", found.wall_free_target);
        } else if (sources > 0) {
            found.value = VolumeClass::IV;
            why.push_back("a source and walls, and no target");
        } else {
            found.value = VolumeClass::V;
            why.push_back("walls alone: source and target are missing");
        }
    }
    check_override(volume, found);
    if (volume.override_class && *volume.override_class != found.value) {
        why.push_back(formatted("class {} by override, instead of {}", to_string(*volume.override_class),
                                to_string(found.value)));
        found.value = *volume.override_class;
    }
    return found;
}

NamedEntity entity_of(const Model& model, FaceId face)
{
    const Face& f = model[face];
    return {f.origin == Origin::made_void ? "void face" : "face", f.tag, f.name};
}

NamedEntity entity_of(const Model& model, EdgeId edge)
{
    const Edge& e = model[edge];
    return {.kind = e.origin == Origin::made_void ? "void edge" : "edge",
            .tag = e.tag,
            .ends = std::pair<long long, long long>(model[e.from].tag, model[e.to].tag)};
}

NamedEntity entity_of(const Model& model, VertexId vertex) { return {"vertex", model[vertex].tag}; }

std::string name_of(const Model& model, FaceId face) { return formatted("{}", entity_of(model, face)); }
std::string name_of(const Model& model, EdgeId edge) { return formatted("{}", entity_of(model, edge)); }
std::string name_of(const Model& model, VertexId vertex) { return formatted("{}", entity_of(model, vertex)); }

} // namespace lacuna::topology
