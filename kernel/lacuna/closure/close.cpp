// SPDX-License-Identifier: MIT
#include <lacuna/closure/close.h>

#include <lacuna/closure/detail/axis_rims.h>
#include <lacuna/closure/detail/close_class.h>
#include <lacuna/closure/detail/close_trial.h>
#include <lacuna/closure/detail/end_holes.h>
#include <lacuna/closure/detail/guesses.h>
#include <lacuna/closure/detail/moved_end.h>
#include <lacuna/closure/detail/no_roles.h>
#include <lacuna/closure/detail/sealing.h>
#include <lacuna/closure/detail/smooth_ends.h>
#include <lacuna/closure/detail/stubs.h>
#include <lacuna/closure/detail/void_edges.h>
#include <lacuna/core/error.h>
#include <lacuna/core/shared/attempt.h>
#include <lacuna/core/shared/criteria.h>
#include <lacuna/core/shared/list_text.h>
#include <lacuna/geometry/shared/angle.h>
#include <lacuna/topology/shared/face_parts.h>
#include <lacuna/topology/shared/face_plane.h>
#include <lacuna/topology/shared/names_of.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <set>

namespace lacuna::closure {

using namespace topology;

namespace {

/// @throw NotClosed  an edge is not used twice in opposite directions, or the enclosed volume is not
///         positive.
void prove_sealed(const OpenVolume& volume)
{
    const Model& model = volume.model;
    if (const std::optional<EdgeId> edge = unpaired_edge(model)) {
        const std::span<const FaceUse> uses = model.uses_of_edge(*edge);
        throw NotClosed(
            Message("closure.not_watertight",
                    "after closing, {} belongs to {} face{}{} instead of two faces that use it in "
                    "opposite directions",
                    entity_of(model, *edge), found(uses.size()), uses.size() == 1 ? "" : "s",
                    uses.size() == 2 ? " that use it in the same direction" : "")
                .remedy("check the faces next to it"));
    }
    if (!(enclosed_volume(volume) > 0)) {
        throw NotClosed(
            Message("closure.no_volume",
                    "the sealed faces enclose a volume of {:.3g}, which is not positive: source and "
                    "target coincide, or the faces between them are twisted",
                    found(enclosed_volume(volume)))
                .remedy("check the roles, or pair vertices with match{{ vertices = … }}"));
    }
}

bool has_two_ends(VolumeClass value)
{
    return value == VolumeClass::I || value == VolumeClass::II || value == VolumeClass::III;
}

/// @throw InvalidInput  an option that does not apply to the class.
void check_options(const OpenVolume& volume, VolumeClass value, const std::vector<EndHole>& holes,
                   const CloseOptions& options)
{
    if (options.holes != Holes::automatic && holes.empty()) {
        throw InvalidInput(
            Message("closure.holes_unused",
                    "the option 'holes' applies only to holes without walls in a given end, and there are "
                    "none")
                .remedy("leave 'holes' out"));
    }
    if (!options.void_edges.empty() && !has_two_ends(value)) {
        if (value == VolumeClass::closed)
            throw InvalidInput(
                Message("closure.void_edges_unused",
                        "the option 'void_edges' replaces missing walls, and no wall is missing")
                    .remedy("leave 'void_edges' out"));
        throw InvalidInput(
            Message("closure.void_edges_unused",
                    "the option 'void_edges' joins a given source and target, and a volume of class {} lacks "
                    "one of these",
                    found(to_string(value)))
                .remedy("leave 'void_edges' out, or name both ends"));
    }
    if (options.cap == Cap::automatic || value == VolumeClass::IV) return;
    if (value == VolumeClass::V && options.cap == Cap::flat) return;
    if (value == VolumeClass::V)
        throw InvalidInput(Message("closure.cap_unused",
                                   "cap = \"parallel\" copies the shape of the given end, but both ends are "
                                   "missing (class V)")
                               .remedy("use cap = \"flat\", or name the source"));
    throw InvalidInput(
        Message("closure.cap_unused",
                "the option 'cap' sets the shape of a missing end, but {} and {} are both given",
                entity_of(volume.model, volume.faces(Role::source).front()),
                entity_of(volume.model, volume.faces(Role::target).front()))
            .remedy("leave 'cap' out"));
}

/// Angle between the normals of the two ends, both taken in the direction from source to target [radian]. 0
/// if an end faces all around, as a tube does, because it has no mean normal.
double lean_of(const OpenVolume& volume)
{
    const Model& model = volume.model;
    const std::vector<FaceId> source = volume.faces(Role::source), target = volume.faces(Role::target);
    const auto faces_all_round = [&](const std::vector<FaceId>& end) {
        double area = 0;
        for (const FaceId face : end) area += face_area(model, face);
        return area_vector_of(model, end).norm() < kParallel * area;
    };
    if (faces_all_round(source) || faces_all_round(target)) return 0;
    const Vec3 way = centroid_of(model, target) - centroid_of(model, source);
    const auto facing = [&](const std::vector<FaceId>& end) -> Vec3 {
        const Vec3 normal = area_vector_of(model, end).stableNormalized();
        return normal.dot(way) < 0 ? Vec3(-normal) : normal;
    };
    return geometry::angle_between(facing(source), facing(target));
}

/// Above this angle between the ends (`lean_of()`), ends without walls are joined by smooth edges, because
/// straight edges would meet both ends at small angles. Up to this angle, edges are straight.
constexpr double kBend = 100 * kDegree;
/// Above this angle between the ends, straight and smooth edges are both plausible; a note reports the
/// alternative.
constexpr double kLean = 20 * kDegree;

/// Whether both ends are flat and all their rims are circles. A straight tube has no two such ends that are
/// inclined to each other.
bool has_round_ends(const OpenVolume& volume)
{
    const Model& model = volume.model;
    const auto is_round = [&](Role end) {
        const std::vector<FaceId> faces = volume.faces(end);
        const auto plane = plane_of(model, faces.front());
        const auto in_plane = [&](FaceId face) { return lies_in_plane(model, face, *plane); };
        return plane && std::ranges::all_of(faces, in_plane) &&
               std::ranges::all_of(rims(model, faces),
                                   [&](const Rim& rim) { return radius_of_circle(model, rim).has_value(); });
    };
    return is_round(Role::source) && is_round(Role::target);
}

/// Relative difference between an alternative volume and the volume `taken`; 0 if the alternative cannot be
/// sealed.
double share_between(double taken, const std::optional<double>& other)
{
    return other ? std::abs(*other - taken) / taken : 0;
}

/// A shape as a recipe names it. @pre not automatic
const char* word(EdgeShape shape)
{
    return shape == EdgeShape::straight ? "straight" : shape == EdgeShape::follow ? "follow" : "smooth";
}

/// Whether an option asks for a shape.
bool asks_for_shape(const CloseOptions& options)
{
    return options.edge_shape != EdgeShape::automatic || !options.void_edges.empty() ||
           options.cap != Cap::automatic;
}

/// The options of close(), and whether the call comes from close_trial().
struct Asked : CloseOptions {
    bool trial = false;
};

/// Seals an open volume of a given `VolumeClass`: tries several shapes of the void edges and ends in turn.
class Sealer {
public:
    /// @param lines  side lines of the volume; empty: they are found when needed.
    Sealer(const OpenVolume& volume, const std::optional<std::vector<matching::SideLine>>& lines,
           VolumeClass value, const Asked& options, const RunContext& context)
        : volume_(volume), lines_(lines), value_(value), options_(options), context_(context)
    {
        const bool has_walls = value == VolumeClass::II || value == VolumeClass::III;
        if (has_walls && options.edge_shape != EdgeShape::straight) look_at_walls();
        if (options.edge_shape == EdgeShape::follow && !leads()) {
            throw NotClosed(Message("closure.nothing_to_follow",
                                    "edge_shape = \"follow\" needs a given wall that "
                                    "joins source and target, and there is none")
                                .remedy("use \"straight\" or \"smooth\""));
        }
    }

