// SPDX-License-Identifier: MIT
//
// The cost of a chain i … k, closed by the side k → i, is that of its best triangle (i, m, k) and of the two
// remaining chains, so chains are solved from short to long (Barequet and Sharir 1995, Liepa 2003). The bend
// at the sides i–m and m–k is measured against the best triangles of these chains.
#include <lacuna/geometry/detail/polygon_cover.h>

#include <lacuna/geometry/angle.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

namespace lacuna::geometry {
namespace {

// A triangle with a height below this part of its longest side is degenerate: its normal is undefined.
constexpr double kFlat = 1e-10;

struct Chain {
    CoverCost cost{std::numeric_limits<int>::max() / 4, 0};
    Vec3 normal = Vec3::Zero(); ///< normal of the triangle at the closing side
    std::size_t apex = 0;       ///< 0: no solution, or a side of the polygon
};

/// The selected corners, and the table of their pairs.
class ChainTable {
public:
    ChainTable(const CoverPolygon& polygon, const CoverOptions& options, std::span<const std::size_t> corners)
        : polygon_(polygon),
          options_(options),
          corners_(corners),
          count_(corners.size()),
          table_(count_ * count_)
    {
        for (std::size_t i = 0; i + 1 < count_; ++i) chain(i, i + 1).cost = {0, 0};
        for (std::size_t length = 2; length < count_; ++length) {
            for (std::size_t i = 0; i + length < count_; ++i) {
                if (length + 1 == count_ || may_join(i, i + length)) solve(i, i + length);
            }
        }
    }

    [[nodiscard]] bool solved() const { return at(0, count_ - 1).apex != 0; }
    [[nodiscard]] CoverCost cost() const { return at(0, count_ - 1).cost; }

    [[nodiscard]] std::vector<std::array<std::size_t, 3>> triangles() const
    {
        std::vector<std::array<std::size_t, 3>> result;
        std::vector<std::pair<std::size_t, std::size_t>> pending{{0, count_ - 1}};
        while (!pending.empty()) {
            const auto [i, k] = pending.back();
            pending.pop_back();
            if (k - i < 2) continue;
            const std::size_t m = at(i, k).apex;
            result.push_back({i, m, k});
            pending.emplace_back(m, k);
            pending.emplace_back(i, m);
        }
        return result;
    }

private:
    Chain& chain(std::size_t i, std::size_t k) { return table_[i * count_ + k]; }
    [[nodiscard]] const Chain& at(std::size_t i, std::size_t k) const { return table_[i * count_ + k]; }
    [[nodiscard]] const Vec3& place(std::size_t i) const { return polygon_.place[corners_[i]]; }
    [[nodiscard]] Index point(std::size_t i) const { return polygon_.point[corners_[i]]; }

    [[nodiscard]] bool may_join(std::size_t i, std::size_t k) const
    {
        return point(i) != point(k) && !polygon_.barred.contains(std::minmax(point(i), point(k)));
    }

    /// Cost of the bend at the closing side of a solved chain.
    [[nodiscard]] double turn_cost(const Chain& beyond, const Vec3& normal, double length2) const
    {
        if (beyond.apex == 0) return 0;
        return options_.bend * (1 - beyond.normal.dot(normal)) / 2 * length2;
    }

    void solve(std::size_t i, std::size_t k)
    {
        Chain& best = chain(i, k);
        const Vec3 base = place(k) - place(i);
        const double base2 = base.squaredNorm();
        for (std::size_t m = i + 1; m < k; ++m) {
            const Chain& left = at(i, m);
            const Chain& right = at(m, k);
            if ((m - i > 1 && left.apex == 0) || (k - m > 1 && right.apex == 0)) continue;
            if (point(m) == point(i) || point(m) == point(k)) continue;
            CoverCost cost = left.cost + right.cost;
            if (best.apex != 0 && best.cost < cost) continue; // costs only increase
            const Vec3 to = place(m) - place(i);
            const Vec3 cross = to.cross(base);
            const double to2 = to.squaredNorm();
            const double on2 = (base - to).squaredNorm();
            const double twice = cross.norm();
            if (!(twice > kFlat * std::max({base2, to2, on2}))) ++cost.degenerate;
            const Vec3 normal = twice > 0 ? Vec3(cross / twice) : Vec3(Vec3::Zero());
            const double area = twice / 2;
            cost.sum += area + options_.shape * ((base2 + to2 + on2) / (4 * std::numbers::sqrt3) - area) +
                        turn_cost(left, normal, to2) + turn_cost(right, normal, on2);
            if (best.apex != 0 && !(cost < best.cost)) continue;
            best = {cost, normal, m};
        }
    }

