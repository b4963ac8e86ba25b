// SPDX-License-Identifier: MIT
//
// Motions of close_along() in which every point of the source has a vector of its own.
#include <lacuna/closure/detail/along_normals.h>

#include <lacuna/core/error.h>
#include <lacuna/core/shared/criteria.h>
#include <lacuna/core/shared/number_text.h>
#include <lacuna/geometry/shared/angle.h>
#include <lacuna/geometry/shared/facet_tree.h>
#include <lacuna/topology/shared/face_parts.h>
#include <lacuna/topology/shared/face_radius.h>

#include <Eigen/QR>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>

namespace lacuna::closure {

using namespace topology;

namespace {

/// A vector field on the source's facets, given at their corners and linear on each facet.
struct PointVectors {
    std::vector<Triangle> facets;
    geometry::FacetTree tree;
    std::vector<Vec3> at; ///< by point of the model

    PointVectors(const Model& model, std::vector<Vec3> vectors)
        : facets(facets_of(model, all_faces(model))), tree(model.points, facets), at(std::move(vectors))
    {
    }
    [[nodiscard]] Vec3 operator()(const Vec3& place) const
    {
        const geometry::FacetTree::Hit hit = tree.closest(place);
        const Triangle& t = facets[index(hit.triangle)];
        Vec3 sum = Vec3::Zero();
        for (std::size_t i = 0; i < 3; ++i)
            sum += hit.barycentric[static_cast<Eigen::Index>(i)] * at[index(t[i])];
        return sum;
    }
};

/// Unit normal of a round face at a place, directed away from the face's centre or axis.
Vec3 round_normal(const RoundShape& shape, const Vec3& place)
{
    Vec3 out = place - shape.centre;
    if (shape.axis) out -= shape.axis->dot(out) * *shape.axis;
    return out.normalized();
}

/// For each point of a source: the displacement that moves all faces at the point to the parallel faces at
/// distance 1. Its component along the normal of each of these faces is 1. Faces that meet without a crease
/// share their mean normal.
std::vector<Vec3> unit_offsets(const Model& model)
{
    std::vector<std::vector<std::pair<FaceId, Vec3>>> normals(model.points.size());
    for (const FaceId face : all_faces(model)) {
        for (const Triangle& t : model[face].triangles) {
            for (std::size_t i = 0; i < 3; ++i) {
                const Vec3 &a = model.at(t[i]), &b = model.at(t[(i + 1) % 3]), &c = model.at(t[(i + 2) % 3]);
                const double angle = geometry::angle_between(b - a, c - a);
                auto& own = normals[index(t[i])];
                if (own.empty() || own.back().first != face) own.emplace_back(face, Vec3::Zero());
                own.back().second += angle * (b - a).cross(c - a).stableNormalized();
            }
        }
    }
    std::vector<Vec3> offsets(model.points.size(), Vec3::Zero());
    for (std::size_t p = 0; p < normals.size(); ++p) {
        if (normals[p].empty()) continue;
        std::vector<Vec3> sums;
        for (const auto& [face, normal] : normals[p]) {
            const auto alike = std::ranges::find_if(sums, [&](const Vec3& sum) {
                return geometry::angle_between(sum, normal) < kCreaseAngle * kDegree;
            });
            alike == sums.end() ? sums.push_back(normal) : void(*alike += normal);
        }
        Eigen::MatrixXd rows(std::ssize(sums), 3);
        for (std::size_t i = 0; i < sums.size(); ++i)
            rows.row(static_cast<Eigen::Index>(i)) = sums[i].stableNormalized().transpose();
        // Normals that differ by the crease angle are independent: their pivots are 1 and the sine of this
        // angle. A pivot below half of it counts as zero.
        Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> solver;
        solver.setThreshold(std::sin(kCreaseAngle * kDegree) / 2);
        solver.compute(rows);
        offsets[p] = solver.solve(Eigen::VectorXd::Ones(rows.rows()));
    }
    return offsets;
}

/// Report a thickness function that differs from its linear interpolation on the facets by more than a
/// hundredth of its largest value: cells made with the interpolated thickness would visibly differ from the
/// function.
void note_coarse_facets(const Model& model, const std::function<double(const Vec3&)>& thickness,
                        const std::vector<double>& at, const RunContext& context)
{
    double largest = 0, most = 0, taken = 0, wanted = 0;
    Vec3 worst = Vec3::Zero();
    for (const double value : at) largest = std::max(largest, std::abs(value));
    for (const Face& face : model.faces) {
        for (const Triangle& t : face.triangles) {
            const Vec3 middle = (model.at(t[0]) + model.at(t[1]) + model.at(t[2])) / 3;
            const double linear = (at[index(t[0])] + at[index(t[1])] + at[index(t[2])]) / 3;
            const double value = thickness(middle);
            if (!(std::abs(value - linear) > most)) continue;
            most = std::abs(value - linear);
            taken = linear, wanted = value, worst = middle;
        }
    }
    if (most > kAlikeSizes * largest)
        log_line(context,
                 formatted("note: along: the thickness is linear between the corners of the source's "
                           "facets: at {} it is {:.3g}, where the function is {:.3g}; "
                           "model:quads{{ size = ... }}:model() has finer facets",
                           place_with_digits(worst, 4), taken, wanted));
}

/// Thickness at each corner of the source's facets.
std::vector<double> thickness_at(const Model& model, const std::function<double(const Vec3&)>& thickness,
                                 const RunContext& context)
{
    std::vector<double> at(model.points.size(), 0);
    if (!thickness) return at;
    for (const Face& face : model.faces)
        for (const Index p : corners_of(face)) {
            at[index(p)] = thickness(model.at(p));
            if (!std::isfinite(at[index(p)]))
                throw InvalidInput(
                    Message("closure.along_thickness", "along: the thickness at {} is not a finite number",
                            place_with_digits(model.at(p), 4))
                        .remedy("let the function return a finite number at every point of the "
                                "source"));
        }
    note_coarse_facets(model, thickness, at, context);
    return at;
}

/// Move the source's points, and drop its exact surfaces and curves, because the moved points do not lie on
/// them.
void shift_points(Model& model, const std::vector<Vec3>& by)
{
    ModelBuilder builder(std::move(model));
    for (std::size_t p = 0; p < builder.points.size(); ++p) builder.points[p] += by[p];
    for (Face& face : builder.faces) {
        face.surface.reset();
        face.uv.clear();
    }
    for (Edge& edge : builder.edges) {
        edge.curve.reset();
        edge.params.clear();
    }
    model = std::move(builder).finish();
}

} // namespace

Vec3 unit(const Vec3& direction, const char* name)
{
    if (!(direction.stableNorm() > 0))
        throw InvalidInput(
            Message("closure.along_direction", "along: the direction of '{}' has no length", name)
                .remedy("give a vector other than zero"));
    return direction.stableNormalized();
}

geometry::Motion motion_along_normals(OpenVolume& source, const Along::Normals& normals,
                                      const RunContext& context)
{
    const std::vector<Vec3> offsets = unit_offsets(source.model);
    const std::vector<double> inside = thickness_at(source.model, normals.inside, context),
                              outside = thickness_at(source.model, normals.outside, context);
    std::optional<RoundShape> round;
    if (source.model.faces.size() == 1) round = round_shape(source.model, FaceId(0));
    std::vector<Vec3> reach(offsets.size()), back(offsets.size());
    for (std::size_t p = 0; p < offsets.size(); ++p) {
        reach[p] = (inside[p] + outside[p]) * offsets[p];
        back[p] = -inside[p] * offsets[p];
    }
    if (normals.inside) shift_points(source.model, back);
    geometry::Motion motion;
    motion.reach = [vectors = std::make_shared<const PointVectors>(source.model, std::move(reach)),
                    round](const Vec3& place) -> Vec3 {
        const Vec3 vector = (*vectors)(place);
        if (!round) return vector;
        // On a cylinder or a sphere the exact normal is known. Only the length and the sign of the vector are
        // used.
        const Vec3 normal = round_normal(*round, place);
        return (normal.dot(vector) < 0 ? -vector.norm() : vector.norm()) * normal;
    };
    return motion;
}

geometry::Motion motion_to_face(const OpenVolume& source, const Along::ToFace& to)
{
    const Model& model = source.model;
    Vec3 way = area_vector_of(model, all_faces(model));
    if (way.dot(face_centroid(*to.model, to.face) - centroid_of(model, all_faces(model))) < 0) way = -way;
    way = unit(way, "to");
    const auto tree = std::make_shared<const geometry::FacetTree>(to.model->points,
                                                                  (*to.model)[to.face].triangles);
    std::vector<Vec3> reach(model.points.size(), Vec3::Zero());
    for (const Face& face : model.faces) {
        for (const Index p : corners_of(face)) {
            const Vec3& place = model.at(p);
            double least = kInfinity, most = 0;
            tree->all_along(place, way, [&](const geometry::FacetTree::RayHit& hit) {
                least = std::min(least, hit.t);
                most = std::max(most, hit.t);
                return true;
            });
            if (least <= most && most - least <= model.tolerance) {
                reach[index(p)] = least * way;
                continue;
            }
            throw InvalidInput(Message("closure.along_to", "along: the ray from {} meets {} {}",
                                       place_with_digits(place, 4), entity_of(*to.model, to.face),
                                       found(least > most ? "nowhere" : "more than once"))
                                   .remedy("use a face that covers the source once, seen along its normal"));
        }
    }
    geometry::Motion motion;
    motion.reach = [tree, way, vectors = std::make_shared<const PointVectors>(model, std::move(reach))](
                       const Vec3& place) -> Vec3 {
        const geometry::FacetTree::RayHit hit = tree->first_along(place, way);
        // At the rim, rounding may make the ray miss the face.
        return hit.triangle < 0 ? (*vectors)(place) : Vec3(hit.t * way);
    };
    return motion;
}

} // namespace lacuna::closure
