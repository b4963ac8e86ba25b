// SPDX-License-Identifier: MIT
#include <lacuna/closure/detail/void_faces.h>

#include <lacuna/core/error.h>
#include <lacuna/topology/shared/face_parts.h>

#include <algorithm>
#include <map>
#include <optional>
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

    /// The shortest walk from a half-edge up to, but without, another one; empty if it reaches a dead end.
    /// @param depth  number of branchings at which the continuations are compared
    [[nodiscard]] std::optional<std::vector<EdgeUse>> walk(EdgeUse from, EdgeUse goal, int depth) const
    {
        std::vector<EdgeUse> path{from};
        std::set<EdgeUse> on_path{from};
        for (;;) {
            const std::vector<EdgeUse> choices = ways_on(path.back(), goal, on_path);
            if (choices.empty()) return std::nullopt;
            if (std::ranges::find(choices, goal) != choices.end()) return path;
            std::optional<EdgeUse> next = choices.front();
            if (choices.size() > 1 && depth > 0) next = shortest(choices, goal, depth);
            if (!next) return std::nullopt;
            on_path.insert(*next);
            path.push_back(*next);
        }
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

    std::vector<EdgeUse> ways_on(EdgeUse half, EdgeUse start, const std::set<EdgeUse>& on_path) const
    {
        std::vector<EdgeUse> made, given;
        const auto found = leaving_.find(use_to(model_, half));
        if (found == leaving_.end()) return {};
        for (const EdgeUse& next : found->second) {
            if (!halves_.contains(next) || (on_path.contains(next) && next != start)) continue;
            if (next.edge == half.edge && next.reversed != half.reversed) continue;
            (made_.contains(next.edge) ? made : given).push_back(next);
        }
        // Turn into a void edge where possible; after one, continue along the rim.
        const bool came_by_void = made_.contains(half.edge);
        std::vector<EdgeUse>& first = came_by_void ? given : made;
        return first.empty() ? (came_by_void ? made : given) : first;
    }

    /// The half-edge with the shortest walk to a goal.
    std::optional<EdgeUse> shortest(const std::vector<EdgeUse>& choices, EdgeUse goal, int depth) const
    {
        std::optional<EdgeUse> best;
        std::size_t least = 0;
        for (const EdgeUse& choice : choices) {
            const auto rest = walk(choice, goal, depth - 1);
            if (!rest || (best && rest->size() >= least)) continue;
            best = choice;
            least = rest->size();
        }
        return best;
    }

    const Model& model_;
    std::set<EdgeId> made_;
    std::set<EdgeUse> halves_;
    std::map<VertexId, std::vector<EdgeUse>> leaving_;
};

/// Number of branchings that a walk looks ahead. The cost multiplies with each; with fewer, a loop is more
/// often longer than four sides.
constexpr int kLookAhead = 3;

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
        const auto path = walker.walk(start, start, kLookAhead);
        if (!path) {
            throw NotClosed(Message("closure.walk_open",
                                    "the walk from free {} along free edges does not return to its start",
                                    entity_of(model, start.edge))
                                .remedy("check the faces next to it, or pair the vertices with match{{ "
                                        "vertices = … }}"));
        }
        walker.take(*path);
        loops.push_back({*path});
    }
    return loops;
}

} // namespace lacuna::closure
