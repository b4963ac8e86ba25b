// SPDX-License-Identifier: MIT
#include <lacuna/quality/detail/wedge.h>

#include <lacuna/core/shared/constants.h>
#include <lacuna/quality/quality.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace lacuna::quality {
namespace {

double determinant(const Vec3& a, const Vec3& b, const Vec3& c) { return a.dot(b.cross(c)); }

/// Scaled Jacobian at corner `i` of the triangle whose first corner is `level`.
double scaled_at(std::span<const Vec3, 6> corners, std::size_t level, std::size_t i)
{
    const Vec3& p = corners[level + i];
    const Vec3 next = corners[level + (i + 1) % 3] - p, before = corners[level + (i + 2) % 3] - p;
    const Vec3 along = corners[3 + i] - corners[i];
    const double lengths = next.norm() * before.norm() * along.norm();
    if (!(lengths > 0) || !(lengths <= std::numeric_limits<double>::max())) return 0;
    return 2 * std::numbers::inv_sqrt3 * determinant(next, before, along) / lengths;
}

} // namespace

WedgeValues evaluate_wedge(std::span<const Vec3, 6> corners)
{
    WedgeValues values;
    values.scaled = 1;
    for (const std::size_t level : {0, 3})
        for (std::size_t i = 0; i < 3; ++i)
            values.scaled = std::min(values.scaled, scaled_at(corners, level, i));
    const Vec3 a0 = corners[1] - corners[0], b0 = corners[2] - corners[0];
    const Vec3 a1 = corners[4] - corners[3], b1 = corners[5] - corners[3];
    values.smallest = kInfinity;
    double sum = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const Vec3 along = corners[3 + i] - corners[i];
        values.coefficients[i] = {determinant(a0, b0, along),
                                  (determinant(a0, b1, along) + determinant(a1, b0, along)) / 2,
                                  determinant(a1, b1, along)};
        for (const double value : values.coefficients[i]) {
            sum += value;
            values.smallest = value < values.smallest ? value : values.smallest;
        }
    }
    if (!std::isfinite(sum)) values.smallest = values.scaled = 0;
    // Each coefficient has the same integral: 1/3 along the height times 1/2 · 1/3 over the triangle.
    values.volume = sum / 18;
    return values;
}

Coefficients over_cube(const WedgeValues& values)
{
    Coefficients cube{};
    for (std::size_t c = 0; c < 3; ++c) {
        const std::array<double, 4> corner{values.coefficients[0][c], values.coefficients[1][c],
                                           values.coefficients[2][c], values.coefficients[2][c]};
        for (std::size_t b = 0; b < 3; ++b) {
            const double v = 0.5 * static_cast<double>(b);
            for (std::size_t a = 0; a < 3; ++a) {
                const double u = 0.5 * static_cast<double>(a);
                cube[a + 3 * b + 9 * c] = (1 - v) * ((1 - u) * corner[0] + u * corner[1]) +
                                          v * ((1 - u) * corner[3] + u * corner[2]);
            }
        }
    }
    return cube;
}

double wedge_scaled_jacobian(std::span<const Vec3, 6> corners) { return evaluate_wedge(corners).scaled; }

bool wedge_certified_positive(std::span<const Vec3, 6> corners, int max_depth)
{
    const WedgeValues values = evaluate_wedge(corners);
    return values.smallest > 0 || positive_everywhere(view_of(over_cube(values)), max_depth);
}

} // namespace lacuna::quality
