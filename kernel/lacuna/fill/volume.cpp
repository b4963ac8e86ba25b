// SPDX-License-Identifier: MIT
#include <lacuna/fill/volume.h>

#include <lacuna/closure/shared/along.h>
#include <lacuna/closure/shared/branches.h>
#include <lacuna/closure/shared/cut.h>
#include <lacuna/closure/shared/piece_ends.h>
#include <lacuna/closure/shared/round_rims.h>
#include <lacuna/core/error.h>
#include <lacuna/core/shared/number_text.h>
#include <lacuna/core/shared/progress.h>
#include <lacuna/fill/detail/crossing_faces.h>
#include <lacuna/fill/detail/members.h>
#include <lacuna/fill/detail/touching_parts.h>
#include <lacuna/geometry/shared/facet_tree.h>
#include <lacuna/geometry/shared/polyline.h>
#include <lacuna/healing/shared/stitch.h>
#include <lacuna/topology/shared/face_parts.h>
#include <lacuna/topology/shared/hollows.h>
#include <lacuna/topology/shared/names_of.h>
#include <lacuna/topology/shared/use_places.h>

#include <algorithm>
#include <iterator>
#include <ranges>
#include <set>
#include <utility>

namespace lacuna::fill {

using topology::Role;

namespace {

constexpr const char* kRimsDivided =
    "note: rounds tangent to an end are divided at 45 degrees: the flatter half belongs to the end, the rest "
    "to the walls";

bool asks_nothing(const closure::CloseOptions& options)
{
    const closure::CloseOptions none;
    return options.edge_shape == none.edge_shape && options.void_edges.empty() && options.cap == none.cap &&
           options.holes == none.holes;
}

void match_ends(Volume& volume, const matching::MatchOptions& options, const RunContext& context)
{
    if (options == matching::MatchOptions{} && volume.as_read) {
        volume.match = volume.as_read->match;
        return;
    }
    volume.as_read.reset();
    volume.match = matching::match(volume.volume, options, context);
}

/// Whether closing needs a match. If holes are to be covered, the ends can be matched only afterwards.
bool must_match(const Volume& volume, const closure::CloseOptions& options, const RunContext& context)
{
    const topology::OpenVolume& open = volume.volume;
    if (volume.match || options.holes == closure::Holes::cover || open.faces(Role::source).empty() ||
        open.faces(Role::target).empty())
        return false;
    return !(topology::free_edges(open).empty() && closure::has_steps(open, context));
}

/// Undo the closing with which the roles of a volume were found. If an end was a void face, this end is
/// missing afterwards.
void reopen(Volume& volume, const RunContext& context)
{
    topology::Roles roles;
    for (const auto& [list, role] :
         {std::pair{&roles.source, Role::source}, {&roles.target, Role::target}, {&roles.walls, Role::wall}})
        std::ranges::copy_if(volume.volume.faces(role), std::back_inserter(*list), [&](FaceId face) {
            return volume.volume.model[face].origin == topology::Origin::given;
        });
    volume.volume = topology::open_volume(volume.volume.model, roles, context);
    volume.closure.reset();
}

/// Largest sag of the model's edges: the distance between their chords and the curves that they approximate.
double edge_sag(const topology::Model& model)
{
    double sag = 0;
    for (const topology::Edge& edge : model.edges)
        sag = std::max(sag, geometry::sag(topology::places_at(model, edge.points)));
    return sag;
}

/// The skin of a source swept along a path. Where a wall is given, it replaces the wall that the sweep would
/// make there.
/// @throw NotClosed "closure.along_walls"  a given wall does not end where the replaced wall ends; names the
///         place.
closure::Closed with_given_walls(closure::Closed closed, const topology::Model& walls,
                                 const RunContext& context)
{
    const topology::Model& swept = closed.volume.model;
    // The given walls and the swept ones may approximate the same edge by chords of different lengths.
    const double tolerance = swept.tolerance + edge_sag(swept) + edge_sag(walls);
    const auto rims_of = [](const topology::Model& model, FaceId face) {
        std::vector<std::vector<Vec3>> rims;
        for (const topology::Loop& loop : model[face].loops)
            rims.push_back(topology::loop_places(model, loop.uses));
        return rims;
    };
    const std::vector<Triangle> facets = topology::facets_of(walls, topology::all_faces(walls));
    const geometry::FacetTree given(walls.points, facets);
    const auto is_on = [&](const Vec3& p) { return (given.closest(p).point - p).norm() <= tolerance; };
    // The sides of a wall that is missing between given ones lie on these, so middles of segments count, too.
    const auto is_rim_on = [&](const std::vector<Vec3>& rim) {
        for (std::size_t i = 0; i < rim.size(); ++i)
            if (!is_on(rim[i]) || !is_on((rim[i] + rim[(i + 1) % rim.size()]) / 2)) return false;
        return true;
    };
    std::vector<FaceId> kept;
    std::vector<Role> roles;
    std::vector<Vec3> ends; // end points of the segments around the walls that are replaced
    std::vector<Triangle> segments;
    for (const FaceId face : topology::all_faces(swept)) {
        const auto rims = rims_of(swept, face);
        const Role role = closed.volume.role[face.index()];
        if (role != Role::wall || !std::ranges::all_of(rims, is_rim_on)) {
            kept.push_back(face);
            roles.push_back(role);
            continue;
        }
        for (const std::vector<Vec3>& rim : rims) {
            const auto first = static_cast<Index>(ends.size()), count = static_cast<Index>(rim.size());
            for (Index i = 0; i < count; ++i)
                segments.push_back({first + i, first + (i + 1) % count, first + i});
            ends.insert(ends.end(), rim.begin(), rim.end());
        }
    }
    const auto refuse = [](const Vec3& place) {
        throw NotClosed(
            Message("closure.along_walls",
                    "a given wall does not meet the other faces of the volume along this path at {}",
                    place_with_digits(place, 4))
                .remedy("give walls that reach from the source to the end of the path, or leave them "
                        "out"));
    };
    if (segments.empty()) refuse(rims_of(walls, FaceId(0)).front().front());
    const geometry::FacetTree around(ends, segments);
    for (const FaceId wall : topology::all_faces(walls))
        for (const std::vector<Vec3>& rim : rims_of(walls, wall))
            for (const Vec3& p : rim)
                if ((around.closest(p).point - p).norm() > tolerance) refuse(p);
    topology::ModelBuilder builder(topology::extract(swept, kept));
    for (topology::Edge& edge : builder.edges) {
        // Make an edge of the path a polyline, so that it can be joined with the polyline of a given wall.
        if (edge.origin != topology::Origin::made_void ||
            !std::ranges::all_of(edge.points, [&](Index p) { return is_on(builder.points[index(p)]); }))
            continue;
        edge.curve.reset();
        edge.params.clear();
    }
    add_model(builder, walls);
    roles.resize(builder.faces.size(), Role::wall);
    topology::Model joined = std::move(builder).finish();
    healing::stitch(joined, tolerance, context);
    if (joined.faces.size() != roles.size()) refuse(ends.front());
    closed.volume.role = std::move(roles);
    closed.volume.model = std::move(joined);
    const topology::Model& model = closed.volume.model;
    if (const auto free = topology::free_edges(closed.volume); !free.empty())
        refuse(model.at(model[free.front()].points.front()));
    topology::orient_skin(closed.volume.model, context);
    closure::list_void(closed);
    return closed;
}

} // namespace

Volume override_class(Volume volume, topology::VolumeClass value)
{
    require_roles(volume);
    if (volume.closure)
        throw InvalidInput(Message("lua.sealed", "override_class: the volume is sealed already")
                               .remedy("override its class before close()"));
    if (volume.along && value == topology::VolumeClass::zero) return volume;
    if (volume.along)
        throw InvalidInput(Message("closure.along_roles",
                                   "override_class: 'along' fixes the class, which is {}",
                                   topology::to_string(volume.classification.value))
                               .remedy("leave out override_class"));
    volume.others.reset();
    volume.as_read.reset();
    volume.volume.override_class = value;
    volume.classification = topology::classify(volume.volume);
    return volume;
}

void note_joined(const topology::Model& whole, const std::vector<closure::StepPiece>& pieces,
                 const RunContext& context)
{
    std::set<int> kept;
    for (const closure::StepPiece& piece : pieces)
        for (const topology::Face& face : piece.volume.model.faces)
            if (face.origin == topology::Origin::given) kept.insert(face.tag);
    std::vector<FaceId> joined;
    for (const FaceId face : topology::all_faces(whole))
        if (whole[face].origin == topology::Origin::given && !whole[face].tube &&
            !kept.contains(whole[face].tag))
            joined.push_back(face);
    if (joined.empty()) return;
    log_line(context, formatted("note: joined with the walls beside them, because their smooth edges meet in "
                                "a vertex of a rim: {}",
                                topology::entities_of(whole, joined)));
}

void require_roles(const Volume& volume)
{
    if (volume.no_roles) throw InvalidInput(*volume.no_roles);
}

Volume with_rims_divided(const Volume& volume, const RunContext& context)
{
    const bool as_found = volume.roles_found && !volume.told;
    if (volume.along || volume.no_roles || (!as_found && (volume.match || volume.closure))) return volume;
    Volume divided = volume;
    const std::size_t faces = divided.volume.model.faces.size();
    closure::split_round_rims(divided.volume, closure::RoundsOf::walls, context);
    if (divided.volume.model.faces.size() == faces) return volume;
    if (divided.closure) {
        closure::Closed sealed{std::move(divided.volume), std::move(*divided.closure)};
        closure::list_void(sealed);
        divided.volume = std::move(sealed.volume);
        divided.closure = std::move(sealed.closure);
    }
    if (divided.volume.model.faces.size() > faces) log_line(context, kRimsDivided);
    note_joined(volume.volume.model, {{divided.volume, 0}}, context);
    divided.match.reset();
    divided.as_read.reset();
    divided.others.reset();
    return divided;
}

Volume match(Volume volume, const std::optional<matching::MatchOptions>& options, const RunContext& context)
{
    require_roles(volume);
    if (volume.closure && (options || !volume.match))
        throw InvalidInput(
            Message("lua.sealed", "match: the volume is sealed already").remedy("match it before close()"));
    if (options) volume.others.reset();
    if (options || !volume.match) match_ends(volume, options.value_or(matching::MatchOptions{}), context);
    return volume;
}

Volume close(Volume volume, const std::optional<closure::CloseOptions>& options, const RunContext& context)
{
    if (options) require_roles(volume);
    if (volume.closure && options && volume.told)
        throw InvalidInput(
            "lua.sealed",
            "close: the volume is sealed already; give these options in the first call of close()");
    if (volume.closure && options) reopen(volume, context);
    if (options) volume.others.reset();
    if (volume.closure) { // sealed while its roles were found; its assumptions were not logged then
        if (!std::exchange(volume.told, true)) closure::log_notes(*volume.closure, context);
        return volume;
    }
    closure::CloseOptions asked = options.value_or(closure::CloseOptions{});
    if (must_match(volume, asked, context)) {
        matching::MatchOptions by_hand;
        by_hand.vertices = closure::pairs_by_hand(volume.volume, asked);
        match_ends(volume, by_hand, context);
    }
    report_progress(context, "closing");
    volume.told = true;
    // With void edges, the closing was only tried: its assumptions were neither measured nor logged. So the
    // volume is closed again here.
    if (volume.as_read && asks_nothing(asked) && volume.as_read->closure.void_edges.empty()) {
        volume.closure = std::move(volume.as_read->closure);
        volume.volume = std::move(volume.as_read->volume);
        volume.as_read.reset();
        closure::log_notes(*volume.closure, context);
        return volume;
    }
    asked.roles_by = volume.roles_by;
    const topology::Model& model = volume.volume.model;
    closure::Closed closed = unless_faces_cross(model, topology::all_faces(model), context, [&] {
        return volume.along
                   ? closure::close_along(*volume.along, asked, context)
                   : closure::close(volume.volume, volume.match.value_or(matching::Match{}), asked, context);
    });
    if (volume.along && volume.along->walls)
        closed = with_given_walls(std::move(closed), *volume.along->walls, context);
    volume.volume = std::move(closed.volume);
    volume.closure = std::move(closed.closure);
    return volume;
}

Volume with_other_sweep(const Volume& volume, std::size_t number)
{
    Volume other = volume;
    other.volume = closure::other_sweep(*volume.others, number);
    other.closure = volume.others->closure;
    other.classification = topology::classify(other.volume);
    other.match.reset();
    return other;
}

bool has_pieces(const Volume& volume, const RunContext& context)
{
    return volume.along ? volume.along->full_turn : closure::has_pieces(volume.volume, context);
}

std::vector<closure::StepPiece> cut_into_pieces(const Volume& volume, const RunContext& context)
{
    if (volume.along && volume.along->full_turn) return closure::halves_along(*volume.along, context);
    std::vector<closure::StepPiece> pieces = closure::cut_into_pieces(volume.volume, context);
    if (pieces.size() == 1 && pieces.front().volume.model.faces.size() > volume.volume.model.faces.size())
        log_line(context, kRimsDivided);
    note_joined(volume.volume.model, pieces, context);
    return pieces;
}

Volume sealed_whole(const Volume& volume, const RunContext& context)
{
    if (volume.volume.full_turn && !volume.along) return volume;
    Volume sealed = close(volume, {}, context);
    if (sealed.others && sealed.others->ways.empty()) sealed.volume = sealed.others->volume;
    return sealed;
}

Volume piece_of(const Volume& whole, closure::StepPiece piece, const std::string& name)
{
    Volume volume;
    volume.volume = std::move(piece.volume);
    volume.level = piece.level;
    volume.name = name;
    volume.material = whole.material;
    volume.roles_by = whole.roles_by;
    volume.decks = whole.decks;
    volume.scale = whole.scale;
    volume.unit = whole.unit;
    volume.glued = whole.glued;
    return volume;
}

Volume open_anew(const Volume& volume, const topology::Model& model, RoleRequest request,
                 const RunContext& context)
{
    RunContext quiet = context;
    quiet.log = nullptr;
    request.name = volume.name;
    request.material = volume.material;
    request.glued = volume.glued;
    Volume own = open(model, request, quiet);
    own.decks = volume.decks;
    own.scale = volume.scale;
    own.unit = volume.unit;
    own.told = true;
    return own;
}

namespace {

/// A piece between whose ends its walls do not run. If these ends were found for the whole, where a mouth of
/// the piece may be a wall, the piece is read like a volume of its own.
Volume with_own_ends(Volume piece, const RunContext& context)
{
    if (piece.roles_by == closure::RolesBy::person || !topology::free_edges(piece.volume).empty() ||
        closure::walls_run_between_ends(piece.volume))
        return piece;
    Volume own = open_anew(piece, piece.volume.model, {}, context);
    if (own.no_roles) return piece;
    own.level = piece.level;
    return own;
}

} // namespace

std::vector<Volume> cut(const Volume& volume, const Cut& where, const RunContext& context)
{
    if (volume.along && !volume.closure && !volume.along->full_turn)
        return fill::cut(close(volume, {}, context), where, context);
    std::vector<closure::StepPiece> cut;
    if (where.automatic) {
        double share = -1;
        const auto keep_best = [&](std::vector<closure::StepPiece> pieces) {
            if (const double own = swept_share(pieces); own > share) {
                share = own;
                cut = std::move(pieces);
            }
            return share == 1;
        };
        partitions(sealed_whole(volume, context).volume, keep_best, context);
    } else if (where.plane) {
        cut = closure::cut_by_plane(volume.volume, *where.plane, context);
    } else if (where.model != nullptr) {
        cut = closure::cut_by_face(volume.volume, *where.model, where.face, context);
    } else {
        require_roles(volume);
        cut = cut_into_pieces(volume, context);
    }
    if (where.plane || where.model) cut = closure::read_ends(std::move(cut), context).pieces;
    std::vector<Volume> pieces;
    for (closure::StepPiece& piece : cut) {
        const std::string name = formatted("{}_{}", volume.name, pieces.size() + 1);
        Volume& own = pieces.emplace_back(
            piece_of(volume, std::move(piece), volume.name.empty() ? "" : name));
        own.classification = topology::classify(own.volume);
        own.level = std::max(volume.level, own.level);
        if (where.plane || where.model) own = with_own_ends(std::move(own), context);
    }
    return pieces;
}

} // namespace lacuna::fill
