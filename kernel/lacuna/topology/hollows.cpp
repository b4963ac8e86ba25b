// SPDX-License-Identifier: MIT
#include <lacuna/topology/hollows.h>

#include <lacuna/core/error.h>
#include <lacuna/geometry/facet_tree.h>
#include <lacuna/geometry/union_find.h>
#include <lacuna/topology/detail/patches.h>
#include <lacuna/topology/open_volume.h>

#include <algorithm>
#include <map>

namespace lacuna::topology {

namespace {

/// The parts of the model without free edges. @pre oriented
std::vector<std::vector<FaceId>> closed_shells(const Model& model,
                                               const std::vector<std::vector<FaceUse>>& uses)
{
    std::vector<std::vector<FaceId>> shells = connected_parts(model, all_faces(model));
    std::erase_if(shells, [&](const std::vector<FaceId>& part) {
        return !std::all_of(part.begin(), part.end(), [&](FaceId face) {
            return std::all_of(model[face].loops.begin(), model[face].loops.end(), [&](const Loop& loop) {
                return std::all_of(loop.uses.begin(), loop.uses.end(),
                                   [&](const EdgeUse& use) { return uses[use.edge.index()].size() == 2; });
            });
        });
    });
    return shells;
}

/// Whether a shell is where two regions of a mesh meet: there is no space on either side.
bool is_between_regions(const Model& model, const std::vector<FaceId>& shell)
{
    return std::all_of(shell.begin(), shell.end(),
                       [&](FaceId face) { return model[face].regions.size() > 1; });
}

/// Turn the shells over that lie within another one, or within any odd number: the space inside them is none
/// of the solid's. @pre each looks outward. @return these.
std::vector<std::vector<FaceId>> turn_inner_shells(Model& model,
                                                   const std::vector<std::vector<FaceId>>& shells,
                                                   const RunContext& context)
{
    if (shells.size() < 2) return {};
    std::vector<geometry::FacetTree> trees;
    for (const std::vector<FaceId>& shell : shells) {
        std::vector<Triangle> facets;
        for (const FaceId face : shell)
            facets.insert(facets.end(), model[face].triangles.begin(), model[face].triangles.end());
        trees.emplace_back(model.points, facets, context);
    }
    std::vector<std::vector<FaceId>> turned;
    for (std::size_t inner = 0; inner < shells.size(); ++inner) {
        check_cancelled(context);
        const Vec3& point = model.at(model[shells[inner].front()].triangles.front()[0]);
        constexpr double kInside = 0.5; // between the winding numbers 0 and 1
        int depth = 0;
        for (std::size_t outer = 0; outer < shells.size(); ++outer)
            if (outer != inner && trees[outer].bounds().contains(trees[inner].bounds()) &&
                trees[outer].winding_number(point) > kInside)
                ++depth;
        if (depth % 2 == 0 || is_between_regions(model, shells[inner])) continue;
        flip_faces(model, shells[inner]);
        turned.push_back(shells[inner]);
    }
    return turned;
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
    const std::vector<std::vector<FaceId>> shells = closed_shells(model, uses);
    const std::vector<std::vector<FaceId>> inner = turn_inner_shells(model, shells, context);
    std::vector<bool> closed(model.faces.size(), false);
    for (const std::vector<FaceId>& shell : shells)
        for (const FaceId face : shell) closed[face.index()] = true;
    const std::vector<double> fold = folds_across(model, uses, context);
    geometry::UnionFind hang(model.faces.size());
    for (const std::vector<FaceId>& shell : inner)
        for (const FaceId face : shell) hang.unite_least(shell.front().index(), face.index());
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
