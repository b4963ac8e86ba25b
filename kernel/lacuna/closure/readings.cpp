// SPDX-License-Identifier: MIT
#include <lacuna/closure/readings.h>

#include <lacuna/closure/detail/close_trial.h>
#include <lacuna/closure/detail/flat_fill.h>
#include <lacuna/closure/detail/full_turn.h>
#include <lacuna/closure/detail/guesses.h>
#include <lacuna/closure/detail/hollow_readings.h>
#include <lacuna/closure/detail/no_roles.h>
#include <lacuna/closure/detail/round_walls.h>
#include <lacuna/closure/detail/sealed_voids.h>
#include <lacuna/closure/detail/touching_faces.h>
#include <lacuna/closure/detail/void_sweeps.h>
#include <lacuna/core/error.h>
#include <lacuna/core/shared/attempt.h>
#include <lacuna/core/shared/criteria.h>
#include <lacuna/matching/match.h>
#include <lacuna/topology/shared/face_parts.h>
#include <lacuna/topology/shared/face_plane.h>
#include <lacuna/topology/shared/hollows.h>
#include <lacuna/topology/shared/names_of.h>
#include <lacuna/topology/shared/patches.h>
#include <lacuna/topology/shared/use_places.h>

#include <algorithm>
#include <initializer_list>

