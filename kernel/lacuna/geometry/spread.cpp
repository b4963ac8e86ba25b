// SPDX-License-Identifier: MIT
#include <lacuna/geometry/shared/spread.h>

#include <Eigen/Eigenvalues>

#include <numeric>

namespace lacuna::geometry {
namespace {

/// Call `use(point, normalised weight)` for each point.
template <class Use>
void for_each_share(std::span<const Vec3> points, std::span<const double> weights, const Use& use)
{
    const double all = weights.empty() ? static_cast<double>(points.size())
                                       : std::accumulate(weights.begin(), weights.end(), 0.0);
    for (std::size_t p = 0; p < points.size(); ++p) use(points[p], (weights.empty() ? 1 : weights[p]) / all);
}

} // namespace

Spread spread_of(std::span<const Vec3> points, std::span<const double> weights)
{
    Vec3 mean(0, 0, 0);
    for_each_share(points, weights, [&](const Vec3& p, double share) { mean += share * p; });
    return spread_about(mean, points, weights);
}

Spread spread_about(const Vec3& centre, std::span<const Vec3> points, std::span<const double> weights)
{
    Eigen::Matrix3d moments = Eigen::Matrix3d::Zero();
    for_each_share(points, weights, [&](const Vec3& p, double share) {
        moments += share * (p - centre) * (p - centre).transpose();
    });
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(moments); // eigenvalues are ascending
    return {centre, axes.eigenvalues(), axes.eigenvectors()};
}

} // namespace lacuna::geometry
