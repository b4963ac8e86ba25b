// SPDX-License-Identifier: MIT
#include <lacuna/geometry/shared/triangulate.h>

#include <lacuna/core/error.h>
#include <lacuna/core/shared/constants.h>
#include <lacuna/geometry/shared/delaunay.h>
#include <lacuna/geometry/shared/predicates.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <queue>

namespace lacuna::geometry {
namespace {

NamedEntity named_loop(std::size_t loop) { return {"loop", static_cast<long long>(loop) + 1}; }

void check_loops(std::span<const Vec2> points, std::span<const std::vector<Index>> loops)
{
    if (loops.empty()) throw InvalidInput("geometry.no_loop", "triangulate needs at least one loop");
    for (std::size_t l = 0; l < loops.size(); ++l) {
        const NamedEntity loop = named_loop(l);
        if (loops[l].size() < 3) {
            throw InvalidInput("geometry.short_loop", "{} of {} has {} points; a region needs at least {}",
                               loop, loops.size(), found(loops[l].size()), needed(3));
        }
        for (const Index p : loops[l]) {
            if (p >= 0 && index(p) < points.size() && points[index(p)].allFinite()) continue;
            throw InvalidInput("geometry.bad_point",
                               "{} of {} uses point {} of {}, which does not exist or is not finite", loop,
                               loops.size(), found(p + 1), points.size());
        }
        const Vec2& a = points[index(loops[l][0])];
        const auto differs = [&](Index p) { return points[index(p)] != a; };
        const auto other = std::find_if(loops[l].begin(), loops[l].end(), differs);
        const bool flat = other == loops[l].end() || std::all_of(other, loops[l].end(), [&](Index p) {
                              return orient2d(a, points[index(*other)], points[index(p)]) == 0;
                          });
        if (flat)
            throw InvalidInput("geometry.zero_area", "{} of {} has zero area: all its points are collinear",
                               loop, loops.size());
    }
    if (const auto crossing = find_crossing(points, loops)) {
        throw InvalidInput("geometry.loops_cross",
                           "segment {0} of {1} of {4} crosses or touches segment {2} of {3} of {4}; loops "
                           "must be simple and disjoint",
                           crossing->segment_a + 1, named_loop(crossing->loop_a), crossing->segment_b + 1,
                           named_loop(crossing->loop_b), loops.size());
    }
}

// --- adding points ----------------------------------------------------------------------------------

// Ratios of circumradius to target length. An equilateral triangle of target size has 1/√3. A triangle is too
// large above 1/√2, so a right triangle whose legs have the target length is accepted.
constexpr double kEquilateral = 1 / std::numbers::sqrt3;
constexpr double kTooLarge = 1 / std::numbers::sqrt2;
// Smallest ratio of circumradius to shortest side for which inserting circumcentres provably ends, with
// graded triangles (Ruppert 1995).
constexpr double kTooSkinny = std::numbers::sqrt2;

class Refinement {
public:
    Refinement(DelaunayMesh& mesh, std::span<const std::vector<Index>> loops,
               const TriangulateOptions& options)
        : mesh_(mesh), options_(options), size_(mesh.points().size(), kInfinity)
    {
        rim_sizes(loops);
        grade_rim();
        state_.resize(mesh_.triangles().size());
    }

    void run(const RunContext& context)
    {
        for (std::size_t t = 0; t < mesh_.triangles().size(); ++t) judge(static_cast<Index>(t));
        for (std::size_t t = 0; t < mesh_.triangles().size(); ++t) enqueue(static_cast<Index>(t));
        const auto limit = mesh_.points().size() + options_.max_points;
        while (!queue_.empty() && mesh_.points().size() < limit) {
            check_cancelled(context);
            const Waiting next = queue_.top();
            queue_.pop();
            State& state = state_[index(next.triangle)];
            if (state.stamp != next.stamp || state.settled) continue;
            if (improve(next.triangle)) continue;
            state_[index(next.triangle)].settled = true;
            for (int side = 0; side < 3; ++side) {
                if (!mesh_[next.triangle].is_fixed(side)) enqueue(mesh_[next.triangle].across(side));
            }
        }
    }

private:
    struct State {
        double badness = 0;  ///< above 1: the triangle should be refined
        Index stamp = 0;     ///< identifies queue entries of an earlier triangle with the same number
        bool settled = true; ///< good, or cannot be improved
        bool queued = false;
    };
    struct Waiting {
        double badness;
        Index triangle, stamp;
        bool operator<(const Waiting& other) const
        {
            return std::pair(badness, -triangle) < std::pair(other.badness, -other.triangle);
        }
    };

