// SPDX-License-Identifier: MIT
#include <lacuna/topology/open_volume.h>

#include <lacuna/topology/detail/directed_sides.h>

#include <algorithm>
#include <map>

namespace lacuna::topology {

namespace {

/// Position of a use in its face's loops.
struct UsePosition {
    FaceId face;
    std::size_t loop = 0, position = 0;
};

double length_of(const Model& model, const Rim& rim)
{
    double sum = 0;
    for (const EdgeUse& use : rim.uses) sum += edge_length(model, use.edge);
    return sum;
}

EdgeUse opposite(EdgeUse use) { return {use.edge, !use.reversed}; }

} // namespace

std::vector<Rim> rims(const Model& model, const std::vector<FaceId>& faces)
{
    std::map<EdgeUse, UsePosition> places;
    for (const FaceId face : faces) {
        const std::vector<Loop>& loops = model[face].loops;
        for (std::size_t l = 0; l < loops.size(); ++l) {
            for (std::size_t i = 0; i < loops[l].uses.size(); ++i) places[loops[l].uses[i]] = {face, l, i};
        }
    }
    const auto next_in_face = [&](EdgeUse use) {
        const UsePosition& at = places.at(use);
        const std::vector<EdgeUse>& uses = model[at.face].loops[at.loop].uses;
        return uses[(at.position + 1) % uses.size()];
    };

    std::map<EdgeUse, bool> seen;
    std::vector<Rim> result;
    for (const auto& [start, place] : places) {
        if (places.contains(opposite(start)) || seen[start]) continue;
        Rim rim;
        EdgeUse use = start;
        while (!seen[use]) {
            seen[use] = true;
            rim.uses.push_back(use);
            // Rotate through the faces at the end of the use until one has a free edge.
            use = next_in_face(use);
            for (std::size_t turns = 0; places.contains(opposite(use)) && turns <= places.size(); ++turns) {
                use = next_in_face(opposite(use));
            }
        }
        result.push_back(std::move(rim));
    }
    std::stable_sort(result.begin(), result.end(),
                     [&](const Rim& a, const Rim& b) { return length_of(model, a) > length_of(model, b); });
    return result;
}

std::vector<Loop> border_loops(const Model& model, FaceId face)
{
    const std::vector<Loop>& loops = model[face].loops;
    std::vector<EdgeId> edges;
    for (const Loop& loop : loops) {
        for (const EdgeUse& use : loop.uses) edges.push_back(use.edge);
    }
    std::sort(edges.begin(), edges.end());
    if (std::adjacent_find(edges.begin(), edges.end()) == edges.end()) return loops;
    std::vector<Loop> border;
    for (Rim& rim : rims(model, {face})) border.push_back({std::move(rim.uses)});
    return border;
}

long euler_number(const Model& model, const std::vector<FaceId>& faces)
{
    DirectedSides sides(model.points.size());
    return euler_number(model, faces, sides);
}

std::vector<EdgeId> free_edges(const OpenVolume& volume)
{
    const auto uses = edge_uses(volume.model);
    std::vector<EdgeId> result;
    for (std::size_t e = 0; e < uses.size(); ++e) {
        if (uses[e].size() == 1) result.emplace_back(e);
    }
    return result;
}

std::vector<Rim> free_loops(const OpenVolume& volume)
{
    const std::vector<FaceId> all = all_faces(volume.model);
    return rims(volume.model, all);
}

} // namespace lacuna::topology
