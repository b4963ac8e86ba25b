// SPDX-License-Identifier: MIT
#include <lacuna/quads/detail/pave_size.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <utility>

namespace lacuna::quads::paving {
namespace {

struct BoundarySide {
    Vec2 middle;
    double length;
};

std::vector<BoundarySide> sides_of(const PlanarRegion& region)
{
    std::vector<BoundarySide> sides;
    for (const auto& loop : region.loops) {
        for (std::size_t i = 0; i < loop.size(); ++i) {
            const Vec2& a = region.points[static_cast<std::size_t>(loop[i])];
            const Vec2& b = region.points[static_cast<std::size_t>(loop[(i + 1) % loop.size()])];
            sides.push_back({(a + b) / 2, (b - a).norm()});
        }
    }
    return sides;
}

/// Bounds on the size, on a grid over the region, spread from the boundary sides.
class SizeBounds {
public:
    SizeBounds(const std::vector<BoundarySide>& sides, double grading)
    {
        Vec2 high = sides.front().middle;
        low_ = high;
        for (const BoundarySide& side : sides) {
            low_ = low_.cwiseMin(side.middle);
            high = high.cwiseMax(side.middle);
        }
        // Cells of half the shortest side, and no more than so many along the longer side of the box, for the
        // time. Choices, not measurements.
        constexpr double kAcross = 128, kOfSide = 0.5;
        const double shortest =
            std::min_element(sides.begin(), sides.end(), [](const auto& a, const auto& b) {
                return a.length < b.length;
            })->length;
        cell_ = std::max(
            {(high - low_).maxCoeff() / kAcross, kOfSide * shortest, std::numeric_limits<double>::min()});
        low_ -= Vec2::Constant(cell_);
        nx_ = static_cast<int>((high.x() - low_.x()) / cell_) + 2;
        ny_ = static_cast<int>((high.y() - low_.y()) / cell_) + 2;
        const auto cells = static_cast<std::size_t>(nx_ * ny_);
        most_.assign(cells, std::numeric_limits<double>::infinity());
        least_.assign(cells, 0);
        for (const BoundarySide& side : sides) {
            const std::size_t c = cell_of(side.middle);
            most_[c] = std::min(most_[c], side.length);
            least_[c] = std::max(least_[c], side.length);
        }
        // Two rounds of two sweeps spread the bounds everywhere but around sharp bends.
        for (int round = 0; round < 2; ++round) {
            for (int y = 0; y < ny_; ++y)
                for (int x = 0; x < nx_; ++x) relax(x, y, -1, grading);
            for (int y = ny_ - 1; y >= 0; --y)
                for (int x = nx_ - 1; x >= 0; --x) relax(x, y, 1, grading);
        }
    }

    /// The size asked for, within the bounds at the four cells around; where they disagree the upper one
    /// holds.
    [[nodiscard]] double limit(const Vec2& p, double asked) const
    {
        const double x = std::clamp((p.x() - low_.x()) / cell_ - 0.5, 0.0, nx_ - 1.001);
        const double y = std::clamp((p.y() - low_.y()) / cell_ - 0.5, 0.0, ny_ - 1.001);
        const int i = static_cast<int>(x), j = static_cast<int>(y);
        const double u = x - i, v = y - j;
        const auto mix = [&](const std::vector<double>& f) {
            const std::size_t c = static_cast<std::size_t>(j * nx_ + i),
                              d = c + static_cast<std::size_t>(nx_);
            return (1 - v) * ((1 - u) * f[c] + u * f[c + 1]) + v * ((1 - u) * f[d] + u * f[d + 1]);
        };
        return std::min(std::max(asked, mix(least_)), mix(most_));
    }

private:
    [[nodiscard]] std::size_t cell_of(const Vec2& p) const
    {
        const int x = static_cast<int>((p.x() - low_.x()) / cell_),
                  y = static_cast<int>((p.y() - low_.y()) / cell_);
        return static_cast<std::size_t>(y * nx_ + x);
    }

    void relax(int x, int y, int back, double grading)
    {
        const std::size_t c = static_cast<std::size_t>(y * nx_ + x);
        for (const auto& [dx, dy] : {std::pair{back, 0}, {0, back}, {back, back}, {-back, back}}) {
            const int i = x + dx, j = y + dy;
            if (i < 0 || j < 0 || i >= nx_ || j >= ny_) continue;
            const std::size_t n = static_cast<std::size_t>(j * nx_ + i);
            const double rise = grading * cell_ * (dx != 0 && dy != 0 ? std::numbers::sqrt2 : 1.0);
            most_[c] = std::min(most_[c], most_[n] + rise);
            least_[c] = std::max(least_[c], least_[n] - rise);
        }
    }

    Vec2 low_;
    double cell_ = 1;
    int nx_ = 0, ny_ = 0;
    std::vector<double> most_, least_;
};

} // namespace

std::function<double(const Vec2&)> size_with_boundary(const PlanarRegion& region, double grading,
                                                      double alike)
{
    const std::vector<BoundarySide> sides = sides_of(region);
    double sum = 0;
    for (const BoundarySide& side : sides) sum += side.length;
    std::function<double(const Vec2&)> asked = region.size;
    if (!asked) asked = [mean = sum / static_cast<double>(sides.size())](const Vec2&) { return mean; };
    const bool all_alike = std::all_of(sides.begin(), sides.end(), [&](const BoundarySide& side) {
        const double size = asked(side.middle);
        return side.length < alike * size && size < alike * side.length;
    });
    if (all_alike) return asked;
    return [asked, bounds = std::make_shared<const SizeBounds>(sides, grading)](const Vec2& p) {
        return bounds->limit(p, asked(p));
    };
}

} // namespace lacuna::quads::paving