namespace lacuna::closure {

using namespace topology;

namespace {

/// Largest number of candidates that are sealed, or checked if none can be sealed, the likeliest first.
/// Sealing them takes some tenths of a second for 10,000 facets.
constexpr std::size_t kMostSealed = 24;

double void_area(const Model& model, const Closure& closure)
{
    double area = 0;
    for (const FaceId face : closure.void_faces) area += face_area(model, face);
    return area;
}

/// If one flat face in each free loop closes the volume, drop the voids whose void faces have a larger area
/// than these flat faces: they are bent or join two loops. Flat faces are likelier, even if the resulting
/// volume cannot be swept.
/// @return  whether a void was dropped
bool prefer_flat(std::vector<Void>& found, const std::optional<FlatFilling>& filled,
                 const RunContext& context)
{
    if (!filled || !filled->each_alone || found.empty()) return false;
    const Model& model = filled->volume.model;
    // Only for a single connected part, because flat faces would close each part separately. Not if a flat
    // face would lie in the plane of an adjacent face, because it would enclose nothing.
    std::vector<FaceId> given = all_faces(model);
    std::erase_if(given, [&](FaceId face) { return model[face].origin != Origin::given; });
    if (connected_parts(model, given).size() != 1) return false;
    const std::vector<double> angle = angles_across(model, context);
    for (const FaceId face : filled->closure.void_faces)
        for (const EdgeUse& use : uses_of(model[face]))
            if (angle[use.edge.index()] < kCreaseAngle) return false;
    const double flat = (1 + kVolumeNoted) * void_area(model, filled->closure);
    return std::erase_if(found, [&](const Void& v) {
               return void_area(v.sealed.volume.model, v.sealed.closure) > flat;
           }) > 0;
}

/// The void closed by flat faces. Empty if each free loop is planar and gets a face of its own
/// (`each_alone`), or if the void has no sweep direction.
std::optional<Void> fill_flat(std::optional<FlatFilling> filled, const std::vector<FaceId>& faces,
                              const RunContext& context)
{
    if (!filled || filled->each_alone) return std::nullopt;
    const std::vector<RoleCandidate> sweeps = best_sweeps(filled->volume.model, context);
    if (sweeps.empty()) return std::nullopt;
    Void found;
    found.first.roles.walls = faces;
    const auto likeliest = std::ranges::min_element(sweeps, {}, &RoleCandidate::cost);
    // Splitting a loop between faces is as unlikely as missing ends.
    found.cost = topology::kNoEnd + likeliest->cost;
    found.sealed.volume = std::move(filled->volume);
    found.sealed.closure = std::move(filled->closure);
    found.sealed.enclosed = enclosed_volume(found.sealed.volume);
    found.filled = "sealed by flat faces in its free loops";
    return found;
}

/// A sealed void as a reading without ends. Empty if it encloses no volume, for example because the rim of a
/// flat face is filled with a second flat face.
std::optional<Reading> without_ends(FlatFilling filled)
{
    Reading reading;
    reading.volume = std::move(filled.volume);
    reading.closure = std::move(filled.closure);
    reading.enclosed = enclosed_volume(reading.volume);
    double area = 0;
    for (const FaceId face : all_faces(reading.volume.model)) area += face_area(reading.volume.model, face);
    if (!(reading.enclosed > reading.volume.model.tolerance * area)) return std::nullopt;
    return reading;
}

/// The reading in which each missing face has the shape that its rim determines (`fill_free_loops()`). Its
/// ends are found on the sealed skin, as for a volume without missing faces.
std::optional<Reading> read_filled(const Model& model, const std::vector<FaceId>& faces,
                                   const RunContext& context)
{
    // Filling throws if a new face shares an edge with two other faces.
    auto filled = unless_refused([&] {
                      return fill_free_loops(model, faces, Missing::any, context);
                  }).value_or(std::nullopt);
    if (!filled || filled->closure.void_faces.empty()) return std::nullopt;
    const Model skin = filled->volume.model;
    const std::vector<Reading> whole = find_readings(skin, all_faces(skin), context);
    auto reading = without_ends(std::move(*filled));
    if (!reading) return std::nullopt;
    reading->guess = guess_of_bent(reading->volume, *reading->closure, RolesBy::finding);
    if (!reading->guess)
        reading->guess = untold_face(reading->volume, *reading->closure, kVolumeNoted * reading->enclosed);
    // `closure` is set if read_bowl() found the reading; its faces are split.
    if (whole.empty() || whole.front().closure) {
        reading->no_roles = why_no_roles(model, faces, context);
        return reading;
    }
    reading->roles = whole.front().roles;
    reading->others = whole.front().others;
    set_ends(reading->volume, reading->roles.roles);
    // The roles name faces of `skin` here; below they are changed to faces of the model.
    Roles& roles = reading->roles.roles;
    for (std::vector<FaceId>* list : {&roles.source, &roles.target, &roles.walls}) {
        std::erase_if(*list, [&](FaceId face) { return face.index() >= faces.size(); });
        for (FaceId& face : *list) face = faces[face.index()];
    }
    reading->classification = class_as_given(model, roles);
    reading->roles.value = reading->classification.value;
    reading->roles.reasons.push_back("sealed by the faces that its rims determine");
    return reading;
}

/// The sealed state of a reading; empty if no faces are missing.
std::optional<Closed> sealed_state(const Reading& reading)
{
    if (reading.closure) return Closed{reading.volume, *reading.closure};
    if (reading.sealed) return static_cast<const Closed&>(*reading.sealed);
    return std::nullopt;
}

/// Whether a closing makes no other assumptions than some.
bool assumes_only(const Closure& closure, std::initializer_list<Assumed> kinds)
{
    return std::ranges::all_of(closure.assumptions, [&](const Assumption& assumption) {
        return std::ranges::find(kinds, assumption.what) != kinds.end();
    });
}

/// Whether a hole of given faces is closed in their plane.
bool closes_hole(const Model& model, const Closure& closure)
{
    return std::ranges::any_of(closure.void_faces, [&](FaceId face) {
        const auto plane = model[face].loops.size() == 1 ? plane_of(model, face) : std::nullopt;
        return plane && std::ranges::all_of(faces_beside(model, face), [&](FaceId other) {
                   return lies_in_plane(model, other, *plane);
               });
    });
}

/// The ring around an axis of which some faces bound a part, such as a groove around a shaft, as a full turn.
/// Empty if the faces form no tube, or if the ring may not be enclosed.
std::optional<Reading> read_groove(const Model& model, const std::vector<FaceId>& faces,
                                   const MayEnclose& may_enclose, const RunContext& context)
{
    OpenVolume open = open_volume(model, {{}, {}, faces}, context);
    open.full_turn = true;
    const std::vector<FaceId> all = all_faces(open.model);
    if (free_loops(open).size() != 2 || connected_parts(open.model, all).size() != 1 ||
        euler_number(open.model, all) != 0)
        return std::nullopt;
    Reading ring;
    const bool fits = unless_refused([&] {
                          for (const StepPiece& half : cut_full_turn(open, context)) {
                              const auto match = matching::match(half.volume, {}, context);
                              const Closed closed = close_trial(half.volume, match, context);
                              ring.enclosed += enclosed_volume(closed.volume);
                              if (!may_enclose(closed.volume.model)) return false;
                          }
                          return true;
                      }).value_or(false);
    if (!fits) return std::nullopt;
    ring.roles.roles.walls = faces;
    ring.roles.reasons.emplace_back("the faces form a groove around an axis, which is swept as a full turn: "
                                    "their rims are closed around the body, not through it");
    ring.volume = std::move(open);
    return ring;
}

/// Replace the readings by that of `read_filled()` if this one is sure. It is only made if the readings
/// differ, if the first one assumes the shape of a face, or if it closes a hole in its plane: a round wall
/// may be missing there.
/// - If the readings differ in volume, or in whether holes go through, it must close no hole; also if the
///   faces are connected and nothing else is in doubt.
/// - If the readings differ in volume, or the user is asked about holes (`leave_holes_open()`), it may assume
///   nothing but round walls between rims; otherwise also that missing faces are flat and missing walls
///   straight.
void prefer_told(const Model& model, const std::vector<FaceId>& faces, std::vector<Reading>& readings,
                 const MayEnclose& may_enclose, const RunContext& context)
{
    const Reading& reading = readings.front();
    const bool differ = readings.size() > 1 || reading.holed.valid();
    const auto sealed = sealed_state(reading);
    const bool untold = sealed && (untold_face(sealed->volume, sealed->closure) ||
                                   std::ranges::any_of(sealed->closure.void_faces, [&](FaceId face) {
                                       return is_bent_ring(sealed->volume.model, face);
                                   }));
    const bool closes = sealed && closes_hole(sealed->volume.model, sealed->closure);
    if (!differ && !untold && !closes && !reading.guess) return;
    auto told = read_filled(model, faces, context);
    if (!told || told->guess || !may_enclose(told->volume.model)) return;
    const bool alone = closes && !untold && !reading.guess && connected_parts(model, faces).size() == 1;
    if ((differ || alone) && closes_hole(told->volume.model, *told->closure)) return;
    const bool asks = readings.size() > 1 || leave_holes_open(model, readings, faces, context);
    const bool is_sure = asks ? assumes_only(*told->closure, {Assumed::round_wall, Assumed::rim})
                              : assumes_only(*told->closure,
                                             {Assumed::straight, Assumed::round_wall, Assumed::rim});
    // A reading without `guess` is one connected body. A filling with several parts must not replace it.
    if (is_sure && ((!differ && reading.guess) ||
                    connected_parts(told->volume.model, all_faces(told->volume.model)).size() == 1)) {
        readings.clear();
        readings.push_back(std::move(*told));
    }
}

/// Whether all void faces of a reading are flat.
bool closes_flat(const Reading& reading)
{
    const Model& model = reading.volume.model;
    return std::ranges::all_of(reading.closure->void_faces,
                               [&](FaceId face) { return has_flat_loops(model, face); });
}

/// The reading of faces without ends: a ring, which is swept as a full turn, or a closed skin, to be cut or
/// filled with tetrahedra.
Reading read_skin(const Model& model, const std::vector<FaceId>& faces, const RunContext& context)
{
    OpenVolume open = open_volume(model, {{}, {}, faces}, context);
    if (is_ring(open, context)) {
        Reading ring;
        ring.roles.roles.walls = faces;
        ring.roles.reasons.push_back("the faces form a closed ring, which is swept as a full turn");
        ring.volume = std::move(open);
        ring.volume.full_turn = true;
        ring.enclosed = enclosed_volume(ring.volume);
        return ring;
    }
    Message why = why_no_roles(model, faces, context);
    auto filled = free_edges(open).empty() ? fill_free_loops(model, faces, Missing::flat, context)
                                           : std::nullopt;
    auto reading = filled ? without_ends(std::move(*filled)) : std::nullopt;
    if (!reading) throw InvalidInput(std::move(why));
    reading->no_roles = std::move(why);
    return std::move(*reading);
}

/// The readings of faces whose sealed volumes `may_enclose` accepts, likeliest first.
std::vector<Reading> readings_of(const Model& model, const std::vector<FaceId>& faces,
                                 const MayEnclose& may_enclose, const RunContext& context)
{
    if (auto floor = read_floor(model, faces, may_enclose, context); floor && closes_flat(*floor)) {
        std::vector<Reading> readings;
        readings.push_back(std::move(*floor));
        prefer_told(model, faces, readings, may_enclose, context);
        return readings;
    }
    const auto seals = [&](const RoleCandidate& candidate) {
        return seal(model, candidate.roles, may_enclose, context).has_value();
    };
    std::vector<Void> found = voids(model, role_candidates(model, faces, {}, context), kMostSealed,
                                    may_enclose, context);
    if (found.empty()) // the likeliest candidates cannot be sealed; less likely ones may be
        found = voids(model, less_likely(model, faces, {.most = kMostSealed}, seals, context), kMostSealed,
                      may_enclose, context);
    auto flat = fill_free_loops(model, faces, Missing::flat, context);
    if (flat && !may_enclose(flat->volume.model)) flat.reset();
    const bool dropped = prefer_flat(found, flat, context);
    if (auto filled = fill_flat(std::move(flat), faces, context)) add_filled(found, std::move(*filled));
    take_moved(model, faces, found, context);
    std::erase_if(found, [&](const Void& v) { return !may_enclose(v.sealed.volume.model); });
    std::vector<Reading> readings;
    for (Void& now : found) {
        if (auto reading = read(model, found, now, context)) readings.push_back(std::move(*reading));
    }
    if (readings.empty() && !dropped) {
        auto bowl = read_bowl(model, faces, context);
        if (bowl && may_enclose(bowl->volume.model)) readings.push_back(std::move(*bowl));
    }
    if (readings.empty()) {
        auto filled = read_filled(model, faces, context);
        if (filled && may_enclose(filled->volume.model)) readings.push_back(std::move(*filled));
    } else {
        prefer_told(model, faces, readings, may_enclose, context);
    }
    return readings;
}

} // namespace

OpenVolume other_sweep(const OtherSweeps& others, std::size_t k)
{
    OpenVolume volume = others.volume;
    set_ends(volume, others.ways[k].roles);
    return volume;
}

std::vector<Reading> find_readings(const Model& model, const std::vector<FaceId>& faces,
                                   const RunContext& context)
{
    return find_readings(model, faces, Bodies(model), context);
}

std::vector<Reading> find_readings(const Model& model, const std::vector<FaceId>& faces, const Bodies& bodies,
                                   const RunContext& context)
{
    const auto any = [](const Model&) { return true; };
    const double share = bodies.share_of(faces);
    if (!(share < 1.0 / 2)) return readings_of(model, faces, any, context);
    const MayEnclose outside = [&](const Model& sealed) { return !lies_in_material(model, faces, sealed); };
    std::vector<Reading> readings = readings_of(model, faces, outside, context);
    if (!readings.empty()) return readings;
    if (auto groove = read_groove(model, faces, outside, context)) {
        readings.push_back(std::move(*groove));
        return readings;
    }
    readings = readings_of(model, faces, any, context);
    if (!(share < 1.0 / 4)) return readings; // a body that lacks faces
    for (Reading& reading : readings) {
        Closure* closure = reading.closure  ? &*reading.closure
                           : reading.sealed ? &reading.sealed->closure
                                            : nullptr;
        if (closure == nullptr) continue;
        assume(*closure,
               Message("closure.in_material",
                       "the volume lies in the material of the body to which {} belong, not beside it",
                       entities_of(model, faces))
                   .remedy("to fill the space beside it, give the missing faces there"),
               1);
    }
    return readings;
}

Reading find_reading(const Model& model, const std::vector<FaceId>& faces, int number,
                     const RunContext& context)
{
    if (faces.empty())
        throw InvalidInput(Message("topology.no_faces", "there are no faces to form a volume")
                               .remedy("load a file that has some, or add_face{{ points =, cells = }}"));
    std::vector<Reading> readings = find_readings(model, faces, context);
    if (readings.empty()) readings.push_back(read_skin(model, faces, context));
    if (number == 0) {
        if (auto open = leave_holes_open(model, readings, faces, context)) return std::move(*open);
    }
    if (number == 0 && readings.size() == 1) {
        if (!readings.front().guess) return std::move(readings.front());
        throw InvalidInput(
            Message(*readings.front().guess)
                .remedy("give the missing face, name the roles, or accept the assumed shape, which encloses "
                        "{:.4g}, with open_volume{{ faces = …, reading = 1 }}",
                        readings.front().enclosed));
    }
    const auto place = static_cast<std::size_t>(number);
    if (number >= 1 && place <= readings.size()) return std::move(readings[place - 1]);
    if (number == 0) {
        throw InvalidInput(
            Message("topology.roles_ambiguous",
                    "the faces can be closed in several equally likely ways with different volumes: {}",
                    listed(readings))
                .remedy("choose one by its number, as in open_volume{{ faces = …, reading = 1 }}, or name "
                        "source, target and walls"));
    }
    throw InvalidInput("topology.no_such_reading",
                       "the faces have no reading number {}; the likely ones are {}", found(number),
                       listed(readings));
}

} // namespace lacuna::closure