    /// Seal with the first of the `wanted()` methods that succeeds, and check the result.
    Closed seal(const matching::Match& match)
    {
        std::optional<Outcome<Closed>> first;
        for (const Way& way : wanted()) {
            auto closed = attempt<NotClosed>([&] {
                Closed sealed = seal_as(way, match);
                add_ambiguity_notes(way, match, sealed);
                say_what_is_open(sealed);
                return sealed;
            });
            if (closed) return std::move(*closed);
            if (!first) first = std::move(closed);
        }
        if (options_.trial) first->raise();
        throw NotClosed(with_what_helps(*first->why, match));
    }

private:
    void look_at_walls()
    {
        if (!follower_)
            follower_.emplace(volume_, lines_ ? *lines_ : matching::side_lines(volume_, context_), context_);
    }

    [[nodiscard]] bool leads() const { return follower_ && follower_->leads(); }

    /// The closing methods to try, in order. If an option sets the shape, only this shape is tried. Otherwise
    /// the first shape of void edges is:
    /// - between two ends with walls that join them: `follow` if the walls are bent
    ///   (`Follower::leads_astray()`), otherwise `straight`;
    /// - between two ends without such walls: `smooth` if the angle between the ends exceeds `kBend`, or if
    ///   it exceeds `kLean` and all rims are circles, as at an elbow; otherwise `straight`.
    std::vector<Way> wanted() const
    {
        if (value_ == VolumeClass::IV) {
            if (options_.cap == Cap::automatic)
                return {{EdgeShape::straight, Cap::flat, true}, {EdgeShape::straight, Cap::parallel}};
            return {{EdgeShape::straight, options_.cap}};
        }
        if (options_.edge_shape != EdgeShape::automatic) return {{options_.edge_shape}};
        if (!has_two_ends(value_)) return {{EdgeShape::straight}};
        std::vector<Way> ways{{EdgeShape::straight}};
        const double lean = leads() ? 0 : lean_of(volume_);
        if (lean > kBend || (lean > kLean && has_round_ends(volume_)))
            return {{EdgeShape::smooth}, {EdgeShape::straight}};
        if (leads()) ways.insert(follower_->leads_astray() ? ways.begin() : ways.end(), {EdgeShape::follow});
        ways.push_back({EdgeShape::smooth});
        return ways;
    }

