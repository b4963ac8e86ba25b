// SPDX-License-Identifier: MIT
#include <lacuna/closure/detail/no_roles.h>

#include <lacuna/closure/detail/class_five.h>
#include <lacuna/closure/detail/cut_planes.h>
#include <lacuna/closure/detail/full_turn.h>
#include <lacuna/closure/detail/turns.h>
#include <lacuna/closure/readings.h>
#include <lacuna/closure/shared/branches.h>
#include <lacuna/closure/shared/cut.h>
#include <lacuna/closure/shared/piece_ends.h>
#include <lacuna/closure/shared/walls_alone.h>
#include <lacuna/core/error.h>
#include <lacuna/core/shared/attempt.h>
#include <lacuna/core/shared/criteria.h>
#include <lacuna/core/shared/limits.h>
#include <lacuna/core/shared/list_text.h>
#include <lacuna/topology/shared/cone_shape.h>
#include <lacuna/topology/shared/face_plane.h>
#include <lacuna/topology/shared/face_radius.h>
#include <lacuna/topology/shared/names_of.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace lacuna::closure {

using namespace topology;

namespace {

/// A list of faces in recipe syntax; `{ … }` for one that a message would shorten.
std::string in_braces(const Model& model, const std::vector<FaceId>& faces)
{
    const auto tag = [&](FaceId face) { return formatted("{}", model[face].tag); };
    const std::string list = full_list(faces, tag);
    return list == short_list(faces, tag) ? formatted("{{ {} }}", list) : "{ … }";
}

/// A cut in recipe syntax. Nine digits are far finer than the tolerance, a millionth of the diagonal.
std::string cut_in_words(const Model& model, const Vec3& point, const Vec3& normal)
{
    const Vec3 place = (point.array().abs() < model.tolerance / 1000).select(0.0, point.array());
    return formatted("cut{{ plane = {{ {{{:.9g}, {:.9g}, {:.9g}}}, {{{:.9g}, {:.9g}, {:.9g}}} }} }}",
                     place.x(), place.y(), place.z(), normal.x(), normal.y(), normal.z());
}

/// A cut, in recipe syntax, by the plane of a flat face at a concave edge. All its pieces have two ends.
/// Empty if no such cut is found.
std::string cut_at_concave_edge(const OpenVolume& volume, const RunContext& context)
{
    const Model& model = volume.model;
    const std::vector<double> turns = concave_turns(volume, context);
    std::vector<FaceId> tried;
    for (std::size_t e = 0; e < turns.size(); ++e) {
        if (!(turns[e] > kCreaseAngle)) continue;
        for (const FaceUse& use : model.uses_of_edge(EdgeId(e))) {
            const auto plane = plane_of(model, use.face);
            if (!plane || tried.size() == kMostTrials || std::ranges::find(tried, use.face) != tried.end())
                continue;
            tried.push_back(use.face);
            // A cut is refused if the plane crosses given quads of a face, or leaves the volume in one piece.
            const auto cut = unless_refused(
                [&] { return read_ends(cut_by_plane(volume, *plane, context), context).pieces; });
            if (cut && std::ranges::all_of(*cut, walls_run_between_ends, &StepPiece::volume))
                return cut_in_words(model, model.at(model[model[EdgeId(e)].from].point), plane->normal);
        }
    }
    return "";
}

bool is_cone_to_its_tip(const Model& model, FaceId face)
{
    const auto cone = cone_shape(model, face);
    return cone && cone->least_radius <= kAlikeSizes * cone->largest_radius;
}

/// An edge between two cylinders with non-parallel axes, each of half a turn or more; invalid if there is
/// none. Fillets are less than half a turn.
EdgeId crossing_of_bores(const Model& model)
{
    const auto is_bore = [&](FaceId face) { return turns_as_bore(model, face); };
    for (std::size_t e = 0; e < model.edges.size(); ++e) {
        const std::span<const FaceUse> uses = model.uses_of_edge(EdgeId(e));
        if (uses.size() != 2 || uses[0].face == uses[1].face) continue;
        if (!is_bore(uses[0].face) || !is_bore(uses[1].face)) continue;
        const auto a = round_shape(model, uses[0].face), b = round_shape(model, uses[1].face);
        if (a && b && a->axis && b->axis && a->axis->cross(*b->axis).norm() > kAlongAxis) return EdgeId(e);
    }
    return {};
}

} // namespace

bool is_ring(const OpenVolume& volume, const RunContext& context)
{
    const std::vector<FaceId> all = all_faces(volume.model);
    if (!free_edges(volume).empty() || connected_parts(volume.model, all).size() != 1 ||
        euler_number(volume.model, all) != 0)
        return false;
    return unless_refused([&] { return cut_full_turn(volume, context); }).has_value();
}

