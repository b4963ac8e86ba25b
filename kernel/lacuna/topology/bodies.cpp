// SPDX-License-Identifier: MIT
#include <lacuna/topology/shared/bodies.h>

#include <lacuna/core/error.h>
#include <lacuna/geometry/shared/facet_tree.h>
#include <lacuna/topology/open_volume.h>
#include <lacuna/topology/shared/face_facts.h>
#include <lacuna/topology/shared/face_parts.h>
#include <lacuna/topology/shared/hollows.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>

namespace lacuna::topology {

namespace {

/// Whether faces have no free edge. Where a body touches itself, an edge has four uses.
bool is_closed(const Model& model, const std::vector<FaceId>& faces)
{
    std::map<EdgeId, int> uses;
    for (const FaceId face : faces)
        for (const EdgeUse& use : uses_of(model[face])) ++uses[use.edge];
    return std::ranges::all_of(uses, [](const auto& use) { return use.second % 2 == 0; });
}

/// Add the closed connected parts of faces without regions.
void add_parts(const Model& model, const std::vector<FaceId>& faces, std::vector<Body>& bodies,
               const RunContext& context)
{
    std::vector<std::vector<FaceId>> parts = connected_parts(model, faces), inner;
    std::erase_if(parts, [&](const std::vector<FaceId>& part) { return !is_closed(model, part); });
    const std::vector<bool> is_inner = inner_parts(model, parts, context);
    const auto first = static_cast<std::ptrdiff_t>(bodies.size());
    for (std::size_t p = 0; p < parts.size(); ++p) {
        if (is_inner[p])
            inner.push_back(std::move(parts[p]));
        else
            bodies.push_back({formatted("body_{}", bodies.size() + 1), std::move(parts[p])});
    }
    const auto volume = [&](const Body& body) { return std::abs(volume_integral(model, body.faces)); };
    for (const std::vector<FaceId>& part : inner) {
        Body* round = nullptr; // the smallest body around the part
        for (auto body = bodies.begin() + first; body != bodies.end(); ++body)
            if (inner_parts(model, {body->faces, part}, context)[1] &&
                (round == nullptr || volume(*body) < volume(*round)))
                round = &*body;
        if (round != nullptr) std::ranges::copy(part, std::back_inserter(round->faces));
    }
    for (auto body = bodies.begin() + first; body != bodies.end(); ++body) std::ranges::sort(body->faces);
}

} // namespace

std::vector<Body> bodies(const Model& model, const RunContext& context)
{
    std::vector<Body> found;
    std::map<std::string, std::size_t> place;
    for (const FaceId face : all_faces(model)) {
        for (const std::vector<std::string>& region : model[face].regions) {
            const auto [known, fresh] = place.try_emplace(region.front(), found.size());
            if (fresh) found.push_back({region.front(), {}});
            std::vector<FaceId>& faces = found[known->second].faces;
            if (faces.empty() || faces.back() != face) faces.push_back(face);
        }
    }
    std::erase_if(found, [&](const Body& body) { return !is_closed(model, body.faces); });
    std::vector<bool> used(model.faces.size(), false);
    for (const Body& body : found)
        for (const FaceId face : body.faces) used[face.index()] = true;
    std::vector<FaceId> others = all_faces(model);
    std::erase_if(others, [&](FaceId face) { return used[face.index()]; });
    add_parts(model, others, found, context);
    return found;
}

void require_apart(const Model& model, const std::vector<Body>& bodies, const RunContext& context)
{
    std::vector<Eigen::AlignedBox3d> boxes(bodies.size());
    for (std::size_t b = 0; b < bodies.size(); ++b)
        for (const FaceId face : bodies[b].faces) boxes[b].extend(box_of(model, face));
    for (std::size_t a = 0; a < bodies.size(); ++a) {
        std::vector<std::size_t> near;
        for (std::size_t b = 0; b < bodies.size(); ++b)
            if (b != a && boxes[a].intersects(boxes[b])) near.push_back(b);
        if (near.empty()) continue;
        Model own = extract(model, bodies[a].faces);
        orient_skin(own, context);
        const geometry::FacetTree tree(own.points, facets_of(own, all_faces(own)), context);
        for (const std::size_t b : near) {
            check_cancelled(context);
            if (!any_inside(model, bodies[b].faces, tree)) continue;
            throw InvalidInput(Message("topology.bodies_overlap",
                                       "the body {} lies in the body {}, at least in part", bodies[b].name,
                                       bodies[a].name)
                                   .remedy("cut one from the other in the CAD system; for the space between "
                                           "them: model:open_volume()"));
        }
    }
}

} // namespace lacuna::topology
