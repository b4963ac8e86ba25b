// SPDX-License-Identifier: MIT
#include <lacuna/quads/detail/pave_size.h>

#include <lacuna/quads/detail/corner_sine.h>

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
        // With a rim of cells that bound nothing.
        nx_ = static_cast<int>((high.x() - low_.x()) / cell_) + 4;
        ny_ = static_cast<int>((high.y() - low_.y()) / cell_) + 4;
        low_ -= Vec2::Constant(cell_);
        bound_.assign(static_cast<std::size_t>(nx_ * ny_), {});
        for (const BoundarySide& side : sides) {
            Bounds& own = bound_[cell_of(side.middle)];
            own.most = std::min(own.most, side.length);
            own.least = std::max(own.least, side.length);
        }
        // Two rounds of two sweeps spread the bounds everywhere but around sharp bends.
        const double rise = grading * cell_;
        const auto row = static_cast<std::ptrdiff_t>(nx_);
        for (int round = 0; round < 2; ++round) {
            for (int y = 1; y + 1 < ny_; ++y)
                for (int x = 1; x + 1 < nx_; ++x) relax(y * row + x, -1, row, rise);
            for (int y = ny_ - 2; y > 0; --y)
                for (int x = nx_ - 2; x > 0; --x) relax(y * row + x, 1, row, rise);
        }
    }

    /// The size asked for, within the bounds at the four cells around; where they disagree the upper one
    /// holds.
    [[nodiscard]] double limit(const Vec2& p, double asked) const
    {
        const double x = std::clamp((p.x() - low_.x()) / cell_ - 0.5, 1.0, nx_ - 2.001);
        const double y = std::clamp((p.y() - low_.y()) / cell_ - 0.5, 1.0, ny_ - 2.001);
        const int i = static_cast<int>(x), j = static_cast<int>(y);
        const double u = x - i, v = y - j;
        const Bounds* at = bound_.data() + j * nx_ + i;
        const auto mix = [&](double Bounds::*f) {
            return (1 - v) * ((1 - u) * at[0].*f + u * at[1].*f) +
                   v * ((1 - u) * at[nx_].*f + u * at[nx_ + 1].*f);
        };
        return std::min(std::max(asked, mix(&Bounds::least)), mix(&Bounds::most));
    }

private:
    [[nodiscard]] std::size_t cell_of(const Vec2& p) const
    {
        const int x = static_cast<int>((p.x() - low_.x()) / cell_),
                  y = static_cast<int>((p.y() - low_.y()) / cell_);
        return static_cast<std::size_t>(y * nx_ + x);
    }

    /// Bring the bounds of a cell and of four of its neighbours together.
    /// @param back  -1 or 1: the neighbours before the cell, or after it
    void relax(std::ptrdiff_t cell, int back, std::ptrdiff_t row, double rise)
    {
        const double far = rise * std::numbers::sqrt2;
        const Bounds* at = bound_.data() + cell;
        const Bounds &a = at[back], &b = at[back * row], &c = at[back * (row + 1)], &d = at[back * (row - 1)];
        Bounds& own = bound_[static_cast<std::size_t>(cell)];
        own.most = std::min({own.most, std::min(a.most, b.most) + rise, std::min(c.most, d.most) + far});
        own.least = std::max(
            {own.least, std::max(a.least, b.least) - rise, std::max(c.least, d.least) - far});
    }

    struct Bounds {
        double most = std::numeric_limits<double>::infinity(), least = 0;
    };

    Vec2 low_;
    double cell_ = 1;
    int nx_ = 0, ny_ = 0;
    std::vector<Bounds> bound_; ///< of each cell
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

double quads_within(const PlanarRegion& region)
{
    double area = 0, length = 0, sides = 0;
    for (const auto& loop : region.loops) {
        for (std::size_t i = 0; i < loop.size(); ++i) {
            const Vec2 &a = region.points[index(loop[i])],
                       &b = region.points[index(loop[(i + 1) % loop.size()])];
            area += cross(a, b) / 2;
            length += (b - a).norm();
            ++sides;
        }
    }
    return area * sides * sides / (length * length);
}

bool has_quads_asked(const PlanarQuads& mesh, const std::function<double(const Vec2&)>& size)
{
    constexpr double kOff = 0.25;
    double asked = 0;
    for (const Quad& quad : mesh.quads) {
        const auto at = [&](std::size_t k) -> const Vec2& {
            return mesh.points[static_cast<std::size_t>(quad[k])];
        };
        const double length = size((at(0) + at(1) + at(2) + at(3)) / 4);
        asked += cross(at(2) - at(0), at(3) - at(1)) / 2 / (length * length);
    }
    return std::abs(static_cast<double>(mesh.quads.size()) - asked) <= kOff * asked;
}

} // namespace lacuna::quads::paving
