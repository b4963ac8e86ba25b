// SPDX-License-Identifier: MIT
//
// Every candidate gives all faces a role, so candidates differ only in which patches are ends. Facts that do
// not depend on the ends (angles, areas, Euler numbers, neighbours) are computed once per patch; a candidate
// adds them up.
#include <lacuna/topology/auto_roles.h>

#include <lacuna/core/shared/criteria.h>
#include <lacuna/core/shared/list_text.h>
#include <lacuna/core/shared/marks.h>
#include <lacuna/geometry/shared/union_find.h>
#include <lacuna/topology/detail/end_costs.h>
#include <lacuna/topology/detail/wall_parts.h>
#include <lacuna/topology/detail/wall_tally.h>
#include <lacuna/topology/shared/hollows.h>
#include <lacuna/topology/shared/names_of.h>
#include <lacuna/topology/shared/use_places.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <tuple>

namespace lacuna::topology {

namespace {

/// Cost of a connected set of sharp wall edges that does not run from end to end, and cost of a window (a rim
/// of the walls whose edges are all free). Rule of thumb: the shoulder of a stepped bore is more likely part
/// of a stepped end than a wall.
constexpr double kLoose = 0.3;
/// Weight of walls whose normals point along the sweep. It multiplies the mean squared cosine between wall
/// normals and sweep, which is 0 for a straight sweep and at most a quarter for a bend by 90°. Tuned on 277
/// voids of prisms, tubes, bends and pockets.
constexpr double kAcross = 2.0;
/// Largest mean squared cosine between wall normals and sweep at which a volume with steps can be cut
/// straight along the sweep. Rule of thumb.
constexpr double kStraight = 0.02;
/// Cost of each doubling of the number of steps. Rule of thumb: a candidate with fewer steps is likelier, but
/// a plate may have a hundred.
constexpr double kStep = 0.01;

/// Maximum number of candidates that are kept and sorted at once: those with the lowest costs. If all of them
/// are invalid, the candidates with the next higher costs are found. Usually few candidates are tried;
/// sorting eight times as many took longer than finding them.
constexpr std::size_t kMostKept = std::size_t{1} << 15;

constexpr std::size_t kGap = kNoIndex - 1; ///< not the index of a target rim: the walls end at a free loop

/// A candidate: the patches that are its ends, with `kNoIndex` for a missing end.
struct Reading {
    std::size_t source = kNoIndex, target = kNoIndex;
    double cost = 0;
    std::size_t step = kNoIndex; ///< index in `Readings::stepped_` if its ends consist of several patches

    /// Cheapest first. At equal costs, candidates without ends come first, then candidates with stepped ends,
    /// then the others by the patch numbers of their ends.
    friend bool operator<(const Reading& x, const Reading& y)
    {
        if (x.cost != y.cost) return x.cost < y.cost;
        const auto rank = [](const Reading& r) {
            const std::size_t kind = r.source == kNoIndex ? 0 : r.step != kNoIndex ? 1 : 2;
            return std::tuple(kind, kind == 1 ? r.step : r.source, r.target + 1); // 0 for a missing end
        };
        return rank(x) < rank(y);
    }
};

/// The patches of ends at several heights.
struct SteppedEnds {
    std::vector<std::size_t> source, target;
};

/// Cost of a candidate with one end, and of steps at both ends: half way between those of two ends and of
/// none. A sweep from one flat face falls into fewer pieces, and any flat end is likelier than a bent end.
double cost_of_one_end() { return kNoEnd / 2; }

/// The angles across edges. A smooth edge between a flat and a bent face gets the crease angle, so that a
/// floor with a rounded rim can be an end.
std::vector<double> parted_at_flat_faces(const Model& model, std::vector<double> angle)
{
    std::vector<bool> flat(model.faces.size());
    for (std::size_t f = 0; f < flat.size(); ++f) {
        const FaceId id(f);
        flat[f] = face_area_vector(model, id).norm() > (1 - kFlatShare) * face_area(model, id);
    }
    for (std::size_t e = 0; e < angle.size(); ++e) {
        const std::span<const FaceUse> uses = model.uses_of_edge(EdgeId(e));
        if (uses.size() == 2 && flat[uses[0].face.index()] != flat[uses[1].face.index()])
            angle[e] = std::max(angle[e], kCreaseAngle);
    }
    return angle;
}

class Readings {
public:
    /// @param flat_alone  whether a flat face with smooth neighbours is a patch of its own
    /// @param branches    as in `RoleOptions`
    Readings(const Model& model, bool flat_alone, bool branches, const RunContext& context)
        : model_(model),
          flat_alone_(flat_alone),
          branches_(branches),
          context_(context),
          angle_(angles_across(model, context)),
          map_{smooth_patches(model, flat_alone ? parted_at_flat_faces(model, angle_) : angle_, context),
               std::vector<std::size_t>(2 * model.edges.size(), kNoIndex),
               std::vector<EdgeUse>(2 * model.edges.size()),
               std::vector<std::vector<std::size_t>>(model.vertices.size())},
          walls_(map_, free_),
          vertex_seen_(model.vertices.size())
    {
        for (std::size_t p = 0; p < map_.patches.size(); ++p) index_patch(p);
        for (std::size_t u = 0; u < map_.of_use.size(); ++u) {
            if (map_.of_use[u] != kNoIndex && map_.of_use[u ^ 1] == kNoIndex)
                free_.push_back({EdgeId(u / 2), u % 2 == 1});
        }
        for (std::size_t e = 0; e < angle_.size(); ++e) {
            if (angle_[e] >= kCreaseAngle) sharp_.emplace_back(e);
        }
        if (!used_twice_) tally_.emplace(map_, walls_.free_loops());
    }

