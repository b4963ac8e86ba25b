// SPDX-License-Identifier: MIT
#include <lacuna/topology/shared/joined_faces.h>

#include <lacuna/core/shared/constants.h>
#include <lacuna/core/shared/criteria.h>
#include <lacuna/geometry/exact.h>
#include <lacuna/topology/open_volume.h>
#include <lacuna/topology/shared/cone_shape.h>
#include <lacuna/topology/shared/face_parts.h>
#include <lacuna/topology/shared/face_plane.h>
#include <lacuna/topology/shared/face_radius.h>
#include <lacuna/topology/shared/facet_area.h>
#include <lacuna/topology/shared/patches.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <memory>
#include <utility>

namespace lacuna::topology {
namespace {

/// One surface that several faces share. The parameters of a part are those of its own surface, moved along u
/// by a range of its own.
class JoinedSurface final : public geometry::ExactSurface {
public:
    JoinedSurface(const Model& model, const std::vector<FaceId>& parts)
    {
        for (const FaceId part : parts) {
            surfaces_.push_back(model[part].surface);
            for (const auto& uv : model[part].uv)
                for (const Vec2& at : uv) {
                    low_ = std::min(low_, at.x());
                    high_ = std::max(high_, at.x());
                }
        }
    }

    /// The parameters on this surface of parameters of a part's surface.
    [[nodiscard]] Vec2 from_part(std::size_t part, Vec2 uv) const
    {
        uv.x() += static_cast<double>(part) * stride();
        return uv;
    }

    void project(std::span<Vec3> points, std::span<Vec2> uv, const RunContext& context) const override
    {
        std::vector<std::vector<std::size_t>> of_part(surfaces_.size());
        for (std::size_t i = 0; i < points.size(); ++i) {
            const double part = std::floor((uv[i].x() - low_) / stride() +
                                           0.25); // in the middle of its range
            of_part[static_cast<std::size_t>(std::clamp(part, 0.0, static_cast<double>(of_part.size()) - 1))]
                .push_back(i);
        }
        for (std::size_t part = 0; part < of_part.size(); ++part) {
            std::vector<Vec3> at;
            std::vector<Vec2> own;
            for (const std::size_t i : of_part[part]) {
                at.push_back(points[i]);
                own.emplace_back(uv[i].x() - static_cast<double>(part) * stride(), uv[i].y());
            }
            if (at.empty()) continue;
            surfaces_[part]->project(at, own, context);
            for (std::size_t k = 0; k < at.size(); ++k) {
                points[of_part[part][k]] = at[k];
                uv[of_part[part][k]] = from_part(part, own[k]);
            }
        }
    }

private:
    [[nodiscard]] double stride() const { return 2 * (high_ - low_); }

