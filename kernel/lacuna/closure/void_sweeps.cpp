// SPDX-License-Identifier: MIT
#include <lacuna/closure/detail/void_sweeps.h>

#include <lacuna/closure/detail/end_holes.h>
#include <lacuna/closure/detail/guesses.h>
#include <lacuna/closure/detail/turns.h>
#include <lacuna/closure/shared/branches.h>
#include <lacuna/closure/shared/piece_ends.h>
#include <lacuna/closure/shared/steps.h>
#include <lacuna/core/shared/attempt.h>
#include <lacuna/core/shared/constants.h>
#include <lacuna/core/shared/criteria.h>
#include <lacuna/core/shared/limits.h>
#include <lacuna/geometry/shared/union_find.h>
#include <lacuna/topology/shared/face_parts.h>
#include <lacuna/topology/shared/joined_faces.h>

#include <algorithm>
#include <functional>
#include <iterator>
#include <string>
#include <utility>

namespace lacuna::closure {

using namespace topology;

namespace {

/// Whether a closed skin with these roles can be cut at the steps of its ends; true if there are no steps.
bool can_be_cut(const Model& skin, const Roles& roles, const RunContext& context)
{
    OpenVolume volume{skin, std::vector<Role>(skin.faces.size()), std::nullopt};
    set_ends(volume, roles);
    return unless_refused([&] {
               return has_steps(volume, context) ? cut_steps(volume, context) : std::vector<StepPiece>();
           })
        .has_value();
}

/// Make one wall of the walls that meet smoothly, such as a bore and the void wall that continues it.
OpenVolume with_smooth_walls_joined(OpenVolume volume, const RunContext& context)
{
    const std::vector<double> turns = concave_turns(volume, context);
    geometry::UnionFind joined(volume.model.faces.size());
    for (std::size_t e = 0; e < turns.size(); ++e) {
        const std::span<const FaceUse> uses = volume.model.uses_of_edge(EdgeId(e));
        const bool walls = std::ranges::all_of(
            uses, [&](const FaceUse& use) { return volume.role[use.face.index()] == Role::wall; });
        if (walls && uses.size() == 2 && std::abs(turns[e]) < kCreaseAngle / 2)
            joined.unite_least(uses[0].face.index(), uses[1].face.index());
    }
    join_faces(volume, std::move(joined), context);
    return volume;
}

/// Whether the walls of all pieces of a closed skin with these roles run between their ends.
bool has_pieces_with_ends(const Model& skin, const Roles& roles, const RunContext& context)
{
    OpenVolume volume{skin, std::vector<Role>(skin.faces.size()), std::nullopt};
    set_ends(volume, roles);
    const auto pieces = unless_refused([&] { return cut_into_pieces(volume, context); });
    return pieces && std::ranges::all_of(*pieces, [&](const StepPiece& piece) {
               return walls_run_between_ends(with_smooth_walls_joined(piece.volume, context));
           });
}

/// If no likely sweep of a closed skin suits it, add less likely ones that do, after the others. Branches may
/// leave the skin where the likely ones have their ends.
void add_sweeps_with_branches(const Model& skin, std::vector<RoleCandidate>& sweeps,
                              const RunContext& context)
{
    const auto suits = [&](const RoleCandidate& way) {
        return has_pieces_with_ends(skin, way.roles, context);
    };
    if (sweeps.empty() || !fit_in_set(skin) || std::ranges::any_of(sweeps, suits)) return;
    std::vector<RoleCandidate> others = less_likely(skin, all_faces(skin), {.branches = true}, suits,
                                                    context);
    for (std::size_t i = 0; i < others.size(); ++i)
        if (i == 0 || suits(others[i])) sweeps.push_back(std::move(others[i]));
}

/// The given faces among some faces of a sealed volume.
struct GivenPart {
    std::vector<FaceId> faces; ///< ascending
    bool all = true;
};

GivenPart given_part(const std::vector<FaceId>& faces, const std::vector<FaceId>& as_named)
{
    GivenPart part;
    for (const FaceId face : faces) {
        if (face.index() < as_named.size())
            part.faces.push_back(as_named[face.index()]);
        else
            part.all = false;
    }
    std::ranges::sort(part.faces);
    return part;
}

/// The ends of a sweep of a sealed skin, in the input model's numbering.
struct Ends {
    GivenPart source, target;
};

std::vector<FaceId> rising(std::vector<FaceId> faces)
{
    std::ranges::sort(faces);
    return faces;
}

std::string ways_in_words(const Reading& reading)
{
    return formatted("{} readings enclose the same volume, {:.4g}; this one is swept, because it has the "
                     "fewest irregular nodes (at least {} on its source) and the most even cells",
                     reading.ways, reading.enclosed, reading.roles.irregular);
}

/// Set the volume, class and roles of a reading to those of an open volume.
void take_open(const Model& model, RoleCandidate roles, Reading& reading, const RunContext& context)
{
    reading.volume = open_volume(model, roles.roles, context);
    reading.classification = classify(reading.volume);
    reading.roles = std::move(roles);
}

/// The current roles of a sealed volume as a candidate.
RoleCandidate way_of(const OpenVolume& volume)
{
    RoleCandidate way;
    way.roles = {volume.faces(Role::source), volume.faces(Role::target), volume.faces(Role::wall)};
    return way;
}

/// Whether a candidate of the given faces has these ends, in either direction.
bool has_ends(const RoleCandidate& way, const Ends& ends)
{
    for (const GivenPart* end : {&ends.source, &ends.target})
        if (!end->all && !end->faces.empty()) return false; // an end that consists of given and void faces
    const std::vector<FaceId> s = rising(way.roles.source), t = rising(way.roles.target);
    return (s == ends.source.faces && t == ends.target.faces) ||
           (t == ends.source.faces && s == ends.target.faces);
}

/// Rank of a sweep among those with equally many irregular nodes: 0 with both ends open, 1 with one end open,
/// 2 between given ends, 3 if no candidate of the given faces has these ends. A bore or pocket is accessible
/// at an open end.
std::size_t openness(const Ends& ends, const std::vector<RoleCandidate>& ways)
{
    const auto same = std::ranges::find_if(ways,
                                           [&](const RoleCandidate& way) { return has_ends(way, ends); });
    if (same == ways.end()) return 3;
    return same->value == VolumeClass::V ? 0 : same->value == VolumeClass::IV ? 1 : 2;
}

/// Remove and return the best sweep: of those with the fewest irregular nodes, the one with the lowest
/// `openness()`. At most `kMostTrials` others are kept. @pre sorted by irregular nodes
RoleCandidate take_best(std::vector<RoleCandidate>& sweeps,
                        const std::function<Ends(const RoleCandidate&)>& ends_of,
                        const std::vector<RoleCandidate>& ways)
{
    const auto end = std::ranges::find_if(
        sweeps, [&](const RoleCandidate& way) { return way.irregular > sweeps.front().irregular; });
    const auto best = std::ranges::min_element(
        sweeps.begin(), end, {}, [&](const RoleCandidate& way) { return openness(ends_of(way), ways); });
    RoleCandidate taken = std::move(*best);
    sweeps.erase(best);
    if (sweeps.size() > kMostTrials) sweeps.resize(kMostTrials);
    return taken;
}

} // namespace

std::vector<RoleCandidate> best_sweeps(const Model& skin, const RunContext& context)
{
    const auto fails = [&](const RoleCandidate& way) { return !can_be_cut(skin, way.roles, context); };
    std::vector<RoleCandidate> all = role_candidates(skin, all_faces(skin), {}, context);
    const bool any = !all.empty();
    std::erase_if(all, fails);
    if (any && all.empty()) { // the likeliest cannot be swept; less likely ones may
        all = less_likely(skin, all_faces(skin), {}, std::not_fn(fails), context);
        std::erase_if(all, fails);
    }
    std::ranges::stable_sort(all, {}, &RoleCandidate::irregular);
    return all;
}

std::vector<RoleCandidate> less_likely(const Model& model, const std::vector<FaceId>& faces,
                                       RoleOptions options,
                                       const std::function<bool(const RoleCandidate&)>& suits,
                                       const RunContext& context)
{
    options.margin = kInfinity;
    const std::vector<RoleCandidate> all = role_candidates(model, faces, options, context);
    const auto first = std::ranges::find_if(all, suits);
    return {first, std::find_if(first, all.end(), [&](const RoleCandidate& candidate) {
                return candidate.cost > first->cost + RoleOptions{}.margin;
            })};
}

Classification class_as_given(const Model& model, const Roles& roles)
{
    OpenVolume open;
    open.role.assign(roles.source.size(), Role::source);
    open.role.insert(open.role.end(), roles.target.size(), Role::target);
    open.role.insert(open.role.end(), roles.walls.size(), Role::wall);
    open.model = extract(model, all_faces(roles));
    orient_consistently(open.model);
    return classify(open);
}

void set_ends(OpenVolume& volume, const Roles& roles)
{
    std::ranges::fill(volume.role, Role::wall);
    for (const FaceId f : roles.source) volume.role[f.index()] = Role::source;
    for (const FaceId f : roles.target) volume.role[f.index()] = Role::target;
    volume.turned_round = false;
}

void note_hole(const Model& model, FaceId through, const std::vector<FaceId>& given, const Sealed& sealed,
               Reading& reading)
{
    reading.holed = through.valid() ? through : open_hole(model, given, sealed.volume, sealed.closure);
    if (reading.holed.valid()) reading.guess = guess_of_hole(model, reading.holed);
}

std::optional<Reading> leave_holes_open(const Model& model, const std::vector<Reading>& readings,
                                        const std::vector<FaceId>& faces, const RunContext& context)
{
    const auto holed = std::ranges::find_if(readings, [](const Reading& r) { return r.holed.valid(); });
    if (holed == readings.end()) return std::nullopt;
    RoleCandidate roles;
    roles.roles.source = {holed->holed};
    std::ranges::copy_if(faces, std::back_inserter(roles.roles.walls),
                         [&](FaceId face) { return face != holed->holed; });
    roles.value = VolumeClass::IV;
    roles.reasons.push_back(
        formatted("{} has holes without walls, and the opposite end is missing; choose close{{ holes = "
                  "\"cover\" }} or close{{ holes = \"through\" }}",
                  entity_of(model, holed->holed)));
    Reading reading;
    reading.holed = holed->holed;
    // Faces that are connected to the others by missing faces alone cannot be walls.
    if (!unless_refused([&] { return take_open(model, std::move(roles), reading, context), true; }))
        return std::nullopt;
    if (reading.classification.value != VolumeClass::IV || holes_without_walls(reading.volume).empty())
        return std::nullopt;
    const HoleVolumes volumes = hole_volumes(reading.volume, {}, context);
    const auto is_one_of_both = [&](const Reading& other) {
        return same_volume(other.enclosed, volumes.covered.value_or(0)) ||
               same_volume(other.enclosed, volumes.through.value_or(0));
    };
    if (!std::ranges::all_of(readings, is_one_of_both)) return std::nullopt;
    reading.enclosed = volumes.covered.value_or(volumes.through.value_or(0));
    return reading;
}

std::optional<Reading> read(const Model& model, const std::vector<Void>& likelier, Void& found,
                            const RunContext& context)
{
    Reading reading;
    reading.enclosed = found.sealed.enclosed;
    if (found.untold || !found.filled.empty())
        reading.guess = guess_of_bent(found.sealed.volume, found.sealed.closure, RolesBy::finding);
    const RoleCandidate& first = found.first;
    const std::vector<FaceId> names = all_faces(first.roles);
    if (!reading.guess) note_hole(model, found.through, names, found.sealed, reading);
    reading.ways = std::max<std::size_t>(1, found.ways.size());
    std::vector<RoleCandidate> sweeps;
    // Class I: both ends and no walls are given, so no other sweep direction is tried.
    if (first.value != VolumeClass::I) {
        sweeps = best_sweeps(found.sealed.volume.model, context);
        add_sweeps_with_branches(found.sealed.volume.model, sweeps, context);
    }
    if (sweeps.empty() && !found.filled.empty()) sweeps.push_back(way_of(found.sealed.volume));
    if (sweeps.empty()) {
        take_open(model, first, reading, context);
        reading.sealed = std::move(found.sealed);
        return reading;
    }
    const auto ends_of = [&](const RoleCandidate& way) {
        return Ends{given_part(way.roles.source, names), given_part(way.roles.target, names)};
    };
    RoleCandidate best = take_best(sweeps, ends_of, found.ways);
    auto [source, target] = ends_of(best);
    if (source.faces.empty() && !target.faces.empty()) {
        std::swap(source, target);
        std::swap(best.roles.source, best.roles.target);
    }
    const auto is_same = [&](const RoleCandidate& way) { return has_ends(way, {source, target}); };
    for (const Void* other = likelier.data(); other != &found; ++other) {
        if (std::ranges::any_of(other->ways, is_same) || std::ranges::any_of(other->bent, is_same))
            return std::nullopt;
    }
    const auto same = std::ranges::find_if(found.ways, is_same);
    const long irregular = best.irregular;
    if (!sweeps.empty())
        reading.others = std::make_shared<const OtherSweeps>(OtherSweeps{found.sealed, std::move(sweeps)});
    if (same != found.ways.end()) {
        const bool as_sealed = same == found.ways.begin() && found.filled.empty() &&
                               !found.sealed.closure.void_faces.empty();
        take_open(model, *same, reading, context);
        if (as_sealed) reading.sealed = std::move(found.sealed);
        reading.roles.irregular = irregular;
    } else if (found.sealed.closure.void_faces.empty()) {
        for (std::vector<FaceId>* list : {&best.roles.source, &best.roles.target, &best.roles.walls})
            *list = given_part(*list, names).faces;
        take_open(model, std::move(best), reading, context);
    } else {
        reading.volume = std::move(found.sealed.volume);
        reading.closure = std::move(found.sealed.closure);
        set_ends(reading.volume, best.roles);
        reading.roles = std::move(best);
        reading.roles.roles = {source.faces, target.faces,
                               given_part(reading.roles.roles.walls, names).faces};
        reading.classification = class_as_given(model, reading.roles.roles);
        reading.roles.value = reading.classification.value;
        reading.roles.reasons.push_back(formatted(
            "{}, and swept between void faces",
            !found.filled.empty() ? found.filled : "sealed as " + in_words(model, first.roles, first.value)));
    }
    if (reading.ways > 1) reading.roles.reasons.push_back(ways_in_words(reading));
    return reading;
}

} // namespace lacuna::closure
