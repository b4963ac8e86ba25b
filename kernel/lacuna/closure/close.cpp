// SPDX-License-Identifier: MIT
#include <lacuna/closure/close.h>

#include <lacuna/closure/detail/close_class.h>
#include <lacuna/closure/detail/guesses.h>
#include <lacuna/closure/detail/membranes.h>
#include <lacuna/closure/detail/moved_end.h>
#include <lacuna/closure/detail/no_roles.h>
#include <lacuna/closure/detail/sealing.h>
#include <lacuna/closure/detail/stubs.h>
#include <lacuna/closure/detail/void_edges.h>
#include <lacuna/core/error.h>
#include <lacuna/core/number_text.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <set>

namespace lacuna::closure {

using namespace topology;

namespace {

/// @throw NotClosed unless the volume is sealed.
void prove_sealed(const OpenVolume& volume)
{
    const Model& model = volume.model;
    const auto uses = edge_uses(model);
    for (std::size_t e = 0; e < uses.size(); ++e) {
        if (uses[e].size() == 2 && uses[e][0].reversed != uses[e][1].reversed) continue;
        throw NotClosed("closure.not_watertight",
                        name_of(model, EdgeId(e)) + " is used " + std::to_string(uses[e].size()) +
                            (uses[e].size() == 2 ? " times in the same direction" : " times") +
                            " after closing; every edge must be used twice, in opposite directions: check "
                            "the faces around it");
    }
    if (!(enclosed_volume(volume) > 0)) {
        throw NotClosed("closure.no_volume",
                        "the sealed faces enclose a volume of " + std::to_string(enclosed_volume(volume)) +
                            ", which is not above 0: source and target lie in each other, or the faces "
                            "between them are twisted");
    }
}

bool has_two_ends(VolumeClass value)
{
    return value == VolumeClass::I || value == VolumeClass::II || value == VolumeClass::III;
}

/// @throw InvalidInput  an option that the class has no use for.
void check_options(const OpenVolume& volume, VolumeClass value, const CloseOptions& options)
{
    if (!options.void_edges.empty() && !has_two_ends(value)) {
        throw InvalidInput("closure.void_edges_unused",
                           value == VolumeClass::closed
                               ? "void_edges are for walls that are missing, and none is"
                               : "void_edges join a given source and a given target, and a volume of class " +
                                     std::string(to_string(value)) + " has not both");
    }
    if (options.cap == Cap::automatic || value == VolumeClass::IV) return;
    if (value == VolumeClass::V && options.cap == Cap::flat) return;
    throw InvalidInput(
        "closure.cap_unused",
        value == VolumeClass::V
            ? "cap = \"parallel\" carries a given end's shape to the other, and both are "
              "missing (class V); use \"flat\", or name the source"
            : "cap shapes a missing end, and " + name_of(volume.model, volume.faces(Role::source).front()) +
                  " and " + name_of(volume.model, volume.faces(Role::target).front()) + " are both given");
}

/// By how much the ends of a volume are turned against each other, each facing the other [radian]; 0 where
/// one looks past the other or encloses nothing.
double lean_of(const OpenVolume& volume)
{
    const Model& model = volume.model;
    std::array<Vec3, 2> facing, middle;
    for (const Role end : {Role::source, Role::target}) {
        Vec3 sum = Vec3::Zero(), at = Vec3::Zero();
        double area = 0;
        for (const FaceId face : volume.faces(end)) {
            sum += face_area_vector(model, face);
            at += face_area(model, face) * face_centroid(model, face);
            area += face_area(model, face);
        }
        facing[end == Role::source ? 0 : 1] = sum.stableNormalized();
        middle[end == Role::source ? 0 : 1] = at / area;
    }
    const Vec3 way = middle[1] - middle[0];
    for (Vec3& normal : facing)
        if (normal.dot(way) < 0) normal = -normal;
    return std::atan2(facing[0].cross(facing[1]).norm(), facing[0].dot(facing[1]));
}

/// Ends without walls that are turned by more than this are closed by a bend: straight edges would graze
/// both.
/// A choice, not a measurement.
constexpr double kBend = 100 * std::numbers::pi / 180;
/// What is closed straight between ends turned by more than this may have been meant as a bend, and it is
/// said.
constexpr double kLean = 20 * std::numbers::pi / 180;

/// Ways to shape what is missing that differ by more than this share of the volume are both said. A choice.
constexpr double kToBeSaid = 0.01;

/// The share of each of the source's rims' edges that has no wall.
std::vector<double> shares_without_walls(const OpenVolume& volume)
{
    const auto uses = edge_uses(volume.model);
    std::vector<double> shares;
    for (const Rim& rim : rims(volume.model, volume.faces(Role::source))) {
        const auto bare = std::ranges::count_if(
            rim.uses, [&](const EdgeUse& use) { return uses[use.edge.index()].size() == 1; });
        shares.push_back(static_cast<double>(bare) / static_cast<double>(rim.uses.size()));
    }
    return shares;
}

/// A volume being sealed as one of a class, in one way after another.
class Sealer {
public:
    /// @param lines  those of the volume where they are known
    Sealer(const OpenVolume& volume, const std::optional<std::vector<matching::SideLine>>& lines,
           VolumeClass value, const CloseOptions& options, const RunContext& context)
        : volume_(volume), lines_(lines), value_(value), options_(options), context_(context)
    {
        const bool has_walls = value == VolumeClass::II || value == VolumeClass::III;
        if (has_walls && options.edge_shape != EdgeShape::straight) look_at_walls();
        if (options.edge_shape == EdgeShape::follow && !leads()) {
            throw NotClosed("closure.nothing_to_follow",
                            "edge_shape = \"follow\" needs a given wall that joins source and "
                            "target, and there is none; use \"straight\" or \"smooth\"");
        }
    }

