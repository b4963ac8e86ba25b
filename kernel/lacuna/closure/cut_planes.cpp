// SPDX-License-Identifier: MIT
#include <lacuna/closure/detail/cut_planes.h>

#include <lacuna/closure/detail/turns.h>
#include <lacuna/closure/shared/piece_ends.h>
#include <lacuna/core/shared/criteria.h>
#include <lacuna/geometry/shared/union_find.h>
#include <lacuna/topology/shared/cone_shape.h>
#include <lacuna/topology/shared/face_plane.h>
#include <lacuna/topology/shared/face_radius.h>
#include <lacuna/topology/shared/use_places.h>

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

namespace lacuna::closure {

using namespace topology;

namespace {

bool are_parallel(const Vec3& a, const Vec3& b) { return a.cross(b).norm() < kParallel; }

/// The direction of a straight edge; empty if the edge is curved.
std::optional<Vec3> straight_along(const Model& model, EdgeId edge)
{
    const Vec3 chord = model.at(model[model[edge].to].point) - model.at(model[model[edge].from].point);
    if (chord.norm() < (1 - kFlatShare) * edge_length(model, edge)) return std::nullopt;
    return chord.stableNormalized();
}

/// The direction of a sweep for which both faces at an edge can belong to one end, such as a flat face with a
/// conical hollow: the normal of the flat face. Empty if neither face is flat, or if the other face is as
/// steep as a wall.
std::optional<Vec3> across_hollow(const Model& model, EdgeId edge)
{
    const std::span<const FaceUse> uses = model.uses_of_edge(edge);
    for (const FaceUse& flat : uses) {
        const auto plane = plane_of(model, flat.face);
        if (plane && std::ranges::all_of(uses, [&](const FaceUse& use) {
                const double along = plane->normal.dot(face_area_vector(model, use.face));
                return std::abs(along) > kFacesEnd * face_area(model, use.face);
            }))
            return plane->normal;
    }
    return std::nullopt;
}

/// The straight edges of a cylinder along its axis.
std::vector<EdgeId> edges_along(const Model& model, FaceId face, const Vec3& axis)
{
    std::vector<EdgeId> edges;
    for (const EdgeUse& use : uses_of(model[face]))
        if (const auto along = straight_along(model, use.edge); along && are_parallel(*along, axis))
            edges.push_back(use.edge);
    return edges;
}

/// The bend of a face that is a concave cylinder: either one that turns by more than a right angle, or a
/// fillet, which meets the faces on both sides smoothly. Empty for any other face.
std::optional<Bend> round_bend(const Model& model, FaceId face, const SkinTurns& turns)
{
    const double area = face_area(model, face);
    const double mean_normal = face_area_vector(model, face).norm() / area;
    if (!(mean_normal < 1 - kFlatShare)) return std::nullopt;
    const auto shape = round_shape(model, face);
    if (!shape || !shape->axis) return std::nullopt;
    double outward = 0;
    for (const Triangle& t : model[face].triangles) {
        const Vec3 &a = model.at(t[0]), &b = model.at(t[1]), &c = model.at(t[2]);
        outward += (a - shape->centre).dot((b - a).cross(c - a));
    }
    if ((outward > 0) != turns.faces_void[face.index()]) return std::nullopt;
    const double turned = area / shape->radius / kRightAngle; // length times number of right angles
    if (mean_normal < kQuarterTurn)
        return Bend{{}, face, turned * (1 - mean_normal / kQuarterTurn), shape->axis};
    const std::vector<EdgeId> sides = edges_along(model, face, *shape->axis);
    const auto is_smooth = [&](EdgeId edge) { return std::abs(turns.concave[edge.index()]) <= kCreaseAngle; };
    if (sides.size() < 2 || !std::ranges::all_of(sides, is_smooth)) return std::nullopt;
    return Bend{{}, face, turned, shape->axis};
}

/// The part of a bend on one side of a plane.
struct Share {
    double length;
    const std::optional<Vec3>* axis;
};

double length_to_cut(const std::vector<Share>& shares)
{
    double all = 0, most = 0;
    for (const Share& one : shares) {
        all += one.length;
        if (!*one.axis) continue;
        double along = 0;
        for (const Share& other : shares)
            if (*other.axis && are_parallel(**one.axis, **other.axis)) along += other.length;
        most = std::max(most, along);
    }
    return 2 * all - most;
}

/// A range of heights along a normal.
struct Interval {
    double low = kInfinity, high = -kInfinity;

    void add(double height)
    {
        low = std::min(low, height);
        high = std::max(high, height);
    }
};

class Planner {
public:
    Planner(const OpenVolume& volume, const std::vector<Bend>& bends, std::size_t most)
        : model_(volume.model), bends_(bends), most_(most)
    {
    }

