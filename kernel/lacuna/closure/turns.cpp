// SPDX-License-Identifier: MIT
#include <lacuna/closure/detail/turns.h>

#include <lacuna/core/shared/edge_key.h>
#include <lacuna/geometry/shared/facet_tree.h>
#include <lacuna/topology/shared/face_parts.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <unordered_map>
#include <unordered_set>

namespace lacuna::closure {

using namespace topology;

namespace {

std::vector<std::vector<FaceId>> parts_of(const Model& model)
{
    return connected_parts(model, all_faces(model));
}

/// By part, whether it is inside another.
std::vector<bool> inner_parts(const Model& model, const std::vector<std::vector<FaceId>>& parts,
                              const RunContext& context)
{
    std::vector<bool> inner(parts.size(), false);
    if (parts.size() < 2) return inner;
    for (std::size_t o = 0; o < parts.size(); ++o) {
        const geometry::FacetTree tree(model.points, facets_of(model, parts[o]), context);
        for (std::size_t p = 0; p < parts.size(); ++p) {
            const Vec3& at = model.at(model[parts[p].front()].triangles.front()[0]);
            if (p != o && tree.bounds().contains(at) && std::abs(tree.winding_number(at)) > 0.5)
                inner[p] = !inner[p];
        }
    }
    return inner;
}

/// Whether facets face away from their centre.
bool faces_outward(const Model& model, const std::vector<FaceId>& faces)
{
    const Vec3 centre = centroid_of(model, faces);
    double sum = 0;
    for (const Triangle& t : facets_of(model, faces)) {
        const Vec3 &a = model.at(t[0]), &b = model.at(t[1]), &c = model.at(t[2]);
        sum += ((a + b + c) / 3 - centre).dot((b - a).cross(c - a));
    }
    return sum >= 0;
}

/// Approximate number of an end's facets from which rays are cast.
constexpr std::size_t kAsked = 50;

/// The facets of all parts of the skin for ray casting. Built on demand: for most skins the walls suffice.
class PartsSeen {
public:
    PartsSeen(const Model& model, const std::vector<std::vector<FaceId>>& parts, const RunContext& context)
        : model_(model), parts_(parts), context_(context)
    {
    }

    /// The first face along a ray, of one part or of all others.
    [[nodiscard]] std::optional<FaceId> first(const Vec3& origin, const Vec3& way, std::size_t part,
                                              bool others)
    {
        if (!tree_) build();
        geometry::FacetTree::RayHit least;
        tree_->all_along(origin, way, [&](const geometry::FacetTree::RayHit& hit) {
            const bool wanted = (part_[index(hit.triangle)] != part) == others;
            if (wanted && (least.triangle < 0 || hit.t < least.t ||
                           (hit.t == least.t && hit.triangle < least.triangle)))
                least = hit;
            return true;
        });
        if (least.triangle < 0) return std::nullopt;
        return face_[index(least.triangle)];
    }

private:
    void build()
    {
        std::vector<Triangle> facets;
        for (std::size_t p = 0; p < parts_.size(); ++p) {
            for (const FaceId face : parts_[p]) {
                std::ranges::copy(model_[face].triangles, std::back_inserter(facets));
                face_.resize(facets.size(), face);
            }
            part_.resize(facets.size(), p);
        }
        tree_.emplace(model_.points, facets, context_);
    }