    /// Report the other possible shape of the void edges and the volume that it encloses. Between inclined
    /// ends without walls, the two shapes are straight and smooth. Beside bent walls, and along a loop
    /// without walls, they are straight and following the given walls.
    void add_ambiguity_notes(const Way& way, const matching::Match& match, Closed& closed)
    {
        Closure& closure = closed.closure;
        if (!has_two_ends(value_) || options_.edge_shape != EdgeShape::automatic ||
            !options_.void_edges.empty())
            return;
        const bool straight = way.edges == EdgeShape::straight, follows = way.edges == EdgeShape::follow;
        const double lean = leads() || closure.void_edges.empty() ? 0 : lean_of(volume_);
        const auto is_bare = [](double share) { return share == 1; };
        if (leads() ? !(straight && follower_->bow() > kVolumeNoted / 2) &&
                          !(follows && std::ranges::any_of(shares_without_walls(volume_), is_bare))
                    : !(lean > kLean))
            return;
        const EdgeShape other = !straight ? EdgeShape::straight
                                : leads() ? EdgeShape::follow
                                          : EdgeShape::smooth;
        const double taken = enclosed_volume(closed.volume);
        std::optional<double> instead;
        if (!options_.trial) instead = volume_sealed_as({other}, match);
        const double share = share_between(taken, instead);
        if (leads() && !(share > kSameVolume))
            return; // beside bent walls the alternative is reported only if the volumes differ; between
                    // inclined ends it always is
        const std::string text =
            follows
                ? "a loop of the source has no wall, and void faces there follow the walls of another loop"
            : leads()
                ? "void edges are straight next to given walls that bend"
                : formatted("the angle between the ends is {:.3g}° and no given wall determines the bend "
                            "between them: void edges are {}",
                            lean * 180 / std::numbers::pi,
                            straight ? "straight" : "curves that leave both ends square");
        const std::string alternative = instead
                                            ? formatted("encloses {:.4g} instead of {:.4g}", *instead, taken)
                                            : "is the alternative";
        assume(closure,
               {follows   ? "closure.loop_follows"
                : leads() ? "closure.straight_assumed"
                          : "closure.bend_assumed",
                "{}; close{{ edge_shape = \"{}\" }} {}", text, word(other), alternative},
               share);
    }

