// SPDX-License-Identifier: MIT
#include <lacuna/closure/detail/sealing.h>

#include <lacuna/closure/close.h>
#include <lacuna/geometry/shared/facet_tree.h>
#include <lacuna/topology/shared/face_parts.h>

#include <algorithm>
#include <iterator>

namespace lacuna::closure {

using namespace topology;

namespace {

int shared_points(const Triangle& a, const Triangle& b)
{
    int count = 0;
    for (const Index p : a) count += std::count(b.begin(), b.end(), p) > 0 ? 1 : 0;
    return count;
}

} // namespace

std::optional<FaceCrossing> first_crossing(const OpenVolume& volume, const RunContext& context)
{
    const Model& model = volume.model;
    std::vector<FaceId> void_faces = all_faces(model);
    std::erase_if(void_faces, [&](FaceId face) { return model[face].origin != Origin::made_void; });
    const std::vector<Triangle> made = facets_of(model, void_faces);
    if (made.empty()) return std::nullopt;
    // Given faces may be finely meshed, so only their facets near void faces are checked.
    const geometry::FacetTree all_made(model.points, made, context);
    std::vector<std::vector<Triangle>> facets(model.faces.size());
    std::vector<geometry::FacetTree> trees(model.faces.size());
    for (std::size_t f = 0; f < model.faces.size(); ++f) {
        check_cancelled(context);
        const Face& face = model.faces[f];
        const bool given = face.origin != Origin::made_void;
        std::copy_if(face.triangles.begin(), face.triangles.end(), std::back_inserter(facets[f]),
                     [&](const Triangle& t) {
                         Eigen::AlignedBox3d box(model.at(t[0]));
                         box.extend(model.at(t[1]));
                         box.extend(model.at(t[2]));
                         return !given || all_made.may_meet(box);
                     });
        trees[f] = geometry::FacetTree(model.points, facets[f], context);
    }
    const auto corners = [&](const Triangle& t) {
        return std::array<Vec3, 3>{model.at(t[0]), model.at(t[1]), model.at(t[2])};
    };
    for (const FaceId void_face : void_faces) {
        const std::size_t v = void_face.index();
        for (std::size_t f = 0; f < model.faces.size(); ++f) {
            if (f == v || (f < v && model.faces[f].origin == Origin::made_void)) continue;
            const bool clear = trees[v].overlaps(trees[f], [&](Index a, Index b) {
                check_cancelled(context);
                const Triangle& mine = facets[v][index(a)];
                const Triangle& theirs = facets[f][index(b)];
                // Neighbours along a shared side can only fold onto each other, which the enclosed volume
                // reveals.
                if (shared_points(mine, theirs) >= 2) return true;
                return !geometry::triangles_cross(corners(mine), corners(theirs), model.tolerance);
            });
            if (!clear) return FaceCrossing{void_face, FaceId(f)};
        }
    }
    return std::nullopt;
}

double enclosed_volume(const OpenVolume& volume)
{
    return volume_integral(volume.model, all_faces(volume.model));
}

bool is_watertight(const OpenVolume& volume)
{
    for (std::size_t e = 0; e < volume.model.edges.size(); ++e) {
        const std::span<const FaceUse> uses = volume.model.uses_of_edge(EdgeId(e));
        if (uses.size() != 2 || uses[0].reversed == uses[1].reversed) return false;
    }
    return enclosed_volume(volume) > 0;
}

} // namespace lacuna::closure
