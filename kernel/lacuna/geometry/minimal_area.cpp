// SPDX-License-Identifier: MIT
#include <lacuna/geometry/minimal_area.h>

#include <lacuna/core/error.h>
#include <lacuna/geometry/detail/loop_points.h>
#include <lacuna/geometry/detail/patch_mesh.h>
#include <lacuna/geometry/detail/polygon_cover.h>
#include <lacuna/geometry/newell.h>
#include <lacuna/geometry/triangulate.h>

#include <algorithm>
#include <limits>
#include <map>
#include <optional>
#include <string>

namespace lacuna::geometry {
namespace {

void check_loops(std::span<const Vec3> points, std::span<const std::vector<Index>> loops)
{
    if (loops.empty()) throw InvalidInput("geometry.no_loop", "minimal_area needs at least one loop");
    std::vector<Index> loop_of(points.size(), -1);
    for (std::size_t l = 0; l < loops.size(); ++l) {
        const std::string name = "loop " + std::to_string(l + 1) + " of " + std::to_string(loops.size());
        check_loop_points<Vec3>(points, loops[l], name, "a surface");
        for (const Index p : loops[l]) {
            if (loop_of[index(p)] >= 0) {
                throw InvalidInput("geometry.loops_touch", name + " contains point " + std::to_string(p + 1) +
                                                               ", which is also in loop " +
                                                               std::to_string(loop_of[index(p)] + 1) +
                                                               "; loops must be simple and disjoint");
            }
            loop_of[index(p)] = static_cast<Index>(l);
        }
    }
}

void check_options(const MinimalAreaOptions& options)
{
    const bool good = options.bend >= 0 && options.shape >= 0 && options.exact_limit >= 8 &&
                      options.bridge_trials >= 1 && options.grading >= 0;
    if (good) return;
    throw InvalidInput("geometry.bad_option",
                       "minimal_area needs bend, shape and grading of 0 or above, exact_limit of 8 "
                       "or above and at least one of bridge_trials");
}

// --- several loops become one -------------------------------------------------------------------------

struct Bridge {
    Index a, b; ///< points
    double length2;
};

/// The shortest bridges between two loops, `count` of them, spaced evenly along the first loop.
std::vector<Bridge> bridges_between(std::span<const Vec3> points, const std::vector<Index>& from,
                                    const std::vector<Index>& to, std::size_t count)
{
    std::vector<std::pair<double, std::size_t>> order;
    std::vector<Bridge> nearest;
    for (std::size_t i = 0; i < from.size(); ++i) {
        Bridge best{from[i], -1, std::numeric_limits<double>::infinity()};
        for (const Index q : to) {
            const double length2 = (points[index(q)] - points[index(from[i])]).squaredNorm();
            if (length2 < best.length2) best = {from[i], q, length2};
        }
        order.emplace_back(best.length2, i);
        nearest.push_back(best);
    }
    std::sort(order.begin(), order.end());
    std::vector<std::size_t> chosen;
    for (const auto& [length2, i] : order) {
        if (chosen.size() == count) break;
        const bool apart = std::all_of(chosen.begin(), chosen.end(), [&, i = i](std::size_t j) {
            const std::size_t steps = i > j ? i - j : j - i;
            return std::min(steps, from.size() - steps) * (count + 1) >= from.size();
        });
        if (apart) chosen.push_back(i);
    }
    std::vector<Bridge> result;
    result.reserve(chosen.size());
    for (const std::size_t i : chosen) result.push_back(nearest[i]);
    return result;
}

/// Bridges of a minimum spanning tree over the loops, `trials` choices for each, in the order a tree grows
/// Candidate bridges of a minimum spanning tree over the loops, `trials` for each loop, in the order in which
/// the tree grows from the first loop: every bridge starts at a loop reached earlier.
struct Joint {
    std::size_t loop; ///< the loop that the bridge reaches
    std::vector<Bridge> choices;
};

std::vector<Joint> spanning_joints(std::span<const Vec3> points, std::span<const std::vector<Index>> loops,
                                   std::size_t trials)
{
    const std::size_t count = loops.size();
    std::vector<double> least(count, std::numeric_limits<double>::infinity());
    std::vector<std::size_t> from(count, 0);
    std::vector<bool> reached(count, false);
    std::vector<Joint> joints;
    std::size_t last = 0;
    reached[0] = true;
    for (std::size_t step = 1; step < count; ++step) {
        std::size_t next = count;
        for (std::size_t l = 0; l < count; ++l) {
            if (reached[l]) continue;
            const double length2 = bridges_between(points, loops[last], loops[l], 1).front().length2;
            if (length2 < least[l]) {
                least[l] = length2;
                from[l] = last;
            }
            if (next == count || least[l] < least[next]) next = l;
        }
        joints.push_back({next, bridges_between(points, loops[from[next]], loops[next], trials)});
        reached[next] = true;
        last = next;
    }
    return joints;
}

/// One polygon along all loops, and the pairs of its sides that belong to a bridge.
struct JoinedPolygon {
    CoverPolygon polygon;
    std::vector<std::pair<std::size_t, std::size_t>> banks; ///< to merge; side k starts at corner k
};

JoinedPolygon join_loops(std::span<const Vec3> points, std::span<const std::vector<Index>> loops,
                         const std::vector<Joint>& joints, std::size_t trial)
{
    struct Corner {
        Index point;
        Index bank; ///< the side after this corner is bank 2·j or 2·j + 1 of bridge j; -1: a side of a loop
    };
    std::vector<Corner> walk;
    for (const Index p : loops[0]) walk.push_back({p, -1});
    for (std::size_t j = 0; j < joints.size(); ++j) {
        const Bridge& bridge = joints[j].choices[trial % joints[j].choices.size()];
        const std::vector<Index>& loop = loops[joints[j].loop];
        const auto at = std::find_if(walk.begin(), walk.end(),
                                     [&](const Corner& c) { return c.point == bridge.a; });
        const auto start = static_cast<std::size_t>(std::find(loop.begin(), loop.end(), bridge.b) -
                                                    loop.begin());
        std::vector<Corner> detour{{bridge.a, static_cast<Index>(2 * j)}};
        for (std::size_t k = 0; k < loop.size(); ++k) detour.push_back({loop[(start + k) % loop.size()], -1});
        detour.push_back({bridge.b, static_cast<Index>(2 * j + 1)});
        walk.insert(at, detour.begin(), detour.end()); // inserted before the corner, whose side is unchanged
    }
    JoinedPolygon joined;
    joined.banks.resize(joints.size());
    for (std::size_t k = 0; k < walk.size(); ++k) {
        const Index p = walk[k].point;
        joined.polygon.point.push_back(p);
        joined.polygon.place.push_back(points[index(p)]);
        joined.polygon.barred.insert(std::minmax(p, walk[(k + 1) % walk.size()].point));
        if (walk[k].bank < 0) continue;
        auto& banks = joined.banks[index(walk[k].bank / 2)];
        (walk[k].bank % 2 == 0 ? banks.first : banks.second) = k;
    }
    return joined;
}

// --- surfaces -----------------------------------------------------------------------------------------

using SideMap = std::map<std::pair<Index, Index>, std::pair<Index, std::size_t>>;

/// Triangle and side number of each directed side.
SideMap map_sides(const std::vector<Triangle>& triangles)
{
    SideMap side_of;
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        for (std::size_t side = 0; side < 3; ++side) {
            side_of[{triangles[t][(side + 1) % 3], triangles[t][(side + 2) % 3]}] = {static_cast<Index>(t),
                                                                                     side};
        }
    }
    return side_of;
}

std::vector<Triangle> neighbours(const SideMap& side_of, std::size_t triangles)
{
    std::vector<Triangle> next(triangles, Triangle{-1, -1, -1});
    for (const auto& [ends, here] : side_of) {
        const auto twin = side_of.find({ends.second, ends.first});
        if (twin != side_of.end()) next[index(here.first)][here.second] = twin->second.first;
    }
    return next;
}

/// Triangles over the points, merged along the bridges; nothing if duplicate sides remain.
std::optional<PatchMesh> glued(std::span<const Vec3> points, const JoinedPolygon& joined, const Cover& cover)
{
    const auto corners = static_cast<Index>(joined.polygon.point.size());
    const SideMap side_of = map_sides(cover.triangles);
    std::vector<Triangle> next = neighbours(side_of, cover.triangles.size());
    for (const auto& [first, second] : joined.banks) {
        const auto side = [&](std::size_t k) {
            return side_of.at({static_cast<Index>(k), (static_cast<Index>(k) + 1) % corners});
        };
        next[index(side(first).first)][side(first).second] = side(second).first;
        next[index(side(second).first)][side(second).second] = side(first).first;
    }
    std::vector<Triangle> triangles = cover.triangles;
    for (Triangle& triangle : triangles) {
        for (Index& corner : triangle) corner = joined.polygon.point[index(corner)];
    }
    PatchMesh mesh({points.begin(), points.end()}, std::move(triangles), std::move(next));
    if (!mesh.resolve_doubled()) return std::nullopt;
    return mesh;
}

/// Delaunay triangles of the projection of the loops to their Newell plane, if the projection is one region
/// whose boundary has the direction of the loops.
std::optional<PatchMesh> shadow_patch(std::span<const Vec3> points, std::span<const std::vector<Index>> loops)
{
    std::vector<std::vector<Vec3>> places(loops.size());
    for (std::size_t l = 0; l < loops.size(); ++l) {
        for (const Index p : loops[l]) places[l].push_back(points[index(p)]);
    }
    const Plane plane = newell_plane(places);
    std::vector<Vec2> shadow;
    for (const Vec3& p : points) shadow.push_back(to_plane(plane, p));
    Triangulation flat;
    try {
        flat = triangulate(shadow, loops, {.interior_points = false, .single_region = true});
    } catch (const InvalidInput&) {
        return std::nullopt; // the projection intersects itself, or has no area
    }
    const SideMap side_of = map_sides(flat.triangles);
    for (const std::vector<Index>& loop : loops) {
        for (std::size_t k = 0; k < loop.size(); ++k) {
            if (!side_of.contains({loop[k], loop[(k + 1) % loop.size()]})) return std::nullopt;
        }
    }
    std::vector<Triangle> next = neighbours(side_of, flat.triangles.size());
    return PatchMesh({points.begin(), points.end()}, std::move(flat.triangles), std::move(next));
}

PatchMesh best_patch(std::span<const Vec3> points, std::span<const std::vector<Index>> loops,
                     const MinimalAreaOptions& options, const RunContext& context)
{
    std::size_t count = 0;
    for (const std::vector<Index>& loop : loops) count += loop.size();
    if (count > options.exact_limit) {
        if (auto patch = shadow_patch(points, loops)) return *std::move(patch);
    }
    const std::vector<Joint> joints = spanning_joints(points, loops, options.bridge_trials);
    const CoverOptions cover_options{options.bend, options.shape, options.exact_limit};
    std::optional<PatchMesh> best;
    CoverCost best_cost;
    const std::size_t trials = joints.empty() ? 1 : options.bridge_trials;
    for (std::size_t trial = 0; trial < trials; ++trial) {
        check_cancelled(context);
        const JoinedPolygon joined = join_loops(points, loops, joints, trial);
        const Cover cover = cover_polygon(joined.polygon, cover_options);
        if (!cover.found || (best && !(cover.cost < best_cost))) continue;
        auto patch = glued(points, joined, cover);
        if (!patch) continue;
        best = std::move(patch);
        best_cost = cover.cost;
    }
    if (best) return *std::move(best);
    throw InvalidInput("geometry.no_surface",
                       "the " + std::to_string(loops.size()) +
                           " loops cannot be connected by triangles between their points without "
                           "a duplicate side; give the loops more points");
}

} // namespace

MinimalArea minimal_area(std::span<const Vec3> points, std::span<const std::vector<Index>> loops,
                         const MinimalAreaOptions& options, const RunContext& context)
{
    check_options(options);
    check_loops(points, loops);
    PatchMesh patch = best_patch(points, loops, options, context);
    if (options.interior_points) {
        patch.refine(options.grading, options.max_points, context);
        for (int step = 0; step < options.fairing_steps; ++step) {
            check_cancelled(context);
            patch.relax();
            patch.make_delaunay();
            patch.place_harmonic(context);
        }
        patch.make_delaunay();
    }
    return {patch.points(), patch.triangles(), patch.area()};
}

} // namespace lacuna::geometry