    std::vector<CutPlane> run()
    {
        add_face_planes();
        add_rim_planes();
        add_fillet_planes();
        find_features();
        for (const Vec3& normal : normals()) add_between(normal);
        std::ranges::stable_sort(between_, {}, &std::pair<double, geometry::Plane>::first);
        for (std::size_t b = 0; b < std::min(between_.size(), most_); ++b)
            planes_.push_back({between_[b].second, {}});
        add_through_axes();
        add_at_bent_rims();
        add_edge_planes();
        return std::move(planes_);
    }

private:
    void add_face_planes()
    {
        for (const FaceId face : all_faces(model_)) {
            std::vector<EdgeId> edges;
            for (const Bend& bend : bends_)
                if (bend.edge.valid() &&
                    std::ranges::any_of(model_.uses_of_edge(bend.edge),
                                        [&](const FaceUse& use) { return use.face == face; }))
                    edges.push_back(bend.edge);
            const auto plane = edges.empty() ? std::nullopt : plane_of(model_, face);
            if (plane) planes_.push_back({*plane, std::move(edges)});
        }
    }

    /// Add the planes of the flat rims of bores: below the plane, a cone, ball or rounded bottom of the bore
    /// is a hollow in an end.
    void add_rim_planes()
    {
        const std::size_t first = planes_.size();
        for (const Bend& bend : bends_) {
            if (!bend.face.valid() || !turns_as_bore(model_, bend.face)) continue;
            for (const EdgeUse& use : uses_of(model_[bend.face])) {
                const geometry::Plane plane = geometry::plane_across(
                    model_.at(model_[model_[use.edge].from].point), *bend.axis);
                const auto lies_flat = [&](const FaceUse& user) {
                    return lies_in_plane(model_, user.face, plane);
                };
                if (!is_in_plane(use.edge, plane) ||
                    std::ranges::any_of(model_.uses_of_edge(use.edge), lies_flat))
                    continue;
                const auto known = std::ranges::find_if(
                    planes_.begin() + static_cast<std::ptrdiff_t>(first), planes_.end(),
                    [&](const CutPlane& own) { return is_in_plane(use.edge, own.plane); });
                if (known != planes_.end())
                    known->edges.push_back(use.edge);
                else
                    planes_.push_back({plane, {use.edge}});
            }
        }
    }

    [[nodiscard]] bool is_in_plane(EdgeId edge, const geometry::Plane& plane) const
    {
        return std::ranges::all_of(model_[edge].points, [&](Index p) {
            return std::abs(geometry::height(plane, model_.at(p))) <= model_.tolerance;
        });
    }

    /// Add the planes through the axis of a concave cylinder and a straight edge between the cylinder and a
    /// flat face.
    void add_fillet_planes()
    {
        for (const Bend& bend : bends_) {
            if (!bend.face.valid()) continue;
            const Vec3 centre = round_shape(model_, bend.face)->centre;
            for (const EdgeId edge : edges_along(model_, bend.face, *bend.axis)) {
                if (std::ranges::none_of(model_.uses_of_edge(edge), [&](const FaceUse& use) {
                        return plane_of(model_, use.face).has_value();
                    }))
                    continue;
                const Vec3 out = model_.at(model_[model_[edge].from].point) - centre;
                planes_.push_back(
                    {geometry::plane_across(centre, bend.axis->cross(out).normalized()), {edge}});
            }
        }
    }

    /// Find the feature of each bend: bends whose faces are the same or share an edge form one feature.
    void find_features()
    {
        std::vector<bool> bent(model_.faces.size(), false);
        geometry::UnionFind sets(model_.faces.size());
        for (const Bend& bend : bends_) {
            if (bend.face.valid()) bent[bend.face.index()] = true;
            if (bend.edge.valid())
                for (const FaceUse& use : model_.uses_of_edge(bend.edge)) bent[use.face.index()] = true;
        }
        for (std::size_t e = 0; e < model_.edges.size(); ++e) {
            const std::span<const FaceUse> uses = model_.uses_of_edge(EdgeId(e));
            if (uses.size() == 2 && bent[uses[0].face.index()] && bent[uses[1].face.index()])
                sets.unite_least(uses[0].face.index(), uses[1].face.index());
        }
        for (const Bend& bend : bends_)
            feature_.push_back(sets.find(
                bend.face.valid() ? bend.face.index() : model_.uses_of_edge(bend.edge).front().face.index()));
    }

    /// Normals of flat faces and common normals of two axes. Parallel normals are listed once.
    [[nodiscard]] std::vector<Vec3> normals() const
    {
        std::vector<Vec3> found;
        const auto add = [&](const Vec3& normal) {
            if (std::ranges::none_of(found, [&](const Vec3& own) { return are_parallel(own, normal); }))
                found.push_back(normal);
        };
        for (const FaceId face : all_faces(model_))
            if (const auto plane = plane_of(model_, face)) add(plane->normal);
        for (const Bend& a : bends_)
            for (const Bend& b : bends_)
                if (a.face.valid() && b.face.valid() && !are_parallel(*a.axis, *b.axis))
                    add(a.axis->cross(*b.axis).normalized());
        return found;
    }

