// SPDX-License-Identifier: MIT
//
// Motions of close_along() in which every point of the source has a vector of its own.
#include <lacuna/closure/detail/along_normals.h>

#include <lacuna/core/error.h>
#include <lacuna/core/shared/criteria.h>
#include <lacuna/core/shared/edge_key.h>
#include <lacuna/core/shared/number_text.h>
#include <lacuna/geometry/shared/angle.h>
#include <lacuna/geometry/shared/facet_tree.h>
#include <lacuna/topology/shared/face_parts.h>
#include <lacuna/topology/shared/face_radius.h>
#include <lacuna/topology/shared/side_points.h>

#include <Eigen/QR>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <unordered_set>
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

/// Splits the facets of a source that moves onto a face along one direction. A moved facet is flat between
/// its corners, but the face may not be.
class FacetRefiner {
public:
    /// @param reach  for each point: its distance from the face.
    FacetRefiner(Model model, const geometry::FacetTree& face, const Vec3& way, std::vector<double> reach)
        : model_(std::move(model)), face_(face), way_(way), reach_(std::move(reach))
    {
        for (const double distance : reach_) allowed_ = std::max(allowed_, kAlikeSizes * distance);
        for (const Face& own : model_.faces) {
            if (!own.keeps_nodes) continue;
            for (const Triangle& t : own.triangles)
                for (std::size_t k = 0; k < 3; ++k) kept_.insert(edge_key(t[k], t[(k + 1) % 3]));
        }
    }

    /// Split facets at the middle of their longest sides, until none deviates from the face by more than a
    /// hundredth of the largest distance. Sides of given cells stay, and so do sides below that deviation.
    /// @return  for each point: its distance from the face.
    const std::vector<double>& run(const RunContext& context)
    {
        for (Index first = 0;;) { // the first point of the last round
            check_cancelled(context);
            std::map<std::uint64_t, std::array<Index, 2>> split;
            for (const Face& face : model_.faces)
                for (const Triangle& t : face.triangles)
                    if (*std::ranges::max_element(t) >= first) check(t, split);
            if (split.empty()) break;
            first = static_cast<Index>(model_.points.size());
            split_sides(split);
        }
        if (worst_ > 0)
            log_line(context, formatted("note: along: the target is up to {:.3g} away from the face given as "
                                        "'to', near {}: given cells of the source stay, and their images are "
                                        "flat; load the source with keep_mesh = false",
                                        worst_, place_with_digits(worst_at_, 4)));
        return reach_;
    }

    Model model() && { return std::move(model_).finish(); }

private:
    /// Largest distance of a moved facet from the face, at its centroid and at the quarters of its sides.
    [[nodiscard]] double deviation(const Triangle& t) const
    {
        double most = 0;
        const auto sample = [&](double a, double b, double c) {
            const Vec3 place = a * model_.at(t[0]) + b * model_.at(t[1]) + c * model_.at(t[2]);
            const double flat = a * reach_[index(t[0])] + b * reach_[index(t[1])] + c * reach_[index(t[2])];
            const geometry::FacetTree::RayHit hit = face_.first_along(place, way_);
            if (hit.triangle >= 0) most = std::max(most, std::abs(hit.t - flat));
        };
        sample(1.0 / 3, 1.0 / 3, 1.0 / 3);
        for (const double part : {0.25, 0.5, 0.75}) {
            sample(1 - part, part, 0);
            sample(0, 1 - part, part);
            sample(part, 0, 1 - part);
        }
        return most;
    }

    /// Check a facet, and add its longest side to those that are split if it deviates from the face.
    void check(const Triangle& t, std::map<std::uint64_t, std::array<Index, 2>>& split)
    {
        const double off = deviation(t);
        if (!(off > allowed_)) return;
        const auto length = [&](std::size_t k) {
            return (model_.at(t[(k + 1) % 3]) - model_.at(t[k])).norm();
        };
        const std::size_t k = std::ranges::max(std::array<std::size_t, 3>{0, 1, 2}, {}, length);
        const std::uint64_t key = edge_key(t[k], t[(k + 1) % 3]);
        if (!kept_.contains(key)) {
            if (length(k) > allowed_) split.try_emplace(key, std::array{t[k], t[(k + 1) % 3]});
        } else if (off > worst_) {
            worst_ = off;
            worst_at_ = (model_.at(t[0]) + model_.at(t[1]) + model_.at(t[2])) / 3;
        }
    }

