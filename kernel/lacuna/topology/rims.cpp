// SPDX-License-Identifier: MIT
#include <lacuna/topology/open_volume.h>

#include <lacuna/topology/detail/directed_sides.h>
#include <lacuna/topology/shared/use_places.h>

#include <algorithm>
#include <functional>
#include <map>
#include <set>

namespace lacuna::topology {

std::vector<Rim> rims(const Model& model, const std::vector<FaceId>& faces)
{
    std::map<EdgeUse, EdgeUse> next_in_face;
    for (const FaceId face : faces)
        for (const Loop& loop : model[face].loops)
            for (std::size_t i = 0; i < loop.uses.size(); ++i)
                next_in_face[loop.uses[i]] = loop.uses[(i + 1) % loop.uses.size()];

    std::map<EdgeUse, bool> seen;
    std::vector<std::pair<double, Rim>> found; // with their lengths
    for (const auto& [start, next] : next_in_face) {
        if (next_in_face.contains(opposite(start)) || seen[start]) continue;
        Rim rim;
        EdgeUse use = start;
        while (!seen[use]) {
            seen[use] = true;
            rim.uses.push_back(use);
            // Rotate through the faces at the end of the use until one has a free edge.
            use = next_in_face.at(use);
            for (std::size_t turns = 0; next_in_face.contains(opposite(use)) && turns <= next_in_face.size();
                 ++turns)
                use = next_in_face.at(opposite(use));
        }
        const double length = length_of(model, rim.uses);
        found.emplace_back(length, std::move(rim));
    }
    std::ranges::stable_sort(found, std::greater{}, [](const auto& rim) { return rim.first; });
    std::vector<Rim> result;
    for (auto& [length, rim] : found) result.push_back(std::move(rim));
    return result;
}

std::vector<Loop> border_loops(const Model& model, FaceId face)
{
    std::set<EdgeId> edges;
    const bool has_seam = !std::ranges::all_of(
        uses_of(model[face]), [&](const EdgeUse& use) { return edges.insert(use.edge).second; });
    if (!has_seam) return model[face].loops;
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
    std::vector<EdgeId> result;
    for (std::size_t e = 0; e < volume.model.edges.size(); ++e) {
        if (volume.model.uses_of_edge(EdgeId(e)).size() == 1) result.emplace_back(e);
    }
    return result;
}

std::vector<Rim> free_loops(const OpenVolume& volume) { return rims(volume.model, all_faces(volume.model)); }

} // namespace lacuna::topology
