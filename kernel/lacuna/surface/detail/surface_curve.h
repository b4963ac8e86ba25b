// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/geometry/exact.h>

#include <memory>
#include <span>
#include <utility>
#include <vector>

/// Curves on exact surfaces. Internal to this folder.
namespace lacuna::surface {

/// A polyline on a face whose segments are projected onto the exact surface.
class SurfaceCurve : public geometry::ExactCurve {
public:
    SurfaceCurve(std::vector<Vec3> points, std::vector<Vec2> uv,
                 std::shared_ptr<const geometry::ExactSurface> surface)
        : points_(std::move(points)), uv_(std::move(uv)), surface_(std::move(surface))
    {
    }

    /// The parameter is the index of a point plus the position within the segment to the next point.
    void evaluate(std::span<const double> params, std::span<Vec3> points,
                  const RunContext& context) const override;

private:
    std::vector<Vec3> points_;
    std::vector<Vec2> uv_;
    std::shared_ptr<const geometry::ExactSurface> surface_;
};

} // namespace lacuna::surface