    Readings(const Readings&) = delete; // the tally refers to the map
    Readings& operator=(const Readings&) = delete;

    /// Candidates that their ends alone do not rule out: the cheapest ones, in ascending order of their
    /// costs.
    /// @param after  only candidates that rank after this one
    [[nodiscard]] std::vector<Reading> by_cost(const std::optional<Reading>& after)
    {
        std::vector<Reading> found; // heap with the candidate of the highest cost on top
        const auto add = [&](const Reading& reading) {
            if (after && !(*after < reading)) return;
            if (found.size() == kMostKept) {
                if (!(reading < found.front())) return;
                std::pop_heap(found.begin(), found.end());
                found.back() = reading;
            } else {
                found.push_back(reading);
            }
            std::push_heap(found.begin(), found.end());
        };
        if (const auto cost = cost_of_no_end(model_)) add({kNoIndex, kNoIndex, *cost});
        if (free_.empty()) {
            if (!after) find_stepped();
            for (const Reading& reading : with_steps_) add(reading);
        }
        for (std::size_t a = 0; a < map_.patches.size(); ++a) {
            check_cancelled(context_);
            if (stands_alone(a) && (!tally_ || tally_->can_hold(a)))
                add({a, kNoIndex, cost_of_one_end() + bend(map_.patches[a]) + map_.patches[a].slant});
        }
        // Sort the patches so that those that can form pairs with the most other patches come first.
        std::vector<std::size_t> order(map_.patches.size());
        for (std::size_t p = 0; p < order.size(); ++p) order[p] = p;
        std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
            return tally_ && tally_->at_most(a) > tally_->at_most(b);
        });
        const std::size_t parts = tally_ ? tally_->parts() : 0;
        for (std::size_t i = 0; i < order.size() && parts <= 2; ++i) {
            check_cancelled(context_);
            vertex_seen_.clear();
            for (const VertexId v : map_.patches[order[i]].vertices) vertex_seen_.add(v.index());
            for (std::size_t k = i + 1; k < order.size(); ++k) {
                if (tally_ && !tally_->can_hold(order[i], order[k])) break; // the following ones fail as well
                const auto [a, b] = std::minmax(order[i], order[k]);
                if (parts == 2 && tally_->hang_together(a, b)) continue;
                if (are_apart(order[i], order[k]))
                    add({a, b, cost_of_two_ends(map_.patches[a], map_.patches[b])});
            }
        }
        std::sort_heap(found.begin(), found.end());
        return found;
    }