    /// Planes midway between features, each with the length that it leaves to cut.
    void add_between(const Vec3& normal)
    {
        std::vector<Interval> own(bends_.size());
        std::map<std::size_t, Interval> whole;
        for (std::size_t b = 0; b < bends_.size(); ++b) {
            const Bend& bend = bends_[b];
            for (const Index p :
                 bend.face.valid() ? corner_points(model_[bend.face]) : model_[bend.edge].points) {
                own[b].add(normal.dot(model_.at(p)));
                whole[feature_[b]].add(normal.dot(model_.at(p)));
            }
        }
        for (const auto& [feature, interval] : whole) {
            double next = kInfinity;
            for (const auto& [other, there] : whole)
                if (there.low > interval.high + model_.tolerance) next = std::min(next, there.low);
            if (next == kInfinity) continue;
            const double height = (interval.high + next) / 2;
            std::vector<Share> below, above, all;
            for (std::size_t b = 0; b < bends_.size(); ++b) {
                const Bend& bend = bends_[b];
                const double reach = std::max(own[b].high - own[b].low, model_.tolerance);
                const double share = std::clamp((height - own[b].low) / reach, 0.0, 1.0);
                all.push_back({bend.length, &bend.axis});
                if (share > 0) below.push_back({share * bend.length, &bend.axis});
                if (share < 1) above.push_back({(1 - share) * bend.length, &bend.axis});
            }
            const double left = length_to_cut(below) + length_to_cut(above);
            if (left < (1 - kVisible) * length_to_cut(all))
                between_.emplace_back(left, geometry::plane_across(height * normal, normal));
        }
    }

    /// Planes through the axes of crossing cylinders.
    void add_through_axes()
    {
        const auto bend_at = [&](const FaceUse& use) {
            return std::ranges::find_if(bends_, [&](const Bend& bend) { return bend.face == use.face; });
        };
        for (std::size_t e = 0; e < model_.edges.size(); ++e) {
            const std::span<const FaceUse> uses = model_.uses_of_edge(EdgeId(e));
            if (uses.size() != 2) continue;
            const auto a = bend_at(uses[0]), b = bend_at(uses[1]);
            if (a == bends_.end() || b == bends_.end() || are_parallel(*a->axis, *b->axis)) continue;
            const Vec3 across = a->axis->cross(*b->axis).normalized();
            for (const auto& [one, other] : {std::pair(a, b), std::pair(b, a)}) {
                const Vec3 centre = round_shape(model_, one->face)->centre;
                for (const Vec3& normal : {across, Vec3(one->axis->cross(across))})
                    add_new(geometry::plane_across(centre, normal));
            }
        }
    }

    /// Whether the rim of a bore goes on at an end of an edge, out of the plane of a flat face.
    [[nodiscard]] bool leaves_plane(FaceId bore, EdgeId edge, const geometry::Plane& plane) const
    {
        const std::array ends{model_[edge].from, model_[edge].to};
        return std::ranges::any_of(uses_of(model_[bore]), [&](const EdgeUse& use) {
            const Edge& other = model_[use.edge];
            const bool meets = std::ranges::any_of(
                ends, [&](VertexId end) { return other.from == end || other.to == end; });
            return meets && !is_in_plane(use.edge, plane) && !straight_along(model_, use.edge);
        });
    }

    /// Add the planes through the axis of a bore that leaves through a bent face, such as the side of a shaft
    /// or of an elbow, or over an edge between flat faces. Their normals are the directions in which that
    /// face is straightest and most bent: the principal axes of the rim, weighted with its heights.
    void add_at_bent_rims()
    {
        for (const Bend& bend : bends_) {
            if (!bend.face.valid() || !turns_as_bore(model_, bend.face)) continue;
            const Vec3 &axis = *bend.axis, centre = round_shape(model_, bend.face)->centre;
            const Vec3 u = axis.unitOrthogonal(), v = axis.cross(u);
            double length = 0, mean = 0;
            Eigen::Matrix2d moment = Eigen::Matrix2d::Zero(), around = moment;
            for (const EdgeUse& use : uses_of(model_[bend.face])) {
                const auto is_flat = [&](const FaceUse& user) {
                    const auto plane = plane_of(model_, user.face);
                    return plane && !leaves_plane(bend.face, use.edge, *plane);
                };
                const std::vector<Vec3> line = use_places(model_, use);
                if (is_in_plane(use.edge, geometry::plane_across(line.front(), axis)) ||
                    std::ranges::any_of(model_.uses_of_edge(use.edge), is_flat) ||
                    straight_along(model_, use.edge))
                    continue;
                for (std::size_t i = 0; i + 1 < line.size(); ++i) {
                    const Vec3 out = (line[i] + line[i + 1]) / 2 - centre;
                    const Vec2 way = Vec2(out.dot(u), out.dot(v)).normalized();
                    const double side = (line[i + 1] - line[i]).norm(), height = std::abs(out.dot(axis));
                    const Eigen::Matrix2d own = side * way * way.transpose();
                    length += side;
                    mean += side * height;
                    moment += height * own;
                    around += own;
                }
            }
            if (!(length > 0)) continue;
            const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver(moment - mean / length * around);
            for (int k = 0; k < 2; ++k) {
                const Vec2 normal = solver.eigenvectors().col(k);
                add_new(geometry::plane_across(centre, normal.x() * u + normal.y() * v));
            }
        }
    }

