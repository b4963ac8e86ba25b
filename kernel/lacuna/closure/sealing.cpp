// SPDX-License-Identifier: MIT
#include <lacuna/closure/detail/sealing.h>

#include <lacuna/closure/close.h>
#include <lacuna/geometry/shared/facet_tree.h>
#include <lacuna/topology/shared/face_parts.h>

#include <algorithm>
#include <iterator>
#include <utility>

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
        return std::array<Vec3, 3>{model.at(t[0]), model.at(t[1]), model.at(t[2])};
    };
    std::optional<std::pair<std::size_t, std::size_t>> first; // a void face, and another face
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
            if (shared_points(mine, theirs) < 2 &&
                geometry::triangles_cross(corners(mine), corners(theirs), model.tolerance))
                first = pair;
            return true;
        };
    };
    made_tree.overlaps(made_tree, visit_with(made));
    made_tree.overlaps(geometry::FacetTree(model.points, given.triangles, context), visit_with(given));
    if (!first) return std::nullopt;
    return FaceCrossing{FaceId(first->first), FaceId(first->second)};
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