    /// Whether the walls of a candidate join its two ends, or lead from its only end to free loops. Near
    /// linear in the edges of patches.
    [[nodiscard]] bool holds(const Reading& reading)
    {
        check_cancelled(context_);
        // Candidates without ends or with steps were checked when they were found.
        if (reading.source == kNoIndex || reading.step != kNoIndex) return true;
        if (flat_alone_ && has_fans(reading)) return false;
        const std::vector<WallPart> parts = walls_.between(reading.source, reading.target);
        const SmoothPatch& source = map_.patches[reading.source];
        std::vector<std::size_t> served(source.rims.size(), kNoIndex);
        std::size_t before_gap = 0, behind_gap = 0;
        for (const WallPart& part : parts) {
            if (part.several || (part.source_rim == kNoIndex && part.target_rim == kNoIndex)) return false;
            if (part.source_rim == kNoIndex || part.target_rim == kNoIndex) {
                // The walls must be a ring that ends at a free loop. Either the end beyond this loop is
                // missing, or the walls between this loop and the end.
                if (part.rims != 2 || part.euler != 0) return false;
                if (part.source_rim == kNoIndex) {
                    ++behind_gap;
                    continue;
                }
                if (served[part.source_rim] != kNoIndex) return false;
                served[part.source_rim] = kGap;
                ++before_gap;
                continue;
            }
            // Walls with a handle form no ring, whatever faces are added.
            if (part.euler != 2 - static_cast<long>(part.rims)) return false;
            std::size_t& now = served[part.source_rim];
            if (now != kNoIndex && now != part.target_rim) return false;
            now = part.target_rim;
        }
        return reading.target == kNoIndex || before_gap == behind_gap;
    }

    /// A candidate with all its data. @pre holds()
    [[nodiscard]] RoleCandidate candidate(const Reading& reading) const
    {
        RoleCandidate result;
        result.cost = reading.cost;
        if (reading.source != kNoIndex) result.irregular = irregular(reading);
        const std::array<std::vector<FaceId>*, 3> lists{&result.roles.walls, &result.roles.source,
                                                        &result.roles.target};
        for (std::size_t p = 0; p < map_.patches.size(); ++p) {
            std::vector<FaceId>& list = *lists[end_of(p, reading)];
            list.insert(list.end(), map_.patches[p].faces.begin(), map_.patches[p].faces.end());
        }
        result.value = class_of(reading);
        result.reasons = reasons(reading, result.roles);
        return result;
    }

    /// The cost of a candidate's walls and steps. Near linear in the edges of patches.
    /// @pre  the last call of holds() was for this candidate.
    [[nodiscard]] double cost_of_walls(const Reading& reading)
    {
        if (reading.source == kNoIndex) return 0;
        const std::size_t windows = reading.target == kNoIndex || reading.step != kNoIndex ? 0
                                                                                           : walls_.windows();
        return cost_of_facing_along(reading) + cost_of_loose_edges(reading) + cost_of_steps(reading) +
               kLoose * static_cast<double>(windows);
    }

private:
    /// Cost of walls whose normals point along the sweep.
    [[nodiscard]] double cost_of_facing_along(const Reading& reading) const
    {
        const SmoothPatch& source = map_.patches[reading.source];
        const Vec3 way = reading.target == kNoIndex || reading.step != kNoIndex
                             ? source.normal
                             : (map_.patches[reading.target].centre - source.centre).stableNormalized();
        double along = 0, area = 0;
        for (std::size_t p = 0; p < map_.patches.size(); ++p) {
            if (end_of(p, reading) != 0) continue;
            along += way.dot(map_.patches[p].spread * way);
            area += map_.patches[p].area;
        }
        return area > 0 ? kAcross * along / area : 0;
    }

    [[nodiscard]] double cost_of_steps(const Reading& reading) const
    {
        if (reading.step == kNoIndex) return 0;
        const SteppedEnds& ends = stepped_[reading.step];
        const auto patches = static_cast<double>(ends.source.size() + ends.target.size());
        return kStep * std::log2(patches - 1) + (ends.source.size() > 1 ? cost_of_one_end() : 0);
    }

    /// Cost of sharp edges between walls that do not run from end to end.
    [[nodiscard]] double cost_of_loose_edges(const Reading& reading) const
    {
        std::vector<EdgeId> sharp; // where two walls meet at an angle
        std::ranges::copy_if(sharp_, std::back_inserter(sharp), [&](EdgeId e) {
            const auto is_wall = [&](std::size_t use) { return end_of(map_.of_use[use], reading) == 0; };
            return is_wall(2 * e.index()) && is_wall(2 * e.index() + 1);
        });
        geometry::UnionFind hang(model_.vertices.size());
        for (const EdgeId e : sharp) hang.unite_least(model_[e].from.index(), model_[e].to.index());
        std::map<std::size_t, unsigned> touched; // by connected set, the ends it touches
        for (const EdgeId e : sharp) touched[hang.find(model_[e].from.index())] |= 0;
        for (std::size_t p = 0; p < map_.patches.size(); ++p) {
            const unsigned end = end_of(p, reading);
            if (end == 0) continue;
            for (const VertexId v : map_.patches[p].vertices) {
                const auto found = touched.find(hang.find(v.index()));
                if (found != touched.end()) found->second |= end;
            }
        }
        // The walls of a step run between two patches of one end, so they need to touch that end only.
        const bool steps = reading.step != kNoIndex;
        const unsigned wanted = steps ? (stepped_[reading.step].source.size() > 1 ? 1U : 0U) |
                                            (stepped_[reading.step].target.size() > 1 ? 2U : 0U)
                                      : (reading.target == kNoIndex ? 1U : 3U);
        double cost = 0;
        for (const auto& [root, ends] : touched)
            cost += (steps ? (ends & wanted) != 0 : (ends & wanted) == wanted) ? 0 : kLoose;
        return cost;
    }

