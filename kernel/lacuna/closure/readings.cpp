// SPDX-License-Identifier: MIT
#include <lacuna/closure/readings.h>

#include <lacuna/closure/detail/bowl.h>
#include <lacuna/closure/detail/class_five.h>
#include <lacuna/closure/detail/flat_fill.h>
#include <lacuna/closure/detail/membranes.h>
#include <lacuna/closure/steps.h>
#include <lacuna/core/error.h>
#include <lacuna/core/number_text.h>
#include <lacuna/geometry/facet_tree.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <string>

namespace lacuna::closure {

using namespace topology;

namespace {

/// As many readings of the given faces are sealed. A choice: some tenths of a second for 10,000 facets.
constexpr std::size_t kMostSealed = 24;
/// And as many are tried where one closes with a membrane. For the time: bent faces take long to close.
constexpr std::size_t kMostSettled = 3;
/// Volumes that differ by less than this share of the larger are as large: what chords leave out of round
/// faces, and more.
constexpr double kSameVolume = 5e-3;
/// And skins lie on each other where they are no further apart than this share of the cube root of what they
/// enclose. A choice, not a measurement.
constexpr double kSameSkin = 0.02;
/// And as many are tried where none of the likeliest seals. A choice as well.
constexpr std::size_t kMostTried = 50;
/// What void faces cost that are bent by a half turn: of two ways to close, the one with flat faces is
/// likelier. A choice, not a measurement.
constexpr double kBentVoid = 0.5;
/// What it costs to close by flat faces that are not one for each free loop: as `topology::role_candidates()`
/// counts no end at all. A choice.
constexpr double kFilled = 0.1;
/// As many other ways to sweep a void are kept. A choice: each may cost as much as the first.
constexpr std::size_t kMostOthers = 3;
/// As many readings are listed: what a person reads in a message.
constexpr std::size_t kMostListed = 8;

/// A reading of the given faces, sealed.
struct Sealed : SealedVolume {
    double enclosed = 0;
};

/// One void, and the readings that enclose it.
struct Void {
    double cost = 0;                 ///< of its likeliest reading, and of what closing bends
    RoleCandidate first;             ///< by which it was sealed
    Sealed sealed;                   ///< as that seals it
    std::vector<RoleCandidate> ways; ///< the likeliest first
    bool fills_flat_loops = false;   ///< all that is missing
    bool flat_filled = false;        ///< sealed by flat faces within the free loops, by no roles
};

/// Whether what is missing is one face for each of the free loops: nothing needs a void edge, and no face has
/// several loops.
bool fills_each_loop(const OpenVolume& open, std::size_t loops)
{
    const Classification found = classify(open);
    switch (found.value) {
    case VolumeClass::closed:
        return true;
    case VolumeClass::III: // every vertex of both ends is on a wall, which leads to the other
        return found.wall_free_source.empty() && found.wall_free_target.empty();
    case VolumeClass::IV:
        return loops == 1;
    case VolumeClass::V:
        return loops == 2;
    default:
        return false;
    }
}

std::optional<Sealed> seal(const Model& model, const Roles& roles, const RunContext& context)
{
    try {
        Sealed sealed;
        sealed.volume = open_volume(model, roles, context);
        if (!roles.source.empty() && !roles.target.empty() && !free_edges(sealed.volume).empty())
            sealed.match = matching::match(sealed.volume, {}, context);
        sealed.closure = close(sealed.volume, sealed.match, {.hints = false}, context);
        sealed.enclosed = enclosed_volume(sealed.volume);
        return sealed;
    } catch (const InvalidInput&) {
        return std::nullopt;
    } catch (const NotClosed&) {
        return std::nullopt;
    }
}

bool has_membranes(const Sealed& sealed)
{
    return !membranes(sealed.volume.model, sealed.closure.void_faces).empty();
}

/// The void faces of a volume.
geometry::FacetTree void_facets(const Sealed& sealed)
{
    std::vector<Triangle> facets;
    for (const FaceId face : sealed.closure.void_faces) {
        const std::vector<Triangle>& own = sealed.volume.model[face].triangles;
        facets.insert(facets.end(), own.begin(), own.end());
    }
    return {sealed.volume.model.points, facets};
}

/// Whether the corners and the middles of one volume's void facets lie near those of another.
bool lies_on(const Sealed& sealed, const geometry::FacetTree& other, double near)
{
    const Model& model = sealed.volume.model;
    const auto on = [&](const Vec3& p) { return other.closest(p, near * near).triangle >= 0; };
    for (const FaceId face : sealed.closure.void_faces) {
        for (const Triangle& t : model[face].triangles) {
            if (!on((model.at(t[0]) + model.at(t[1]) + model.at(t[2])) / 3)) return false;
            for (const Index p : t)
                if (!on(model.at(p))) return false;
        }
    }
    return true;
}

bool enclose_the_same(const Sealed& a, const Sealed& b)
{
    const double larger = std::max(a.enclosed, b.enclosed);
    if (std::abs(a.enclosed - b.enclosed) > kSameVolume * larger) return false;
    const double near = kSameSkin * std::cbrt(larger);
    return lies_on(a, void_facets(b), near) && lies_on(b, void_facets(a), near);
}

/// Whether a reading only fills flat free loops, which any other that does fills alike.
bool fills_flat_loops(const Model& model, const Roles& roles, const RunContext& context)
{
    try {
        const OpenVolume open = open_volume(model, roles, context);
        const std::vector<Rim> loops = free_loops(open);
        return fills_each_loop(open, loops.size()) &&
               std::all_of(loops.begin(), loops.end(),
                           [&](const Rim& rim) { return is_flat(open.model, rim); });
    } catch (const InvalidInput&) {
        return false; // sealing it says no as well
    }
}

/// How unlikely a void is: by its ends, and by how far its void faces are from flat.
double cost_of(const RoleCandidate& candidate, const Sealed& sealed)
{
    const Model& model = sealed.volume.model;
    double bent = 0, whole = 0;
    for (const FaceId face : sealed.closure.void_faces) {
        const double area = face_area(model, face);
        // As ends are judged: four times, so that 90° costs 0.4 of what a half turn does.
        bent += std::min(area, 4 * (area - face_area_vector(model, face).norm()));
        whole += area;
    }
    return candidate.cost + (whole > 0 ? kBentVoid * bent / whole : 0);
}

void keep_likely(std::vector<Void>& found)
{
    std::stable_sort(found.begin(), found.end(),
                     [](const Void& a, const Void& b) { return a.cost < b.cost; });
    std::erase_if(found, [&, least = found.empty() ? 0 : found.front().cost](const Void& v) {
        return v.cost > least + RoleOptions{}.margin;
    });
}

/// Readings of the given faces, sealed and sorted by what they enclose.
/// @param most     as many are sealed
/// @param settled  leave out those that close with a membrane, and count those that do not seal too
std::vector<Void> voids(const Model& model, const std::vector<RoleCandidate>& candidates, std::size_t most,
                        bool settled, const RunContext& context)
{
    std::vector<Void> found;
    std::size_t sealed = 0;
    for (const RoleCandidate& candidate : candidates) {
        check_cancelled(context);
        const bool flat = fills_flat_loops(model, candidate.roles, context);
        const auto filled = std::find_if(found.begin(), found.end(),
                                         [&](const Void& v) { return flat && v.fills_flat_loops; });
        if (filled != found.end()) {
            filled->ways.push_back(candidate);
            continue;
        }
        if (sealed == most) break;
        std::optional<Sealed> now = seal(model, candidate.roles, context);
        if (now || settled) ++sealed;
        if (!now || (settled && has_membranes(*now))) continue;
        auto same = std::find_if(found.begin(), found.end(),
                                 [&](const Void& v) { return enclose_the_same(v.sealed, *now); });
        if (same == found.end())
            same = found.insert(found.end(),
                                Void{cost_of(candidate, *now), candidate, std::move(*now), {}, false});
        same->ways.push_back(candidate);

        same->fills_flat_loops = same->fills_flat_loops || flat;
    }
    keep_likely(found);
    return found;
}

/// The one void that readings without steps enclose, however unlikely, closed without a membrane; what of
/// several is meant, nobody knows.
std::optional<Void> settled_void(const Model& model, std::vector<RoleCandidate> candidates,
                                 const RunContext& context)
{
    std::erase_if(candidates, [&](const RoleCandidate& candidate) {
        return connected_parts(model, candidate.roles.source).size() > 1 ||
               connected_parts(model, candidate.roles.target).size() > 1;
    });
    std::vector<Void> found = voids(model, candidates, kMostSettled, true, context);
    if (found.size() != 1 || has_steps(found.front().sealed.volume, context)) return std::nullopt;
    return std::move(found.front());
}

/// Whether a way over a closed skin can be swept in pieces, where an end lies at several heights.
bool can_be_cut(const Model& skin, const Roles& roles, const RunContext& context)
{
    OpenVolume volume{skin, std::vector<Role>(skin.faces.size(), Role::wall), {}, false};
    for (const FaceId f : roles.source) volume.role[f.index()] = Role::source;
    for (const FaceId f : roles.target) volume.role[f.index()] = Role::target;
    try {
        if (has_steps(volume, context)) cut_steps(volume, context);
        return true;
    } catch (const NotSweepable&) {
        return false;
    }
}

/// The ways to sweep a closed skin about as likely as the likeliest that can be cut where it has to be: those
/// with the fewest irregular nodes first, and of these the ones with the most even cells.
std::vector<RoleCandidate> best_sweeps(const Model& skin, const RunContext& context)
{
    const auto fails = [&](const RoleCandidate& way) { return !can_be_cut(skin, way.roles, context); };
    const RoleOptions near;
    std::vector<RoleCandidate> all = role_candidates(skin, all_faces(skin), near, context);
    const bool any = !all.empty();
    std::erase_if(all, fails);
    if (any && all.empty()) { // the likeliest cannot be swept; what comes after them may
        RoleOptions far;
        far.margin = std::numeric_limits<double>::infinity();
        all = role_candidates(skin, all_faces(skin), far, context);
        all.erase(all.begin(), std::ranges::find_if_not(all, fails));
        std::erase_if(all, [&, least = all.empty() ? 0 : all.front().cost](const RoleCandidate& way) {
            return way.cost > least + near.margin || fails(way);
        });
    }
    std::stable_sort(all.begin(), all.end(), [](const RoleCandidate& a, const RoleCandidate& b) {
        return a.irregular < b.irregular;
    });
    return all;
}

/// The faces of a sealed volume that were given, as the model knows them, and whether there are others.
struct GivenPart {
    std::vector<FaceId> faces; ///< rising
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
    std::sort(part.faces.begin(), part.faces.end());
    return part;
}

/// The ends of a way over a sealed skin, as the model knows them.
struct Ends {
    GivenPart source, target;
};

std::vector<FaceId> rising(std::vector<FaceId> faces)
{
    std::sort(faces.begin(), faces.end());
    return faces;
}

std::string plain(double value) { return with_digits(value, 4); }

std::string ways_in_words(const Reading& reading)
{
    if (reading.ways == 1) return {};
    return std::to_string(reading.ways) + " readings enclose the same volume, " + plain(reading.enclosed) +
           "; of the likely ones this is swept with the fewest irregular nodes, " +
           std::to_string(reading.roles.irregular) + " on its source at least, and the most even cells";
}

/// The class by which the given faces alone go, with their roles on a sealed skin.
Classification class_as_given(const Model& model, const Roles& roles)
{
    OpenVolume open;
    std::vector<FaceId> faces;
    for (const auto& [list, role] : {std::pair{&roles.source, Role::source},
                                     {&roles.target, Role::target},
                                     {&roles.walls, Role::wall}}) {
        faces.insert(faces.end(), list->begin(), list->end());
        open.role.insert(open.role.end(), list->size(), role);
    }
    open.model = extract(model, faces);
    orient_consistently(open.model);
    Classification found = classify(open);
    return found;
}

/// Open a volume by roles of the model's faces.
void take_open(const Model& model, RoleCandidate roles, Reading& reading, const RunContext& context)
{
    reading.volume = open_volume(model, roles.roles, context);
    reading.classification = classify(reading.volume);
    reading.roles = std::move(roles);
}

/// Give the faces of a sealed volume the roles of one way to sweep it.
void set_ends(OpenVolume& volume, const Roles& roles)
{
    std::fill(volume.role.begin(), volume.role.end(), Role::wall);
    for (const FaceId f : roles.source) volume.role[f.index()] = Role::source;
    for (const FaceId f : roles.target) volume.role[f.index()] = Role::target;
    volume.turned_round = false;
}

/// Whether a reading of the given faces has these ends, whichever is the source.
bool has_ends(const RoleCandidate& way, const Ends& ends)
{
    for (const GivenPart* end : {&ends.source, &ends.target})
        if (!end->all && !end->faces.empty()) return false; // given faces and others in one end
    const std::vector<FaceId> s = rising(way.roles.source), t = rising(way.roles.target);
    return (s == ends.source.faces && t == ends.target.faces) ||
           (t == ends.source.faces && s == ends.target.faces);
}

/// Of sweeps as good as each other that with open ends first, both or one: what is missing is how one gets
/// into a bore or a pocket. Then those whose ends were given, then those between faces that closing makes.
std::size_t openness(const Ends& ends, const std::vector<RoleCandidate>& ways)
{
    const auto same = std::find_if(ways.begin(), ways.end(),
                                   [&](const RoleCandidate& way) { return has_ends(way, ends); });
    if (same == ways.end()) return 3;
    return same->value == VolumeClass::V ? 0 : same->value == VolumeClass::IV ? 1 : 2;
}

/// Take the best of the ways to sweep a void out of the rest, which come first as they are the better.
RoleCandidate take_best(std::vector<RoleCandidate>& sweeps,
                        const std::function<Ends(const RoleCandidate&)>& ends_of,
                        const std::vector<RoleCandidate>& ways)
{
    const auto end = std::find_if(sweeps.begin(), sweeps.end(), [&](const RoleCandidate& way) {
        return way.irregular > sweeps.front().irregular;
    });
    const auto best = std::min_element(sweeps.begin(), end,
                                       [&](const RoleCandidate& a, const RoleCandidate& b) {
                                           return openness(ends_of(a), ways) < openness(ends_of(b), ways);
                                       });
    RoleCandidate taken = std::move(*best);
    sweeps.erase(best);
    if (sweeps.size() > kMostOthers) sweeps.resize(kMostOthers);
    return taken;
}

/// A void, to be swept the best way. Nothing where a likelier void is what these ends enclose.
std::optional<Reading> read(const Model& model, const std::vector<Void>& likelier, Void& found,
                            const RunContext& context)
{
    Reading reading;
    reading.enclosed = found.sealed.enclosed;
    reading.ways = std::max<std::size_t>(1, found.ways.size());
    const RoleCandidate& first = found.first;
    std::vector<FaceId> as_named = first.roles.source; // in the order open_volume() takes them
    as_named.insert(as_named.end(), first.roles.target.begin(), first.roles.target.end());
    as_named.insert(as_named.end(), first.roles.walls.begin(), first.roles.walls.end());
    std::vector<RoleCandidate> sweeps;
    // Two ends alone were given as such.
    if (first.value != VolumeClass::I) sweeps = best_sweeps(found.sealed.volume.model, context);
    if (sweeps.empty()) {
        take_open(model, first, reading, context);
        reading.sealed = std::move(found.sealed);
        return reading;
    }
    const auto ends_of = [&](const RoleCandidate& way) {
        return Ends{given_part(way.roles.source, as_named), given_part(way.roles.target, as_named)};
    };
    RoleCandidate best = take_best(sweeps, ends_of, found.ways);
    auto [source, target] = ends_of(best);
    if (source.faces.empty() && !target.faces.empty()) {
        std::swap(source, target);
        std::swap(best.roles.source, best.roles.target);
    }
    const auto is_same = [&](const RoleCandidate& way) { return has_ends(way, {source, target}); };
    for (const Void* other = likelier.data(); other != &found; ++other) {
        if (std::any_of(other->ways.begin(), other->ways.end(), is_same)) return std::nullopt;
    }
    const auto same = std::find_if(found.ways.begin(), found.ways.end(), is_same);
    const long irregular = best.irregular;
    if (!sweeps.empty())
        reading.others = std::make_shared<const OtherSweeps>(
            OtherSweeps{found.sealed.volume, found.sealed.closure, std::move(sweeps)});
    if (same != found.ways.end()) {
        const bool as_sealed = same == found.ways.begin() && !found.flat_filled &&
                               !found.sealed.closure.void_faces.empty();
        take_open(model, *same, reading, context);
        if (as_sealed) reading.sealed = std::move(found.sealed);
        reading.roles.irregular = irregular;
    } else if (found.sealed.closure.void_faces.empty()) {
        for (std::vector<FaceId>* list : {&best.roles.source, &best.roles.target, &best.roles.walls})
            *list = given_part(*list, as_named).faces;
        take_open(model, std::move(best), reading, context);
    } else {
        reading.volume = std::move(found.sealed.volume);
        reading.closure = std::move(found.sealed.closure);
        set_ends(reading.volume, best.roles);
        reading.roles = std::move(best);
        reading.roles.roles = {source.faces, target.faces,
                               given_part(reading.roles.roles.walls, as_named).faces};
        reading.classification = class_as_given(model, reading.roles.roles);
        reading.roles.value = reading.classification.value;
        const std::string how = found.flat_filled ? "sealed by flat faces within its free loops"
                                                  : "sealed as " + in_words(model, first.roles, first.value);
        reading.roles.reasons.push_back(how + ", and swept between faces that closing made");
    }
    if (reading.ways > 1) reading.roles.reasons.push_back(ways_in_words(reading));
    return reading;
}

/// The void that flat faces close, where these are not one for each free loop.
std::optional<Void> fill_flat(const Model& model, const std::vector<FaceId>& faces, const RunContext& context)
{
    auto filled = fill_flat_loops(model, faces, context);
    if (!filled || filled->each_alone) return std::nullopt;
    const std::vector<RoleCandidate> sweeps = best_sweeps(filled->volume.model, context);
    if (sweeps.empty()) return std::nullopt;
    Void found;
    found.first.roles.walls = faces;
    const auto likeliest = std::ranges::min_element(sweeps, {}, &RoleCandidate::cost);
    found.cost = kFilled + likeliest->cost;
    found.sealed.volume = std::move(filled->volume);
    found.sealed.closure = std::move(filled->closure);
    found.sealed.enclosed = enclosed_volume(found.sealed.volume);
    found.flat_filled = true;
    return found;
}

/// A hollow whose bottom goes over into its walls smoothly, parted where it bends.
std::optional<Reading> read_bowl(const Model& model, const std::vector<FaceId>& faces,
                                 const RunContext& context)
{
    auto filled = fill_flat_loops(model, faces, context);
    if (!filled) return std::nullopt;
    auto bowl = part_bowl(filled->volume, context);
    if (!bowl) return std::nullopt;
    Reading reading;
    Roles& roles = reading.roles.roles;
    for (std::size_t f = 0; f < bowl->parent.size(); ++f) {
        const std::size_t given = bowl->parent[f].index();
        if (given >= faces.size()) continue;
        const Role role = bowl->volume.role[f];
        std::vector<FaceId>& list = role == Role::source   ? roles.source
                                    : role == Role::target ? roles.target
                                                           : roles.walls;
        if (std::ranges::find(list, faces[given]) == list.end()) list.push_back(faces[given]);
    }
    reading.classification.value = filled->closure.void_faces.empty() ? VolumeClass::closed
                                   : roles.target.empty()             ? VolumeClass::IV
                                                                      : VolumeClass::III;
    reading.classification.reasons.push_back(
        "the bottom goes over into the walls smoothly; it is parted from them " +
        with_digits(bowl->depth, 4) + " below " + name_of(bowl->volume.model, bowl->mouth) +
        ", where it bends");
    reading.roles.value = reading.classification.value;
    reading.roles.reasons = reading.classification.reasons;
    reading.volume = std::move(bowl->volume);
    reading.closure = std::move(filled->closure);
    reading.enclosed = enclosed_volume(reading.volume);
    return reading;
}

/// A tube with one end open all over and in the other a floor round a narrower bore: a counterbore without
/// the bore. The floor is the source, with the flat face that closes the bore.
std::optional<Reading> read_floor(const Model& model, const std::vector<FaceId>& faces,
                                  const RunContext& context)
{
    const Roles walls{{}, {}, faces};
    std::vector<FaceId> low, high;
    try {
        OpenVolume open = open_volume(model, walls, context); // numbers the faces as they are listed
        if (free_loops(open).size() != 2 || connected_parts(open.model, open.faces(Role::wall)).size() != 1)
            return std::nullopt;
        const EndLoops ends = group_loops(open);
        low = floors_round(open, ends.source);
        high = floors_round(open, ends.target);
    } catch (const InvalidInput&) {
        return std::nullopt; // other readings say why, or get on without
    }
    if (low.empty() == high.empty()) return std::nullopt; // two floors are the ends of a ring
    const std::optional<Sealed> sealed = seal(model, walls, context);
    if (!sealed) return std::nullopt;
    Reading reading;
    reading.volume = sealed->volume;
    reading.closure = sealed->closure;
    reading.enclosed = sealed->enclosed;
    if (low.empty()) {
        for (Role& role : reading.volume.role)
            role = role == Role::source ? Role::target : role == Role::target ? Role::source : role;
    }
    Roles& roles = reading.roles.roles;
    for (std::size_t f = 0; f < faces.size(); ++f)
        (reading.volume.role[f] == Role::source ? roles.source : roles.walls).push_back(faces[f]);
    reading.classification = class_as_given(model, roles);
    reading.roles.value = reading.classification.value;
    reading.roles.reasons.push_back(name_of(model, roles.source.front()) +
                                    " is a floor round a narrower bore, and the bore is closed there");
    return reading;
}

/// Add a void that flat faces close, unless it is one of those known: then that is closed by the fewer faces.
/// Only those about as likely as the likeliest stay.
void add_filled(std::vector<Void>& found, Void filled)
{
    const auto known = std::ranges::find_if(
        found, [&](const Void& v) { return enclose_the_same(v.sealed, filled.sealed); });
    if (known == found.end()) {
        found.push_back(std::move(filled));
    } else if (filled.sealed.closure.void_faces.size() < known->sealed.closure.void_faces.size()) {
        known->first = std::move(filled.first);
        known->sealed = std::move(filled.sealed);
        known->flat_filled = true;
    }
    keep_likely(found);
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
    if (auto floor = read_floor(model, faces, context)) return {std::move(*floor)};
    const RoleOptions near;
    std::vector<Void> found = voids(model, role_candidates(model, faces, near, context), kMostSealed, false,
                                    context);
    RoleOptions far;
    far.margin = std::numeric_limits<double>::infinity();
    far.most = kMostTried;
    if (found.empty()) { // the likeliest do not seal; what comes after them may
        const std::vector<RoleCandidate> all = role_candidates(model, faces, far, context);
        const auto seals = std::find_if(all.begin(), all.end(), [&](const RoleCandidate& candidate) {
            return seal(model, candidate.roles, context).has_value();
        });
        const auto end = std::find_if(seals, all.end(), [&](const RoleCandidate& candidate) {
            return candidate.cost > seals->cost + near.margin;
        });
        found = voids(model, {seals, end}, kMostSealed, false, context);
    }
    if (!found.empty() && has_membranes(found.front().sealed)) {
        // What it encloses is a guess; where the rims say how void faces go it is none.
        auto settled = settled_void(model, role_candidates(model, faces, far, context), context);
        if (settled) {
            found.clear();
            found.push_back(std::move(*settled));
        }
    }
    if (auto filled = fill_flat(model, faces, context)) add_filled(found, std::move(*filled));
    std::vector<Reading> readings;
    for (Void& now : found) {
        if (auto reading = read(model, found, now, context)) readings.push_back(std::move(*reading));
    }
    if (readings.empty()) {
        if (auto bowl = read_bowl(model, faces, context)) readings.push_back(std::move(*bowl));
    }
    return readings;
}

Reading find_reading(const Model& model, const std::vector<FaceId>& faces, int number,
                     const RunContext& context)
{
    if (faces.empty())
        throw InvalidInput("topology.no_faces",
                           "the model has no faces to find a volume in; load a file that "
                           "has some, or add_face{ points =, cells = }");
    std::vector<Reading> readings = find_readings(model, faces, context);
    if (readings.empty()) {
        std::string tags;
        for (const FaceId face : faces) tags += (tags.empty() ? "" : ", ") + std::to_string(model[face].tag);
        throw InvalidInput("topology.no_roles",
                           "no reading of the faces " + tags +
                               " as source, target and walls of one sweep was found; name the roles: "
                               "open_volume{ source = …, target = …, walls = … }");
    }
    if (number == 0 && readings.size() == 1) return std::move(readings.front());
    const auto place = static_cast<std::size_t>(number);
    if (number >= 1 && place <= readings.size()) return std::move(readings[place - 1]);
    std::string text;
    for (std::size_t i = 0; i < std::min(readings.size(), kMostListed); ++i) {
        text += "\n  " + std::to_string(i + 1) + ": volume " + plain(readings[i].enclosed) + ", " +
                in_words(model, readings[i].roles.roles, readings[i].roles.value);
    }
    if (readings.size() > kMostListed) text += "\n  … (" + std::to_string(readings.size()) + " in all)";
    if (number == 0) {
        throw InvalidInput("topology.roles_ambiguous",
                           "the faces enclose different volumes by readings about as likely; take one of "
                           "them by open_volume{ faces = …, reading = 1 }, or name its roles:" +
                               text);
    }
    throw InvalidInput("topology.no_such_reading", "there is no reading " + std::to_string(number) +
                                                       " of the faces; those about as "
                                                       "likely are:" +
                                                       text);
}

} // namespace lacuna::closure
