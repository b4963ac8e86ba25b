// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/types.h>
#include <lacuna/surface/shared/seeds.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

/// A line of the source and its images in several sections of the volume. Internal to this folder.
namespace lacuna::surface {

/// Number of sections of a line, evenly spaced from source to target. Heuristic.
inline constexpr std::size_t kSections = 5;
inline constexpr std::size_t kSource = 0;
/// Relative height of a section: 0 at the source, 1 at the target.
inline double height_of(std::size_t section)
{
    return static_cast<double>(section) / static_cast<double>(kSections - 1);
}

/// A piece of an edge as a curve in several sections. The parameter u of the curve counts mesh sides, from 0
/// at the start of the piece.
struct SectionLine {
    SeedPiece* piece = nullptr;
    /// For each section, points that divide each side of the piece evenly. Empty for sections whose points
    /// are not known; those of the source are always known.
    std::array<std::vector<Vec3>, kSections> points;
    std::vector<double> at;            ///< u of each node on the source, ends included [sides]
    std::vector<double> above;         ///< u of each node on the target; empty: as on the source [sides]
    std::vector<std::size_t> variable; ///< for each node, the variable of its position `at`
    std::vector<std::size_t> variable_above; ///< for each node, the variable of its position `above`
    /// At each node, the length of a side divided by the length of the column. The difference between the
    /// node's positions on target and source [sides], times this, is the slope of the column. Set if `above`
    /// is set.
    std::vector<double> steep;
    bool on_rim = false;

    /// Position of a node's column in a section, interpolated linearly between source and target.
    [[nodiscard]] double column(std::size_t section, std::size_t node) const
    {
        if (section == kSource || above.empty()) return at[node];
        const double height = height_of(section);
        return (1 - height) * at[node] + height * above[node];
    }

    /// A point of a section, and its derivative by u.
    struct Spot {
        Vec3 at, slope;
    };
    [[nodiscard]] Spot spot(std::size_t section, double u) const
    {
        const std::vector<Vec3>& p = points[section];
        const auto last = static_cast<double>(p.size() - 1);
        const double per_side = last / piece->count;
        const double x = std::clamp(u * per_side, 0.0, last);
        const std::size_t i = std::min(static_cast<std::size_t>(x), p.size() - 2);
        const double f = x - static_cast<double>(i);
        const Vec3 before = i > 0 ? Vec3(p[i - 1]) : Vec3(2 * p[0] - p[1]);
        const Vec3 after = i + 2 < p.size() ? Vec3(p[i + 2]) : Vec3(2 * p[i + 1] - p[i]);
        // Cubic interpolation with the slopes of the adjacent chords.
        const Vec3 a = (p[i + 1] - before) / 2, b = (after - p[i]) / 2, c = p[i + 1] - p[i];
        return {p[i] + f * (a + f * ((3 * c - 2 * a - b) + f * (a + b - 2 * c))),
                per_side * (a + f * (2 * (3 * c - 2 * a - b) + 3 * f * (a + b - 2 * c)))};
    }
    [[nodiscard]] Vec3 place(std::size_t section, double u) const { return spot(section, u).at; }
    /// Direction along the edge at u, and the derivative of this direction by u. The direction is taken from
    /// half a side before u to half a side after it.
    [[nodiscard]] Spot tangent(std::size_t section, double u) const
    {
        const Spot before = spot(section, u - 0.5), after = spot(section, u + 0.5);
        const Vec3 chord = after.at - before.at;
        const double length = chord.norm();
        if (length <= 0) return {Vec3::Zero(), Vec3::Zero()};
        const Vec3 along = chord / length, slope = (after.slope - before.slope) / length;
        return {along, slope - slope.dot(along) * along};
    }
    /// Evenly spaced positions of the nodes.
    [[nodiscard]] std::vector<double> even() const
    {
        std::vector<double> places(at.size());
        for (std::size_t i = 0; i < places.size(); ++i) places[i] = static_cast<double>(i);
        return places;
    }
    /// For evenly spaced nodes: the value of `steep` at each node.
    [[nodiscard]] std::vector<double> steepness() const
    {
        std::vector<double> steep_at;
        for (const double u : even()) {
            double side = 0, length = 0;
            for (std::size_t k = 0; k < kSections; ++k) {
                side += (place(k, u + 0.5) - place(k, u - 0.5)).norm() / kSections;
                if (k > 0) length += (place(k, u) - place(k - 1, u)).norm();
            }
            steep_at.push_back(length > 0 ? side / length : 0);
        }
        return steep_at;
    }
};

} // namespace lacuna::surface