    /// Seal and prove it, in the first of the wanted ways that can be done.
    Closure seal(const matching::Match& match)
    {
        std::optional<NotClosed> first;
        for (const Way& way : wanted(match)) {
            try {
                Closure closure = seal_as(way, match);
                say_what_else(way, closure);
                say_what_is_followed(way, match, closure);
                say_what_is_open(closure);
                return closure;
            } catch (const NotClosed& error) {
                if (!first) first = error;
            }
        }
        throw NotClosed(first->code(), first->what() + (options_.hints ? what_helps(match) : std::string()));
    }

    [[nodiscard]] OpenVolume take() { return std::move(sealed_); }

private:
    void look_at_walls()
    {
        if (!follower_)
            follower_.emplace(volume_, lines_ ? *lines_ : matching::side_lines(volume_, context_), context_);
    }

    [[nodiscard]] bool leads() const { return follower_ && follower_->leads(); }

    /// Left to itself, a bent volume is closed bent, and a straight one straight unless that cuts through
    /// what is given or encloses nothing.
    std::vector<Way> wanted(const matching::Match& match) const
    {
        if (value_ == VolumeClass::IV) {
            if (options_.cap == Cap::automatic)
                return {{EdgeShape::straight, Cap::flat, true}, {EdgeShape::straight, Cap::parallel}};
            return {{EdgeShape::straight, options_.cap}};
        }
        if (options_.edge_shape != EdgeShape::automatic) return {{options_.edge_shape}};
        if (!has_two_ends(value_)) return {{EdgeShape::straight}};
        std::vector<Way> ways{{EdgeShape::straight}};
        if (!leads() && lean_of(volume_) > kBend) return {{EdgeShape::smooth}, {EdgeShape::straight}};
        if (leads())
            ways.insert(follower_->leads_astray(volume_, match) ? ways.begin() : ways.end(),
                        {EdgeShape::follow});
        ways.push_back({EdgeShape::smooth});
        return ways;
    }

    /// Ends that lean against each other with no walls between leave open whether the way is straight or a
    /// bend.
    void say_what_else(const Way& way, Closure& closure) const
    {
        if (!has_two_ends(value_) || options_.edge_shape != EdgeShape::automatic || leads()) return;
        if (closure.void_edges.empty() || !options_.void_edges.empty()) return;
        const double lean = lean_of(volume_);
        if (way.edges == EdgeShape::follow || !(lean > kLean)) return;
        const bool straight = way.edges == EdgeShape::straight;
        const std::string turned = "the ends are turned by " + with_digits(lean * 180 / std::numbers::pi, 3) +
                                   "° and no given wall says how the way between them bends: void edges are ";
        closure.notes.push_back(turned + (straight
                                              ? "straight; close{ edge_shape = \"smooth\" } makes a bend"
                                              : "curves that leave both ends square; close{ edge_shape = "
                                                "\"straight\" } makes them straight"));
        log_line(context_, closure.notes.back());
    }

