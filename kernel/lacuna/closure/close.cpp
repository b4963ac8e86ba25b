// SPDX-License-Identifier: MIT
#include <lacuna/closure/close.h>

#include <lacuna/closure/detail/class_five.h>
#include <lacuna/closure/detail/sealing.h>
#include <lacuna/closure/detail/stubs.h>
#include <lacuna/closure/detail/void_edges.h>
#include <lacuna/closure/detail/void_faces.h>
#include <lacuna/closure/follow.h>
#include <lacuna/closure/void_geometry.h>
#include <lacuna/core/error.h>

#include <algorithm>
#include <optional>
#include <set>

namespace lacuna::closure {

using namespace topology;

namespace {

void note(Closure& closure, const std::string& algorithm)
{
    auto& list = closure.algorithms;
    if (std::find(list.begin(), list.end(), algorithm) == list.end()) list.push_back(algorithm);
}

/// What every way of closing needs.
struct Tools {
    const Follower* follower; ///< null: straight
    const RunContext& context;
};

void add_face(OpenVolume& volume, Closure& closure, const std::vector<Loop>& loops, Role role,
              const Tools& tools)
{
    const std::string name = "void face " + std::to_string(closure.void_faces.size() + 1);
    VoidFilling filling = fill(volume, loops, tools.follower, name, tools.context);
    note(closure, filling.algorithm);
    closure.void_faces.push_back(add_void_face(volume, std::move(filling), role));
}

/// With no walls between them nothing but the match says how source and target face each other.
void turn_target_to_source(OpenVolume& volume, const matching::Match& match)
{
    if (match.loops.empty() || !match.loops.front().flipped) return;
    for (const std::vector<FaceId>& part : connected_parts(volume.model, volume.faces(Role::target))) {
        flip_faces(volume.model, part);
    }
}

/// Eq. (2): V = ∪(Fs, Ft) + ∪ Fi + ∪ Fvi, one wall v-TopoFace a free loop.
void add_void_walls(OpenVolume& volume, const Tools& tools, Closure& closure)
{
    for (const Loop& loop : void_loops(volume, closure.void_edges))
        add_face(volume, closure, {loop}, Role::wall, tools);
    note(closure, "Algorithm 3");
}

/// A loop with no wall at all is connected by void edges alone.
void check_matched(const OpenVolume& volume, const matching::Match& match)
{
    const auto uses = edge_uses(volume.model);
    for (std::size_t l = 0; l < match.source_loops.size(); ++l) {
        const std::vector<EdgeUse>& rim = match.source_loops[l].uses;
        const bool bare = std::all_of(rim.begin(), rim.end(),
                                      [&](const EdgeUse& use) { return uses[use.edge.index()].size() == 1; });
        const bool matched = std::any_of(match.vertices.begin(), match.vertices.end(), [&](const auto& pair) {
            return std::any_of(rim.begin(), rim.end(),
                               [&](const EdgeUse& use) { return use_from(volume.model, use) == pair.first; });
        });
        if (!bare || matched) continue;
        throw NotClosed("closure.unmatched_loop",
                        "source loop " + std::to_string(l + 1) + ", with " +
                            name_of(volume.model, rim.front().edge) +
                            ", has no wall and none of its vertices is matched to the target; pair some by "
                            "hand with match{ vertices = … }");
    }
}

/// Class I has no algorithm of its own in the paper; its walls are those of class II with no wall given.
void close_class_one_or_two(OpenVolume& volume, matching::Match match, const Tools& tools, Closure& closure)
{
    if (closure.value == VolumeClass::II) note(closure, "Algorithm 8");
    turn_target_to_source(volume, match);
    matching::apply_splits(volume, match);
    check_matched(volume, match);
    closure.void_edges = make_void_edges(volume, match, tools.follower);
    note(closure, "Algorithm 2");
    add_void_walls(volume, tools, closure);
}

void close_class_three(OpenVolume& volume, const Tools& tools, Closure& closure)
{
    note(closure, "Algorithm 9");
    add_void_walls(volume, tools, closure);
}

Loop reversed(const Rim& rim)
{
    Loop loop;
    for (auto use = rim.uses.rbegin(); use != rim.uses.rend(); ++use)
        loop.uses.push_back({use->edge, !use->reversed});
    return loop;
}

/// Eq. (3) and (4): the free loops of source and walls are the target's.
void close_class_four(OpenVolume& volume, const RunContext& context, Closure& closure)
{
    note(closure, "Algorithm 10");
    const Model& model = volume.model;
    std::set<EdgeId> on_source;
    for (const FaceId face : volume.faces(Role::source)) {
        for (const Loop& loop : model[face].loops) {
            for (const EdgeUse& use : loop.uses) on_source.insert(use.edge);
        }
    }
    std::vector<Loop> loops;
    for (const Rim& rim : free_loops(volume)) {
        for (const EdgeUse& use : rim.uses) {
            if (!on_source.contains(use.edge)) continue;
            throw NotClosed("closure.wall_missing",
                            name_of(model, use.edge) +
                                " of the source has no wall; without a target every wall must be there "
                                "(class IV): name the wall, or the target");
        }
        loops.push_back(reversed(rim));
    }
    const std::size_t wanted = rims(model, volume.faces(Role::source)).size();
    if (loops.size() != wanted) {
        throw NotClosed("closure.loop_counts", "the source has " + std::to_string(wanted) +
                                                   " loops and the walls leave " +
                                                   std::to_string(loops.size()) +
                                                   " free loops for the target; a sweep needs as many on "
                                                   "both ends: check the walls, or name the target");
    }
    add_face(volume, closure, loops, Role::target, {nullptr, context});
}

/// Eq. (5) to (8): the free loops, sorted into two subsets, are the source's and the target's.
void close_class_five(OpenVolume& volume, const RunContext& context, Closure& closure)
{
    note(closure, "Algorithm 11");
    const EndLoops ends = group_loops(volume);
    add_face(volume, closure, ends.source, Role::source, {nullptr, context});
    add_face(volume, closure, ends.target, Role::target, {nullptr, context});
}

Closure close_as(OpenVolume& volume, const matching::Match& match, VolumeClass value, const Tools& tools)
{
    Closure closure;
    closure.value = value;
    switch (value) {
    case VolumeClass::closed:
        break;
    case VolumeClass::I:
    case VolumeClass::II:
        close_class_one_or_two(volume, match, tools, closure);
        break;
    case VolumeClass::III:
        close_class_three(volume, tools, closure);
        break;
    case VolumeClass::IV:
        close_class_four(volume, tools.context, closure);
        break;
    case VolumeClass::V:
        close_class_five(volume, tools.context, closure);
        break;
    }
    if (enclosed_volume(volume) < 0) {
        std::vector<FaceId> all;
        for (std::size_t f = 0; f < volume.model.faces.size(); ++f) all.emplace_back(f);
        flip_faces(volume.model, all);
    }
    return closure;
}

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

/// Seal a volume as one of a class, and prove it.
Closure seal(OpenVolume& volume, const matching::Match& match, VolumeClass value, const CloseOptions& options,
             const RunContext& context)
{
    const bool has_walls = value == VolumeClass::II || value == VolumeClass::III;
    std::optional<Follower> follower;
    if (has_walls && options.edge_shape != EdgeShape::straight) follower.emplace(volume, context);
    const bool can_follow = follower && follower->leads();
    const bool follow_at_once = options.edge_shape == EdgeShape::follow;
    if (follow_at_once && !can_follow) {
        throw NotClosed("closure.nothing_to_follow",
                        "edge_shape = \"follow\" needs a given wall that joins source and "
                        "target, and there is none; use \"straight\"");
    }

    // Left to itself, a bent volume is closed bent, and a straight one straight unless that cuts through
    // what is given.
    const bool bend_first = follow_at_once || (can_follow && follower->leads_astray(volume, match));
    const Follower* const leader = can_follow ? &*follower : nullptr;
    OpenVolume sealed = volume;
    Closure closure = close_as(sealed, match, value, {bend_first ? leader : nullptr, context});
    auto crossing = first_crossing(sealed, context);
    if (crossing && can_follow && !follow_at_once) {
        OpenVolume other = volume;
        Closure otherwise = close_as(other, match, value, {bend_first ? nullptr : leader, context});
        if (!first_crossing(other, context)) {
            crossing.reset();
            sealed = std::move(other);
            closure = std::move(otherwise);
        }
    }
    // Left to itself the closing has tried both shapes; a shape asked for is set against the other.
    const auto other_shape_helps = [&]() -> std::string {
        if (!has_walls || options.edge_shape == EdgeShape::automatic) return "";
        try {
            if (!follower) follower.emplace(volume, context);
            if (!follower->leads()) return "";
            OpenVolume other = volume;
            close_as(other, match, value, {follow_at_once ? nullptr : &*follower, context});
            if (first_crossing(other, context)) return "";
        } catch (const NotClosed&) {
            return "";
        }
        return std::string("; with close{ edge_shape = ") + (follow_at_once ? "\"straight\"" : "\"follow\"") +
               " } no faces cross";
    };
    if (crossing) {
        throw NotClosed("closure.faces_cross", name_of(sealed.model, crossing->first) + " would cross " +
                                                   name_of(sealed.model, crossing->second) +
                                                   other_shape_helps());
    }
    prove_sealed(sealed);
    closure.watertight = true;
    volume = std::move(sealed);
    return closure;
}

} // namespace

Closure close(OpenVolume& volume, const matching::Match& match, const CloseOptions& options,
              const RunContext& context)
{
    check_cancelled(context);
    const VolumeClass whole = classify(volume).value;
    const bool two_ends = whole == VolumeClass::I || whole == VolumeClass::II || whole == VolumeClass::III;
    if (!two_ends) return seal(volume, match, whole, options, context);
    OpenVolume lent = volume;
    const std::vector<FaceId> stubs = lend_stubs_to_ends(lent);
    if (stubs.empty()) return seal(volume, match, whole, options, context);

    // Part of a stack is missing: what is open lies between the stubs, and is matched there.
    lent.override_class.reset();
    Closure closure = seal(lent, matching::match(lent, {}, context), classify(lent).value, options, context);
    closure.value = whole;
    for (const FaceId stub : stubs) lent.role[stub.index()] = Role::wall;
    lent.override_class = volume.override_class;
    volume = std::move(lent);
    return closure;
}

} // namespace lacuna::closure