    /// The end of a candidate that a patch belongs to: 1 the source, 2 the target; 0: it is a wall.
    [[nodiscard]] unsigned end_of(std::size_t p, const Reading& reading) const
    {
        if (reading.step == kNoIndex) return p == reading.source ? 1 : p == reading.target ? 2 : 0;
        const SteppedEnds& ends = stepped_[reading.step]; // both ascending
        return std::ranges::binary_search(ends.source, p)   ? 1
               : std::ranges::binary_search(ends.target, p) ? 2
                                                            : 0;
    }

    /// Lower bound of the number of irregular nodes in the source's quads.
    [[nodiscard]] long irregular(const Reading& reading) const
    {
        const SmoothPatch& end = map_.patches[reading.source];
        return std::abs(4 * (2 - static_cast<long>(end.rims.size())) - end.corners);
    }

    /// Find the candidates with ends at several heights: one end consists of all flat patches that face one
    /// way, the other of all flat patches that face the opposite way. With branches, caps count as flat.
    /// The two ends together have at least three patches. If one end is a single patch, it is the source.
    void find_stepped()
    {
        std::vector<std::size_t> flat;
        for (std::size_t p = 0; p < map_.patches.size(); ++p) {
            // The tip of a drilled hole is an end of it as well.
            const bool cap = branches_ && map_.patches[p].rims.size() == 1 &&
                             map_.patches[p].flatness > kContinues;
            if ((cap || map_.patches[p].flatness > 1 - kFlatShare) && !map_.patches[p].rims.empty())
                flat.push_back(p);
        }
        Eigen::Matrix3d whole = Eigen::Matrix3d::Zero();
        double area = 0;
        for (const SmoothPatch& patch : map_.patches) whole += patch.spread, area += patch.area;
        for (const std::size_t source : flat) {
            check_cancelled(context_);
            const Vec3 way = -map_.patches[source].normal;
            // Patches of both ends: those with the source's normal, and those with the opposite normal.
            std::vector<std::size_t> same, ahead;
            double ends = 0;
            for (const std::size_t p : flat) {
                const double facing = map_.patches[p].normal.dot(way);
                if (facing > 1 - kFlatShare) ahead.push_back(p);
                if (facing < kFlatShare - 1) same.push_back(p);
                if (std::abs(facing) > 1 - kFlatShare) ends += map_.patches[p].area;
                if (!same.empty() && same.front() < source) break;
            }
            if (ahead.empty() || same.size() + ahead.size() < 3) continue;
            const bool first = source == same.front() && same.front() < ahead.front();
            if (source != same.front() || (same.size() > 1 && (ahead.size() == 1 || !first)))
                continue; // once per axis
            vertex_seen_.clear();
            for (const std::size_t p : same)
                for (const VertexId v : map_.patches[p].vertices) vertex_seen_.add(v.index());
            const auto touches = [&](std::size_t p) {
                return std::ranges::any_of(map_.patches[p].vertices,
                                           [&](VertexId v) { return vertex_seen_.has(v.index()); });
            };
            if (std::ranges::any_of(ahead, touches)) continue; // layers would have no height there
            // All other faces must be parallel to the sweep, but for branches, which are cut off first: void
            // faces below the steps would cut them.
            const double leaning = std::max(0.0, way.dot(whole * way) - ends) / std::max(area - ends, 1e-300);
            if (!branches_ && !(leaning < kStraight)) continue;
            with_steps_.push_back({largest(same), largest(ahead), std::sqrt(leaning), stepped_.size()});
            stepped_.push_back({same, ahead});
        }
    }

