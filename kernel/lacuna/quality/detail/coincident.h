// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/core/shared/criteria.h>
#include <lacuna/core/types.h>

#include <Eigen/Geometry>

#include <array>
#include <cstdint>
#include <optional>
#include <span>

/// Search for coincident nodes. Internal to this folder.
namespace lacuna::quality {

/// Bounding box of the points; empty if a point is not finite. Parallel.
Eigen::AlignedBox3d finite_bounds(std::span<const Vec3> points, const RunContext& context);

/// Points closer than this coincide: `kSamePlace` × the diagonal.
inline double coincidence_tolerance(const Eigen::AlignedBox3d& bounds)
{
    return kSamePlace * bounds.diagonal().norm();
}

/// A grid of cubes whose edges are 1024 tolerances long. A point within a tolerance of a cube's side is also
/// entered in the neighbouring cube, so two points within a tolerance of each other share a cube. The grid is
/// shifted against the bounds of the points by a fraction of a cube: meshes often have whole planes of nodes
/// exactly on their bounds, and these nodes would otherwise lie on sides of cubes.
struct CoincidenceGrid {
    Vec3 corner;
    double tolerance;
    double per_length;

    CoincidenceGrid(const Eigen::AlignedBox3d& bounds, double within) : tolerance(within)
    {
        const double size = 1024 * tolerance;
        per_length = 1 / size;
        corner = bounds.min() - size * Vec3(0.381966, 0.618034, 0.271828);
    }

    static std::uint32_t hash(std::int64_t x, std::int64_t y, std::int64_t z)
    {
        auto h = static_cast<std::uint64_t>(x) * 0x9E3779B97F4A7C15u + static_cast<std::uint64_t>(y);
        h = (h ^ (h >> 29)) * 0xBF58476D1CE4E5B9u + static_cast<std::uint64_t>(z);
        h = (h ^ (h >> 32)) * 0x94D049BB133111EBu;
        return static_cast<std::uint32_t>(h >> 32);
    }

    /// Call `enter` with the hash of every cube that contains the point or is within a tolerance of it.
    template <class Enter>
    void visit(const Vec3& point, const Enter& enter) const
    {
        const Vec3 at = (point - corner) * per_length;
        const double near = tolerance * per_length;
        std::int64_t low[3], high[3];
        for (int d = 0; d < 3; ++d) {
            low[d] = static_cast<std::int64_t>(at[d] - near);
            high[d] = static_cast<std::int64_t>(at[d] + near);
        }
        enter(hash(low[0], low[1], low[2]));
        if (low[0] == high[0] && low[1] == high[1] && low[2] == high[2]) return;
        for (int corner_of = 1; corner_of < 8; ++corner_of) {
            std::int64_t c[3];
            bool other = true;
            for (int d = 0; d < 3; ++d) {
                const bool up = (corner_of >> d & 1) != 0;
                c[d] = up ? high[d] : low[d];
                if (up && low[d] == high[d]) other = false;
            }
            if (other) enter(hash(c[0], c[1], c[2]));
        }
    }
};

/// Find two points within `tolerance` of each other; the same pair for any number of threads. O(points).
/// @param level  number of points in each of consecutive levels; 0: no levels. Levels that can be separated
///               along a line are searched one by one, in less than half the time.
/// @pre  `bounds` contains every point.
std::optional<std::array<Index, 2>> find_coincident(std::span<const Vec3> points, std::size_t level,
                                                    double tolerance, const Eigen::AlignedBox3d& bounds,
                                                    const RunContext& context);

} // namespace lacuna::quality
