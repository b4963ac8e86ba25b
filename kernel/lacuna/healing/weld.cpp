// SPDX-License-Identifier: MIT
#include <lacuna/healing/shared/weld.h>

#include <lacuna/core/shared/constants.h>

#include <bit>
#include <cmath>
#include <cstdint>

namespace lacuna::healing {
namespace {

using GridCell = std::array<std::int64_t, 3>;

std::uint64_t mix(std::uint64_t h)
{
    h ^= h >> 33;
    h *= 0xff51afd7ed558ccdULL;
    h ^= h >> 33;
    h *= 0xc4ceb9fe1a85ec53ULL;
    return h ^ (h >> 33);
}

std::uint64_t hash_of(const GridCell& cell)
{
    std::uint64_t h = 0;
    for (const std::int64_t c : cell) h = mix(h + 0x9e3779b97f4a7c15ULL + static_cast<std::uint64_t>(c));
    return h;
}

/// Hash table of points by grid cell, with chaining.
class CellTable {
public:
    /// @param points  number of points.
    /// @param cells  expected number of occupied cells
    CellTable(std::size_t points, std::size_t cells)
        : first_(std::bit_ceil(cells + cells / 2 + 1), -1), next_(points, -1)
    {
    }

    void add(const GridCell& cell, Index point)
    {
        Index& head = first_[slot(cell)];
        next_[static_cast<std::size_t>(point)] = head;
        head = point;
    }
    template <class Visit>
    void each_near(const GridCell& cell, const Visit& visit) const
    {
        for (Index p = first_[slot(cell)]; p >= 0; p = next_[static_cast<std::size_t>(p)]) visit(p);
    }

private:
    [[nodiscard]] std::size_t slot(const GridCell& cell) const { return hash_of(cell) & (first_.size() - 1); }

    std::vector<Index> first_, next_;
};

/// Merge equal points. This is done first, because it is cheaper than the search for near points, and an STL
/// file repeats each point about six times.
std::vector<Index> weld_equal(std::span<const Vec3> points)
{
    std::vector<Index> result(points.size());
    CellTable table(points.size(), points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
        GridCell bits;
        for (std::size_t k = 0; k < 3; ++k) {
            bits[k] = std::bit_cast<std::int64_t>(points[i][static_cast<Eigen::Index>(k)] + 0.0); // −0 hashes
                                                                                                  // like 0
        }
        Index same = -1;
        table.each_near(bits, [&](Index p) {
            if (points[static_cast<std::size_t>(p)] == points[i]) same = p;
        });
        if (same < 0) table.add(bits, static_cast<Index>(i));
        result[i] = same < 0 ? static_cast<Index>(i) : same;
    }
    return result;
}

/// Width of a cell, in tolerances. For most points, only their own cell is then searched, and few points
/// share a cell. The value only affects run time.
constexpr double kCellWidth = 32;

} // namespace

std::vector<Index> weld(std::span<const Vec3> points, double tolerance, const RunContext& context)
{
    std::vector<Index> result = weld_equal(points);
    if (!(tolerance > 0) || points.empty()) return result;
    Eigen::AlignedBox3d box;
    for (const Vec3& p : points) box.extend(p);
    // Cells are wider if the tolerance is below the resolution of the coordinates; cell numbers would
    // overflow otherwise.
    const double width = std::max(kCellWidth * tolerance, box.sizes().maxCoeff() * std::ldexp(1.0, -52));
    const auto cell_at = [&](const Vec3& p) {
        const Eigen::Array3d cell = ((p - box.min()) / width).array().floor();
        return GridCell{static_cast<std::int64_t>(cell.x()), static_cast<std::int64_t>(cell.y()),
                        static_cast<std::int64_t>(cell.z())};
    };
    std::size_t different = 0;
    for (std::size_t i = 0; i < points.size(); ++i) different += result[i] == static_cast<Index>(i) ? 1 : 0;
    CellTable table(points.size(), different);
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (i % kBetweenPolls == 0) check_cancelled(context);
        if (result[i] != static_cast<Index>(i)) continue;
        const GridCell least = cell_at(points[i].array() - tolerance);
        const GridCell most = cell_at(points[i].array() + tolerance);
        Index best = -1;
        double best_distance = tolerance * tolerance;
        const auto consider = [&](Index p) {
            const double distance = (points[static_cast<std::size_t>(p)] - points[i]).squaredNorm();
            if (distance > best_distance || (distance == best_distance && best >= 0 && p > best)) return;
            best = p;
            best_distance = distance;
        };
        for (std::int64_t x = least[0]; x <= most[0]; ++x) {
            for (std::int64_t y = least[1]; y <= most[1]; ++y) {
                for (std::int64_t z = least[2]; z <= most[2]; ++z) table.each_near({x, y, z}, consider);
            }
        }
        if (best >= 0) {
            result[i] = best;
            continue;
        }
        table.add(cell_at(points[i]), static_cast<Index>(i));
    }
    for (Index& p : result) p = result[static_cast<std::size_t>(p)];
    return result;
}

} // namespace lacuna::healing
