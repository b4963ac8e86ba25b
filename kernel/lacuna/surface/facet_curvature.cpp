// SPDX-License-Identifier: MIT
#include <lacuna/surface/detail/facet_curvature.h>

#include <lacuna/core/shared/constants.h>
#include <lacuna/core/shared/edge_key.h>
#include <lacuna/geometry/shared/dense_solve.h>
#include <lacuna/topology/shared/cone_shape.h>
#include <lacuna/topology/shared/facet_area.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_map>

namespace lacuna::surface {

using namespace topology;

namespace {

struct Around {
    Eigen::Matrix3d bends = Eigen::Matrix3d::Zero();
    double area = 0, shortest = kInfinity;

    void add(const Around& other)
    {
        bends += other.bends;
        area += other.area;
    }
};

} // namespace

std::vector<PointCurvature> facet_curvature(const Model& model, FaceId face, double crease)
{
    const Face& f = model[face];
    if (f.kind == "plane") return {};
    const std::vector<Index> number = corner_points(f);
    const auto place = [&](Index p) {
        return static_cast<std::size_t>(std::lower_bound(number.begin(), number.end(), p) - number.begin());
    };
    std::vector<Around> at(number.size());
    std::unordered_map<std::uint64_t, std::size_t> first;
    first.reserve(2 * f.triangles.size());
    for (std::size_t i = 0; i < f.triangles.size(); ++i) {
        const Triangle& t = f.triangles[i];
        const Vec3 normal = facet_area_vector(model, t);
        const std::array<std::size_t, 3> own{place(t[0]), place(t[1]), place(t[2])};
        for (std::size_t k = 0; k < 3; ++k) {
            const Index a = t[k], b = t[(k + 1) % 3];
            Around &from = at[own[k]], &to = at[own[(k + 1) % 3]];
            const Vec3 side = model.at(b) - model.at(a);
            from.area += normal.norm() / 3;
            for (Around* end : {&from, &to}) end->shortest = std::min(end->shortest, side.norm());
            const auto [found, fresh] = first.try_emplace(edge_key(a, b), i);
            if (fresh) continue;
            const Vec3 other = facet_area_vector(model, f.triangles[found->second]);
            const double length = side.norm();
            if (!(length > 0) || !(normal.norm() > 0) || !(other.norm() > 0)) continue;
            const double bend = std::atan2(other.cross(normal).dot(side) / length, other.dot(normal));
            if (std::abs(bend) > crease) continue;
            const Vec3 across = side.cross(normal + other).stableNormalized();
            const Eigen::Matrix3d part = bend * length / 2 * across * across.transpose();
            from.bends += part;
            to.bends += part;
        }
    }
    // The facets at one vertex may be slivers that are too few to measure curvature. The facets at
    // neighbouring vertices are therefore included.
    std::vector<Around> wide = at;
    for (const auto& [side, triangle] : first) {
        const std::size_t a = place(static_cast<Index>(side >> 32));
        const std::size_t b = place(static_cast<Index>(side & 0xffffffffU));
        wide[a].add(at[b]);
        wide[b].add(at[a]);
    }
    std::vector<PointCurvature> result;
    result.reserve(number.size());
    for (std::size_t p = 0; p < wide.size(); ++p) {
        PointCurvature& point = result.emplace_back();
        point.point = model.at(number[p]);
        point.area = at[p].area;
        if (!(wide[p].area > 0)) continue;
        const Vec3 bends = geometry::symmetric_eigenvalues(wide[p].bends / wide[p].area).cwiseAbs();
        if (!(bends.maxCoeff() * model.diagonal > 1e-6)) continue; // too flat to affect any size
        point.most = bends.maxCoeff();
        point.sum = bends.sum();
        if (f.surface == nullptr) point.least_size = wide[p].shortest / 2;
    }
    return result;
}

} // namespace lacuna::surface
