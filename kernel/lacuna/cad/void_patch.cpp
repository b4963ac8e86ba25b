// SPDX-License-Identifier: MIT
#include <lacuna/cad/detail/void_patch.h>

#include <lacuna/cad/detail/edge_shape.h>
#include <lacuna/core/shared/criteria.h>
#include <lacuna/core/shared/limits.h>
#include <lacuna/geometry/shared/dense_solve.h>
#include <lacuna/geometry/shared/harmonic.h>
#include <lacuna/geometry/shared/polyline.h>
#include <lacuna/geometry/shared/union_find.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>

namespace lacuna::cad {

using namespace topology;

namespace {

/// Piecewise linear map from the parameter of the patch to the share of a side, so that the breaks of
/// opposite sides get the same parameter.
struct BreakMap {
    std::vector<double> patch{0}, side{0};

    [[nodiscard]] static double through(const std::vector<double>& from, const std::vector<double>& to,
                                        double x)
    {
        const auto [i, f] = geometry::place_at(from, x);
        return (1 - f) * to[i] + f * to[i + 1];
    }
    [[nodiscard]] double to_side(double x) const { return through(patch, side, x); }
    [[nodiscard]] double to_patch(double s) const { return through(side, patch, s); }
    [[nodiscard]] std::vector<double> to_side(std::span<const double> parameters) const
    {
        std::vector<double> shares;
        for (const double x : parameters) shares.push_back(to_side(x));
        return shares;
    }
};

/// Pair the breaks of opposite sides. If both sides have the same number of breaks, they are paired in order.
/// Otherwise the breaks of each side are also used on the other side.
std::pair<BreakMap, BreakMap> pair_breaks(const std::vector<double>& a, const std::vector<double>& b)
{
    BreakMap on_a, on_b;
    if (a.size() == b.size()) {
        for (std::size_t i = 0; i < a.size(); ++i) {
            const double middle = (a[i] + b[i]) / 2;
            on_a.patch.push_back(middle);
            on_b.patch.push_back(middle);
            on_a.side.push_back(a[i]);
            on_b.side.push_back(b[i]);
        }
    } else {
        std::vector<double> all;
        std::merge(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(all));
        for (const double x : all) {
            if (x - on_a.patch.back() < kSamePlace) continue;
            for (BreakMap* map : {&on_a, &on_b}) {
                map->patch.push_back(x);
                map->side.push_back(x);
            }
        }
    }
    for (BreakMap* map : {&on_a, &on_b}) {
        map->patch.push_back(1);
        map->side.push_back(1);
    }
    return {on_a, on_b};
}

std::vector<EdgeUse> backward(std::vector<EdgeUse> uses)
{
    std::reverse(uses.begin(), uses.end());
    for (EdgeUse& use : uses) use.reversed = !use.reversed;
    return uses;
}

/// A displacement added to the Coons patch; zero on all four sides.
struct Correction {
    SplineAxisData u, v;
    std::array<Eigen::MatrixXd, 3> poles; ///< rows along u, columns along v; the outermost poles are zero
};

/// A Coons patch over the unit square: bottom and top are curves in u, left and right in v.
class Patch {
public:
    Patch(const Model& model, const std::vector<std::vector<EdgeUse>>& sides)
        : bottom_(model, sides[0]),
          right_(model, sides[1]),
          top_(model, backward(sides[2])),
          left_(model, backward(sides[3]))
    {
        std::tie(on_bottom_, on_top_) = pair_breaks(bottom_.breaks(), top_.breaks());
        std::tie(on_left_, on_right_) = pair_breaks(left_.breaks(), right_.breaks());
    }

    [[nodiscard]] const std::vector<double>& breaks_u() const { return on_bottom_.patch; }
    [[nodiscard]] const std::vector<double>& breaks_v() const { return on_left_.patch; }

    /// Points of the patch: for each v, one row of points along u.
    [[nodiscard]] std::vector<Vec3> grid(std::span<const double> u, std::span<const double> v) const
    {
        const Sides sides = sides_at(u, v);
        std::vector<Vec3> places;
        for (std::size_t j = 0; j < v.size(); ++j)
            for (std::size_t i = 0; i < u.size(); ++i) places.push_back(sides.at(i, u[i], j, v[j]));
        if (!correction_) return places;
        const Eigen::MatrixXd along = basis_rows(correction_->u, u), across = basis_rows(correction_->v, v);
        for (std::size_t d = 0; d < 3; ++d) {
            const Eigen::MatrixXd added = along * correction_->poles[d] * across.transpose();
            for (std::size_t k = 0; k < places.size(); ++k)
                places[k][static_cast<Eigen::Index>(d)] += added(static_cast<Eigen::Index>(k % u.size()),
                                                                 static_cast<Eigen::Index>(k / u.size()));
        }
        return places;
    }