    /// Note three kinds of ambiguity:
    /// - a missing end with missing walls is closed by several flat faces;
    /// - the rim of a void face does not determine the inside of the face;
    /// - a void face may close off a pocket.
    void say_what_is_open(Closed& closed) const
    {
        auto& [sealed, closure] = closed;
        if (value_ == VolumeClass::IV && !closure.void_edges.empty())
            assume_walls(sealed,
                         {"closure.walls_filled",
                          "the walls beside the missing target stop below it and are continued by flat faces "
                          "that meet in straight edges"},
                         closure);
        note_open_rims(sealed, options_.roles_by, closure);
        note_joined_rims(sealed, options_.roles_by, closure);
        if (asks_for_shape(options_)) closure.assumptions.clear();
        note_closed_holes(volume_.model, all_faces(volume_.model), sealed, options_.roles_by, closure);
    }

    Closed seal_as(const Way& way, const matching::Match& match) const
    {
        OpenVolume sealed = volume_;
        const Tools tools{way, leads() ? &*follower_ : nullptr, options_.void_edges, context_};
        Closure closure = close_as(sealed, match, value_, tools);
        if (const auto crossing = first_crossing(sealed, context_)) {
            throw NotClosed(Message("closure.faces_cross", "{} of the closing would cross {}",
                                    entity_of(sealed.model, crossing->first),
                                    entity_of(sealed.model, crossing->second))
                                .remedy("give the missing face there, close with another 'edge_shape', 'cap' "
                                        "or 'void_edges', or pair other loops with match{{ loops = … }}"));
        }
        prove_sealed(sealed);
        closure.watertight = true;
        return {std::move(sealed), std::move(closure)};
    }

    /// The volume that is enclosed if `way` is used; empty if sealing fails.
    std::optional<double> volume_sealed_as(const Way& way, const matching::Match& match) const
    {
        return unless_refused([&] { return enclosed_volume(seal_as(way, match).volume); });
    }

    /// The error `failed` with a remedy. Other shapes and the reverse matching of all loops are tried; the
    /// remedy names the first option that seals the volume.
    Message with_what_helps(const Message& failed, const matching::Match& match)
    {
        const auto otherwise = [&]() -> Message {
            if (!failed.remedy().empty()) return failed;
            return failed.remedy("give the missing face, or another wall");
        };
        if (!has_two_ends(value_)) return otherwise();
        if (options_.edge_shape != EdgeShape::automatic) {
            if (value_ != VolumeClass::I) look_at_walls();
            for (const EdgeShape shape : {EdgeShape::straight, EdgeShape::follow, EdgeShape::smooth}) {
                if (shape == options_.edge_shape || (shape == EdgeShape::follow && !leads())) continue;
                if (volume_sealed_as({shape}, match))
                    return failed.remedy("close{{ edge_shape = \"{}\" }} seals it", word(shape));
            }
        }
        matching::MatchOptions turned;
        turned.vertices = pairs_by_hand(volume_, options_);
        for (const matching::LoopPair& pair : match.loops) turned.flip.push_back(pair.source);
        // match() throws if walls or given pairs determine the direction.
        const auto other = unless_refused([&] { return matching::match(volume_, turned, context_); });
        if (!other) return otherwise();
        for (const Way& way : wanted()) {
            if (volume_sealed_as(way, *other))
                return failed.remedy(
                    "match{{ flip = {{ {} }} }} seals it",
                    full_list(turned.flip, [](int loop) { return formatted("{}", loop + 1); }));
        }
        return otherwise();
    }