    /// Split sides in the middle. New points lie on exact curves and surfaces.
    void split_sides(const std::map<std::uint64_t, std::array<Index, 2>>& split)
    {
        const std::size_t first = model_.points.size();
        SidePoints sides;
        for (const auto& [key, side] : split) {
            sides.add(side[0], side[1], {static_cast<Index>(model_.points.size())});
            model_.points.emplace_back((model_.at(side[0]) + model_.at(side[1])) / 2);
        }
        std::set<Index> on_curves;
        for (Edge& edge : model_.edges) split_edge(edge, sides, on_curves);
        for (Face& face : model_.faces) {
            cut_at_sides(model_.points, face, sides);
            if (face.surface && face.kind != "plane") project(face, first, on_curves);
        }
        auto side = split.begin();
        for (std::size_t p = first; p < model_.points.size(); ++p, ++side) {
            const auto& [a, b] = side->second;
            const geometry::FacetTree::RayHit hit = face_.first_along(model_.points[p], way_);
            // At the rim, rounding may make the ray miss the face.
            reach_.push_back(hit.triangle < 0 ? (reach_[index(a)] + reach_[index(b)]) / 2 : hit.t);
        }
    }

    /// Put the new points of a face, except those on exact curves, onto its surface.
    /// @param first  the first new point
    void project(Face& face, std::size_t first, const std::set<Index>& on_curves)
    {
        std::vector<std::pair<std::size_t, std::size_t>> corners; // facet and corner
        std::vector<Vec3> places;
        std::vector<Vec2> params;
        for (std::size_t t = 0; t < face.triangles.size(); ++t)
            for (std::size_t k = 0; k < 3; ++k) {
                const Index p = face.triangles[t][k];
                if (index(p) < first || on_curves.contains(p)) continue;
                corners.emplace_back(t, k);
                places.push_back(model_.at(p));
                params.push_back(face.uv[t][k]);
            }
        if (corners.empty()) return;
        face.surface->project(places, params);
        for (std::size_t i = 0; i < corners.size(); ++i) {
            const auto& [t, k] = corners[i];
            model_.points[index(face.triangles[t][k])] = places[i];
            face.uv[t][k] = params[i];
        }
    }

    void split_edge(Edge& edge, const SidePoints& sides, std::set<Index>& on_curves)
    {
        std::vector<Index> points{edge.points.front()}, fresh;
        std::vector<double> params, at; // of all points, and of the new ones
        if (!edge.params.empty()) params.push_back(edge.params.front());
        for (std::size_t i = 1; i < edge.points.size(); ++i) {
            for (const Index made : sides.on(edge.points[i - 1], edge.points[i])) {
                points.push_back(made);
                if (edge.params.empty()) continue;
                fresh.push_back(made);
                at.push_back((edge.params[i - 1] + edge.params[i]) / 2);
                params.push_back(at.back());
            }
            points.push_back(edge.points[i]);
            if (!edge.params.empty()) params.push_back(edge.params[i]);
        }
        edge.points = std::move(points);
        edge.params = std::move(params);
        if (!edge.curve || fresh.empty()) return;
        std::vector<Vec3> places(at.size());
        edge.curve->evaluate(at, places);
        for (std::size_t i = 0; i < fresh.size(); ++i) model_.points[index(fresh[i])] = places[i];
        on_curves.insert(fresh.begin(), fresh.end());
    }

    ModelBuilder model_;
    const geometry::FacetTree& face_;
    Vec3 way_;
    std::vector<double> reach_;
    double allowed_ = 0;
    std::unordered_set<std::uint64_t> kept_; ///< sides of given cells
    double worst_ = 0;                       ///< largest deviation of a facet whose longest side stays
    Vec3 worst_at_ = Vec3::Zero();
};

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

geometry::Motion motion_to_face(OpenVolume& source, const Along::ToFace& to, const RunContext& context)
{
    const Model& model = source.model;
    Vec3 way = area_vector_of(model, all_faces(model));
    if (way.dot(face_centroid(*to.model, to.face) - centroid_of(model, all_faces(model))) < 0) way = -way;
    way = unit(way, "to");
    const auto tree = std::make_shared<const geometry::FacetTree>(to.model->points,
                                                                  (*to.model)[to.face].triangles);
    std::vector<double> reach(model.points.size(), 0);
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
                reach[index(p)] = least;
                continue;
            }
            throw InvalidInput(Message("closure.along_to", "along: the ray from {} meets {} {}",
                                       place_with_digits(place, 4), entity_of(*to.model, to.face),
                                       found(least > most ? "nowhere" : "more than once"))
                                   .remedy("use a face that covers the source once, seen along its normal"));
        }
    }
    FacetRefiner refiner(std::move(source.model), *tree, way, std::move(reach));
    std::vector<Vec3> vectors;
    for (const double distance : refiner.run(context)) vectors.emplace_back(distance * way);
    source.model = std::move(refiner).model();
    const auto between = std::make_shared<const PointVectors>(source.model, std::move(vectors));
    geometry::Motion motion;
    motion.reach = [tree, way, between](const Vec3& place) -> Vec3 {
        const geometry::FacetTree::RayHit hit = tree->first_along(place, way);
        // At the rim, rounding may make the ray miss the face.
        return hit.triangle < 0 ? (*between)(place) : Vec3(hit.t * way);
    };
    return motion;
}

} // namespace lacuna::closure