    /// Fit the patch to the facets if one of their points is farther from the patch than twice the largest
    /// chord error of the sides plus the tolerance.
    void follow(const Model& model, const Face& face);
    [[nodiscard]] bool follows() const { return correction_.has_value(); }

private:
    /// The points of the sides at given parameters, from which the Coons formula is evaluated.
    struct Sides {
        std::vector<Vec3> bottom, top, left, right;
        std::array<Vec3, 4> corner; ///< both ends of the bottom, then both ends of the top
        [[nodiscard]] Vec3 at(std::size_t i, double u, std::size_t j, double v) const
        {
            const Vec3 corners = (1 - v) * ((1 - u) * corner[0] + u * corner[1]) +
                                 v * ((1 - u) * corner[2] + u * corner[3]);
            return (1 - v) * bottom[i] + v * top[i] + (1 - u) * left[j] + u * right[j] - corners;
        }
    };
    [[nodiscard]] Sides sides_at(std::span<const double> u, std::span<const double> v) const
    {
        const std::array<double, 2> ends{0, 1};
        const std::vector<Vec3> low = bottom_.at(ends), high = top_.at(ends);
        return {bottom_.at(on_bottom_.to_side(u)),
                top_.at(on_top_.to_side(u)),
                left_.at(on_left_.to_side(v)),
                right_.at(on_right_.to_side(v)),
                {low[0], low[1], high[0], high[1]}};
    }
    PatchSide bottom_, right_, top_, left_;
    BreakMap on_bottom_, on_top_, on_left_, on_right_;
    std::optional<Correction> correction_;
    friend struct Laid;
};

/// The facets of a face, cut open along its seams and mapped to the unit square.
struct Laid {
    std::vector<Vec3> points;
    std::vector<Vec2> uv;
    std::vector<bool> on_rim;

    Laid(const Model& model, const Face& face, const Patch& patch)
    {
        std::vector<Triangle> triangles = cut_open(model, face);
        std::vector<Index> rim;
        std::vector<Vec2> rim_uv;
        const auto add = [&](const PatchSide& side, const BreakMap& map, bool forward, const auto& place) {
            const std::size_t n = side.points().size();
            for (std::size_t k = 0; k + 1 < n; ++k) {
                const std::size_t from = forward ? k : n - 1 - k, to = forward ? k + 1 : n - 2 - k;
                rim.push_back(corner_.at({side.points()[from], side.points()[to]}));
                rim_uv.push_back(place(map.to_patch(side.shares()[from])));
            }
        };
        add(patch.bottom_, patch.on_bottom_, true, [](double x) { return Vec2(x, 0); });
        add(patch.right_, patch.on_right_, true, [](double x) { return Vec2(1, x); });
        add(patch.top_, patch.on_top_, false, [](double x) { return Vec2(x, 1); });
        add(patch.left_, patch.on_left_, false, [](double x) { return Vec2(0, x); });
        geometry::HarmonicProblem problem{points, triangles, rim, {}, {}, {}};
        problem.fixed_values.resize(static_cast<Eigen::Index>(rim.size()), 2);
        on_rim.assign(points.size(), false);
        for (std::size_t i = 0; i < rim.size(); ++i) {
            problem.fixed_values.row(static_cast<Eigen::Index>(i)) = rim_uv[i].transpose();
            on_rim[static_cast<std::size_t>(rim[i])] = true;
        }
        const Eigen::MatrixXd laid = geometry::solve_harmonic(problem);
        for (Eigen::Index i = 0; i < laid.rows(); ++i) uv.emplace_back(laid.row(i).transpose());
    }

private:
    /// Duplicate points so that facets on the two sides of a seam, which the loop passes twice, have their
    /// own points.
    std::vector<Triangle> cut_open(const Model& model, const Face& face)
    {
        std::map<Segment, std::size_t> facet_at; // facet of each directed side
        for (std::size_t t = 0; t < face.triangles.size(); ++t)
            for (std::size_t i = 0; i < 3; ++i)
                facet_at[{face.triangles[t][i], face.triangles[t][(i + 1) % 3]}] = t;
        std::set<Segment> rim; // directed sides
        for (const Loop& loop : face.loops) {
            for (const EdgeUse& use : loop.uses) {
                const std::vector<Index> chain = use_points(model, use);
                for (std::size_t k = 0; k + 1 < chain.size(); ++k) rim.insert({chain[k], chain[k + 1]});
            }
        }
        // Merge facet corners that meet at a side that is not on the rim.
        geometry::UnionFind same(3 * face.triangles.size());
        const auto corner_of = [&](std::size_t t, Index p) {
            const Triangle& corners = face.triangles[t];
            return 3 * t +
                   static_cast<std::size_t>(std::find(corners.begin(), corners.end(), p) - corners.begin());
        };
        for (const auto& [side, t] : facet_at) {
            const auto other = facet_at.find({side[1], side[0]});
            if (other == facet_at.end() || rim.contains(side) || rim.contains({side[1], side[0]})) continue;
            for (const Index p : side) same.unite(corner_of(other->second, p), corner_of(t, p));
        }
        std::map<std::size_t, Index> number;
        std::vector<Triangle> open(face.triangles.size());
        for (std::size_t c = 0; c < 3 * face.triangles.size(); ++c) {
            const auto [place, fresh] = number.try_emplace(same.find(c), static_cast<Index>(points.size()));
            if (fresh) points.push_back(model.at(face.triangles[c / 3][c % 3]));
            open[c / 3][c % 3] = place->second;
        }
        for (const auto& [side, t] : facet_at) corner_[side] = open[t][corner_of(t, side[0]) % 3];
        return open;
    }