    void rim_sizes(std::span<const std::vector<Index>> loops)
    {
        for (const std::vector<Index>& loop : loops) {
            const std::size_t count = loop.size();
            for (std::size_t k = 0; k < count; ++k) {
                const Vec2& p = mesh_.at(loop[k]);
                const double before = (p - mesh_.at(loop[(k + count - 1) % count])).norm();
                const double after = (p - mesh_.at(loop[(k + 1) % count])).norm();
                size_[index(loop[k])] = std::min(std::sqrt(before) * std::sqrt(after), wished(p));
            }
        }
    }

    /// Limit the sizes at rim points by the graded sizes of other points, along the sides of the first
    /// triangulation.
    void grade_rim()
    {
        if (!std::isfinite(options_.grading)) return;
        std::vector<std::vector<Index>> around(mesh_.points().size());
        for (const DelaunayTriangle& tri : mesh_.triangles()) {
            if (!tri.inside) continue;
            for (int side = 0; side < 3; ++side) {
                around[index(tri.from(side))].push_back(tri.to(side));
                around[index(tri.to(side))].push_back(tri.from(side));
            }
        }
        std::priority_queue<std::pair<double, Index>, std::vector<std::pair<double, Index>>, std::greater<>>
            queue;
        for (std::size_t p = 0; p < around.size(); ++p) {
            if (!around[p].empty()) queue.emplace(size_[p], static_cast<Index>(p));
        }
        while (!queue.empty()) {
            const auto [size, p] = queue.top();
            queue.pop();
            if (size > size_[index(p)]) continue;
            for (const Index q : around[index(p)]) {
                const double bound = size + options_.grading * (mesh_.at(q) - mesh_.at(p)).norm();
                if (bound >= size_[index(q)]) continue;
                size_[index(q)] = bound;
                queue.emplace(bound, q);
            }
        }
    }

    [[nodiscard]] double wished(const Vec2& p) const
    {
        if (!options_.size) return kInfinity;
        const double value = options_.size(p);
        if (value > 0) return value;
        throw InvalidInput("geometry.bad_size",
                           "the target edge length at ({:.6g}, {:.6g}) is {:.6g}; it must be above {}", p.x(),
                           p.y(), found(value), needed(0));
    }

    [[nodiscard]] double wanted_at(const Vec2& p, Index holder) const
    {
        double wanted = wished(p);
        if (std::isfinite(options_.grading)) {
            for (const Index corner : mesh_[holder].corner) {
                wanted = std::min(wanted,
                                  size_[index(corner)] + options_.grading * (mesh_.at(corner) - p).norm());
            }
        }
        return wanted;
    }

    [[nodiscard]] double mean_size(const Triangle& corner) const
    {
        return (size_[index(corner[0])] + size_[index(corner[1])] + size_[index(corner[2])]) / 3;
    }

    void judge(Index t)
    {
        State& state = state_[index(t)];
        ++state.stamp;
        state.queued = false;
        state.settled = true;
        const DelaunayTriangle& tri = mesh_[t];
        if (!tri.inside) return;
        double shortest = kInfinity;
        double product = 1;
        for (int side = 0; side < 3; ++side) {
            const double length = (mesh_.at(tri.to(side)) - mesh_.at(tri.from(side))).norm();
            shortest = std::min(shortest, length);
            product *= length;
        }
        const double area2 = orient2d(mesh_.at(tri.corner[0]), mesh_.at(tri.corner[1]),
                                      mesh_.at(tri.corner[2]));
        const double radius = std::min(product / (2 * area2), std::numeric_limits<double>::max());
        state.badness = std::max(radius / (kTooLarge * mean_size(tri.corner)),
                                 radius / (kTooSkinny * shortest));
        state.settled = !(state.badness > 1);
    }

    /// Queue a triangle for refinement. It is queued only when one of its sides is final (on the rim, or next
    /// to a settled triangle), so that points are added in rows from the rim inwards.
    void enqueue(Index t)
    {
        State& state = state_[index(t)];
        if (state.settled || state.queued) return;
        for (int side = 0; side < 3; ++side) {
            if (!is_front(t, side)) continue;
            state.queued = true;
            queue_.push({state.badness, t, state.stamp});
            return;
        }
    }

    [[nodiscard]] bool is_front(Index t, int side) const
    {
        return mesh_[t].is_fixed(side) || state_[index(mesh_[t].across(side))].settled;
    }

