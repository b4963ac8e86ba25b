// SPDX-License-Identifier: MIT
#include <lacuna/fill/volume.h>

#include <lacuna/closure/shared/along.h>
#include <lacuna/closure/shared/cavities.h>
#include <lacuna/closure/shared/trim.h>
#include <lacuna/closure/shared/walls_alone.h>
#include <lacuna/core/error.h>
#include <lacuna/core/shared/list_text.h>
#include <lacuna/core/shared/progress.h>
#include <lacuna/fill/detail/crossing_faces.h>
#include <lacuna/fill/detail/edge_sets.h>
#include <lacuna/fill/detail/members.h>
#include <lacuna/fill/detail/touching_parts.h>
#include <lacuna/io/shared/deck_materials.h>
#include <lacuna/topology/shared/auto_walls.h>
#include <lacuna/topology/shared/bodies.h>
#include <lacuna/topology/shared/face_parts.h>
#include <lacuna/topology/shared/hollows.h>
#include <lacuna/topology/shared/left_out.h>
#include <lacuna/topology/shared/names_of.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>
#include <utility>

namespace lacuna::fill {

namespace {

using topology::Model;
using topology::Roles;

/// The faces that a request names; without any, all faces.
std::vector<FaceId> named_faces(const Model& model, const RoleRequest& request)
{
    return request.roles   ? topology::all_faces(*request.roles)
           : request.faces ? *request.faces
                           : topology::all_faces(model);
}

/// Find the walls from the rim of the one named end.
/// @return  reasons why the walls were chosen and why faces were left out.
std::vector<std::string> find_walls(const Model& model, Roles& roles, const RunContext& context)
{
    if (roles.source.empty() && roles.target.empty())
        throw InvalidInput(
            Message("lua.walls_without_ends",
                    "open_volume: walls = \"auto\" searches from the rim of an end, and none is named")
                .remedy("name the source or the target"));
    const topology::WallChoice found = topology::find_walls(model, roles.source, roles.target, context);
    roles.walls = found.walls;
    const bool by_target = roles.source.empty();
    std::vector<FaceId>& end = by_target ? roles.target : roles.source;
    std::vector<FaceId>& other = by_target ? roles.source : roles.target;
    end.insert(end.end(), found.more_of_end.begin(), found.more_of_end.end());
    other.insert(other.end(), found.more_of_other.begin(), found.more_of_other.end());
    std::vector<std::string> reasons;
    if (found.of_cavity)
        reasons.emplace_back("the given end lies in a cavity of a solid, whose other faces are the walls");
    for (std::size_t i = 0; i < found.left_out.size(); ++i) {
        reasons.push_back(formatted("{} is not a wall, because two faces of the volume already use {}",
                                    entity_of(model, found.left_out[i]), entity_of(model, found.taken[i])));
    }
    return reasons;
}

/// Find the roles of faces if the user named no roles, or only walls.
/// @return  empty if the named roles are to be used.
std::optional<closure::Reading> find_roles(const Model& model, const std::vector<FaceId>& faces,
                                           const RoleRequest& request, const RunContext& context)
{
    if (!request.roles) {
        topology::require_none_left_out(model, faces, "roles");
        return closure::find_reading(model, faces, request.reading, context);
    }
    const Roles& named = *request.roles;
    if (request.find_walls || !named.source.empty() || !named.target.empty() || named.walls.empty() ||
        request.override_class)
        return std::nullopt;
    auto found = closure::read_walls_alone(model, named.walls, request.reading == 1, context);
    if (found) topology::require_none_left_out(model, named.walls, "roles");
    return found;
}

topology::OpenVolume open_full_turn(const Model& model, const std::vector<FaceId>& faces,
                                    const RoleRequest& request, const RunContext& context)
{
    if (!request.roles && !request.faces) topology::require_none_left_out(model, faces, "walls");
    topology::OpenVolume volume = topology::open_volume(
        model, request.roles ? *request.roles : Roles{{}, {}, faces}, context);
    volume.full_turn = true;
    return volume;
}

/// Log the node sets of decks that hold nodes of a source, if the mesh will not keep these nodes.
void note_node_sets(const Model& source, const RoleRequest& request, const char* why,
                    const RunContext& context)
{
    std::vector<std::string> sets;
    for (const auto& deck : request.decks) {
        std::set<io::DeckTag> on_source;
        for (const Index node : io::nodes_at(*deck, source.points, source.tolerance, request.scale).nodes)
            on_source.insert(deck->point_tags[index(node)]);
        for (const io::DeckSet& set : deck->sets)
            if (set.kind == io::DeckSet::Kind::nodes &&
                std::ranges::any_of(set.members, [&](io::DeckTag tag) { return on_source.contains(tag); }))
                sets.push_back(set.name);
    }
    if (!sets.empty())
        log_line(context, formatted("note: open_volume: {}, so that the mesh does not have the node sets {}; "
                                    "'with' of mesh:write keeps them",
                                    why, short_list(sets, std::identity())));
}

std::shared_ptr<const closure::SweptSource> open_along(const Model& model, const RoleRequest& request,
                                                       const RunContext& context)
{
    const bool source = request.roles && !request.roles->source.empty();
    if (!source || request.find_walls || !request.roles->target.empty() || request.full_turn ||
        request.reading > 0 ||
        request.override_class.value_or(topology::VolumeClass::zero) != topology::VolumeClass::zero)
        throw InvalidInput(Message("closure.along_roles",
                                   "open_volume: 'along' sweeps a source alone, and makes the target and "
                                   "walls that are not given")
                               .remedy("name the source, given walls, and no other role, class or reading"));
    const topology::OpenVolume open = topology::open_volume(model, {request.roles->source, {}, {}}, context);
    auto swept = std::make_shared<closure::SweptSource>(
        closure::swept_source(model, open, *request.along, context));
    swept->sets = edge_sets(swept->source.model, request.decks, request.scale);
    const auto* const normals = std::get_if<closure::Along::Normals>(&request.along->course);
    if (normals != nullptr && normals->inside)
        note_node_sets(open.model, request, "the source is moved", context);
    else if (swept->on_axis)
        note_node_sets(open.model, request, "the source has edges on the axis", context);
    if (request.roles->walls.empty()) return swept;
    if (swept->full_turn || swept->on_axis)
        throw InvalidInput(Message("closure.along_walls",
                                   "open_volume: given walls cannot be combined with a full turn, "
                                   "or with a source that has edges on its axis")
                               .remedy("leave out the walls"));
    swept->walls = topology::extract(model, request.roles->walls);
    return swept;
}

/// Call `change(faces)` for each list of faces that a request names.
template <class Change>
void each_list(RoleRequest& request, const Change& change)
{
    if (request.faces) change(*request.faces);
    if (request.roles)
        for (std::vector<FaceId>* role :
             {&request.roles->source, &request.roles->target, &request.roles->walls})
            change(*role);
}

/// The same request for a model whose touching parts were joined, with the faces renamed.
RoleRequest joined_request(RoleRequest request, const JoinedParts& joined)
{
    each_list(request, [&](std::vector<FaceId>& faces) {
        std::vector<FaceId> now;
        for (const FaceId face : faces)
            now.insert(now.end(), joined.faces_of[face.index()].begin(), joined.faces_of[face.index()].end());
        faces = std::move(now);
    });
    return request;
}

/// Leave out what contacts separate from the volume, such as the ends of a tube beyond the plates through
/// which it passes, or the part of a plate outside a frame that stands on it. The volume is what is connected
/// to a named end, if there is one, and to a face that no contact divides.
/// @param model  before the faces were divided
void leave_out_beyond_contacts(const Model& model, const JoinedParts& joined, RoleRequest& request,
                               const RunContext& context)
{
    std::vector<std::size_t> parent(joined.model.faces.size());
    for (std::size_t f = 0; f < joined.faces_of.size(); ++f)
        for (const FaceId part : joined.faces_of[f]) parent[part.index()] = f;
    std::set<FaceId> ends;
    if (request.roles) {
        ends.insert(request.roles->source.begin(), request.roles->source.end());
        ends.insert(request.roles->target.begin(), request.roles->target.end());
    }
    const auto is_end = [&](FaceId face) { return ends.contains(face); };
    const auto is_whole = [&](FaceId face) { return joined.faces_of[parent[face.index()]].size() == 1; };
    std::vector<std::vector<FaceId>> parts = topology::connected_parts(joined.model,
                                                                       named_faces(joined.model, request));
    std::set<std::size_t> stays;
    std::erase_if(parts, [&](const std::vector<FaceId>& part) {
        if (std::ranges::none_of(part, is_whole) || (!ends.empty() && std::ranges::none_of(part, is_end)))
            return false;
        for (const FaceId face : part) stays.insert(parent[face.index()]);
        return true;
    });
    std::set<FaceId> gone, whole;
    for (const std::vector<FaceId>& part : parts) {
        if (std::ranges::none_of(part, [&](FaceId f) { return stays.contains(parent[f.index()]); })) continue;
        gone.insert(part.begin(), part.end());
        for (const FaceId face : part) whole.emplace(parent[face.index()]);
    }
    each_list(request, [&](std::vector<FaceId>& faces) {
        std::erase_if(faces, [&](FaceId face) { return gone.contains(face); });
    });
    if (!whole.empty())
        log_line(context, formatted("note: left out beyond the faces in contact: {}",
                                    topology::entities_of(model, whole)));
}

[[noreturn]] void refuse_parts(std::size_t count)
{
    throw NotSweepable(Message("closure.fill_to",
                               "open_volume: the void behind the plane of 'fill_to' is {} separate parts",
                               found(count))
                           .remedy("open the whole void, and volume:cut{{ plane = … }} gives each part"));
}

/// Whether the plane only touches the volume from outside, along a face of it that may be missing.
bool is_brim(const Volume& volume, const geometry::Plane& plane)
{
    const Model& model = volume.volume.model;
    const auto height = [&](Index p) { return geometry::height(plane, model.at(p)); };
    const auto is_in = [&](Index p) { return std::abs(height(p)) <= model.tolerance; };
    const auto is_face_in = [&](FaceId face) {
        return std::ranges::all_of(topology::corners_of(model[face]), is_in);
    };
    const auto is_edge_in = [&](EdgeId edge) { return std::ranges::all_of(model[edge].points, is_in); };
    const std::vector<FaceId> faces = topology::all_faces(model);
    if (std::ranges::any_of(faces, [&](FaceId face) {
            return std::ranges::any_of(topology::corners_of(model[face]),
                                       [&](Index p) { return height(p) > model.tolerance; });
        }))
        return false;
    const std::vector<EdgeId> free = topology::free_edges(volume.volume);
    const bool lacks_end = volume.volume.faces(topology::Role::source).empty() ||
                           volume.volume.faces(topology::Role::target).empty();
    return std::ranges::any_of(faces, is_face_in) ||
           (std::ranges::any_of(free, is_edge_in) && (lacks_end || std::ranges::all_of(free, is_edge_in)));
}

/// Log the walls of a volume that no part of it behind the plane has.
void note_above(const Volume& volume, const Volume& behind, const RunContext& context)
{
    std::set<int> kept;
    for (const topology::Face& face : behind.volume.model.faces) kept.insert(face.tag);
    std::vector<FaceId> above = volume.volume.faces(topology::Role::wall);
    std::erase_if(above, [&](FaceId face) {
        const topology::Face& own = volume.volume.model[face];
        return own.origin != topology::Origin::given || kept.contains(own.tag);
    });
    if (!above.empty())
        log_line(context, formatted("note: left out, because the level of 'fill_to' lies below: {}",
                                    topology::entities_of(volume.volume.model, above)));
}

/// The part of a volume behind a plane.
Volume part_behind(const Volume& volume, const geometry::Plane& plane, const RunContext& context)
{
    if (!volume.along && is_brim(volume, plane)) return volume;
    Cut where;
    where.plane = plane;
    std::vector<Volume> pieces = cut(volume, where, context);
    std::erase_if(pieces, [&](const Volume& piece) {
        const Model& model = piece.volume.model;
        return geometry::height(plane, topology::centroid_of(model, topology::all_faces(model))) > 0;
    });
    if (pieces.size() != 1) refuse_parts(pieces.size());
    note_above(volume, pieces.front(), context);
    pieces.front().name = volume.name;
    return std::move(pieces.front());
}

void take(closure::Reading found, Volume& volume)
{
    volume.volume = std::move(found.volume);
    if (!found.holed.valid()) volume.roles_by = closure::RolesBy::finding;
    volume.role_reasons = std::move(found.roles.reasons);
    volume.classification = std::move(found.classification);
    volume.closure = std::move(found.closure);
    volume.as_read = std::move(found.sealed);
    volume.others = std::move(found.others);
    volume.no_roles = std::move(found.no_roles);
}

/// A model and the faces to open, with the options that are left to apply.
struct Opening {
    Model model;
    RoleRequest request;
};

/// The opening of trimmed faces. Empty if a named end is gone.
std::optional<Opening> opening_of(const RoleRequest& request, const Model& model, closure::Trimmed trimmed)
{
    JoinedParts parts;
    parts.faces_of.resize(model.faces.size());
    for (std::size_t f = 0; f < trimmed.parent.size(); ++f)
        parts.faces_of[trimmed.parent[f].index()].emplace_back(f);
    Opening opening{std::move(trimmed.model), joined_request(request, parts)};
    if (request.roles) {
        const Roles &before = *request.roles, &after = *opening.request.roles;
        if (before.source.empty() != after.source.empty() || before.target.empty() != after.target.empty())
            return std::nullopt;
    }
    return opening;
}

/// Whether faces reach a plane.
bool reach(const Model& model, const std::vector<FaceId>& faces, const geometry::Plane& plane)
{
    return std::ranges::any_of(faces, [&](FaceId face) {
        return std::ranges::any_of(topology::corners_of(model[face]), [&](Index p) {
            return std::abs(geometry::height(plane, model.at(p))) <= model.tolerance;
        });
    });
}

/// Cut the faces off at the level of `fill_to`. Empty if the volume must be closed before it is cut:
/// - the plane crosses missing faces;
/// - the roles are given, and the flat face at the level is no wall, because an end does not reach the level.
std::optional<Opening> filled_to_level(const Model& model, const RoleRequest& request,
                                       const RunContext& context)
{
    const std::vector<FaceId> named = named_faces(model, request);
    auto trimmed = closure::trim(model, named, named, *request.fill_to, context);
    if (!trimmed || trimmed->voids == 0) return std::nullopt;
    const std::size_t voids = trimmed->voids;
    const std::vector<FaceId> gone = trimmed->gone;
    auto opening = opening_of(request, model, std::move(*trimmed));
    if (!opening) return std::nullopt;
    if (const auto& roles = opening->request.roles;
        roles && !(reach(opening->model, roles->source, *request.fill_to) &&
                   reach(opening->model, roles->target, *request.fill_to)))
        return std::nullopt;
    if (voids > 1) refuse_parts(voids);
    if (!gone.empty())
        log_line(context, formatted("note: left out, because the level of 'fill_to' lies below: {}",
                                    topology::entities_of(model, gone)));
    opening->request.fill_to.reset();
    return opening;
}

/// Cut off the parts of faces that stick out of flat rims of other faces, or end in their planes. Empty if
/// there are none.
std::optional<Opening> without_overhangs(const Model& whole, const RoleRequest& request,
                                         const RunContext& context)
{
    std::optional<Opening> opening;
    while (true) {
        const Model& model = opening ? opening->model : whole;
        const RoleRequest& now = opening ? opening->request : request;
        const auto found = closure::find_overhang(model, named_faces(model, now));
        // Faces that are not named stay: they may be in contact with named ones.
        auto trimmed = found ? closure::trim(model, topology::all_faces(model), found->faces, found->plane,
                                             context)
                             : std::nullopt;
        if (!trimmed) return opening;
        std::vector<FaceId> lost = trimmed->cut;
        std::ranges::copy(trimmed->gone, std::back_inserter(lost));
        auto shorter = opening_of(now, model, std::move(*trimmed));
        if (!shorter) return opening;
        const Message note("closure.cut_off", "cut off in the plane of the rim of {}: {}",
                           topology::entity_of(model, found->beside), topology::entities_of(model, lost));
        log_line(context, formatted("note: {} [{}]", note.text(), note.code()));
        opening = std::move(shorter);
    }
}

/// Open a volume from a model in which touching solids no longer share faces.
Volume open_apart(const Model& whole, const RoleRequest& asked, const RunContext& context)
{
    report_progress(context, "roles");
    Volume volume;
    Opening opening{whole, asked};
    if (asked.find_walls && !asked.along) {
        volume.role_reasons = find_walls(whole, *opening.request.roles, context);
        topology::require_none_left_out(whole, topology::all_faces(*opening.request.roles), "walls");
        opening.request.find_walls = false;
        if (auto shorter = without_overhangs(opening.model, opening.request, context))
            opening = std::move(*shorter);
    }
    if (!asked.along && !asked.full_turn) {
        if (auto level = asked.fill_to ? filled_to_level(opening.model, opening.request, context)
                                       : std::nullopt)
            opening = std::move(*level);
    }
    const auto& [model, request] = opening;
    std::vector<FaceId> faces;
    if (!request.roles) faces = request.faces ? *request.faces : topology::all_faces(model);
    if (request.along) {
        volume.along = open_along(model, request, context);
        volume.volume = volume.along->source;
        volume.volume.full_turn = volume.along->full_turn;
    } else if (request.full_turn) {
        volume.volume = open_full_turn(model, faces, request, context);
    } else if (auto found = find_roles(model, faces, request, context)) {
        take(std::move(*found), volume);
        volume.roles_found = !request.roles;
        if (request.override_class) {
            require_roles(volume);
            volume.others.reset();
        }
    } else {
        volume.volume = topology::open_volume(model, *request.roles, context);
    }
    if (volume.closure && request.override_class && *request.override_class != volume.classification.value)
        throw InvalidInput(
            Message("lua.class_of_found_roles",
                    "open_volume: at least one end of these faces is missing, and they are swept as class {}",
                    found(topology::to_string(volume.classification.value)))
                .remedy("to override the class, name the roles"));
    if (!volume.closure && !volume.along) {
        volume.volume.override_class = request.override_class;
        if (request.override_class) volume.as_read.reset();
        volume.classification = topology::classify(volume.volume);
    }
    if (volume.along) {
        volume.classification = topology::classify(volume.volume);
        volume.classification.value = topology::VolumeClass::zero;
        volume.classification.reasons = {
            "a source alone and a path along which it is swept: not a class of the "
            "paper"};
    }
    for (const FaceId face : topology::bodies_inside(whole, volume.volume.model, context))
        log_line(
            context,
            formatted(
                "note: {} lies inside the volume, and the mesh goes through it and the faces connected to "
                "it; name them too if the mesh should leave them out",
                topology::entity_of(whole, face)));
    if (request.reading > 0 || (request.full_turn && !request.roles))
        volume.roles_by = closure::RolesBy::finding;
    volume.name = request.name;
    volume.material = request.material;
    volume.glued = request.glued;
    if (request.fill_to) return part_behind(volume, *request.fill_to, context);
    return volume;
}

/// Keep the first of equal entries of each list of faces.
RoleRequest without_repeats(const Model& model, RoleRequest request, const RunContext& context)
{
    each_list(request, [&](std::vector<FaceId>& faces) {
        std::set<FaceId> seen, twice;
        std::erase_if(faces,
                      [&](FaceId face) { return !seen.insert(face).second && (twice.insert(face), true); });
        if (!twice.empty())
            log_line(context, formatted("note: listed more than once, counted once: {}",
                                        topology::entities_of(model, twice)));
    });
    return request;
}

/// If the user named no faces, a closed body is filled itself. Log the faces of its largest cavities.
void note_body_filled(const Model& model, const RunContext& context)
{
    constexpr std::size_t kMostNamed = 2; // more would hide the first
    std::string words;
    for (const closure::Cavity& cavity : closure::largest_cavities(model, kMostNamed, context)) {
        std::set<int> tags; // parts of one face have its tag
        for (const FaceId face : cavity.faces) tags.insert(model[face].tag);
        words += formatted("; for its {} of volume {:.4g}{} give faces={{{}}}", cavity.kind, cavity.volume,
                           cavity.has_bodies ? " (with the bodies in it)" : "",
                           full_list(tags, [](int tag) { return std::to_string(tag); }));
    }
    if (!words.empty()) log_line(context, "note: no faces are named, so the body itself is filled" + words);
}

/// Open a volume from a model whose solids may touch.
Volume open_joined(const Model& model, const RoleRequest& request, const RunContext& context)
{
    const auto joined = join_touching_parts(model, named_faces(model, request), request.find_walls, context);
    if (!request.roles && !request.faces && !request.full_turn)
        note_body_filled(joined ? joined->model : model, context);
    if (!joined) return open_apart(model, request, context);
    log_line(context, joined->note);
    RoleRequest now = joined_request(request, *joined);
    if (!now.find_walls) leave_out_beyond_contacts(model, *joined, now, context);
    return open_apart(joined->model, now, context);
}

Volume open_named(const Model& model, const RoleRequest& request, const RunContext& context)
{
    if (request.along) return open_apart(model, request, context);
    if (request.full_turn) return open_joined(model, request, context);
    const std::vector<FaceId> named = named_faces(model, request);
    report_progress(context, "roles");
    auto left = request.find_walls ? leave_out_other_bodies(model, named, context) : std::nullopt;
    if (!left && request.find_walls) left = leave_out_double_faces(model, named);
    if (!left) left = leave_out_shared_faces(model, named, request.find_walls);
    if (left) {
        log_line(context, left->note);
        return open_named(left->model, joined_request(request, *left), context);
    }
    // Where a part stands on another, its top still sticks out of a rim.
    if (const auto shorter = request.find_walls ? std::nullopt : without_overhangs(model, request, context))
        return open_joined(shorter->model, shorter->request, context);
    return open_joined(model, request, context);
}

/// Log a material that no deck of the model defines: writing the mesh with the deck refuses it, which a user
/// should know before meshing.
void note_unknown_material(const RoleRequest& request, const RunContext& context)
{
    if (request.material.empty()) return;
    for (const auto& deck : request.decks)
        if ((deck->format != io::DeckFormat::abaqus && deck->format != io::DeckFormat::nastran) ||
            io::has_material(*deck, request.material))
            return;
    for (const auto& deck : request.decks)
        log_line(
            context,
            formatted("note: material = {}: {} has {}, so 'with' of mesh:write will not add the mesh to it",
                      request.material, deck->path, io::materials_in_words(*deck)));
}

} // namespace

std::vector<Volume> open_bodies(const Model& model, const RunContext& context)
{
    const std::vector<topology::Body> bodies = topology::bodies(model, context);
    topology::require_apart(model, bodies, context);
    if (bodies.size() > 1) { // the hollow between two halves of a mould is a cavity of both together
        const auto joined = join_touching_parts(model, topology::all_faces(model), false, context);
        note_body_filled(joined ? joined->model : model, context);
    }
    std::set<FaceId> loose;
    for (const FaceId face : topology::all_faces(model)) loose.insert(face);
    std::vector<Volume> volumes;
    for (const topology::Body& body : bodies) {
        for (const FaceId face : body.faces) loose.erase(face);
        const Model own = topology::extract(model, body.faces);
        RoleRequest request;
        request.faces = topology::all_faces(own);
        request.name = body.name;
        volumes.push_back(open(own, request, context));
    }
    if (!loose.empty())
        log_line(context, formatted("note: these faces bound no closed body: {}",
                                    topology::entities_of(model, loose)));
    return volumes;
}

Volume open(const Model& model, const RoleRequest& request, const RunContext& context)
{
    Volume volume = unless_faces_cross(model, named_faces(model, request), context, [&] {
        return open_named(model, without_repeats(model, request, context), context);
    });
    note_unknown_material(request, context);
    return volume;
}

} // namespace lacuna::fill
