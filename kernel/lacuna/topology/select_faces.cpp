// SPDX-License-Identifier: MIT
#include <lacuna/topology/shared/select_faces.h>

#include <lacuna/core/error.h>
#include <lacuna/core/shared/criteria.h>
#include <lacuna/geometry/shared/facet_tree.h>
#include <lacuna/topology/shared/face_facts.h>
#include <lacuna/topology/shared/face_radius.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

namespace lacuna::topology {

namespace {

/// Squared distance from a place to the facets of a face.
double distance(const Model& model, FaceId face, const Vec3& place)
{
    double least = std::numeric_limits<double>::infinity();
    for (const Triangle& t : model[face].triangles) {
        const auto hit = geometry::closest_on_triangle(place,
                                                       {model.at(t[0]), model.at(t[1]), model.at(t[2])});
        least = std::min(least, hit.distance2);
    }
    return least;
}

bool bounds(const Face& face, const std::string& region)
{
    return std::ranges::any_of(
        face.regions, [&](const auto& names) { return std::ranges::find(names, region) != names.end(); });
}

/// Whether all of a face is in a box, within the model's tolerance.
bool lies_in(const Model& model, FaceId face, const Eigen::AlignedBox3d& box)
{
    const Vec3 slack = Vec3::Constant(model.tolerance);
    return Eigen::AlignedBox3d(box.min() - slack, box.max() + slack).contains(box_of(model, face));
}

/// The faces that `touching` names, and their edges. These faces themselves are not selected.
struct Touched {
    std::vector<bool> face, edge;
};
Touched touched(const Model& model, const FaceSelector& selector)
{
    Touched found{std::vector<bool>(model.faces.size()), std::vector<bool>(model.edges.size())};
    if (selector.touching_model != nullptr && selector.touching_model != &model)
        throw InvalidInput(Message("lua.other_model", "option 'touching' is a face of another model")
                               .remedy("give a face of this model"));
    bool any = false;
    for (std::size_t f = 0; f < model.faces.size(); ++f) {
        const Face& face = model.faces[f];
        found.face[f] = selector.touching_model ? selector.touching == FaceId(f)
                        : selector.touching_tag ? face.tag == *selector.touching_tag
                                                : is_called(face, selector.touching_name);
        any = any || found.face[f];
        if (!found.face[f]) continue;
        for (const Loop& loop : face.loops)
            for (const EdgeUse& use : loop.uses) found.edge[use.edge.index()] = true;
    }
    if (!any)
        throw InvalidInput("lua.no_face", "option 'touching' names a face that the model does not "
                                          "have");
    return found;
}

void keep_touching(const Model& model, const FaceSelector& selector, std::vector<FaceId>& faces)
{
    const Touched by = touched(model, selector);
    std::erase_if(faces, [&](FaceId f) {
        if (by.face[f.index()]) return true;
        for (const Loop& loop : model[f].loops)
            for (const EdgeUse& use : loop.uses)
                if (by.edge[use.edge.index()]) return false;
        return true;
    });
}

bool matches(const Model& model, FaceId id, const FaceSelector& selector)
{
    const Face& face = model[id];
    if (selector.tags && std::ranges::find(*selector.tags, face.tag) == selector.tags->end()) return false;
    if (!selector.name.empty() && !is_called(face, selector.name)) return false;
    if (!selector.region.empty() && !bounds(face, selector.region)) return false;
    if (selector.free && *selector.free != (face.regions.size() < 2)) return false;
    if (!selector.kind.empty() && face.kind != selector.kind) return false;
    if (selector.facing) {
        const double within = std::cos(selector.normal_within * std::numbers::pi / 180);
        if (!(mean_normal(model, id).dot(*selector.facing) >= within)) return false;
    }
    if (selector.box && !lies_in(model, id, *selector.box)) return false;
    if (selector.radius) {
        const std::optional<double> radius = face_radius(model, id);
        if (!radius || *radius < (*selector.radius)[0] || *radius > (*selector.radius)[1]) return false;
    }
    const double area = face_area(model, id);
    return area >= selector.area[0] && area <= selector.area[1];
}

} // namespace

bool is_called(const Face& face, const std::string& name)
{
    return face.name == name || std::ranges::find(face.groups, name) != face.groups.end();
}

Vec3 mean_normal(const Model& model, FaceId face)
{
    // The summed area vectors cancel around a closed skin. Below this share of the area, their direction is
    // only a rounding error.
    const Vec3 vector = face_area_vector(model, face);
    return vector.norm() > kAlikeSizes * face_area(model, face) ? Vec3(vector.normalized())
                                                                : Vec3(Vec3::Zero());
}

std::vector<FaceId> select(const Model& model, FaceSelector selector)
{
    const auto kept = [&](int& tag) { // the tag of a repeated face names the face that was kept
        for (const Face& face : model.faces)
            if (std::ranges::count(face.repeated_tags, tag) > 0) tag = face.tag;
    };
    if (selector.tags) std::ranges::for_each(*selector.tags, kept);
    if (selector.touching_tag) kept(*selector.touching_tag);
    std::vector<FaceId> faces;
    for (const FaceId face : all_faces(model))
        if (matches(model, face, selector)) faces.push_back(face);
    if (selector.tags) { // a void face may have the tag of a given one
        const auto shares_tag = [&](FaceId face) {
            return model[face].origin != Origin::given && std::ranges::any_of(faces, [&](FaceId other) {
                       return model[other].origin == Origin::given && model[other].tag == model[face].tag;
                   });
        };
        std::vector<FaceId> own;
        std::ranges::remove_copy_if(faces, std::back_inserter(own), shares_tag);
        faces = std::move(own);
    }
    if (selector.touching_model || selector.touching_tag || !selector.touching_name.empty())
        keep_touching(model, selector, faces);
    if (!selector.near || faces.empty()) return faces;
    if (selector.within) {
        const double most = *selector.within * *selector.within;
        std::erase_if(faces, [&](FaceId f) { return distance(model, f, *selector.near) > most; });
        return faces;
    }
    const auto further = [&](FaceId a, FaceId b) {
        return distance(model, a, *selector.near) < distance(model, b, *selector.near);
    };
    return {*std::ranges::min_element(faces, further)};
}

} // namespace lacuna::topology
