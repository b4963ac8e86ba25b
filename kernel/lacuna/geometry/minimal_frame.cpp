// SPDX-License-Identifier: MIT
#include <lacuna/geometry/shared/minimal_frame.h>

#include <Eigen/Geometry>

namespace lacuna::geometry {

std::vector<Vec3> ways_along(std::span<const Vec3> middles, std::span<const double> widths)
{
    std::vector<Vec3> ways;
    for (std::size_t k = 0; k < middles.size(); ++k) {
        std::size_t low = k, high = k;
        do {
            low -= low > 0 ? 1 : 0;
            high += high + 1 < middles.size() ? 1 : 0;
        } while ((middles[high] - middles[low]).norm() < widths[k] && (low > 0 || high + 1 < middles.size()));
        ways.push_back((middles[high] - middles[low]).stableNormalized());
    }
    return ways;
}

Eigen::Matrix3d least_turn(const Vec3& from, const Vec3& to)
{
    if (!(from.norm() > 0 && to.norm() > 0)) return Eigen::Matrix3d::Identity();
    return Eigen::Quaterniond::FromTwoVectors(from, to).toRotationMatrix();
}

} // namespace lacuna::geometry
