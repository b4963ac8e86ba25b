// SPDX-License-Identifier: MIT
#include <lacuna/fill/detail/crossing_faces.h>

#include <lacuna/core/shared/criteria.h>
#include <lacuna/geometry/shared/facet_tree.h>
#include <lacuna/topology/shared/face_parts.h>
#include <lacuna/topology/shared/face_radius.h>
#include <lacuna/topology/shared/facet_sag.h>
#include <lacuna/topology/shared/names_of.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
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

bool are_parallel(const Corners& one, const Corners& other)
{
    const Vec3 m = (one[1] - one[0]).cross(one[2] - one[0]),
               n = (other[1] - other[0]).cross(other[2] - other[0]);
    return m.cross(n).norm() <= kParallel * m.norm() * n.norm();
}

/// Whether two facets lie on each other over an area: they are parallel, and shrunk ones touch, too.
bool touch_over_area(const Corners& one, const Corners& other, double tolerance)
{
    const auto shrunk = [](const Corners& facet) {
        const Vec3 middle = (facet[0] + facet[1] + facet[2]) / 3;
        Corners inner = facet;
        for (Vec3& p : inner) p += kAlikeSizes * (middle - p);
        return inner;
    };
    const auto reaches = [&](const Corners& inner, const Corners& facet) {
        return std::ranges::any_of(inner, [&](const Vec3& p) {
            return geometry::closest_on_triangle(p, facet).distance2 <= tolerance * tolerance;
        });
    };
    return are_parallel(one, other) &&
           (reaches(shrunk(one), shrunk(other)) || reaches(shrunk(other), shrunk(one)));
}

/// The message that two parts touch along a line or at a point, where the volume between them has no
/// thickness. Empty also for parts that touch over an area.
std::optional<Message> touching_faces(const Model& model, const std::vector<Triangle>& facets,
                                      const std::vector<FaceId>& face_of, const std::vector<double>& sag,
                                      const std::vector<std::optional<RoundShape>>& round,
                                      const geometry::FacetTree& tree, const RunContext& context)
{
    std::vector<std::size_t> part_of(model.faces.size(), 0);
    const std::vector<std::vector<FaceId>> parts = connected_parts(model, all_faces(model));
    for (std::size_t p = 0; p < parts.size(); ++p)
        for (const FaceId face : parts[p]) part_of[face.index()] = p;
    const auto touch = [&](Index a, Index b) -> std::optional<Vec3> {
        const Corners mine = corners_of(model, facets[index(a)]),
                      theirs = corners_of(model, facets[index(b)]);
        const auto is_near = [&](const Vec3& p, const Corners& corners, double within) {
            return geometry::closest_on_triangle(p, corners).distance2 <= within * within;
        };
        for (const Vec3& p : mine)
            if (is_near(p, theirs, model.tolerance)) return p;
        const FaceId face = face_of[index(a)];
        const std::optional<RoundShape>& shape = round[face.index()];
        if (!shape) return std::nullopt;
        Vec3 inside = shape->centre; // the centre of the sphere, or the point of the axis beside the facet
        if (shape->axis)
            inside += shape->axis->dot((mine[0] + mine[1] + mine[2]) / 3 - inside) * *shape->axis;
        const Vec3 p = geometry::closest_on_triangle(inside, theirs).point;
        const bool touches = std::abs(shape->height(p)) <= model.tolerance &&
                             is_near(p, mine, model.tolerance + sag[face.index()]);
        return touches ? std::optional(p) : std::nullopt;
    };
    struct Touch {
        std::pair<Index, Index> facets;
        Vec3 place;
    };
    std::map<std::pair<std::size_t, std::size_t>, std::optional<Touch>> touches; // of two parts; empty: areas
    tree.overlaps(
        tree,
        [&](Index a, Index b) {
            const auto both = std::minmax(part_of[face_of[index(a)].index()],
                                          part_of[face_of[index(b)].index()]);
            if (both.first == both.second) return true;
            const auto known = touches.find(both);
            if (known != touches.end() && !known->second) return true;
            if (touch_over_area(corners_of(model, facets[index(a)]), corners_of(model, facets[index(b)]),
                                model.tolerance)) {
                touches[both].reset();
                return true;
            }
            if (known != touches.end() && known->second->facets < std::pair(a, b)) return true;
            for (const auto& [s, t] : {std::pair(a, b), std::pair(b, a)})
                if (const auto place = touch(s, t)) touches[both] = Touch{{a, b}, *place};
            return true;
        },
        model.tolerance + *std::ranges::max_element(sag), context);
    std::optional<Touch> first;
    for (const auto& [both, found] : touches)
        if (found && (!first || found->facets < first->facets)) first = found;
    if (!first) return std::nullopt;
    const auto& [pair, place] = *first;
    const auto& [a, b] = pair;
    return Message(
               "topology.faces_touch",
               "{} and {} touch near ({:.4g}, {:.4g}, {:.4g}) along a line or at a point, where the volume "
               "between them has no thickness",
               entity_of(model, face_of[index(a)]), entity_of(model, face_of[index(b)]), place.x(), place.y(),
               place.z())
        .remedy("move them apart, or press one a little into the other and subtract it in the CAD system");
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
    if (facets.empty()) return std::nullopt;
    std::optional<std::pair<Index, Index>> first;
    const auto cross = [&](Index a, Index b) {
        const FaceId one = face_of[index(a)], other = face_of[index(b)];
        const Triangle &s = facets[index(a)], &t = facets[index(b)];
        if (one == other || share_a_point(s, t)) return false;
        const Corners mine = corners_of(model, s), theirs = corners_of(model, t);
        // Faces in one plane are in contact.
        return !are_parallel(mine, theirs) && !is_on_one_side(round[one.index()], theirs, model.tolerance) &&
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
    if (!first) return touching_faces(model, facets, face_of, sag, round, tree, context);
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
