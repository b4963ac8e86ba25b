// SPDX-License-Identifier: MIT
#include <lacuna/geometry/shared/minimal_frame.h>

#include <lacuna/core/shared/criteria.h>

#include <Eigen/Geometry>

#include <cmath>

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
    // Eigen's FromTwoVectors holds a singular value decomposition, which takes 8 s to compile.
    const Vec3 a = from.normalized(), b = to.normalized();
    const double cosine = b.dot(a);
    if (cosine < -1 + kRoundoff) { // opposite: the cross product has lost half its digits
        const Vec3 across = a.unitOrthogonal(); // every half turn is as small
        return least_turn(across, b) * least_turn(a, across);
    }
    const double twice = std::sqrt(2 * (1 + cosine)); // twice the cosine of half the angle
    Eigen::Quaterniond turn;
    turn.vec() = a.cross(b) * (1 / twice);
    turn.w() = twice / 2;
    return turn.toRotationMatrix();
}

} // namespace lacuna::geometry
