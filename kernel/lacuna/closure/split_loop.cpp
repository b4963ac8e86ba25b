// SPDX-License-Identifier: MIT
#include <lacuna/closure/detail/split_loop.h>

#include <lacuna/closure/detail/flat_fill.h>
#include <lacuna/closure/detail/four_corners.h>
#include <lacuna/closure/detail/void_entities.h>
#include <lacuna/core/shared/criteria.h>
#include <lacuna/core/shared/limits.h>
#include <lacuna/geometry/newell.h>
#include <lacuna/geometry/shared/affine.h>
#include <lacuna/geometry/shared/polyline.h>
#include <lacuna/topology/shared/face_parts.h>
#include <lacuna/topology/shared/face_plane.h>
#include <lacuna/topology/shared/use_places.h>

#include <algorithm>
#include <cmath>
#include <span>

namespace lacuna::closure {

using namespace topology;

namespace {

/// The number of consecutive uses of a loop from `start` that lie in one plane.
std::size_t flat_run(const Model& model, const Rim& rim, std::size_t start)
{
    const std::size_t uses = rim.uses.size();
    std::vector<Vec3> points{model.at(model[use_from(model, rim.uses[start])].point)};
    std::optional<Vec3> normal;
    const double tolerance = model.tolerance;
    for (std::size_t n = 0; n < uses; ++n) {
        const std::vector<Index> chain = use_points(model, rim.uses[(start + n) % uses]);
        for (std::size_t i = 1; i < chain.size(); ++i) {
            const Vec3& p = model.at(chain[i]);
            if (normal) {
                if (std::abs((p - points.front()).dot(*normal)) > tolerance) return n;
                continue;
            }
            for (std::size_t k = 1; k < points.size() && !normal; ++k) {
                const Vec3 across = (points[k] - points.front()).cross(p - points.front());
                if (across.norm() > tolerance * (points[k] - points.front()).norm())
                    normal = across.normalized();
            }
            points.push_back(p);
        }
    }
    return uses;
}

/// A run: `count` consecutive uses of a loop from index `first`. It may continue past the end of the list at
/// its start.
struct Run {
    std::size_t first = 0, count = 0;
};

std::vector<EdgeUse> uses_of(const Rim& rim, const Run& run)
{
    std::vector<EdgeUse> uses;
    for (std::size_t k = 0; k < run.count; ++k) uses.push_back(rim.uses[(run.first + k) % rim.uses.size()]);
    return uses;
}

/// Index of the first use of the run after the r-th one. After the last run, the number of uses is added.
/// @pre  the runs are ascending
std::size_t next_start(const Rim& rim, std::span<const Run> runs, std::size_t r)
{
    return r + 1 == runs.size() ? runs.front().first + rim.uses.size() : runs[r + 1].first;
}

/// The run of uses between the r-th run and the next one. @pre the runs are ascending and do not overlap
Run between(const Rim& rim, std::span<const Run> runs, std::size_t r)
{
    const std::size_t end = runs[r].first + runs[r].count;
    return {end, next_start(rim, runs, r) - end};
}

/// Whether ascending runs of a loop overlap.
bool overlap(const Rim& rim, const std::vector<Run>& runs)
{
    for (std::size_t r = 0; r < runs.size(); ++r) {
        if (runs[r].first + runs[r].count > next_start(rim, runs, r)) return true;
    }
    return false;
}

/// Separate runs of uses from a loop by straight void edges. @return the loop of each run, then the loop of
/// the rest.
std::vector<Loop> cut_off(Model& model, const Rim& rim, const std::vector<Run>& runs)
{
    std::vector<Loop> parts(runs.size() + 1);
    for (std::size_t r = 0; r < runs.size(); ++r) {
        parts[r].uses = uses_of(rim, runs[r]);
        const VertexId a = use_from(model, parts[r].uses.front()), b = use_to(model, parts[r].uses.back());
        const EdgeId edge = add_void_edge_through(model, a, b);
        parts[r].uses.push_back({edge, true});
        parts.back().uses.push_back({edge, false});
        const std::vector<EdgeUse> rest = uses_of(rim, between(rim, runs, r));
        parts.back().uses.insert(parts.back().uses.end(), rest.begin(), rest.end());
    }
    return parts;
}

/// One of the two flat runs of a loop that lies in two planes; empty for other loops.
/// @param run  for each use of the loop: the number of consecutive uses from there that lie in one plane.
std::optional<Run> half_run(const std::vector<std::size_t>& run)
{
    const std::size_t uses = run.size();
    for (std::size_t i = 0; i < uses; ++i) {
        const std::size_t first = run[i], j = (i + first) % uses;
        if (first < 2 || first >= uses || uses - first < 2 || run[j] < uses - first) continue;
        // If the two runs overlap, the loop could be split in several places, and no place is better than
        // another.
        if (run[j] == uses - first) return Run{i, first};
    }
    return std::nullopt;
}

/// How often an open chain of points changes direction.
std::size_t turns(const std::vector<Vec3>& chain)
{
    std::size_t count = 0;
    for (std::size_t i = 1; i + 1 < chain.size(); ++i) {
        const Vec3 a = chain[i] - chain[i - 1], b = chain[i + 1] - chain[i];
        count += a.cross(b).norm() > kFileAccuracy * a.norm() * b.norm() ? 1 : 0;
    }
    return count;
}

/// Whether a flat run of a loop shows that a flat face is missing there. Two straight edges do not show it:
/// they are always coplanar.
bool tells_plane(const Model& model, const Rim& rim, const Run& run)
{
    return turns(use_places(model, uses_of(rim, run))) >= 2;
}

/// Whether the uses contain a bent side between two sides that are not parallel, as in a ring sector. A
/// missing face opposite may then be bent in the same way.
bool is_of_ring(const Model& model, const std::vector<EdgeUse>& uses)
{
    const auto way = [&](EdgeUse use) {
        const std::vector<Vec3> chain = use_places(model, use);
        return (chain.back() - chain.front()).stableNormalized();
    };
    std::optional<std::size_t> corner;
    for (std::size_t k = 1; k < uses.size(); ++k) {
        if (!turns_sharply(model, uses[k - 1], uses[k])) continue;
        if (corner && way(uses[*corner - 1]).cross(way(uses[k])).norm() > kParallel) {
            const auto first = uses.begin() + static_cast<std::ptrdiff_t>(*corner);
            if (turns(use_places(model, {first, uses.begin() + static_cast<std::ptrdiff_t>(k)})) > 0)
                return true;
        }
        corner = k;
    }
    return false;
}

/// The ends of a groove: planar runs of a loop with no given face in their plane. Two straight edges are not
/// an end, because they are always coplanar; nor is the side of a ring sector (see `is_of_ring()`).
std::vector<Run> groove_ends(const Model& model, const Rim& rim, const std::vector<std::size_t>& run)
{
    const std::size_t uses = rim.uses.size();
    std::vector<Run> ends;
    for (std::size_t i = 0; i < uses; ++i) {
        if (run[i] == 0 || run[i] == uses) continue;
        if (run[(i + uses - 1) % uses] > run[i]) continue; // the run is a part of a longer one
        const std::vector<EdgeUse> own = uses_of(rim, {i, run[i]});
        const std::vector<Vec3> points = use_places(model, own);
        if (turns(points) < 2 || is_of_ring(model, own)) continue;
        const geometry::Plane plane = geometry::newell_plane({&points, 1});
        const bool given = std::ranges::all_of(own, [&](const EdgeUse& use) {
            return lies_in_plane(model, model.uses_of_edge(use.edge).back().face, plane);
        });
        if (!given) ends.push_back({i, run[i]});
    }
    return ends;
}

/// The common direction of the straight edges of a groove's mouth that run from end to end. Bent parts of the
/// mouth are ignored.
/// @return  empty if there are no such edges, or if they are not parallel.
std::optional<Vec3> way_of(const Model& model, const Rim& rim, const std::vector<Run>& ends)
{
    std::optional<Vec3> way;
    for (std::size_t r = 0; r < ends.size(); ++r) {
        const std::vector<EdgeUse> own = uses_of(rim, between(rim, ends, r));
        if (own.empty()) continue;
        const std::vector<Vec3> chain = use_places(model, own);
        if (turns(chain) > 0) continue; // a bent part, such as the rim of a given end across the mouth
        const Vec3 along = (chain.back() - chain.front()).normalized();
        if (way && way->cross(along).norm() > kParallel) return std::nullopt;
        way = along;
    }
    return way;
}

/// Whether all curved faces run in the direction `way`. In a bent groove they do not: its long edges are
/// planar and were taken for ends, and `way` is the direction of straight edges at the true ends.
bool all_go_along(const Model& model, const Vec3& way)
{
    return std::ranges::all_of(all_faces(model), [&](FaceId face) {
        std::vector<Vec3> normals;
        for (const Triangle& t : model[face].triangles)
            normals.push_back(
                (model.at(t[1]) - model.at(t[0])).cross(model.at(t[2]) - model.at(t[0])).stableNormalized());
        const bool along = std::ranges::all_of(
            normals, [&](const Vec3& n) { return std::abs(n.dot(way)) <= kParallel; });
        return along || std::ranges::all_of(normals, [&](const Vec3& n) {
                   return n.cross(normals.front()).norm() <= kParallel;
               });
    });
}

/// Whether two runs of a loop, one of them traversed backwards, are congruent within `kAlikeSizes`.
bool are_alike(const Model& model, const Rim& rim, const Run& a, const Run& b)
{
    std::vector<Vec3> from = use_places(model, uses_of(rim, a)), to = use_places(model, uses_of(rim, b));
    std::ranges::reverse(to);
    const double allowed = kAlikeSizes * geometry::length(from);
    from = geometry::even_places(from, kChords);
    to = geometry::even_places(to, kChords);
    const geometry::RigidFit moved = geometry::fit_rigid(from, to, false);
    for (std::size_t i = 0; i < from.size(); ++i)
        if ((moved(from[i]) - to[i]).norm() > allowed) return false;
    return true;
}

/// The ends of a channel: two congruent runs with edges of walls between them. Each run must have at least
/// three edges, because two edges do not determine the face (triangle or rectangle), and one planar edge may
/// belong to a bent wall.
std::vector<Run> channel_ends(const Model& model, const Rim& rim, std::vector<Run> ends)
{
    std::erase_if(ends, [](const Run& run) { return run.count < 3; });
    if (ends.size() != 2 || overlap(rim, ends)) return {};
    if (between(rim, ends, 0).count == 0 || between(rim, ends, 1).count == 0) return {};
    return are_alike(model, rim, ends[0], ends[1]) ? ends : std::vector<Run>{};
}

/// Whether some runs are the ends of a straight groove.
bool ends_straight_groove(const Model& model, const Rim& rim, const std::vector<Run>& ends)
{
    if (ends.size() < 2 || overlap(rim, ends)) return false;
    const std::optional<Vec3> way = way_of(model, rim, ends);
    return way && all_go_along(model, *way);
}

/// Separate the ends of a straight groove from its loop. Runs in the plane of the mouth are parts of the
/// mouth, not ends.
/// @return  empty if the loop is not that of a straight groove; the model is then unchanged
std::optional<SplitLoop> part_groove(Model& model, const Rim& rim, std::vector<Run> ends)
{
    if (!ends_straight_groove(model, rim, ends)) return std::nullopt;
    Model tried = model;
    std::vector<Loop> parts = cut_off(tried, rim, ends);
    if (!is_flat(tried, {parts.back().uses})) return std::nullopt;
    const std::vector<Vec3> mouth = use_places(tried, parts.back().uses);
    const geometry::Plane plane = geometry::newell_plane({&mouth, 1});
    const auto in_mouth = [&](const Run& run) {
        return std::ranges::all_of(use_places(model, uses_of(rim, run)), [&](const Vec3& p) {
            return std::abs(geometry::height(plane, p)) <= model.tolerance;
        });
    };
    if (std::erase_if(ends, in_mouth) > 0) return part_groove(model, rim, std::move(ends));
    model = std::move(tried);
    return SplitLoop{std::move(parts)};
}

} // namespace

std::optional<SplitLoop> split_loop(Model& model, const Rim& rim)
{
    std::vector<std::size_t> run;
    for (std::size_t i = 0; i < rim.uses.size(); ++i) run.push_back(flat_run(model, rim, i));
    if (const auto half = half_run(run)) {
        const bool one = tells_plane(model, rim, *half),
                   other = tells_plane(model, rim, between(rim, {&*half, 1}, 0));
        if (one || other) return SplitLoop{cut_off(model, rim, {*half})};
    }
    const std::vector<Run> ends = groove_ends(model, rim, run);
    if (auto groove = part_groove(model, rim, ends)) return groove;
    const std::vector<Run> alike = channel_ends(model, rim, ends);
    if (alike.empty()) return std::nullopt;
    return SplitLoop{cut_off(model, rim, alike), true};
}

} // namespace lacuna::closure