    /// Add the planes that bisect the angles at two or more concave edges between flat faces, and the planes
    /// of concave edges that bend, such as the half ellipses where pipes of equal radius meet. A face in the
    /// plane of such an edge proposes this plane already.
    void add_edge_planes()
    {
        std::vector<CutPlane> bisecting, bent;
        for (const Bend& bend : bends_) {
            if (!bend.edge.valid()) continue;
            const std::span<const FaceUse> uses = model_.uses_of_edge(bend.edge);
            if (!straight_along(model_, bend.edge)) {
                const std::vector<std::vector<Vec3>> line(1, use_places(model_, {bend.edge, false}));
                const geometry::Plane plane = geometry::newell_plane(line);
                const auto lies_flat = [&](const FaceUse& use) {
                    return lies_in_plane(model_, use.face, plane);
                };
                if (is_in_plane(bend.edge, plane) && std::ranges::none_of(uses, lies_flat))
                    add_edge(bent, plane, bend.edge);
                continue;
            }
            const auto one = plane_of(model_, uses[0].face), other = plane_of(model_, uses[1].face);
            if (one && other)
                add_edge(bisecting,
                         geometry::plane_across(model_.at(model_[bend.edge].points.front()),
                                                (one->normal - other->normal).normalized()),
                         bend.edge);
        }
        std::ranges::copy(bent, std::back_inserter(planes_));
        std::ranges::copy_if(bisecting, std::back_inserter(planes_),
                             [](const CutPlane& plane) { return plane.edges.size() > 1; });
    }

    /// Add an edge to the plane of a list that contains it, or add the edge's plane.
    void add_edge(std::vector<CutPlane>& planes, const geometry::Plane& plane, EdgeId edge) const
    {
        const auto known = std::ranges::find_if(planes, [&](const CutPlane& own) {
            return are_parallel(own.plane.normal, plane.normal) && is_in_plane(edge, own.plane);
        });
        if (known != planes.end())
            known->edges.push_back(edge);
        else
            planes.push_back({plane, {edge}});
    }

    void add_new(const geometry::Plane& plane)
    {
        if (std::ranges::none_of(planes_, [&](const CutPlane& other) {
                return other.edges.empty() && are_parallel(other.plane.normal, plane.normal) &&
                       std::abs(geometry::height(other.plane, plane.origin)) <= model_.tolerance;
            }))
            planes_.push_back({plane, {}});
    }

    const Model& model_;
    const std::vector<Bend>& bends_;
    std::size_t most_;
    std::vector<std::size_t> feature_; ///< by bend: the feature that it belongs to
    std::vector<std::pair<double, geometry::Plane>> between_;
    std::vector<CutPlane> planes_;
};

} // namespace

bool turns_as_bore(const Model& model, FaceId face)
{
    return face_area_vector(model, face).norm() < kQuarterTurn * face_area(model, face);
}

std::vector<Bend> bends_of(const Model& model, const SkinTurns& turns)
{
    std::vector<Bend> bends;
    for (std::size_t e = 0; e < turns.concave.size(); ++e) {
        const EdgeId edge(e);
        if (!(turns.concave[e] > kCreaseAngle)) continue;
        const auto along = straight_along(model, edge);
        bends.push_back({edge, {}, edge_length(model, edge), along ? along : across_hollow(model, edge)});
    }
    for (const FaceId face : all_faces(model))
        if (auto bend = round_bend(model, face, turns)) bends.push_back(std::move(*bend));
    return bends;
}

double length_to_cut(const std::vector<Bend>& bends)
{
    std::vector<Share> shares;
    for (const Bend& bend : bends) shares.push_back({bend.length, &bend.axis});
    return length_to_cut(shares);
}

std::vector<CutPlane> cut_planes(const OpenVolume& volume, const std::vector<Bend>& bends, std::size_t most)
{
    return Planner(volume, bends, most).run();
}

} // namespace lacuna::closure
