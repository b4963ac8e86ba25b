// SPDX-License-Identifier: MIT
#include <lacuna/fill/detail/crossing_faces.h>

#include <lacuna/core/shared/criteria.h>
#include <lacuna/geometry/shared/facet_tree.h>
#include <lacuna/topology/shared/face_radius.h>
#include <lacuna/topology/shared/facet_area.h>
#include <lacuna/topology/shared/facet_sag.h>
#include <lacuna/topology/shared/names_of.h>

#include <algorithm>
#include <array>
#include <utility>

namespace lacuna::fill {

using namespace topology;

namespace {

using Corners = std::array<Vec3, 3>;

Corners corners_of(const Model& model, const Triangle& t)
{
    return {model.at(t[0]), model.at(t[1]), model.at(t[2])};
}

/// Whether a round surface has a facet on one side of it. Facets of the surface itself may still cross it.
bool is_on_one_side(const std::optional<RoundShape>& round, const Corners& facet, double tolerance)
{
    if (!round) return false;
    return std::ranges::all_of(facet, [&](const Vec3& p) { return round->height(p) <= tolerance; }) ||
           std::ranges::all_of(facet, [&](const Vec3& p) { return round->height(p) >= -tolerance; });
}

bool share_a_point(const Triangle& a, const Triangle& b)
{
    return std::ranges::any_of(a, [&](Index p) { return std::ranges::find(b, p) != b.end(); });
}

} // namespace

std::optional<Message> crossing_faces(const Model& model, const std::vector<FaceId>& faces,
                                      const RunContext& context)
{
    std::vector<Triangle> facets;
    std::vector<FaceId> face_of; // for each facet
    std::vector<double> sag(model.faces.size(), 0);
    std::vector<std::optional<RoundShape>> round(model.faces.size());
    for (const FaceId face : faces) {
        if (model[face].origin == Origin::made_void) continue;
        const std::vector<Triangle>& own = model[face].triangles;
        facets.insert(facets.end(), own.begin(), own.end());
        face_of.resize(facets.size(), face);
        sag[face.index()] = facet_sag(model, model[face]);
        round[face.index()] = round_shape(model, face);
    }
    std::optional<std::pair<Index, Index>> first;
    const auto cross = [&](Index a, Index b) {
        const FaceId one = face_of[index(a)], other = face_of[index(b)];
        const Triangle &s = facets[index(a)], &t = facets[index(b)];
        if (one == other || share_a_point(s, t)) return false;
        const Vec3 m = facet_area_vector(model, s), n = facet_area_vector(model, t);
        // Faces in one plane are in contact.
        if (m.cross(n).norm() <= kParallel * m.norm() * n.norm()) return false;
        const Corners mine = corners_of(model, s), theirs = corners_of(model, t);
        return !is_on_one_side(round[one.index()], theirs, model.tolerance) &&
               !is_on_one_side(round[other.index()], mine, model.tolerance) &&
               geometry::triangles_cross(mine, theirs,
                                         model.tolerance + sag[one.index()] + sag[other.index()]);
    };
    const geometry::FacetTree tree(model.points, facets, context);
    tree.overlaps(
        tree,
        [&](Index a, Index b) {
            if ((!first || std::pair(a, b) < *first) && cross(a, b)) first = {a, b};
            return true;
        },
        0, context);
    if (!first) return std::nullopt;
    const auto [a, b] = *first;
    const auto box = [&](Index t) {
        Eigen::AlignedBox3d own;
        for (const Vec3& corner : corners_of(model, facets[index(t)])) own.extend(corner);
        return own;
    };
    const Vec3 place = box(a).intersection(box(b)).center();
    return Message(
               "topology.faces_cross",
               "{} and {} cross near ({:.4g}, {:.4g}, {:.4g}): parts of one volume may touch, but not reach "
               "into each other",
               entity_of(model, face_of[index(a)]), entity_of(model, face_of[index(b)]), place.x(), place.y(),
               place.z())
        .remedy("subtract one part from the other in the CAD system, or move them apart");
}

} // namespace lacuna::fill
