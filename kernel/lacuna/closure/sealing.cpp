// SPDX-License-Identifier: MIT
#include <lacuna/closure/detail/sealing.h>

#include <lacuna/closure/close.h>
#include <lacuna/geometry/shared/facet_tree.h>
#include <lacuna/topology/shared/face_parts.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <utility>

namespace lacuna::closure {

using namespace topology;

namespace {

using Corners = std::array<Vec3, 3>;

int shared_points(const Triangle& a, const Triangle& b)
{
    int count = 0;
    for (const Index p : a) count += std::count(b.begin(), b.end(), p) > 0 ? 1 : 0;
    return count;
}

bool touch(const Corners& a, const Corners& b, double tolerance)
{
    const auto holds_corner = [&](const Corners& face, const Corners& other) {
        return std::ranges::any_of(other, [&](const Vec3& p) {
            return geometry::closest_on_triangle(p, face).distance2 <= tolerance * tolerance;
        });
    };
    return holds_corner(a, b) || holds_corner(b, a);
}

/// A void face, a face that it touches, and the facets that touch.
struct Contact {
    std::pair<std::size_t, std::size_t> faces;
    std::array<Triangle, 2> facets;
};

/// The first contact at which two faces cross: there, a facet has the inside of the skin on its outer side.
/// Faces that cross along edges of their facets are found by this test alone, as their facets only touch.
/// @pre a closed skin, oriented consistently inward or outward
std::optional<std::pair<std::size_t, std::size_t>> first_crossed(const Model& model,
                                                                 const std::vector<Contact>& contacts,
                                                                 const RunContext& context)
{
    const std::vector<Triangle> skin = facets_of(model, all_faces(model));
    const geometry::FacetTree tree(model.points, skin, context);
    const int sense = volume_integral(model, all_faces(model)) > 0 ? 1 : -1;
    const auto outward = [&](const Triangle& t) -> Vec3 {
        return sense * (model.at(t[1]) - model.at(t[0])).cross(model.at(t[2]) - model.at(t[0]));
    };
    const auto has_inside_beyond = [&](const Triangle& facet) {
        check_cancelled(context);
        const Vec3 out = outward(facet).stableNormalized();
        const Vec3 middle = (model.at(facet[0]) + model.at(facet[1]) + model.at(facet[2])) / 3;
        int winding = 0;
        tree.all_along(middle, out, [&](const geometry::FacetTree::RayHit& hit) {
            const Triangle& other = skin[index(hit.triangle)];
            if (other != facet) winding += outward(other).dot(out) > 0 ? 1 : -1;
            return true;
        });
        // The ray settles most facets in O(log n). It is not enough: a ray through an edge meets both facets,
        // and facets of a folded face lie in one place, but neither is a crossing.
        if (winding == 0) return false;
        const Vec3 near = model.tolerance * out;
        const auto beyond = std::lround(tree.winding_number(middle + near));
        return beyond != 0 && std::lround(tree.winding_number(middle - near)) == beyond + 1;
    };
    std::optional<std::pair<std::size_t, std::size_t>> first;
    for (const Contact& contact : contacts)
        if ((!first || contact.faces < *first) && std::ranges::any_of(contact.facets, has_inside_beyond))
            first = contact.faces;
    return first;
}

} // namespace

std::optional<EdgeId> unpaired_edge(const Model& model)
{
    for (std::size_t e = 0; e < model.edges.size(); ++e) {
        const std::span<const FaceUse> uses = model.uses_of_edge(EdgeId(e));
        if (uses.size() != 2 || uses[0].reversed == uses[1].reversed) return EdgeId(e);
    }
    return std::nullopt;
}

std::optional<FaceCrossing> first_crossing(const OpenVolume& volume, const RunContext& context)
{
    const Model& model = volume.model;
    struct Facets {
        std::vector<Triangle> triangles;
        std::vector<std::size_t> face;
    } made, given;
    const auto collect = [&](Facets& into, bool are_made, const auto& taken) {
        for (std::size_t f = 0; f < model.faces.size(); ++f) {
            if ((model.faces[f].origin == Origin::made_void) != are_made) continue;
            check_cancelled(context);
            std::ranges::copy_if(model.faces[f].triangles, std::back_inserter(into.triangles), taken);
            into.face.resize(into.triangles.size(), f);
        }
    };
    collect(made, true, [](const Triangle&) { return true; });
    if (made.triangles.empty()) return std::nullopt;
    // Given faces may be finely meshed, so only their facets near void faces are checked.
    const geometry::FacetTree made_tree(model.points, made.triangles, context);
    collect(given, false, [&](const Triangle& t) {
        Eigen::AlignedBox3d box(model.at(t[0]));
        box.extend(model.at(t[1]));
        box.extend(model.at(t[2]));
        return made_tree.may_meet(box);
    });
    const auto corners = [&](const Triangle& t) {
        return Corners{model.at(t[0]), model.at(t[1]), model.at(t[2])};
    };
    std::optional<std::pair<std::size_t, std::size_t>> first; // a void face, and another face
    std::vector<Contact> contacts;
    const auto visit_with = [&](const Facets& others) {
        return [&](Index a, Index b) {
            check_cancelled(context);
            std::pair pair(made.face[index(a)], others.face[index(b)]);
            if (pair.first == pair.second) return true;
            if (&others == &made && pair.first > pair.second) std::swap(pair.first, pair.second);
            if (first && *first <= pair) return true;
            const Triangle& mine = made.triangles[index(a)];
            const Triangle& theirs = others.triangles[index(b)];
            // Facets that share a side can only fold onto each other; the check of the enclosed volume finds
            // folds.
            const int shared = shared_points(mine, theirs);
            if (shared == 0 && touch(corners(mine), corners(theirs), model.tolerance))
                contacts.push_back({pair, {mine, theirs}});
            if (shared < 2 && geometry::triangles_cross(corners(mine), corners(theirs), model.tolerance))
                first = pair;
            return true;
        };
    };
    made_tree.overlaps(made_tree, visit_with(made));
    made_tree.overlaps(geometry::FacetTree(model.points, given.triangles, context), visit_with(given));
    if (!first && !contacts.empty() && !unpaired_edge(model)) first = first_crossed(model, contacts, context);
    if (!first) return std::nullopt;
    return FaceCrossing{FaceId(first->first), FaceId(first->second)};
}

double enclosed_volume(const OpenVolume& volume)
{
    return volume_integral(volume.model, all_faces(volume.model));
}

bool is_watertight(const OpenVolume& volume)
{
    return !unpaired_edge(volume.model) && enclosed_volume(volume) > 0;
}

} // namespace lacuna::closure