    bool improve(Index t)
    {
        int base = -1;
        double base_length = 0;
        double shortest = kInfinity;
        const DelaunayTriangle& tri = mesh_[t];
        for (int side = 0; side < 3; ++side) {
            const double length = (mesh_.at(tri.to(side)) - mesh_.at(tri.from(side))).norm();
            shortest = std::min(shortest, length);
            if (!is_front(t, side) || (base >= 0 && length >= base_length)) continue;
            base = side;
            base_length = length;
        }
        if (base < 0) return false;
        const Vec2 a = mesh_.at(tri.from(base)), b = mesh_.at(tri.to(base));
        const Vec2 middle = (a + b) / 2;
        const Vec2 inward = Vec2(a.y() - b.y(), b.x() - a.x()) / base_length;
        const Vec2 apex = mesh_.at(tri.corner[static_cast<std::size_t>(base)]) - middle;
        // Height of the triangle's circumcentre over the middle of the base.
        const double half = base_length / 2;
        const double height = (apex.squaredNorm() - half * half) / (2 * apex.dot(inward));
        const double wanted = std::min(kEquilateral * mean_size(tri.corner), kTooSkinny * shortest);
        const double radius = std::max(wanted, half);
        const double reach = radius + std::sqrt(radius * radius - half * half);
        if (!std::isfinite(height)) return false;
        if (height > reach && add(t, middle + reach * inward, shortest)) return true;
        return add(t, middle + height * inward, shortest);
    }

    bool add(Index t, const Vec2& p, double shortest)
    {
        const Index holder = mesh_.locate(p, t);
        if (holder < 0 || !mesh_[holder].inside || !mesh_.find_cavity(p, holder, cavity_)) return false;
        const double wanted = wanted_at(p, holder);
        // Other points are at least a circumradius away, because the circumcircle of a triangle is empty.
        const double keep_away = std::min(kEquilateral * wanted, shortest);
        for (const DelaunayMesh::Cavity::Border& side : cavity_.border) {
            const Vec2 to_from = mesh_.at(side.from) - p;
            const Vec2 to_to = mesh_.at(side.to) - p;
            if (to_from.norm() < keep_away) return false;
            if (side.fixed && to_from.dot(to_to) < 0) return false; // inside the segment's diametral circle
        }
        mesh_.fill_cavity(p, cavity_, fresh_);
        size_.push_back(wanted);
        state_.resize(mesh_.triangles().size());
        for (const Index made : fresh_) judge(made);
        for (const Index made : fresh_) {
            enqueue(made);
            if (!mesh_[made].is_fixed(0)) enqueue(mesh_[made].across(0));
        }
        return true;
    }

    DelaunayMesh& mesh_;
    const TriangulateOptions& options_;
    std::vector<double> size_; ///< target edge length at each point
    std::vector<State> state_; ///< state of each triangle
    std::priority_queue<Waiting> queue_;
    DelaunayMesh::Cavity cavity_;
    std::vector<Index> fresh_;
};

Triangulation take_inside(const DelaunayMesh& mesh)
{
    Triangulation result;
    const auto given = mesh.points().begin() + mesh.given_count();
    result.points.assign(mesh.points().begin(), given);
    result.points.insert(result.points.end(), given + 3, mesh.points().end());
    for (const DelaunayTriangle& tri : mesh.triangles()) {
        if (!tri.inside) continue;
        Triangle corner = tri.corner;
        for (Index& p : corner) p -= p >= mesh.given_count() ? 3 : 0;
        result.triangles.push_back(corner);
    }
    return result;
}

} // namespace

Triangulation triangulate(std::span<const Vec2> points, std::span<const std::vector<Index>> loops,
                          const TriangulateOptions& options, const RunContext& context)
{
    if (!(options.grading >= 0)) {
        throw InvalidInput("geometry.bad_grading", "grading is {:.6g}; it must be {} or above",
                           found(options.grading), needed(0));
    }
    check_loops(points, loops);
    std::vector<Index> used;
    for (const std::vector<Index>& loop : loops) used.insert(used.end(), loop.begin(), loop.end());
    DelaunayMesh mesh(points, used);
    for (const std::vector<Index>& loop : loops) {
        for (std::size_t k = 0; k < loop.size(); ++k) mesh.fix_segment(loop[k], loop[(k + 1) % loop.size()]);
    }
    mesh.mark_inside();
    if (options.interior_points) Refinement(mesh, loops, options).run(context);
    return take_inside(mesh);
}

} // namespace lacuna::geometry
