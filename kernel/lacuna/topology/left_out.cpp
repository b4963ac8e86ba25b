// SPDX-License-Identifier: MIT
#include <lacuna/topology/shared/left_out.h>

#include <lacuna/core/error.h>
#include <lacuna/core/shared/list_text.h>
#include <lacuna/topology/shared/names_of.h>
#include <lacuna/topology/shared/use_places.h>

#include <algorithm>

namespace lacuna::topology {

namespace {

std::string name_of(const LeftOutFace& face)
{
    return "face " + std::to_string(face.tag) + " of " + face.source;
}

/// Names of the void faces along any of the edges.
std::string void_faces_along(const Model& model, const std::vector<EdgeId>& edges)
{
    const auto is_along = [&](const EdgeUse& use) { return std::ranges::binary_search(edges, use.edge); };
    std::vector<FaceId> faces = all_faces(model);
    std::erase_if(faces, [&](FaceId face) {
        return model[face].origin != Origin::made_void ||
               std::ranges::none_of(uses_of(model[face]), is_along);
    });
    return names_of(model, faces);
}

} // namespace

std::vector<LeftOutBeside> left_out_beside(const Model& model, const std::vector<FaceId>& faces)
{
    std::vector<int> uses(model.edges.size(), 0);
    for (const FaceId face : faces)
        for (const EdgeUse& use : uses_of(model[face])) ++uses[use.edge.index()];
    std::vector<LeftOutBeside> found;
    for (std::size_t e = 0; e < model.edges.size(); ++e) {
        if (uses[e] != 1) continue;
        const auto* curve = dynamic_cast<const BesideLeftOut*>(model.edges[e].curve.get());
        if (curve == nullptr) continue;
        for (const LeftOutFace& face : curve->left_out()) {
            auto at = std::ranges::find(found, face, &LeftOutBeside::face);
            if (at == found.end()) at = found.insert(at, {face, {}});
            at->edges.emplace_back(e);
        }
    }
    return found;
}

void require_none_left_out(const Model& model, const std::vector<FaceId>& faces, const std::string& found)
{
    const std::vector<LeftOutBeside> missing = left_out_beside(model, faces);
    if (missing.empty()) return;
    const LeftOutBeside& first = missing.front();
    const std::string others = full_list(
        std::span(missing).subspan(1), [](const LeftOutBeside& one) { return std::to_string(one.face.tag); });
    throw InvalidInput(
        "cad.face_left_out",
        name_of(first.face) + " is missing next to " + name_of(model, first.edges.front()) +
            " of the volume: it " + first.face.why +
            (others.empty() ? "" : "; also missing: face " + others) + ". If " + found +
            " are found automatically, its hole becomes part of the void; repair it in the CAD "
            "system, or name source, target and walls by their faces to close it with a void "
            "face");
}

std::vector<std::string> left_out_in_words(const OpenVolume& volume)
{
    const Model& model = volume.model;
    std::vector<FaceId> given = all_faces(model);
    std::erase_if(given, [&](FaceId face) { return model[face].origin != Origin::given; });
    std::vector<std::string> words;
    for (const LeftOutBeside& missing : left_out_beside(model, given)) {
        const std::string stands = void_faces_along(model, missing.edges);
        words.push_back(name_of(missing.face) + " was left out (it " + missing.face.why + ")" +
                        (stands.empty() ? "" : "; its place is taken by " + stands));
    }
    return words;
}

} // namespace lacuna::topology