    std::map<Segment, Index> corner_; ///< the point at which a directed side starts
};

void Patch::follow(const Model& model, const Face& face)
{
    const Laid laid(model, face, *this);
    std::vector<Vec3> off(laid.points.size(), Vec3::Zero());
    std::vector<double> u, v;
    for (const Vec2& uv : laid.uv) {
        u.push_back(std::clamp(uv.x(), 0.0, 1.0));
        v.push_back(std::clamp(uv.y(), 0.0, 1.0));
    }
    const Sides patch = sides_at(u, v);
    double furthest = 0;
    std::size_t inner = 0;
    for (std::size_t i = 0; i < off.size(); ++i) {
        if (laid.on_rim[i]) continue;
        ++inner;
        off[i] = laid.points[i] - patch.at(i, u[i], i, v[i]);
        furthest = std::max(furthest, off[i].norm());
    }
    const double chords = std::max({bottom_.sagitta(), top_.sagitta(), left_.sagitta(), right_.sagitta()});
    if (furthest <= 2 * chords + model.tolerance) return;

    const auto spans = [&](const PatchSide& a, const PatchSide& b) {
        const std::size_t segments = std::max(a.points().size(), b.points().size()) - 1;
        std::size_t count = 1;
        while (2 * count <= kChords && 4 * count <= segments) count *= 2;
        return count;
    };
    Correction fit;
    fit.u = axis_of_spans(spans(bottom_, top_), 3);
    fit.v = axis_of_spans(spans(left_, right_), 3);
    const Eigen::MatrixXd along = basis_rows(fit.u, u), across = basis_rows(fit.v, v);
    const Eigen::Index nu = along.cols(), nv = across.cols();
    const Eigen::Index unknowns = (nu - 2) * (nv - 2);
    Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(unknowns, unknowns);
    Eigen::MatrixXd right = Eigen::MatrixXd::Zero(unknowns, 3);
    for (std::size_t i = 0; i < off.size(); ++i) {
        if (laid.on_rim[i]) continue;
        const auto row_of = static_cast<Eigen::Index>(i);
        const Eigen::VectorXd bu = along.row(row_of).segment(1, nu - 2).transpose();
        const Eigen::MatrixXd product = bu * across.row(row_of).segment(1, nv - 2);
        const Eigen::Map<const Eigen::VectorXd> row(product.data(), unknowns);
        normal.selfadjointView<Eigen::Lower>().rankUpdate(row);
        right += row * off[i].transpose();
    }
    // Poles without data near them keep the shape of the patch.
    normal.diagonal().array() += 1e-8 * static_cast<double>(inner) / static_cast<double>(unknowns);
    const Eigen::MatrixXd solved = geometry::solve_symmetric(normal, right);
    for (Eigen::Index d = 0; d < 3; ++d) {
        Eigen::MatrixXd& poles = fit.poles[static_cast<std::size_t>(d)];
        poles = Eigen::MatrixXd::Zero(nu, nv);
        const Eigen::VectorXd column = solved.col(d);
        poles.block(1, 1, nu - 2, nv - 2) = Eigen::Map<const Eigen::MatrixXd>(column.data(), nu - 2, nv - 2);
    }
    correction_ = std::move(fit);
}

} // namespace

std::vector<SplineSurfaceData> void_patches(const Model& model, const Face& face,
                                            const std::vector<std::vector<EdgeUse>>& sides, double precision)
{
    Patch patch(model, sides);
    patch.follow(model, face);
    // A surface fitted to facets need not be more precise than the facets.
    if (patch.follows()) precision *= 10;
    std::vector<SplineSurfaceData> surfaces;
    const std::vector<double>&u = patch.breaks_u(), &v = patch.breaks_v();
    for (std::size_t j = 0; j + 1 < v.size(); ++j) {
        for (std::size_t i = 0; i + 1 < u.size(); ++i) {
            const auto part = [](std::span<const double> at, double low, double high) {
                std::vector<double> moved;
                for (const double x : at) moved.push_back((1 - x) * low + x * high);
                return moved;
            };
            surfaces.push_back(approximate(
                [&](std::span<const double> at_u, std::span<const double> at_v) {
                    return patch.grid(part(at_u, u[i], u[i + 1]), part(at_v, v[j], v[j + 1]));
                },
                precision));
        }
    }
    return surfaces;
}

} // namespace lacuna::cad
