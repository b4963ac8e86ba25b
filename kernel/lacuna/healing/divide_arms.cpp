// SPDX-License-Identifier: MIT
#include <lacuna/healing/detail/divide_arms.h>

#include <lacuna/core/shared/constants.h>
#include <lacuna/core/shared/criteria.h>
#include <lacuna/geometry/newell.h>
#include <lacuna/geometry/shared/angle.h>
#include <lacuna/geometry/shared/harmonic.h>
#include <lacuna/topology/shared/facet_area.h>
#include <lacuna/topology/shared/side_points.h>
#include <lacuna/topology/shared/use_places.h>

#include <algorithm>
#include <map>
#include <numbers>
#include <numeric>
#include <optional>
#include <set>
#include <utility>

namespace lacuna::healing {

using namespace topology;

namespace {

/// Divides one face.
class Junction {
public:
    Junction(ModelBuilder& model, FaceId face, const RunContext& context)
        : model_(model), face_(face), context_(context)
    {
        for (const Loop& loop : model[face].loops) rims_.push_back(loop_points(model, loop.uses));
    }

    /// A wall that is straight along its rims has no curvature that tubes could leave to their junction.
    [[nodiscard]] bool is_one() const
    {
        const Face& face = model_[face_];
        if (rims_.size() < 3 || !face.given_quads.empty() || face.keeps_nodes || face.surface) return false;
        if (!std::ranges::all_of(rims_, [&](const std::vector<Index>& rim) { return is_tube_at(rim); }))
            return false;
        const std::vector<double> curvature = curvatures();
        return std::reduce(curvature.begin(), curvature.end()) <
               -std::numbers::pi * static_cast<double>(rims_.size() - 2);
    }

    /// @return whether a tube became a face of its own
    bool divide()
    {
        const geometry::HarmonicValues solved = solve();
        level_.resize(model_.points.size());
        for (std::size_t p = 0; p < solved.points.size(); ++p)
            level_[index(solved.points[p])] = solved.values.row(static_cast<Eigen::Index>(p));
        const std::vector<double> curvature = curvatures();
        std::vector<std::optional<double>> ends;
        for (std::size_t k = 0; k < rims_.size(); ++k) ends.push_back(end_of_tube(curvature, k));
        bool any = false;
        for (std::size_t k = 0; k < ends.size(); ++k) {
            check_cancelled(context_);
            any = (ends[k] && cut_off(k, beside_others(k, *ends[k]))) || any;
        }
        return any;
    }

private:
    /// Whether the facets at a rim run along its normal.
    [[nodiscard]] bool is_tube_at(const std::vector<Index>& rim) const
    {
        const std::set<Index> on_rim(rim.begin(), rim.end());
        const Vec3 normal = geometry::newell_vector(places_at(model_, rim)).stableNormalized();
        double area = 0, along = 0;
        for (const Triangle& t : model_[face_].triangles) {
            if (std::ranges::none_of(t, [&](Index p) { return on_rim.contains(p); })) continue;
            const Vec3 own = facet_area_vector(model_, t);
            area += own.norm();
            along += std::abs(own.dot(normal));
        }
        return along < std::sin(kCreaseAngle * kDegree) * area;
    }

    /// For each rim a function that is 0 there and 1 on the other rims.
    [[nodiscard]] geometry::HarmonicValues solve() const
    {
        geometry::HarmonicProblem problem;
        problem.points = model_.points;
        problem.triangles = model_[face_].triangles;
        const auto count = static_cast<Eigen::Index>(rims_.size());
        std::map<Index, Eigen::Index> rim_of;
        for (Eigen::Index k = 0; k < count; ++k)
            for (const Index p : rims_[static_cast<std::size_t>(k)]) rim_of.emplace(p, k);
        problem.fixed_values = Eigen::MatrixXd::Ones(static_cast<Eigen::Index>(rim_of.size()), count);
        for (const auto& [p, k] : rim_of) {
            problem.fixed_values(static_cast<Eigen::Index>(problem.fixed.size()), k) = 0;
            problem.fixed.push_back(p);
        }
        return geometry::solve_on_facets(problem, context_);
    }

    [[nodiscard]] double level(Index point, std::size_t rim) const
    {
        return level_[index(point)][static_cast<Eigen::Index>(rim)];
    }

    /// By point: Gaussian curvature at the inner points of the face, the full angle less the angles of the
    /// facets there [radian]; 0 elsewhere.
    [[nodiscard]] std::vector<double> curvatures() const
    {
        std::vector<double> curvature(model_.points.size(), 0);
        for (const Triangle& t : model_[face_].triangles)
            for (const Index p : t) curvature[index(p)] = 2 * std::numbers::pi;
        for (const Triangle& t : model_[face_].triangles)
            for (std::size_t k = 0; k < 3; ++k) {
                const Vec3& at = model_.at(t[k]);
                curvature[index(t[k])] -= geometry::angle_between(model_.at(t[(k + 1) % 3]) - at,
                                                                  model_.at(t[(k + 2) % 3]) - at);
            }
        for (const std::vector<Index>& rim : rims_)
            for (const Index p : rim) curvature[index(p)] = 0;
        return curvature;
    }

