// SPDX-License-Identifier: MIT
#include <lacuna/geometry/shared/cut.h>

#include <lacuna/core/shared/constants.h>
#include <lacuna/core/shared/edge_key.h>

#include <algorithm>
#include <queue>
#include <unordered_map>
#include <unordered_set>
#include <utility>

namespace lacuna::geometry {

std::vector<Index> shortest_way(std::span<const Vec3> points, std::span<const Triangle> triangles,
                                Index start, const std::set<Index>& off, const std::set<Index>& ends,
                                const RunContext& context)
{
    std::size_t steps = 0;
    const auto poll = [&] {
        if (steps++ % kBetweenPolls == 0) check_cancelled(context);
    };
    std::unordered_map<Index, std::vector<Index>> neighbours;
    for (const Triangle& t : triangles) {
        poll();
        for (std::size_t i = 0; i < 3; ++i) {
            neighbours[t[i]].push_back(t[(i + 1) % 3]);
            neighbours[t[i]].push_back(t[(i + 2) % 3]);
        }
    }
    std::unordered_map<Index, double> cost{{start, 0}};
    std::unordered_map<Index, Index> from;
    using Item = std::pair<double, Index>;
    std::priority_queue<Item, std::vector<Item>, std::greater<>> front;
    front.emplace(0, start);
    while (!front.empty()) {
        poll();
        const auto [c, p] = front.top();
        front.pop();
        if (c > cost[p]) continue;
        if (ends.contains(p)) {
            std::vector<Index> path{p};
            while (path.back() != start) path.push_back(from.at(path.back()));
            std::reverse(path.begin(), path.end());
            return path;
        }
        for (const Index q : neighbours[p]) {
            if (off.contains(q)) continue;
            const double next = c + (points[index(q)] - points[index(p)]).norm();
            const auto known = cost.find(q);
            if (known != cost.end() && known->second <= next) continue;
            cost[q] = next;
            from[q] = p;
            front.emplace(next, q);
        }
    }
    return {};
}

std::vector<std::array<int, 3>> turns_along(std::span<const Triangle> triangles, std::span<const Index> cut)
{
    std::vector<std::array<int, 3>> turns(triangles.size(), {0, 0, 0});
    const std::unordered_set<Index> on_cut(cut.begin(), cut.end());
    std::unordered_map<std::uint64_t, std::size_t> half; // directed side → triangle, for triangles at the cut
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        const Triangle& corner = triangles[t];
        if (std::none_of(corner.begin(), corner.end(), [&](Index p) { return on_cut.contains(p); })) continue;
        for (std::size_t i = 0; i < 3; ++i) half[directed_key(corner[i], corner[(i + 1) % 3])] = t;
    }
    std::set<std::pair<Index, Index>> sides;
    for (std::size_t i = 0; i + 1 < cut.size(); ++i) {
        sides.emplace(cut[i], cut[i + 1]);
        sides.emplace(cut[i + 1], cut[i]);
    }
    const auto corner_of = [&](std::size_t t, Index p) {
        const Triangle& triangle = triangles[t];
        return static_cast<std::size_t>(std::find(triangle.begin(), triangle.end(), p) - triangle.begin());
    };
    // Around each point of the cut, collect the facets on the right of the cut. These contain the cut's sides
    // in the opposite direction.
    for (std::size_t i = 0; i < cut.size(); ++i) {
        std::vector<std::size_t> front;
        const auto start_at = [&](Index a, Index b) {
            const auto found = half.find(directed_key(b, a));
            if (found != half.end()) front.push_back(found->second);
        };
        if (i + 1 < cut.size()) start_at(cut[i], cut[i + 1]);
        if (i > 0) start_at(cut[i - 1], cut[i]);
        while (!front.empty()) {
            const std::size_t t = front.back();
            front.pop_back();
            const std::size_t c = corner_of(t, cut[i]);
            if (turns[t][c] != 0) continue;
            turns[t][c] = 1;
            const Triangle& triangle = triangles[t];
            for (const Index q : {triangle[(c + 1) % 3], triangle[(c + 2) % 3]}) {
                if (sides.contains({cut[i], q})) continue;
                for (const std::uint64_t side : {directed_key(cut[i], q), directed_key(q, cut[i])}) {
                    const auto found = half.find(side);
                    if (found != half.end() && found->second != t) front.push_back(found->second);
                }
            }
        }
    }
    return turns;
}

} // namespace lacuna::geometry
