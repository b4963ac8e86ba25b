// SPDX-License-Identifier: MIT
#include <lacuna/topology/shared/left_out.h>

#include <lacuna/core/error.h>
#include <lacuna/topology/shared/names_of.h>
#include <lacuna/topology/shared/use_places.h>

#include <algorithm>
#include <utility>

namespace lacuna::topology {

namespace {

/// The void faces along any of the edges.
std::vector<NamedEntity> void_faces_along(const Model& model, const std::vector<EdgeId>& edges)
{
    const auto is_along = [&](const EdgeUse& use) { return std::ranges::binary_search(edges, use.edge); };
    std::vector<FaceId> faces = all_faces(model);
    std::erase_if(faces, [&](FaceId face) {
        return model[face].origin != Origin::made_void ||
               std::ranges::none_of(uses_of(model[face]), is_along);
    });
    return entities_of(model, faces);
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

void require_none_left_out(const Model& model, const std::vector<FaceId>& faces, std::string_view found)
{
    const std::vector<LeftOutBeside> missing = left_out_beside(model, faces);
    if (missing.empty()) return;
    const LeftOutBeside& first = missing.front();
    std::vector<NamedEntity> all;
    for (const LeftOutBeside& one : missing) all.push_back({"face", one.face.tag});
    const NamedEntity edge = entity_of(model, first.edges.front());
    Message message = all.size() == 1
                          ? Message("cad.face_left_out",
                                    "{} of {}, next to {}, is missing because it {}. Therefore {} cannot "
                                    "be found automatically: the hole would count as part of the void",
                                    all, first.face.source, edge, first.face.why, found)
                          : Message("cad.face_left_out",
                                    "{} of {} are missing; the first, next to {}, {}. Therefore {} cannot "
                                    "be found automatically: the holes would count as part of the void",
                                    all, first.face.source, edge, first.face.why, found);
    throw InvalidInput(std::move(message).remedy(
        "repair the CAD file, or name source, target and walls to close the hole with a void face"));
}

std::vector<std::string> left_out_in_words(const OpenVolume& volume)
{
    const Model& model = volume.model;
    std::vector<FaceId> given = all_faces(model);
    std::erase_if(given, [&](FaceId face) { return model[face].origin != Origin::given; });
    std::vector<std::string> words;
    for (const LeftOutBeside& missing : left_out_beside(model, given)) {
        const LeftOutFace& face = missing.face;
        words.push_back(formatted("face {} of {} was left out (it {})", face.tag, face.source, face.why));
        const std::vector<NamedEntity> stands = void_faces_along(model, missing.edges);
        if (!stands.empty()) words.back() += formatted("; its place is taken by {}", stands);
    }
    return words;
}

} // namespace lacuna::topology