    const OpenVolume& volume_;
    const std::optional<std::vector<matching::SideLine>>& lines_;
    VolumeClass value_;
    const Asked& options_;
    const RunContext& context_;
    std::optional<Follower> follower_;
};

/// Whether the wall edges of a matched pair include free edges, which happens where adjacent walls end at
/// different heights. The free rims of such walls cannot be matched as loops; the match of the ends is used.
bool climbs_open_rims(const OpenVolume& volume, const matching::Match& match)
{
    const std::vector<EdgeId> free = free_edges(volume);
    const auto is_free = [&](const EdgeUse& use) { return std::ranges::find(free, use.edge) != free.end(); };
    return std::ranges::any_of(find_gaps(volume, match), [&](const Gap& gap) {
        return std::ranges::any_of(gap.below, is_free) || std::ranges::any_of(gap.above, is_free);
    });
}

/// @throw NotClosed  the sealed shape is ambiguous, and no option asks for it.
void refuse_guess(const Closed& closed, const CloseOptions& options)
{
    if (options.roles_by == RolesBy::finding || asks_for_shape(options)) return;
    std::optional<Message> guess = guess_of_bent(closed.volume, closed.closure, RolesBy::person);
    if (!guess) return;
    throw NotClosed(std::move(*guess).remedy(
        "give the face, choose close{{ cap = … }} or close{{ edge_shape = … }}, or accept the assumed shape, "
        "which encloses {:.4g}, with open_volume{{ …, reading = 1 }}",
        enclosed_volume(closed.volume)));
}

bool lacks_walls(const OpenVolume& volume)
{
    return std::ranges::any_of(shares_without_walls(volume), [](double share) { return share > 0; });
}

/// Seal a volume of class IV that lacks walls too. The target gets the source's shape, moved onto the tops of
/// the given walls. Empty if the walls do not determine the motion, or if an option sets another shape.
std::optional<Closed> seal_as_source_tells(const OpenVolume& volume, const CloseOptions& options,
                                           const RunContext& context)
{
    if (options.cap == Cap::flat || !options.void_edges.empty() ||
        volume.override_class.value_or(VolumeClass::IV) != VolumeClass::IV)
        return std::nullopt;
    OpenVolume open = volume;
    open.override_class.reset(); // with the moved end it is of class II or III
    auto moved = move_source(open, context);
    if (!moved) return std::nullopt;
    moved->closure.algorithms.insert(moved->closure.algorithms.begin(), "Algorithm 10");
    // A person who names the roles says which walls are missing.
    if (options.roles_by == RolesBy::person)
        std::erase_if(moved->closure.assumptions,
                      [](const Assumption& assumption) { return assumption.what == Assumed::rim; });
    return moved;
}

/// The match of the ends, including the user's void edges.
matching::Match match_ends(const OpenVolume& volume, const CloseOptions& options, const RunContext& context)
{
    matching::MatchOptions by_hand;
    by_hand.vertices = pairs_by_hand(volume, options);
    return matching::match(volume, by_hand, context);
}

std::string number_of(const std::vector<EndHole>& holes)
{
    return holes.size() == 1 ? "a hole" : formatted("{} holes", holes.size());
}

/// The error about holes without walls. It lists both options and the volumes that they enclose.
Message holes_message(const Model& model, const std::vector<EndHole>& holes, const HoleVolumes& volumes)
{
    const auto encloses = [](const std::optional<double>& volume) {
        return volume ? formatted("and encloses {:.7g}", *volume) : "but the volume cannot be sealed";
    };
    return Message("closure.holes_open", "{} has {} without walls", entity_of(model, holes.front().face),
                   number_of(holes))
        .remedy("close{{ holes = \"cover\" }} closes each hole by flat faces {}; close{{ holes = "
                "\"through\" }} extends each hole to the missing end {}",
                encloses(volumes.covered), encloses(volumes.through));
}

/// Seal a volume, including holes without walls in its ends.
Closed close_as_asked(const OpenVolume& volume, const matching::Match& match, const Asked& options,
                      const RunContext& context)
{
    check_cancelled(context);
    if (volume.full_turn)
        throw NotSweepable(
            Message("closure.full_turn_whole", "a full-turn volume has no ends to close between")
                .remedy("sweep it, or close the pieces that volume:cut() returns"));
    const VolumeClass whole = classify(volume).value;
    const std::vector<EndHole> holes = holes_without_walls(volume);
    check_options(volume, whole, holes, options);
    if (whole == VolumeClass::V && !options.trial) check_tubes(volume, context);
    std::optional<HoleVolumes> volumes; // set if it is ambiguous whether holes are covered or extended
    if (whole == VolumeClass::IV && !holes.empty() && options.holes == Holes::automatic && !options.trial)
        volumes = hole_volumes(volume, options, context);
    if (volumes && options.roles_by == RolesBy::person && (volumes->covered || volumes->through))
        throw NotClosed(holes_message(volume.model, holes, *volumes));

    OpenVolume open = volume;
    matching::Match ends = match;
    VolumeClass value = whole;
    std::vector<FaceId> covers, stubs;
    if (options.holes == Holes::cover) {
        covers = cover_holes(open, holes, context);
        ends = has_two_ends(whole) ? match_ends(open, options, context) : matching::Match{};
        value = classify(open).value;
    }
    std::optional<Closed> closed;
    // Not for close_trial(): find_readings() moves ends itself.
    if (value == VolumeClass::IV && !options.trial && lacks_walls(open))
        closed = seal_as_source_tells(open, options, context);
    // If the middle of the volume is missing, the walls at each end count as a part of the end, so the free
    // rims of these walls are matched with each other.
    OpenVolume lent = open;
    if (!closed && has_two_ends(value)) stubs = lend_stubs_to_ends(lent);
    if (!stubs.empty() && climbs_open_rims(open, ends)) stubs.clear();
    if (!stubs.empty()) {
        open = std::move(lent);
        open.override_class.reset();
        ends = match_ends(open, options, context);
        value = classify(open).value;
    }
    if (!closed) closed = Sealer(open, ends.side_lines, value, options, context).seal(ends);
    refuse_guess(*closed, options);

    closed->closure.value = whole;
    closed->closure.void_faces.insert(closed->closure.void_faces.begin(), covers.begin(), covers.end());
    closed->volume.override_class = volume.override_class;
    for (const FaceId stub : stubs) closed->volume.role[stub.index()] = Role::wall;
    if (volumes)
        assume(closed->closure,
               {"closure.hole_through",
                "{} has {} without walls, extended to the missing end here; close{{ holes = \"cover\" }} {}",
                entity_of(volume.model, holes.front().face), number_of(holes),
                volumes->covered ? formatted("encloses {:.7g} instead of {:.7g}", *volumes->covered,
                                             enclosed_volume(closed->volume))
                                 : "is not possible"},
               share_between(enclosed_volume(closed->volume), volumes->covered));
    return std::move(*closed);
}

/// Note which walls were made part of an end by extend_smooth_ends().
void note_extended(const Model& model, const std::vector<FaceId>& walls, Closure& closure)
{
    if (walls.empty()) return;
    assume(closure,
           {"closure.end_extended",
            "an end meets {} smoothly, so these faces are meshed as part of that end, not as walls",
            entities_of(model, walls)},
           1);
}

} // namespace

std::vector<std::pair<int, int>> pairs_by_hand(const OpenVolume& volume, const CloseOptions& options)
{
    const auto tags = [&](Role end) {
        std::set<int> result;
        for (const EdgeUse& use : rim_uses(volume.model, volume.faces(end)))
            result.insert(volume.model[use_from(volume.model, use)].tag);
        return result;
    };
    const std::set<int> source = tags(Role::source), target = tags(Role::target);
    std::vector<std::pair<int, int>> pairs;
    for (const VoidEdge& edge : options.void_edges) {
        if (source.contains(edge.from) && target.contains(edge.to)) pairs.emplace_back(edge.from, edge.to);
        if (source.contains(edge.to) && target.contains(edge.from)) pairs.emplace_back(edge.to, edge.from);
    }
    return pairs;
}

Closed close(const OpenVolume& volume, const matching::Match& match, const CloseOptions& options,
             const RunContext& context)
{
    Closed closed = close_as_asked(volume, match, {options}, context);
    note_extended(closed.volume.model, extend_smooth_ends(closed.volume, context), closed.closure);
    log_notes(closed.closure, context);
    return closed;
}

Closed close_trial(const OpenVolume& volume, const matching::Match& match, const RunContext& context)
{
    return close_as_asked(volume, match, {{.roles_by = RolesBy::finding}, true}, context);
}

void log_notes(const Closure& closure, const RunContext& context)
{
    for (std::size_t n = 0; n < closure.notes.size(); ++n) {
        const Message& note = closure.notes[n];
        const bool assumed = std::ranges::find(closure.assumptions, n, &Assumption::note) !=
                             closure.assumptions.end();
        log_line(context, assumed ? formatted("note: {} [{}]", note.text(), note.code()) : note.text());
    }
}

} // namespace lacuna::closure
