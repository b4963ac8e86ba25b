// SPDX-License-Identifier: MIT
#include <lacuna/surface/detail/surface_curve.h>

#include <algorithm>
#include <cmath>

namespace lacuna::surface {

void SurfaceCurve::evaluate(std::span<const double> params, std::span<Vec3> points,
                            const RunContext& context) const
{
    std::vector<Vec2> uv;
    for (std::size_t i = 0; i < params.size(); ++i) {
        const double last = static_cast<double>(points_.size()) - 2;
        const double whole = std::clamp(std::floor(params[i]), 0.0, last);
        const auto k = static_cast<std::size_t>(whole);
        const double f = params[i] - whole;
        points[i] = (1 - f) * points_[k] + f * points_[k + 1];
        uv.emplace_back((1 - f) * uv_[k] + f * uv_[k + 1]);
    }
    surface_->project(points, uv, context);
}

} // namespace lacuna::surface