    /// The level at which the tube of a rim ends. Empty if no inner point is below it.
    [[nodiscard]] std::optional<double> end_of_tube(const std::vector<double>& curvature,
                                                    std::size_t rim) const
    {
        std::vector<std::pair<double, double>> order; // level, curvature
        for (std::size_t p = 0; p < curvature.size(); ++p)
            if (curvature[p] != 0) order.emplace_back(level(static_cast<Index>(p), rim), curvature[p]);
        std::ranges::sort(order);
        std::optional<double> end;
        double total = 0;
        for (std::size_t i = 0; i + 1 < order.size(); ++i) {
            total += order[i].second;
            // Halfway to the next point, so that no point is at the level itself.
            if (total > -kCreaseAngle * kDegree && order[i + 1].first > order[i].first)
                end = (order[i].first + order[i + 1].first) / 2;
        }
        return end;
    }

    /// The level at which a tube ends, or one below it at which it does not meet the tubes that were cut off.
    [[nodiscard]] double beside_others(std::size_t rim, double end) const
    {
        double most = end, below = 0;
        for (const Index p : of_others_) most = std::min(most, level(p, rim));
        if (most == end) return end;
        for (const Triangle& t : model_[face_].triangles)
            for (const Index p : t)
                if (level(p, rim) < most) below = std::max(below, level(p, rim));
        return (below + most) / 2;
    }

    /// Split the face along a level of a rim; the part below it becomes a face of its own. False if the level
    /// is not one line.
    bool cut_off(std::size_t rim, double end)
    {
        Face junction = model_[face_];
        SidePoints sides;
        std::set<std::pair<Index, Index>> done;
        const auto first = static_cast<Index>(model_.points.size());
        for (const Triangle& t : junction.triangles)
            for (std::size_t k = 0; k < 3; ++k) {
                const auto [a, b] = std::minmax(t[k], t[(k + 1) % 3]);
                const double from = level(a, rim), to = level(b, rim);
                if ((from < end) == (to < end) || !done.insert({a, b}).second) continue;
                const double f = (end - from) / (to - from);
                const auto p = static_cast<Index>(model_.points.size());
                model_.points.emplace_back((1 - f) * model_.at(a) + f * model_.at(b));
                level_.emplace_back((1 - f) * level_[index(a)] + f * level_[index(b)]);
                level_.back()[static_cast<Eigen::Index>(rim)] = end;
                sides.add(a, b, {p});
            }
        cut_at_sides(model_.points, junction, sides);
        Face tube = junction;
        const auto is_below = [&](const Triangle& t) {
            return std::ranges::any_of(t, [&](Index p) { return level(p, rim) < end; });
        };
        erase_facets(junction, [&](std::size_t t) { return is_below(junction.triangles[t]); });
        erase_facets(tube, [&](std::size_t t) { return !is_below(tube.triangles[t]); });
        std::vector<Index> line = line_from(first, tube);
        if (line.size() < 4 || line.size() != model_.points.size() - index(first) + 1) {
            model_.points.resize(index(first));
            level_.resize(index(first));
            return false;
        }
        of_others_.insert(of_others_.end(), line.begin(), line.end());
        tube.tag = static_cast<int>(model_.faces.size()) + 1;
        tube.tube = true;
        model_[face_] = std::move(junction);
        model_.faces.push_back(std::move(tube));
        Edge edge;
        edge.tag = static_cast<int>(model_.edges.size()) + 1;
        edge.from = edge.to = VertexId(model_.vertices.size());
        model_.vertices.push_back(
            {.point = line.front(), .tag = static_cast<int>(model_.vertices.size()) + 1});
        edge.points = std::move(line);
        model_.edges.push_back(std::move(edge));
        return true;
    }

    /// The closed line of a face's sides through the points from number `first` on.
    static std::vector<Index> line_from(Index first, const Face& face)
    {
        std::map<Index, Index> next;
        for (const Triangle& t : face.triangles)
            for (std::size_t k = 0; k < 3; ++k)
                if (t[k] >= first && t[(k + 1) % 3] >= first) next[t[k]] = t[(k + 1) % 3];
        std::vector<Index> line{first};
        for (auto at = next.find(first); at != next.end() && line.size() <= next.size();
             at = next.find(line.back())) {
            line.push_back(at->second);
            if (line.back() == first) break;
        }
        return line;
    }

    ModelBuilder& model_;
    FaceId face_;
    const RunContext& context_;
    std::vector<std::vector<Index>> rims_;
    std::vector<Eigen::VectorXd> level_; ///< by point: a level for each rim; empty beside the face
    std::vector<Index> of_others_;       ///< points at the ends of the tubes that were cut off
};

} // namespace

void divide_arms(ModelBuilder& model, const RunContext& context)
{
    bool any = false;
    const std::size_t count = model.faces.size();
    for (std::size_t f = 0; f < count; ++f) {
        Junction junction(model, FaceId(f), context);
        if (!junction.is_one()) continue;
        any = junction.divide() || any;
    }
    if (any) model.build_loops(context);
}

} // namespace lacuna::healing
