// SPDX-License-Identifier: MIT
#include <lacuna/topology/shared/face_facts.h>

#include <lacuna/topology/open_volume.h>
#include <lacuna/topology/shared/face_parts.h>

#include <algorithm>

namespace lacuna::topology {

Eigen::AlignedBox3d box_of(const Model& model, FaceId face)
{
    Eigen::AlignedBox3d box;
    for (const Index p : corners_of(model[face])) box.extend(model.at(p));
    return box;
}

std::size_t edge_count(const Face& face)
{
    std::size_t edges = 0;
    for (const Loop& loop : face.loops) edges += loop.uses.size();
    return edges;
}

std::vector<FaceFacts> face_facts(const Model& model)
{
    std::vector<FaceFacts> facts(model.faces.size());
    for (std::size_t f = 0; f < model.faces.size(); ++f) facts[f].box = box_of(model, FaceId(f));
    for (std::size_t e = 0; e < model.edges.size(); ++e) {
        const std::span<const FaceUse> uses = model.uses_of_edge(EdgeId(e));
        if (uses.size() == 1) facts[uses.front().face.index()].free_edges.emplace_back(e);
        for (const FaceUse& a : uses)
            for (const FaceUse& b : uses)
                if (a.face != b.face) facts[a.face.index()].neighbours.push_back(b.face);
    }
    for (FaceFacts& own : facts) {
        std::sort(own.neighbours.begin(), own.neighbours.end());
        own.neighbours.erase(std::unique(own.neighbours.begin(), own.neighbours.end()), own.neighbours.end());
    }
    const auto parts = connected_parts(model, all_faces(model));
    for (std::size_t p = 0; p < parts.size(); ++p)
        for (const FaceId face : parts[p]) facts[face.index()].part = p;
    return facts;
}

} // namespace lacuna::topology