    [[nodiscard]] std::size_t largest(const std::vector<std::size_t>& all) const
    {
        return *std::ranges::max_element(all, {}, [&](std::size_t p) { return map_.patches[p].area; });
    }

    void index_patch(std::size_t p)
    {
        for (const FaceId face : map_.patches[p].faces) {
            for (const Loop& loop : model_[face].loops) {
                for (std::size_t i = 0; i < loop.uses.size(); ++i) {
                    std::size_t& patch = map_.of_use[number_of(loop.uses[i])];
                    used_twice_ = used_twice_ || patch != kNoIndex;
                    patch = p;
                    map_.next[number_of(loop.uses[i])] = loop.uses[(i + 1) % loop.uses.size()];
                }
            }
        }
        for (const VertexId v : map_.patches[p].vertices) map_.at[v.index()].push_back(p);
    }

    // --- costs of ends alone ----------------------------------------------------------------------

    /// Whether a patch can be the only end: it has neighbours on its whole rim.
    [[nodiscard]] bool stands_alone(std::size_t p) const
    {
        const std::vector<Rim>& all = map_.patches[p].rims;
        return !all.empty() && std::all_of(all.begin(), all.end(), [&](const Rim& rim) {
            return std::all_of(rim.uses.begin(), rim.uses.end(),
                               [&](const EdgeUse& use) { return model_.uses_of_edge(use.edge).size() == 2; });
        });
    }

    /// Whether two patches have equal numbers of rims and no vertex in common. @pre the vertices of `a` are
    /// marked.
    [[nodiscard]] bool are_apart(std::size_t a, std::size_t b) const
    {
        const SmoothPatch &s = map_.patches[a], &t = map_.patches[b];
        return !s.rims.empty() && s.rims.size() == t.rims.size() &&
               std::none_of(t.vertices.begin(), t.vertices.end(),
                            [&](VertexId v) { return vertex_seen_.has(v.index()); });
    }

    /// Whether several wall edges leave one vertex of an end. Such ends are invalid, because only one line of
    /// nodes leaves a vertex. Example: a box with rounded rims, three of which meet at a corner. Its floor is
    /// a valid end, its sides are not.
    [[nodiscard]] bool has_fans(const Reading& reading) const
    {
        const auto is_wall = [&](std::size_t p) {
            return p != kNoIndex && p != reading.source && p != reading.target;
        };
        std::vector<char> leaving(model_.vertices.size(), 0);
        for (std::size_t e = 0; e < model_.edges.size(); ++e) {
            const Edge& edge = model_.edges[e];
            if (edge.from == edge.to || !is_wall(map_.of_use[2 * e]) || !is_wall(map_.of_use[2 * e + 1]))
                continue;
            for (const VertexId v : {edge.from, edge.to})
                leaving[v.index()] = static_cast<char>(std::min(leaving[v.index()] + 1, 2));
        }
        const auto fans = [&](std::size_t end) {
            return end != kNoIndex && std::ranges::any_of(map_.patches[end].vertices,
                                                          [&](VertexId v) { return leaving[v.index()] > 1; });
        };
        return fans(reading.source) || fans(reading.target);
    }

    // --- results for the user -----------------------------------------------------------------------

    /// Whether every vertex on the rim of an end is on a wall.
    [[nodiscard]] bool walled_in(std::size_t end, const Reading& reading) const
    {
        for (const Rim& rim : map_.patches[end].rims) {
            for (const EdgeUse& use : rim.uses) {
                const auto& at = map_.at[use_from(model_, use).index()];
                if (std::all_of(at.begin(), at.end(),
                                [&](std::size_t p) { return p == reading.source || p == reading.target; }))
                    return false;
            }
        }
        return true;
    }

    /// The class that `classify()` would return.
    [[nodiscard]] VolumeClass class_of(const Reading& reading) const
    {
        if (free_.empty()) return VolumeClass::closed;
        if (reading.source == kNoIndex) return VolumeClass::V;
        if (reading.target == kNoIndex) return VolumeClass::IV;
        if (map_.patches.size() == 2) return VolumeClass::I;
        const bool both_bare = !walled_in(reading.source, reading) && !walled_in(reading.target, reading);
        return both_bare ? VolumeClass::II : VolumeClass::III;
    }

