// SPDX-License-Identifier: MIT
#include <lacuna/sweep/detail/same_edges.h>

#include <lacuna/core/shared/criteria.h>
#include <lacuna/core/shared/limits.h>
#include <lacuna/geometry/shared/polyline.h>
#include <lacuna/sweep/assembly.h>
#include <lacuna/sweep/detail/rim_arcs.h>
#include <lacuna/topology/shared/give_mesh.h>
#include <lacuna/topology/shared/use_places.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace lacuna::sweep {

using namespace topology;

SameEdges::SameEdges(std::span<const AssemblyMember> members, std::span<const SharedFace> shared,
                     std::span<const std::pair<std::size_t, FaceId>> beside,
                     std::span<const PeriodicFaces> periodic)
    : members_(members), shared_(shared), periodic_(periodic)
{
    for (std::size_t m = 0; m < members.size(); ++m) {
        first_.push_back(edges_.size());
        for (std::size_t e = 0; e < model(m).edges.size(); ++e)
            edges_.push_back(member_edge(model(m), m, EdgeId(e)));
    }
    for (const auto& [m, face] : beside)
        for (const EdgeId edge : rim_edges(model(m), face)) beside_.insert(number(m, edge));
    find_same();
    join_periodic();
    for (std::size_t e = 0; e < edges_.size(); ++e) set_.push_back(same_.find(e));
    find_beside_ends();
    find_cusps();
    find_kept();
}

int SameEdges::given_sides(std::size_t e) const
{
    return static_cast<int>(model(edges_[e].member)[edges_[e].edge].points.size()) - 1;
}

bool SameEdges::runs_along(std::size_t e) const { return run_alike(edges_[e], edges_[set_[e]]); }

const std::size_t* SameEdges::kept_one(std::size_t set) const
{
    const auto found = kept_one_.find(set);
    return found == kept_one_.end() ? nullptr : &found->second;
}

const std::array<double, 2>* SameEdges::cusps(std::size_t set) const
{
    const auto found = cusps_.find(set);
    return found == cusps_.end() ? nullptr : &found->second;
}

