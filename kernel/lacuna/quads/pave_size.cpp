// SPDX-License-Identifier: MIT
#include <lacuna/quads/detail/pave_size.h>

#include <lacuna/core/shared/criteria.h>
#include <lacuna/quads/detail/counted_loop.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>

namespace lacuna::quads::paving {
namespace {

struct BoundarySide {
    Vec2 middle;
    double length;
};

std::vector<BoundarySide> sides_of(const PlanarRegion& region)
{
    std::vector<BoundarySide> sides;
    for_boundary_sides(region, [&](const Vec2& a, const Vec2& b) {
        sides.push_back({(a + b) / 2, (b - a).norm()});
    });
    return sides;
}

/// Lower and upper bounds of the size. They are stored on a grid over the region and propagated from the
/// boundary sides.
class SizeBounds {
public:
    explicit SizeBounds(const std::vector<BoundarySide>& sides)
    {
        Eigen::AlignedBox2d box;
        for (const BoundarySide& side : sides) box.extend(side.middle);
        low_ = box.min();
        const Vec2 high = box.max();
        // The cell width is half the shortest side, but there are at most kAcross cells along the longer side
        // of the box. Finer cells follow the boundary better but take more time.
        constexpr double kAcross = 128, kOfSide = 0.5;
        const double shortest = std::ranges::min_element(sides, [](const auto& a, const auto& b) {
                                    return a.length < b.length;
                                })->length;
        cell_ = std::max(
            {(high - low_).maxCoeff() / kAcross, kOfSide * shortest, std::numeric_limits<double>::min()});
        low_ -= Vec2::Constant(cell_);
        // The grid has a margin of cells without bounds.
        nx_ = static_cast<int>((high.x() - low_.x()) / cell_) + 4;
        ny_ = static_cast<int>((high.y() - low_.y()) / cell_) + 4;
        low_ -= Vec2::Constant(cell_);
        most_.assign(static_cast<std::size_t>(nx_ * ny_), kInfinity);
        least_.assign(most_.size(), 0);
        for (const BoundarySide& side : sides) {
            const std::size_t cell = cell_of(side.middle);
            most_[cell] = std::min(most_[cell], side.length);
            least_[cell] = std::max(least_[cell], side.length);
        }
        // Two rounds of two sweeps each propagate the bounds everywhere, except around sharp bends.
        const double rise = kGrading * cell_;
        for (int round = 0; round < 2; ++round) {
            for (int y = 1; y + 1 < ny_; ++y) relax(y, -1, rise);
            for (int y = ny_ - 2; y > 0; --y) relax(y, 1, rise);
        }
    }

    /// The requested size, limited by the bounds of the four nearest cells. If the bounds contradict each
    /// other, the upper bound applies.
    [[nodiscard]] double limit(const Vec2& p, double asked) const
    {
        const double x = std::clamp((p.x() - low_.x()) / cell_ - 0.5, 1.0, nx_ - 2.001);
        const double y = std::clamp((p.y() - low_.y()) / cell_ - 0.5, 1.0, ny_ - 2.001);
        const int i = static_cast<int>(x), j = static_cast<int>(y);
        const double u = x - i, v = y - j;
        const auto mix = [&](const std::vector<double>& bound) {
            const double* at = bound.data() + j * nx_ + i;
            return (1 - v) * ((1 - u) * at[0] + u * at[1]) + v * ((1 - u) * at[nx_] + u * at[nx_ + 1]);
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

    /// Make the bounds of a row's cells consistent with those of their neighbours: first with the previous
    /// row, by vector instructions, and then along the row.
    /// @param back  -1: the previous row is below; 1: it is above. The rows are visited from that side
    void relax(int row, int back, double rise)
    {
        const double far = rise * std::numbers::sqrt2;
        const std::ptrdiff_t start = static_cast<std::ptrdiff_t>(row) * nx_, inner = nx_ - 2;
        double *most = most_.data() + start + 1, *least = least_.data() + start + 1;
        const double *high = most + back * nx_, *low = least + back * nx_;
        for (std::ptrdiff_t x = 0; x < inner; ++x) {
            most[x] = std::min({most[x], high[x] + rise, std::min(high[x - 1], high[x + 1]) + far});
            least[x] = std::max({least[x], low[x] - rise, std::max(low[x - 1], low[x + 1]) - far});
        }
        for (std::ptrdiff_t k = 0; k < inner; ++k) {
            const std::ptrdiff_t x = back < 0 ? k : inner - 1 - k;
            most[x] = std::min(most[x], most[x + back] + rise);
            least[x] = std::max(least[x], least[x + back] - rise);
        }
    }

    Vec2 low_;
    double cell_ = 1;
    int nx_ = 0, ny_ = 0;
    std::vector<double> most_, least_; ///< bounds of the size in each cell
};

} // namespace

BoundarySizes sizes_with_boundary(const PlanarRegion& region)
{
    const std::vector<BoundarySide> sides = sides_of(region);
    double sum = 0;
    for (const BoundarySide& side : sides) sum += side.length;
    SizeField asked = region.size;
    if (!asked) asked = [mean = sum / static_cast<double>(sides.size())](const Vec2&) { return mean; };
    // Whether the length of every side differs from the requested one by less than this factor.
    const auto are_alike = [&](double most) {
        return std::ranges::all_of(sides, [&](const BoundarySide& side) {
            const double size = asked(side.middle);
            return side.length < most * size && size < most * side.length;
        });
    };
    if (are_alike(kLongestOfSize)) return {asked, asked};
    const SizeField limited = [asked, bounds = std::make_shared<const SizeBounds>(sides)](const Vec2& p) {
        return bounds->limit(p, asked(p));
    };
    return {limited, are_alike(kRingSegment.most) ? asked : limited};
}

double quads_within(const PlanarRegion& region)
{
    double area = 0, length = 0, sides = 0;
    for_boundary_sides(region, [&](const Vec2& a, const Vec2& b) {
        area += cross(a, b) / 2;
        length += (b - a).norm();
        ++sides;
    });
    return area * sides * sides / (length * length);
}

bool has_quads_asked(const PlanarQuads& mesh, const SizeField& size)
{
    double asked = 0;
    for (const Quad& quad : mesh.quads) {
        const auto at = [&](std::size_t k) -> const Vec2& { return mesh.points[index(quad[k])]; };
        const double length = size((at(0) + at(1) + at(2) + at(3)) / 4);
        asked += cross(at(2) - at(0), at(3) - at(1)) / 2 / (length * length);
    }
    return std::abs(static_cast<double>(mesh.quads.size()) - asked) <= kQuadsOff * asked;
}

} // namespace lacuna::quads::paving
