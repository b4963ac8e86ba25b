// SPDX-License-Identifier: MIT
#include <lacuna/closure/shared/model_facts.h>

#include <algorithm>

namespace lacuna::closure {

ModelFacts model_facts(const topology::Model& model, const RunContext& context)
{
    ModelFacts facts;
    facts.faces = topology::face_facts(model);
    std::size_t parts = 0;
    for (const topology::FaceFacts& face : facts.faces) parts = std::max(parts, face.part + 1);
    facts.part_closed.assign(parts, true);
    for (std::size_t f = 0; f < facts.faces.size(); ++f) {
        check_cancelled(context);
        facts.round.push_back(topology::round_shape(model, FaceId(f)));
        facts.cone.push_back(facts.round.back() ? std::nullopt : topology::cone_shape(model, FaceId(f)));
        if (!facts.faces[f].free_edges.empty()) facts.part_closed[facts.faces[f].part] = false;
    }
    facts.gaps = topology::gaps(model, context);
    facts.cavities = cavities(model, context);
    facts.cavity_of.assign(facts.faces.size(), facts.cavities.size());
    for (std::size_t c = 0; c < facts.cavities.size(); ++c) {
        for (const FaceId face : facts.cavities[c].faces) {
            std::size_t& now = facts.cavity_of[face.index()];
            const bool smaller = now == facts.cavities.size() ||
                                 facts.cavities[c].faces.size() < facts.cavities[now].faces.size();
            if (smaller) now = c;
        }
    }
    return facts;
}

const char* use_of(const ModelFacts& facts, FaceId face)
{
    const std::size_t cavity = facts.cavity_of[face.index()];
    if (cavity < facts.cavities.size()) return facts.cavities[cavity].kind.c_str();
    return facts.part_closed[facts.faces[face.index()].part] ? "outer skin" : "open shell";
}

} // namespace lacuna::closure