void SameEdges::find_same()
{
    std::vector<std::size_t> order(edges_.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    planned_.assign(edges_.size(), false);
    std::ranges::sort(order, {}, [&](std::size_t e) { return edges_[e].box.min().x(); });
    same_ = geometry::UnionFind(edges_.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
        const MemberEdge& a = edges_[order[i]];
        const double reach = a.box.min().x() + model(a.member).tolerance + kAlikeSizes * a.length;
        for (std::size_t k = i + 1; k < order.size() && edges_[order[k]].box.min().x() <= reach; ++k) {
            const MemberEdge& b = edges_[order[k]];
            const double within = std::max(model(a.member).tolerance, model(b.member).tolerance);
            if (a.member == b.member || !is_same(a, b, within)) continue;
            same_.unite(std::min(order[i], order[k]), std::max(order[i], order[k]));
            planned_[order[i]] = planned_[order[k]] = true;
        }
    }
    for (const SharedFace& face : shared_) find_same_rims(face);
    for (const std::size_t e : beside_) planned_[e] = true;
}

void SameEdges::find_same_rims(const SharedFace& face)
{
    const auto closed_rims = [&](std::size_t m, FaceId of) {
        std::vector<std::size_t> rims;
        for (const Loop& loop : border_loops(model(m), of))
            if (loop.uses.size() == 1) rims.push_back(number(m, loop.uses.front().edge));
        return rims;
    };
    const std::vector<std::size_t> own = closed_rims(face.a, face.face_a),
                                   others = closed_rims(face.b, face.face_b);
    if (own.size() != others.size()) return;
    for (const std::size_t a : own) {
        const std::size_t b = *std::ranges::min_element(others, {}, [&](std::size_t other) {
            // Concentric rims have the same centre, so their lengths are compared too.
            return (edges_[other].centre - edges_[a].centre).norm() +
                   std::abs(edges_[other].length - edges_[a].length);
        });
        same_.unite(std::min(a, b), std::max(a, b));
        planned_[a] = planned_[b] = true;
    }
}

void SameEdges::join_periodic()
{
    // For each set, keyed by its first edge: its edges, and the motions that move them onto the first one.
    std::map<std::size_t, std::vector<std::pair<std::size_t, Eigen::Isometry3d>>> images;
    for (const PeriodicFaces& pair : periodic_)
        for (const auto& [own, image] : pair.edges) {
            const std::size_t a = same_.find(number(pair.a, own)), b = same_.find(number(pair.b, image));
            images[a].emplace_back(b, pair.onto.inverse());
            images[b].emplace_back(a, pair.onto);
        }
    std::map<std::size_t, Eigen::Isometry3d> home;
    std::vector<std::pair<std::size_t, std::size_t>> joined;
    for (const auto& [first, ignored] : images) {
        if (!home.emplace(first, Eigen::Isometry3d::Identity()).second) continue;
        for (std::vector<std::size_t> left{first}; !left.empty();) {
            const std::size_t at = left.back();
            left.pop_back();
            for (const auto& [next, onto] : images.at(at)) {
                if (!home.emplace(next, home.at(at) * onto).second) continue;
                left.push_back(next);
                joined.emplace_back(first, next);
            }
        }
    }
    for (std::size_t e = 0; e < edges_.size(); ++e) {
        const auto found = home.find(same_.find(e));
        if (found == home.end()) continue;
        edges_[e].home = found->second;
        planned_[e] = true;
    }
    for (const auto& [first, next] : joined) same_.unite(first, next);
    for (const auto& [first, ignored] : home) tied_.insert(same_.find(first));
}

void SameEdges::find_beside_ends()
{
    const auto is_on_end = [&](std::size_t e) {
        const std::size_t m = edges_[e].member;
        return std::ranges::any_of(model(m).uses_of_edge(edges_[e].edge),
                                   [&](const FaceUse& use) { return !is_wall(m, use.face); });
    };
    std::set<std::size_t> on_ends; // sets of same edges
    for (std::size_t e = 0; e < edges_.size(); ++e)
        if (is_on_end(e)) on_ends.insert(set_[e]);
    for (std::size_t e = 0; e < edges_.size(); ++e)
        if (on_ends.contains(set_[e]) && !is_on_end(e)) beside_.insert(e);
}

void SameEdges::find_cusps()
{
    for (std::size_t m = 0; m < members_.size(); ++m) {
        if (members_[m].fixed != nullptr) continue;
        for (std::size_t f = 0; f < model(m).faces.size(); ++f) {
            if (members_[m].volume->role[f] == Role::wall) continue;
            for (const Loop& loop : border_loops(model(m), FaceId(f)))
                for (std::size_t u = 0; u < loop.uses.size() && loop.uses.size() > 1; ++u)
                    find_cusp(m, FaceId(f), loop.uses[u], loop.uses[(u + 1) % loop.uses.size()]);
        }
    }
}

void SameEdges::find_cusp(std::size_t m, FaceId face, const EdgeUse& in, const EdgeUse& out)
{
    const std::size_t a = number(m, in.edge), b = number(m, out.edge);
    std::vector<Vec3> back = use_places(model(m), in), on = use_places(model(m), out);
    std::ranges::reverse(back);
    const std::vector<double> back_at = geometry::arc_lengths(back), on_at = geometry::arc_lengths(on);
    const double most = std::max(back_at.back(), on_at.back()) / 2;
    const Vec3 normal = face_area_vector(model(m), face);
    const auto is_flat = [&](double length) {
        const Vec3 p = geometry::point_at(back, back_at, std::min(length, back_at.back())) - back.front(),
                   q = geometry::point_at(on, on_at, std::min(length, on_at.back())) - on.front();
        const Vec3 across = q.cross(p);
        return p.dot(q) > 0 && across.dot(normal) >= 0 && across.norm() < kFlatQuad * p.norm() * q.norm();
    };
    if (is_flat(most) || !is_flat(std::min(back_at[1], on_at[1]))) return;
    double low = 0, high = most;
    for (int round = 0; round < kMostRounds; ++round)
        (is_flat((low + high) / 2) ? low : high) = (low + high) / 2;
    for (const auto& [e, end] : {std::pair(a, !in.reversed), std::pair(b, out.reversed)}) {
        double& first = cusps_[set_[e]][end == runs_along(e) ? 1 : 0];
        first = std::max(first, high);
        planned_[e] = true;
    }
}

void SameEdges::find_kept()
{
    kept_.assign(edges_.size(), Kept::no);
    for (std::size_t m = 0; m < members_.size(); ++m) {
        for (const EdgeId edge : kept_edges(model(m))) kept_[number(m, edge)] = Kept::rim;
        for (const Face& face : model(m).faces) {
            if (!face.keeps_nodes || face.given_quads.empty()) continue;
            for (const Loop& loop : face.loops) {
                for (const EdgeUse& use : loop.uses) kept_[number(m, use.edge)] = Kept::quads;
            }
        }
    }
    for (std::size_t e = 0; e < edges_.size(); ++e) {
        if (kept_[e] == Kept::no) continue;
        const auto [found, fresh] = kept_one_.try_emplace(set_[e], e);
        if (!fresh && kept_[found->second] < kept_[e]) found->second = e;
    }
}

bool run_alike(const MemberEdge& a, const MemberEdge& b)
{
    const Vec3 from = a.home * a.from;
    return (from - b.home * b.from).norm() <= (from - b.home * b.to).norm();
}

} // namespace lacuna::sweep