    const Model& model_;
    const std::vector<std::vector<FaceId>>& parts_;
    const RunContext& context_;
    std::vector<FaceId> face_;      ///< by facet
    std::vector<std::size_t> part_; ///< by facet
    std::optional<geometry::FacetTree> tree_;
};

/// Area of the ends of part `p` that have an opposite end in front of them, minus the area of those that have
/// one behind them. If positive, the facets face the void, which lies between source and target.
/// @param others  true: opposite ends of other parts; false: of part `p` itself.
double faces_opposite(const OpenVolume& volume, const std::vector<std::vector<FaceId>>& parts, std::size_t p,
                      PartsSeen& seen, bool others)
{
    const Model& model = volume.model;
    double before = 0;
    for (const FaceId face : parts[p]) {
        const Role role = volume.role[face.index()];
        if (role == Role::wall) continue;
        const Role opposite = role == Role::source ? Role::target : Role::source;
        const std::vector<Triangle>& facets = model[face].triangles;
        const std::size_t step = std::max<std::size_t>(1, facets.size() / kAsked);
        for (std::size_t t = 0; t < facets.size(); t += step) {
            const Vec3 &a = model.at(facets[t][0]), &b = model.at(facets[t][1]), &c = model.at(facets[t][2]);
            const Vec3 area = (b - a).cross(c - a) / 2, middle = (a + b + c) / 3;
            for (const double side : {1.0, -1.0}) {
                const Vec3 way = side * area.stableNormalized();
                const auto hit = seen.first(middle + model.tolerance * way, way, p, others);
                if (hit && volume.role[hit->index()] == opposite) before += side * area.norm();
            }
        }
    }
    return before;
}

std::vector<char> points_on_edges(const Model& model)
{
    std::vector<char> on_edge(model.points.size(), 0);
    for (const Edge& edge : model.edges)
        for (const Index p : edge.points) on_edge[index(p)] = 1;
    return on_edge;
}

/// Whether a part's walls are in front of its ends, where their normals point (positive), or behind them
/// (negative); 0 if some are in front and some behind, or if the part lacks an end. A wall between both ends
/// is on the void's side of each; only the risers of a stepped end are on the other side of the end above.
/// @return  sum over the facet sides that an end and a wall share: length times the cosine of the angle
///          between the wall and the end's normal [model length].
double leaves_before(const OpenVolume& volume, const std::vector<FaceId>& part,
                     const std::vector<char>& on_edge)
{
    const auto has = [&](Role role) {
        return std::ranges::any_of(part, [&](FaceId face) { return volume.role[face.index()] == role; });
    };
    if (!has(Role::source) || !has(Role::target)) return 0;
    const Model& model = volume.model;
    // Faces share sides only along edges.
    const auto may_be_shared = [&](Index a, Index b) {
        return on_edge[index(a)] != 0 && on_edge[index(b)] != 0;
    };
    std::unordered_map<std::uint64_t, Vec3> ends; // by side: unit normal of an end's facet there
    for (const FaceId face : part) {
        if (volume.role[face.index()] == Role::wall) continue;
        for (const Triangle& t : model[face].triangles) {
            const Vec3 normal = (model.at(t[1]) - model.at(t[0])).cross(model.at(t[2]) - model.at(t[0]));
            for (std::size_t k = 0; k < 3; ++k)
                if (may_be_shared(t[k], t[(k + 1) % 3]))
                    ends.emplace(edge_key(t[k], t[(k + 1) % 3]), normal.stableNormalized());
        }
    }
    double before = 0, behind = 0;
    for (const FaceId face : part) {
        if (volume.role[face.index()] != Role::wall) continue;
        for (const Triangle& t : model[face].triangles) {
            for (std::size_t k = 0; k < 3; ++k) {
                if (!may_be_shared(t[k], t[(k + 1) % 3])) continue;
                const auto end = ends.find(edge_key(t[k], t[(k + 1) % 3]));
                if (end == ends.end()) continue;
                const Vec3 &a = model.at(t[k]), &b = model.at(t[(k + 1) % 3]), &c = model.at(t[(k + 2) % 3]);
                const Vec3 along = (b - a).stableNormalized();
                const Vec3 off = (c - a) - (c - a).dot(along) * along;
                const double leaves = (b - a).norm() * off.stableNormalized().dot(end->second);
                (leaves > 0 ? before : behind) += leaves;
            }
        }
    }
    return before > 0 && behind < 0 ? 0 : before + behind;
}

/// For each part, whether its facets face the void. The first applicable rule decides:
/// 1. its walls all stand on the same side of its two ends, and the part is inside no other;
/// 2. its ends face, or face away from, an opposite end of another part;
/// 3. its ends face, or face away from, its own opposite end, and the part is inside no other;
/// 4. otherwise the void is on the side of the facets' centre; for a part inside another, on the far side.
std::vector<bool> parts_facing_void(const OpenVolume& volume, const std::vector<std::vector<FaceId>>& parts,
                                    const std::vector<char>& on_edge, const RunContext& context)
{
    const Model& model = volume.model;
    const std::vector<bool> inner = inner_parts(model, parts, context);
    PartsSeen seen(model, parts, context);
    std::vector<bool> facing;
    for (std::size_t p = 0; p < parts.size(); ++p) {
        check_cancelled(context);
        double before = inner[p] ? 0 : leaves_before(volume, parts[p], on_edge);
        const bool ends = std::ranges::any_of(
            parts[p], [&](FaceId face) { return volume.role[face.index()] != Role::wall; });
        if (ends && before == 0 && parts.size() > 1) before = faces_opposite(volume, parts, p, seen, true);
        if (ends && before == 0 && !inner[p]) before = faces_opposite(volume, parts, p, seen, false);
        facing.push_back(before != 0 ? before > 0 : faces_outward(model, parts[p]) == inner[p]);
    }
    return facing;
}

} // namespace

std::vector<double> concave_turns(const OpenVolume& volume, const RunContext& context)
{
    const Model& model = volume.model;
    const std::vector<std::vector<FaceId>> parts = parts_of(model);
    const std::vector<char> on_edge = points_on_edges(model);
    const std::vector<bool> facing = parts_facing_void(volume, parts, on_edge, context);
    std::vector<double> away(model.faces.size(), 1); // away from the void: +1 along the facets' normals
    for (std::size_t p = 0; p < parts.size(); ++p) {
        for (const FaceId face : parts[p]) away[face.index()] = facing[p] ? -1 : 1;
    }
    std::unordered_set<std::uint64_t> sides;
    for (const Edge& edge : model.edges) {
        for (std::size_t i = 0; i + 1 < edge.points.size(); ++i)
            sides.insert(edge_key(edge.points[i], edge.points[i + 1]));
    }
    struct Beside {
        Vec3 normal;
        std::size_t face;
    };
    std::unordered_map<std::uint64_t, Beside> beside; // by directed side on an edge
    for (std::size_t f = 0; f < model.faces.size(); ++f) {
        check_cancelled(context);
        for (const Triangle& t : model.faces[f].triangles) {
            for (std::size_t k = 0; k < 3; ++k) {
                const Index a = t[k], b = t[(k + 1) % 3];
                if (on_edge[index(a)] == 0 || on_edge[index(b)] == 0 || !sides.contains(edge_key(a, b)))
                    continue;
                const Vec3 normal = (model.at(t[1]) - model.at(t[0])).cross(model.at(t[2]) - model.at(t[0]));
                beside.emplace(directed_key(a, b), Beside{normal, f});
            }
        }
    }
    std::vector<double> turns;
    for (const Edge& edge : model.edges) {
        double sum = 0, length = 0;
        for (std::size_t i = 0; i + 1 < edge.points.size(); ++i) {
            const Index a = edge.points[i], b = edge.points[i + 1];
            const auto left = beside.find(directed_key(a, b)), right = beside.find(directed_key(b, a));
            if (left == beside.end() || right == beside.end() || left->second.face == right->second.face)
                continue;
            const Vec3 way = model.at(b) - model.at(a);
            const Vec3 turn = left->second.normal.cross(right->second.normal);
            const double angle = std::atan2(turn.norm(), left->second.normal.dot(right->second.normal));
            // Going from the facet that runs along the edge to the other, a convex skin turns about the
            // edge's direction.
            const double convex = away[left->second.face] * (turn.dot(way) > 0 ? 1 : -1);
            sum -= way.norm() * convex * angle;
            length += way.norm();
        }
        turns.push_back(length > 0 ? sum / length : 0);
    }
    return turns;
}

void face_away(OpenVolume& volume, const RunContext& context)
{
    const std::vector<std::vector<FaceId>> parts = parts_of(volume.model);
    const std::vector<bool> facing = parts_facing_void(volume, parts, points_on_edges(volume.model), context);
    for (std::size_t p = 0; p < parts.size(); ++p)
        if (facing[p]) flip_faces(volume.model, parts[p]);
}

} // namespace lacuna::closure