    [[nodiscard]] std::vector<std::string> reasons(const Reading& reading, const Roles& roles) const
    {
        const std::vector<NamedEntity> source = entities_of(model_, roles.source),
                                       target = entities_of(model_, roles.target);
        if (reading.source == kNoIndex) {
            const std::size_t tubes = connected_parts(model_, roles.walls).size();
            return {formatted("all faces form {} tube{} with a free loop at either side: source and target "
                              "are missing",
                              tubes, tubes == 1 ? "" : "s")};
        }
        if (reading.target == kNoIndex) {
            return {formatted("{} has walls on its whole rim, and each ring of walls ends in one free loop: "
                              "the target is missing",
                              source)};
        }
        if (reading.step != kNoIndex && roles.source.size() > 1) {
            return {formatted("each end consists of flat faces at several heights: one of {}, which have the "
                              "same normal, and the other of the opposite {}",
                              source, target)};
        }
        if (reading.step != kNoIndex) {
            return {formatted("the flat faces opposite {} form the other end, at several heights: {}", source,
                              target)};
        }
        const std::size_t loops = map_.patches[reading.source].rims.size();
        return {formatted("two ends, {} and {}, with {} loop{} each and no vertex in common", source, target,
                          loops, loops == 1 ? "" : "s"),
                roles.walls.empty() ? "no faces between them"
                                    : "every other face joins a loop of one end to a loop of the other"};
    }

    const Model& model_;
    bool flat_alone_, branches_;
    const RunContext& context_;
    std::vector<double> angle_; ///< angle between the two faces at each edge [degrees]
    std::vector<EdgeId> sharp_; ///< edges with at least the crease angle
    PatchMap map_;
    std::vector<SteppedEnds> stepped_; ///< ends of each candidate with ends at several heights
    std::vector<EdgeUse> free_;        ///< uses whose edge has no other use
    WallParts walls_;
    Marks vertex_seen_;
    std::vector<Reading> with_steps_;
    bool used_twice_ = false;        ///< faces use an edge twice in one direction
    std::optional<WallTally> tally_; ///< empty if used_twice_
};

} // namespace

std::string in_words(const Model& model, const Roles& roles, VolumeClass value)
{
    const auto list = [&](std::string_view role, const std::vector<FaceId>& faces) -> std::string {
        if (faces.empty()) return {};
        return formatted(" {} = {{{}}}", role,
                         short_list(faces, [&](FaceId face) { return std::to_string(model[face].tag); }));
    };
    return formatted("class {}:{}{}{}", to_string(value), list("source", roles.source),
                     list("target", roles.target), list("walls", roles.walls));
}

namespace {

/// The candidates among the faces of an oriented part.
std::vector<RoleCandidate> candidates_of(const Model& part, bool flat_alone, const RoleOptions& options,
                                         const RunContext& context)
{
    Readings readings(part, flat_alone, options.branches, context);
    std::vector<Reading> held;
    double least = kInfinity;
    // The cost of the ends is a lower bound: the walls only add to it.
    std::optional<Reading> last;
    for (bool more = true; more;) {
        const std::vector<Reading> likeliest = readings.by_cost(last);
        more = likeliest.size() == kMostKept;
        for (Reading reading : likeliest) {
            last = reading;
            more = more && held.size() < options.most && reading.cost < least + options.margin;
            if (held.size() == options.most || !(reading.cost < least + options.margin)) break;
            if (!readings.holds(reading)) continue;
            reading.cost += readings.cost_of_walls(reading);
            least = std::min(least, reading.cost);
            held.push_back(reading);
        }
    }
    std::erase_if(held, [&](const Reading& reading) { return !(reading.cost < least + options.margin); });
    std::stable_sort(held.begin(), held.end(),
                     [](const Reading& x, const Reading& y) { return x.cost < y.cost; });
    std::vector<RoleCandidate> candidates;
    for (const Reading& reading : held) candidates.push_back(readings.candidate(reading));
    return candidates;
}

} // namespace

std::vector<RoleCandidate> role_candidates(const Model& model, const std::vector<FaceId>& faces,
                                           const RoleOptions& options, const RunContext& context)
{
    Model part = extract(model, faces);
    check_cancelled(context);
    orient_faces(part, context);
    std::vector<RoleCandidate> candidates = candidates_of(part, false, options, context);
    if (candidates.empty()) candidates = candidates_of(part, true, options, context);
    for (RoleCandidate& candidate : candidates) {
        for (std::vector<FaceId>* list :
             {&candidate.roles.source, &candidate.roles.target, &candidate.roles.walls}) {
            for (FaceId& face : *list) face = faces[face.index()];
        }
    }
    return candidates;
}

} // namespace lacuna::topology