    const CoverPolygon& polygon_;
    const CoverOptions& options_;
    std::span<const std::size_t> corners_;
    std::size_t count_;
    std::vector<Chain> table_;
};

/// Select as many corners as can be solved exactly, evenly in arc length plus turning, so that sharp corners
/// of the loop are included.
std::vector<std::size_t> coarse_corners(const CoverPolygon& polygon, std::span<const std::size_t> corners,
                                        std::size_t wanted)
{
    const std::size_t count = corners.size();
    std::vector<double> length(count), turn(count);
    const auto place = [&](std::size_t i) { return polygon.place[corners[i % count]]; };
    for (std::size_t i = 0; i < count; ++i) {
        const Vec3 onward = place(i + 1) - place(i);
        const Vec3 before = place(i) - place(i + count - 1);
        length[i] = onward.norm();
        turn[i] = angle_between(before, onward);
    }
    const double all_length = std::accumulate(length.begin(), length.end(), 0.0);
    const double all_turn = std::max(std::accumulate(turn.begin(), turn.end(), 0.0), 1.0);
    std::vector<std::size_t> result;
    double measure = 0;
    for (std::size_t i = 0; i < count; ++i) {
        measure += turn[i] / all_turn;
        const auto due = static_cast<std::size_t>(measure / 2 * static_cast<double>(wanted)) + 1;
        if (result.size() < std::min(due, wanted)) result.push_back(i);
        measure += length[i] / std::max(all_length, std::numeric_limits<double>::min());
    }
    return result;
}

bool cover_part(const CoverPolygon& polygon, const CoverOptions& options,
                const std::vector<std::size_t>& corners, Cover& cover)
{
    const auto add = [&](std::size_t a, std::size_t b, std::size_t c) {
        cover.triangles.push_back({static_cast<Index>(a), static_cast<Index>(b), static_cast<Index>(c)});
    };
    if (corners.size() <= options.exact_limit) {
        const ChainTable table(polygon, options, corners);
        if (!table.solved()) return false;
        for (const auto& [i, m, k] : table.triangles()) add(corners[i], corners[m], corners[k]);
        cover.cost = cover.cost + table.cost();
        return true;
    }
    const std::vector<std::size_t> coarse = coarse_corners(polygon, corners, options.exact_limit);
    std::vector<std::size_t> coarse_corner;
    coarse_corner.reserve(coarse.size());
    for (const std::size_t i : coarse) coarse_corner.push_back(corners[i]);
    const ChainTable table(polygon, options, coarse_corner);
    if (!table.solved()) return false;
    for (const auto& triangle : table.triangles()) {
        // A side of a coarse triangle is a diagonal, or replaces the part of the polygon between its ends.
        std::vector<std::size_t> part;
        for (std::size_t side = 0; side < 3; ++side) {
            const std::size_t a = triangle[side];
            const std::size_t b = triangle[(side + 1) % 3];
            const bool stands = (a + 1) % coarse.size() == b;
            const std::size_t steps = stands ? (coarse[b] + corners.size() - coarse[a]) % corners.size() : 1;
            for (std::size_t s = 0; s < steps; ++s) part.push_back(corners[(coarse[a] + s) % corners.size()]);
        }
        if (!cover_part(polygon, options, part, cover)) return false;
    }
    return true;
}

} // namespace

Cover cover_polygon(const CoverPolygon& polygon, const CoverOptions& options)
{
    Cover cover;
    std::vector<std::size_t> corners(polygon.place.size());
    std::iota(corners.begin(), corners.end(), std::size_t{0});
    cover.found = cover_part(polygon, options, corners, cover);
    return cover;
}

} // namespace lacuna::geometry
