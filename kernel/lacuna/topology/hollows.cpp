// SPDX-License-Identifier: MIT
#include <lacuna/topology/hollows.h>

#include <lacuna/core/error.h>
#include <lacuna/geometry/union_find.h>
#include <lacuna/topology/detail/patches.h>
#include <lacuna/topology/open_volume.h>

#include <algorithm>
#include <map>

namespace lacuna::topology {

namespace {

/// The faces of closed parts. @pre oriented
std::vector<bool> on_closed_skins(const Model& model, const std::vector<std::vector<FaceUse>>& uses)
{
    const std::vector<FaceId> all = all_faces(model);
    std::vector<bool> closed(model.faces.size(), false);
    for (const std::vector<FaceId>& part : connected_parts(model, all)) {
        const bool whole = std::all_of(part.begin(), part.end(), [&](FaceId face) {
            return std::all_of(model[face].loops.begin(), model[face].loops.end(), [&](const Loop& loop) {
                return std::all_of(loop.uses.begin(), loop.uses.end(),
                                   [&](const EdgeUse& use) { return uses[use.edge.index()].size() == 2; });
            });
        });
        for (const FaceId face : part) closed[face.index()] = whole;
    }
    return closed;
}

/// What faces contribute to a volume, their rims closed by cones to the middle of the faces: below 0 where
/// they face the space between them.
double capped_volume(const Model& model, const std::vector<FaceId>& faces)
{
    Vec3 middle = Vec3::Zero(), area = Vec3::Zero();
    double whole = 0;
    for (const FaceId face : faces) {
        const double own = face_area(model, face);
        middle += own * face_centroid(model, face);
        area += face_area_vector(model, face);
        whole += own;
    }
    if (whole > 0) middle /= whole;
    return volume_integral(model, faces) - middle.dot(area) / 3;
}

} // namespace

std::vector<Hollow> hollows(const Model& given, const RunContext& context)
{
    Model model = given;
    try {
        orient_consistently(model);
    } catch (const InvalidInput&) {
        return {};
    }
    const auto uses = edge_uses(model);
    const std::vector<bool> closed = on_closed_skins(model, uses);
    const std::vector<double> fold = folds_across(model, uses, context);
    geometry::UnionFind hang(model.faces.size());
    for (std::size_t e = 0; e < uses.size(); ++e) {
        if (uses[e].size() == 2 && fold[e] < kSmooth)
            hang.unite_least(uses[e][0].face.index(), uses[e][1].face.index());
    }
    std::map<std::size_t, std::vector<FaceId>> by_root;
    for (std::size_t f = 0; f < model.faces.size(); ++f) {
        if (closed[f]) by_root[hang.find(f)].emplace_back(f);
    }
    std::vector<Hollow> found;
    for (const auto& [root, faces] : by_root) {
        check_cancelled(context);
        const bool flat = std::all_of(faces.begin(), faces.end(),
                                      [&](FaceId face) { return model[face].kind == "plane"; });
        if ((flat && faces.size() < 3) || !(capped_volume(model, faces) < 0)) continue;
        found.push_back({faces, rims(model, faces).size()});
    }
    return found;
}

} // namespace lacuna::topology