    /// A loop without any wall that follows the walls of another one: how much that encloses otherwise. A
    /// bend is told so, a widening of the bore alone is not.
    void say_what_is_followed(const Way& way, const matching::Match& match, Closure& closure)
    {
        if (way.edges != EdgeShape::follow || options_.edge_shape != EdgeShape::automatic || !options_.hints)
            return;
        const auto is_bare = [](double share) { return share == 1; };
        if (std::ranges::none_of(shares_without_walls(volume_), is_bare)) return;
        const OpenVolume followed = sealed_;
        const double encloses = enclosed_volume(followed);
        const bool seals = would_seal({EdgeShape::straight}, match);
        const double straight = seals ? enclosed_volume(sealed_) : encloses;
        sealed_ = followed;
        if (std::abs(straight - encloses) <= kToBeSaid * encloses) return;
        closure.notes.push_back("a loop of the source has no wall, and void faces follow those of another "
                                "loop there, which encloses " +
                                with_digits(encloses, 4) + "; close{ edge_shape = \"straight\" } encloses " +
                                with_digits(straight, 4));
        log_line(context_, closure.notes.back());
    }

    /// Void faces whose inside the rim does not tell, and those that fill what may lie behind them.
    void say_what_is_open(Closure& closure) const
    {
        for (const FaceId face : membranes(sealed_.model, closure.void_faces)) {
            closure.notes.push_back(name_of(sealed_.model, face) +
                                    " spans a rim that lies in no plane, as a membrane does: the rim leaves "
                                    "open how the inside bends; give the face where it bulges");
            log_line(context_, closure.notes.back());
        }
        for (std::string& note : notes_of_holes(volume_.model, all_faces(volume_.model), sealed_, closure)) {
            closure.notes.push_back(std::move(note));
            if (options_.hints) log_line(context_, closure.notes.back()); // not of trials
        }
    }

    Closure seal_as(const Way& way, const matching::Match& match)
    {
        OpenVolume sealed = volume_;
        const Tools tools{way, leads() ? &*follower_ : nullptr, options_.void_edges, context_};
        Closure closure = close_as(sealed, match, value_, tools);
        if (const auto crossing = first_crossing(sealed, context_)) {
            throw NotClosed("closure.faces_cross", name_of(sealed.model, crossing->first) + " would cross " +
                                                       name_of(sealed.model, crossing->second));
        }
        prove_sealed(sealed);
        closure.watertight = true;
        sealed_ = std::move(sealed);
        return closure;
    }

    bool would_seal(const Way& way, const matching::Match& match)
    {
        try {
            seal_as(way, match);
            return true;
        } catch (const NotClosed&) {
            return false;
        }
    }

    /// What was tried after a failure and found to seal; what did not is not recommended.
    std::string what_helps(const matching::Match& match)
    {
        const std::string otherwise = "; give the missing face, or another wall";
        if (!has_two_ends(value_)) return otherwise;
        if (options_.edge_shape != EdgeShape::automatic) {
            if (value_ != VolumeClass::I) look_at_walls();
            if (options_.edge_shape != EdgeShape::straight && would_seal({EdgeShape::straight}, match))
                return "; close{ edge_shape = \"straight\" } seals it";
            if (options_.edge_shape != EdgeShape::follow && leads() && would_seal({EdgeShape::follow}, match))
                return "; close{ edge_shape = \"follow\" } seals it";
            if (options_.edge_shape != EdgeShape::smooth && would_seal({EdgeShape::smooth}, match))
                return "; close{ edge_shape = \"smooth\" } seals it";
        }
        matching::MatchOptions turned;
        turned.vertices = pairs_by_hand(volume_, options_);
        std::string loops;
        for (const matching::LoopPair& pair : match.loops) {
            turned.flip.push_back(pair.source);
            loops += (loops.empty() ? "" : ", ") + std::to_string(pair.source + 1);
        }
        try {
            const matching::Match other = matching::match(volume_, turned, context_);
            for (const Way& way : wanted(other)) {
                if (would_seal(way, other)) return "; match{ flip = { " + loops + " } } seals it";
            }
        } catch (const NotClosed&) {
        } catch (const InvalidInput&) { // walls or pairs settle the direction
        }
        return otherwise;
    }

