// SPDX-License-Identifier: MIT
#include <lacuna/closure/detail/void_faces.h>

#include <lacuna/core/error.h>
#include <lacuna/topology/shared/face_parts.h>

#include <algorithm>
#include <map>
#include <set>

namespace lacuna::closure {

using namespace topology;

namespace {

class Walker {
public:
    Walker(const Model& model, const std::vector<EdgeId>& void_edges) : model_(model)
    {
        for (std::size_t e = 0; e < model.edges.size(); ++e) {
            const std::span<const FaceUse> uses = model.uses_of_edge(EdgeId(e));
            if (uses.size() == 1) add({EdgeId(e), !uses.front().reversed});
        }
        for (const EdgeId edge : void_edges) {
            made_.insert(edge);
            add({edge, false});
            add({edge, true});
        }
    }

    [[nodiscard]] bool open(EdgeUse half) const { return halves_.contains(half); }

    /// The shortest walk from a half-edge back to itself; empty if there is none.
    [[nodiscard]] std::vector<EdgeUse> walk(EdgeUse start) const
    {
        std::vector<EdgeUse> reached{start}, path;
        std::map<EdgeUse, EdgeUse> before{{start, start}};
        for (std::size_t i = 0; i < reached.size(); ++i) {
            for (const EdgeUse& next : ways_on(reached[i])) {
                if (next == start) {
                    for (EdgeUse at = reached[i]; at != start; at = before.at(at)) path.push_back(at);
                    path.push_back(start);
                    std::ranges::reverse(path);
                    return path;
                }
                if (before.emplace(next, reached[i]).second) reached.push_back(next);
            }
        }
        return path;
    }

    void take(const std::vector<EdgeUse>& path)
    {
        for (const EdgeUse& half : path) halves_.erase(half);
    }

private:
    void add(EdgeUse half)
    {
        halves_.insert(half);
        leaving_[use_from(model_, half)].push_back(half);
    }

    std::vector<EdgeUse> ways_on(EdgeUse half) const
    {
        std::vector<EdgeUse> made, given;
        const auto found = leaving_.find(use_to(model_, half));
        if (found == leaving_.end()) return {};
        for (const EdgeUse& next : found->second) {
            if (!halves_.contains(next)) continue;
            if (next.edge == half.edge && next.reversed != half.reversed) continue;
            (made_.contains(next.edge) ? made : given).push_back(next);
        }
        // From a given edge, turn into a void edge where possible; from a void edge, into a given one.
        const bool came_by_void = made_.contains(half.edge);
        std::vector<EdgeUse>& first = came_by_void ? given : made;
        return first.empty() ? (came_by_void ? made : given) : first;
    }

    const Model& model_;
    std::set<EdgeId> made_;
    std::set<EdgeUse> halves_;
    std::map<VertexId, std::vector<EdgeUse>> leaving_;
};

} // namespace

Loop reversed(const Rim& rim)
{
    Loop loop;
    for (auto use = rim.uses.rbegin(); use != rim.uses.rend(); ++use)
        loop.uses.push_back({use->edge, !use->reversed});
    return loop;
}

std::vector<Loop> void_loops(const OpenVolume& volume, const std::vector<EdgeId>& void_edges)
{
    const Model& model = volume.model;
    Walker walker(model, void_edges);
    std::vector<EdgeUse> starts;
    for (const EdgeUse& use : rim_uses(model, volume.faces(Role::source)))
        starts.push_back({use.edge, !use.reversed});
    for (const EdgeId edge : free_edges(volume)) {
        starts.push_back({edge, false});
        starts.push_back({edge, true});
    }
    std::vector<Loop> loops;
    for (const EdgeUse& start : starts) {
        if (!walker.open(start)) continue;
        const std::vector<EdgeUse> path = walker.walk(start);
        if (path.empty()) {
            throw NotClosed(
                Message("closure.walk_open", "the free edges that start with {} do not form a closed loop",
                        entity_of(model, start.edge))
                    .remedy("check the faces next to this edge, or pair the vertices with match{{ "
                            "vertices = … }}"));
        }
        walker.take(path);
        loops.push_back({path});
    }
    return loops;
}

} // namespace lacuna::closure