    std::vector<std::shared_ptr<const geometry::ExactSurface>> surfaces_;
    double low_ = kInfinity, high_ = -kInfinity; ///< range of u over all parts
};

/// The plane, cylinder, cone or sphere of a face, as the distance of a point from it. Empty for other faces.
std::function<double(const Vec3&)> shape_of(const Model& model, FaceId face)
{
    if (const auto plane = plane_of(model, face))
        return [plane](const Vec3& p) { return std::abs(geometry::height(*plane, p)); };
    if (const auto round = round_shape(model, face))
        return [round](const Vec3& p) { return std::abs(round->height(p)); };
    if (const auto cone = cone_shape(model, face))
        return [cone](const Vec3& p) { return std::abs(cone->height(p)); };
    return {};
}

/// The largest distance of a face's corners from a shape.
double distance(const Model& model, FaceId face, const std::function<double(const Vec3&)>& from)
{
    double most = 0;
    for (const Index p : corner_points(model[face])) most = std::max(most, from(model.at(p)));
    return most;
}

/// Whether two faces meet at an edge without a bend. Faces of one shape can only fold back onto each other.
bool meet_smoothly(const Model& model, const FaceUse& a, const FaceUse& b, EdgeId edge)
{
    const std::array<Index, 2> ends{model[edge].points[0], model[edge].points[1]};
    const auto area_beside = [&](FaceId face) -> Vec3 {
        for (const Triangle& t : model[face].triangles)
            if (std::ranges::all_of(ends, [&](Index p) { return std::ranges::find(t, p) != t.end(); }))
                return facet_area_vector(model, t);
        return Vec3::Zero();
    };
    return area_beside(a.face).dot(area_beside(b.face)) > 0;
}

bool has_surface(const Face& face) { return face.surface && face.uv.size() == face.triangles.size(); }

/// Whether a face can be joined with others that continue it. The nodes of a given mesh would move.
bool may_join(const Face& face)
{
    return face.origin == Origin::given && !face.keeps_nodes && face.given_quads.empty() && has_surface(face);
}

/// The edges of a model without those between the parts of a joined face. Seams of a joined face stay only
/// where they connect its other edges.
/// @param group  for each face, the face that it becomes a part of
std::vector<Edge> remaining_edges(const Model& model, const std::vector<std::size_t>& group)
{
    std::vector<std::size_t> parts(model.faces.size(), 0);
    for (const std::size_t own : group) ++parts[own];
    std::vector<char> is_seam(model.edges.size(), 0), inside(model.edges.size(), 0);
    std::vector<char> bounds(model.vertices.size(), 0);
    for (std::size_t e = 0; e < model.edges.size(); ++e) {
        const auto uses = model.uses_of_edge(EdgeId(e));
        if (uses.size() == 2 && group[uses[0].face.index()] == group[uses[1].face.index()] &&
            parts[group[uses[0].face.index()]] > 1)
            (uses[0].face == uses[1].face ? is_seam : inside)[e] = 1;
        else
            for (const VertexId v : {model.edges[e].from, model.edges[e].to}) bounds[v.index()] = 1;
    }
    std::vector<Edge> kept;
    for (std::size_t e = 0; e < model.edges.size(); ++e) {
        const Edge& edge = model.edges[e];
        const bool connects = bounds[edge.from.index()] != 0 && bounds[edge.to.index()] != 0;
        if (inside[e] == 0 && (is_seam[e] == 0 || connects)) kept.push_back(edge);
    }
    return kept;
}

/// Whether other faces lie beside a set of faces. A skin without edges would have no ends.
bool has_border(const Model& model, const std::vector<FaceId>& set)
{
    const auto is_in_set = [&](const FaceUse& use) { return std::ranges::find(set, use.face) != set.end(); };
    return std::ranges::any_of(set, [&](FaceId face) {
        return std::ranges::any_of(uses_of(model[face]), [&](const EdgeUse& use) {
            return !std::ranges::all_of(model.uses_of_edge(use.edge), is_in_set);
        });
    });
}

/// The faces that continue a face, after the face itself.
/// @param folds  if not empty, bent faces of any shape continue each other over edges that are no creases
std::vector<FaceId> continued(const Model& model, FaceId root, const std::vector<double>& folds,
                              const std::function<bool(FaceId)>& is_free)
{
    const auto is_bent = [&](const Face& face) { return face.kind != "plane"; };
    std::vector<FaceId> parts{root};
    if (!may_join(model[root])) return parts;
    std::function<double(const Vec3&)> shape; // fitted where a face beside is free
    double own = 0;
    for (std::size_t p = 0; p < parts.size(); ++p)
        for (const EdgeUse& use : uses_of(model[parts[p]])) {
            const auto uses = model.uses_of_edge(use.edge);
            if (uses.size() != 2) continue;
            const FaceUse& beside = uses[uses[0].face == parts[p] ? 1 : 0];
            const Face& other = model[beside.face];
            if (std::ranges::find(parts, beside.face) != parts.end() || !may_join(other) ||
                !are_named_alike(other, model[root]) || !is_free(beside.face))
                continue;
            if (!folds.empty()) {
                if (is_bent(model[root]) && is_bent(other) &&
                    std::abs(folds[use.edge.index()]) < kCreaseAngle)
                    parts.push_back(beside.face);
                continue;
            }
            if (other.kind != model[root].kind) continue;
            if (!shape) {
                shape = shape_of(model, root);
                if (!shape) return parts;
                own = distance(model, root, shape);
            }
            if (distance(model, beside.face, shape) <= own + model.tolerance &&
                meet_smoothly(model, uses[0], uses[1], use.edge))
                parts.push_back(beside.face);
        }
    return parts;
}

/// One face of all parts. Each part keeps its exact surface if all have one; the facets of a plane are exact.
Face joined_face(const Model& model, const std::vector<FaceId>& parts)
{
    Face face = model[parts.front()];
    if (parts.size() == 1) return face;
    const bool exact = std::ranges::all_of(parts, [&](FaceId part) { return has_surface(model[part]); });
    const bool alike = std::ranges::all_of(parts, [&](FaceId part) { return model[part].kind == face.kind; });
    const auto surface = exact && !(alike && face.kind == "plane")
                             ? std::make_shared<JoinedSurface>(model, parts)
                             : nullptr;
    if (!alike) face.kind = exact ? "surface" : "discrete";
    face.tube = std::ranges::all_of(parts, [&](FaceId part) { return model[part].tube; });
    face.surface = surface;
    face.triangles.clear();
    face.uv.clear();
    for (std::size_t p = 0; p < parts.size(); ++p) {
        const Face& part = model[parts[p]];
        if (p > 0) face.repeated_tags.push_back(part.tag);
        face.triangles.insert(face.triangles.end(), part.triangles.begin(), part.triangles.end());
        if (!surface) continue;
        for (const auto& [a, b, c] : part.uv)
            face.uv.push_back({surface->from_part(p, a), surface->from_part(p, b), surface->from_part(p, c)});
    }
    return face;
}

} // namespace

Model join_faces(const Model& model, const std::vector<std::vector<FaceId>>& parts, const RunContext& context)
{
    std::vector<std::size_t> group(model.faces.size());
    std::vector<Face> faces;
    for (const std::vector<FaceId>& own : parts) {
        for (const FaceId part : own) group[part.index()] = faces.size();
        faces.push_back(joined_face(model, own));
    }
    ModelBuilder builder(model);
    builder.faces = std::move(faces);
    builder.edges = remaining_edges(model, group);
    builder.build_loops(context);
    const Model joined = std::move(builder).finish();
    return extract(joined, all_faces(joined));
}

void join_faces(OpenVolume& volume, geometry::UnionFind joined, const RunContext& context)
{
    std::map<std::size_t, std::vector<FaceId>> sets;
    for (const FaceId face : all_faces(volume.model)) sets[joined.find(face.index())].push_back(face);
    std::vector<std::vector<FaceId>> parts;
    std::vector<Role> role;
    for (auto& [root, own] : sets) {
        role.push_back(volume.role[root]);
        parts.push_back(std::move(own));
    }
    volume.model = join_faces(volume.model, parts, context);
    volume.role = std::move(role);
}

bool are_named_alike(const Face& a, const Face& b)
{
    return a.name == b.name && a.groups == b.groups && a.regions == b.regions;
}

std::vector<std::vector<FaceId>> continued_faces(const Model& model, const std::vector<int>& apart,
                                                 Continued how, const RunContext& context)
{
    const std::vector<double> folds = how == Continued::smoothly ? folds_across(model, context)
                                                                 : std::vector<double>{};
    std::vector<FaceId> roots = all_faces(model);
    std::vector<double> area;
    for (const FaceId face : roots) area.push_back(face_area(model, face));
    std::ranges::stable_sort(roots, std::greater{}, [&](FaceId face) { return area[face.index()]; });
    std::vector<char> taken(model.faces.size(), 0);
    std::vector<std::vector<FaceId>> parts;
    for (const FaceId root : roots) {
        if (taken[root.index()] != 0) continue;
        check_cancelled(context);
        parts.push_back(continued(model, root, folds, [&](FaceId face) {
            return taken[face.index()] == 0 && apart[face.index()] == apart[root.index()];
        }));
        if (how == Continued::smoothly && !has_border(model, parts.back())) parts.back().resize(1);
        for (const FaceId part : parts.back()) taken[part.index()] = 1;
    }
    return parts;
}

} // namespace lacuna::topology