    const OpenVolume& volume_;
    const std::optional<std::vector<matching::SideLine>>& lines_;
    VolumeClass value_;
    const CloseOptions& options_;
    const RunContext& context_;
    std::optional<Follower> follower_;
    OpenVolume sealed_;
};

/// Whether side lines lead up along open rims: walls that end at different heights beside each other. Their
/// open rim is no loop to match then, and the side lines say what goes with what.
bool climbs_open_rims(const OpenVolume& volume, const matching::Match& match)
{
    const std::vector<EdgeId> free = free_edges(volume);
    const auto is_free = [&](const EdgeUse& use) {
        return std::find(free.begin(), free.end(), use.edge) != free.end();
    };
    const std::vector<Gap> gaps = find_gaps(volume, match);
    return std::any_of(gaps.begin(), gaps.end(), [&](const Gap& gap) {
        return std::any_of(gap.below.begin(), gap.below.end(), is_free) ||
               std::any_of(gap.above.begin(), gap.above.end(), is_free);
    });
}

/// @throw NotClosed  the shape that was sealed is a guess which nobody asked for.
void refuse_guess(const OpenVolume& sealed, const Closure& closure, const CloseOptions& options)
{
    if (options.take_guess || options.edge_shape != EdgeShape::automatic || !options.void_edges.empty() ||
        options.cap != Cap::automatic)
        return;
    const std::string guess = guess_of_bent(sealed, closure, RolesBy::person);
    if (guess.empty()) return;
    throw NotClosed("closure.shape_open",
                    guess +
                        "; give the missing face, ask for a shape by close{ cap = … } or "
                        "close{ edge_shape = … }, or take what was assumed, which encloses " +
                        with_digits(enclosed_volume(sealed), 4) + ", by open_volume{ …, reading = 1 }");
}

/// Seal a volume as one of a class, and prove it.
Closure seal(OpenVolume& volume, const matching::Match& match, VolumeClass value, const CloseOptions& options,
             const RunContext& context)
{
    Sealer sealer(volume, match.side_lines, value, options, context);
    Closure closure = sealer.seal(match);
    OpenVolume sealed = sealer.take();
    refuse_guess(sealed, closure, options);
    volume = std::move(sealed);
    return closure;
}

bool lacks_walls(const OpenVolume& volume)
{
    return std::ranges::any_of(shares_without_walls(volume), [](double share) { return share > 0; });
}

/// Seal a volume of class IV that lacks walls as well: the source's shape, moved onto the tops of the walls
/// that stand, is the target's. None where these do not tell, or where another shape is asked for.
std::optional<Closure> seal_as_source_tells(OpenVolume& volume, const CloseOptions& options,
                                            const RunContext& context)
{
    if (options.cap == Cap::flat || !options.void_edges.empty() || volume.override_class) return std::nullopt;
    auto moved = move_source(volume, context);
    if (!moved) return std::nullopt;
    refuse_guess(moved->volume, moved->closure, options);
    Closure& closure = moved->closure;
    closure.value = VolumeClass::IV;
    closure.algorithms.insert(closure.algorithms.begin(), "Algorithm 10");
    closure.notes.insert(closure.notes.begin(),
                         "the target is missing and walls beside it too; it is taken to have the source's "
                         "shape, which " +
                             name_of(volume.model, moved->from) +
                             " tells, where the tops of the walls that stand say");
    for (const std::string& note : closure.notes) log_line(context, note);
    volume = std::move(moved->volume);
    return std::move(moved->closure);
}

} // namespace

std::vector<std::pair<int, int>> pairs_by_hand(const OpenVolume& volume, const CloseOptions& options)
{
    const auto tags = [&](Role end) {
        std::set<int> result;
        for (const Rim& rim : rims(volume.model, volume.faces(end))) {
            for (const EdgeUse& use : rim.uses) result.insert(volume.model[use_from(volume.model, use)].tag);
        }
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

Closure close(OpenVolume& volume, const matching::Match& match, const CloseOptions& options,
              const RunContext& context)
{
    check_cancelled(context);
    if (volume.full_turn)
        throw NotSweepable("closure.full_turn_whole",
                           "the volume runs round its whole turn and has no ends to be closed between; sweep "
                           "it, or close its pieces, which volume:cut() gives");
    const VolumeClass whole = classify(volume).value;
    check_options(volume, whole, options);
    if (whole == VolumeClass::V && options.hints) check_tubes(volume, context);
    // Trials of readings move ends by themselves.
    if (whole == VolumeClass::IV && options.hints && lacks_walls(volume)) {
        if (auto closure = seal_as_source_tells(volume, options, context)) return std::move(*closure);
    }
    if (!has_two_ends(whole)) return seal(volume, match, whole, options, context);
    OpenVolume lent = volume;
    const std::vector<FaceId> stubs = lend_stubs_to_ends(lent);
    if (stubs.empty() || climbs_open_rims(volume, match)) return seal(volume, match, whole, options, context);

    // Part of a stack is missing: what is open lies between the stubs, and is matched there.
    lent.override_class.reset();
    matching::MatchOptions by_hand;
    by_hand.vertices = pairs_by_hand(lent, options);
    Closure closure = seal(lent, matching::match(lent, by_hand, context), classify(lent).value, options,
                           context);
    closure.value = whole;
    for (const FaceId stub : stubs) lent.role[stub.index()] = Role::wall;
    lent.override_class = volume.override_class;
    volume = std::move(lent);
    return closure;
}

} // namespace lacuna::closure