Message why_no_roles(const Model& given, const std::vector<FaceId>& faces, const RunContext& context)
{
    const OpenVolume volume = open_volume(given, {{}, {}, faces}, context);
    const Model& model = volume.model;
    const std::string walls = in_braces(given, faces);
    const auto round = round_shape(model, FaceId(0));
    const bool single = model.faces.size() == 1, closed = free_edges(volume).empty();
    if (single && closed && round && round->is_sphere())
        return Message("topology.sphere", "{} is a whole sphere, which has no ends",
                       entities_of(given, faces))
            .remedy("cut it in two by open_volume{{ walls = {} }}:{} and open each piece with "
                    "piece:model():open_volume()",
                    walls, cut_in_words(model, round->centre, Vec3::UnitZ()));
    if (single && (closed || given.faces.size() == 1))
        return Message("topology.no_roles", "{} is the {}", entities_of(given, faces),
                       closed ? "whole skin, and a single face has no ends"
                              : "only face, and it is no tube between two ends")
            .remedy("give its sides as faces: load it with a smaller 'feature_angle', or, in a recipe, call "
                    "one add_face for each");
    const std::string cut = cut_at_concave_edge(volume, context);
    const auto advised = [&](Message message, const char* otherwise) -> Message {
        if (cut.empty()) return std::move(message).remedy("{}", otherwise);
        return std::move(message).remedy("cut them: open_volume{{ walls = {} }}:{}", walls, cut);
    };
    // Other roles do not help where no single sweep exists.
    const char* const divide = "divide the volume by volume:cut{ plane = … }";
    for (const FaceId face : all_faces(model))
        if (is_cone_to_its_tip(model, face))
            return advised(Message("topology.cone",
                                   "{} is a cone up to its apex, where layers would have no width",
                                   entity_of(model, face)),
                           divide);
    if (const EdgeId edge = crossing_of_bores(model); edge.valid())
        return advised(Message("topology.crossing_bores",
                               "bores cross at {}, and no single sweep can follow both",
                               entity_of(model, edge)),
                       divide);
    std::vector<NamedEntity> tags = entities_of(given, faces);
    for (NamedEntity& face : tags) face.name.clear(); // without names, the message stays short
    return advised(Message("topology.no_roles", "no source, target and walls were found among {}", tags),
                   "name the roles: open_volume{ source = …, target = …, walls = … }");
}

std::string listed(const std::vector<Reading>& readings, std::ptrdiff_t most)
{
    int number = 0;
    const auto text = [&](const Reading& reading) {
        return formatted("{} (class {}, volume {:.4g})", ++number, to_string(reading.roles.value),
                         reading.enclosed);
    };
    return short_list(readings, text, most);
}

void check_tubes(const OpenVolume& volume, const RunContext& context)
{
    const Model& model = volume.model;
    const std::vector<FaceId> part = no_tube(volume), all = all_faces(model);
    if (part.empty() || has_branches(volume, context)) return;
    if (crossing_of_bores(model).valid()) throw InvalidInput(why_no_roles(model, all, context));
    const std::vector<Reading> readings = find_readings(model, all, context);
    const std::size_t loops = rims(model, part).size();
    Message message("closure.tube_loops",
                    "{} and the walls connected to it have {} free {}, but class V needs {}, one at each end",
                    entity_of(model, part.front()), found(loops), loops == 1 ? "loop" : "loops", needed(2));
    if (!readings.empty())
        throw NotClosed(std::move(message).remedy(
            "type open_volume{{ faces = {}, reading = 1 }}, or another of the readings {}",
            in_braces(model, all), listed(readings, 2)));
    if (const std::string cut = cut_at_concave_edge(volume, context); !cut.empty())
        throw NotClosed(std::move(message).remedy("cut them by volume:{}", cut));
    throw NotClosed(std::move(message).remedy("name the source or the target, or add the missing walls"));
}

std::optional<Reading> read_walls_alone(const Model& model, const std::vector<FaceId>& walls,
                                        bool accept_ambiguous, const RunContext& context)
{
    const OpenVolume open = open_volume(model, {{}, {}, walls}, context);
    if (no_tube(open).empty() || free_edges(open).empty() || crossing_of_bores(open.model).valid() ||
        has_branches(open, context))
        return std::nullopt;
    std::vector<Reading> readings = find_readings(model, walls, context);
    if (readings.size() != 1 || readings.front().no_roles || !(accept_ambiguous || !readings.front().guess))
        return std::nullopt;
    const RoleCandidate& roles = readings.front().roles;
    log_line(context,
             formatted("note: the named walls form no tube between two missing ends; they are taken as {}",
                       in_words(model, roles.roles, roles.value)));
    return std::move(readings.front());
}

} // namespace lacuna::closure
