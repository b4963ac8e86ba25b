// SPDX-License-Identifier: MIT
#include <lacuna/core/shared/constants.h>
#include <lacuna/core/shared/criteria.h>
#include <lacuna/quads/detail/central_block.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace lacuna::quads {
namespace {

/// The sides of the block bulge outward: angle between a straight side and the first or last edge of the
/// bulging side. The block's corners are then 132°. Each of the two quads outside a corner has 114° there,
/// close to the 120° of three equal quads. A larger angle flattens the block's own corners.
constexpr double kBulge = 21 * kDegree;
/// Distances from the centre to the block's corners and to the middles of its sides, as shares of the
/// distance to the boundary. With a share of 0.5, quads outside the block are about as large as quads inside.
constexpr double kCornerReach = 0.5, kSideReach = 0.5;

/// Smallest distance from the centre to a boundary node whose direction differs by less than 22.5° from
/// `angle` or from `angle` turned by 90°, 180° or 270°.
double free_way(const PlanarRegion& region, const Vec2& centre, double angle)
{
    double least = kInfinity;
    for (const Vec2& p : region.points) {
        const Vec2 d = p - centre;
        if (std::abs(std::remainder(std::atan2(d.y(), d.x()) - angle, kRightAngle)) < kRightAngle / 4)
            least = std::min(least, d.norm());
    }
    return least;
}

/// The angle of one of four mirror axes that are 45° apart; empty if there are no such axes.
std::optional<double> eighths(const std::vector<Symmetry>& symmetries)
{
    for (const Symmetry& first : symmetries) {
        if (!first.map.mirrors) continue;
        const double angle = first.map.angle() / 2;
        int found = 0;
        for (const Symmetry& other : symmetries) {
            if (other.map.mirrors &&
                std::abs(std::remainder(other.map.angle() / 2 - angle, kRightAngle / 2)) < kFileAccuracy)
                ++found;
        }
        if (found == 4) return angle;
    }
    return std::nullopt;
}

} // namespace

std::optional<CentralBlock> central_block(const PlanarRegion& region, const std::vector<Symmetry>& symmetries,
                                          const SizeField& size, int choice)
{
    const std::optional<double> axis = eighths(symmetries);
    if (!axis) return std::nullopt;
    const Vec2 centre = symmetries.front().map.centre;
    std::array<double, 2> free{free_way(region, centre, *axis),
                               free_way(region, centre, *axis + kRightAngle / 2)};
    double angle = *axis;
    if ((free[1] > free[0]) != (choice == 1)) {
        angle += kRightAngle / 2;
        std::swap(free[0], free[1]);
    }
    // Distance of the middle of a side from the centre, if the distance of the corners is 1.
    const double half = std::numbers::sqrt2 / 2, middle = half * (1 + std::tan(kBulge / 2));
    const double reach = std::min(kCornerReach * free[0], kSideReach * free[1] / middle);
    if (!(reach > 0) || !std::isfinite(reach)) return std::nullopt;
    const double arc = 2 * half * reach * kBulge / std::sin(kBulge);
    const int sides = 2 * std::max(1, static_cast<int>(std::lround(arc / size(centre) / 2)));

    CentralBlock block{region, {}, {}};
    const auto first = static_cast<Index>(region.points.size());
    // Each side of the block follows an arc that bulges outward; each edge is a chord of this arc. The centre
    // of the arc lies beyond the block's centre, seen from the side.
    const double bulge = kBulge * sides / (sides - 1);
    const double radius = half * reach / std::sin(bulge);
    std::vector<Vec2> rim; // counter-clockwise
    for (int k = 0; k < 4; ++k) {
        const double out = angle + (k + 0.5) * kRightAngle;
        const Vec2 along(std::cos(out), std::sin(out));
        const Vec2 about = centre + (half * reach - radius * std::cos(bulge)) * along;
        for (int i = 0; i < sides; ++i) {
            const double turn = out + bulge * (2.0 * i / sides - 1);
            rim.push_back(about + radius * Vec2(std::cos(turn), std::sin(turn)));
        }
    }
    // A hole runs clockwise, so its nodes have the numbers of the rim in reverse order.
    std::vector<Index> hole;
    for (std::size_t i = 0; i < rim.size(); ++i) {
        block.around.points.push_back(rim[i]);
        hole.push_back(first + static_cast<Index>((rim.size() - i) % rim.size()));
    }
    block.around.loops.push_back(std::move(hole));

    const auto at = [&](int x, int y) { // position along the block's rim; -1: inside
        if (y == 0) return x;
        if (x == sides) return sides + y;
        if (y == sides) return 3 * sides - x;
        return x == 0 ? 4 * sides - y : -1;
    };
    std::vector<Index> node(index((sides + 1) * (sides + 1)));
    const auto slot = [&](int x, int y) { return index(y * (sides + 1) + x); };
    const auto rim_at = [&](int x, int y) -> const Vec2& { return rim[index(at(x, y))]; };
    for (int y = 0; y <= sides; ++y) {
        for (int x = 0; x <= sides; ++x) {
            if (at(x, y) >= 0) {
                node[slot(x, y)] = first + static_cast<Index>(at(x, y));
                continue;
            }
            const double u = static_cast<double>(x) / sides, v = static_cast<double>(y) / sides;
            const Vec2 between = (1 - v) * rim_at(x, 0) + v * rim_at(x, sides) + (1 - u) * rim_at(0, y) +
                                 u * rim_at(sides, y);
            const Vec2 corners = (1 - u) * ((1 - v) * rim_at(0, 0) + v * rim_at(0, sides)) +
                                 u * ((1 - v) * rim_at(sides, 0) + v * rim_at(sides, sides));
            node[slot(x, y)] = first + static_cast<Index>(rim.size() + block.inner.size());
            block.inner.push_back(between - corners);
        }
    }
    for (int y = 0; y < sides; ++y) {
        for (int x = 0; x < sides; ++x)
            block.quads.push_back(
                {node[slot(x, y)], node[slot(x + 1, y)], node[slot(x + 1, y + 1)], node[slot(x, y + 1)]});
    }
    return block;
}

PlanarQuads with_block(const CentralBlock& block, PlanarQuads around)
{
    const std::size_t own = block.around.points.size();
    const auto more = static_cast<Index>(around.points.size() - own);
    const auto inner = static_cast<Index>(own);
    around.points.insert(around.points.end(), block.inner.begin(), block.inner.end());
    for (Quad quad : block.quads) {
        for (Index& p : quad) p += p >= inner ? more : 0;
        around.quads.push_back(quad);
    }
    return around;
}

} // namespace lacuna::quads
