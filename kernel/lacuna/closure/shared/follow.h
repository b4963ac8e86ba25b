// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/types.h>
#include <lacuna/geometry/shared/affine.h>
#include <lacuna/matching/match.h>
#include <lacuna/matching/shared/guides.h>
#include <lacuna/topology/open_volume.h>

#include <cstddef>
#include <limits>
#include <unordered_map>
#include <vector>

namespace lacuna::closure {

/// The motion of a cross-section from the source to the target along the given walls. Void edges and faces
/// follow this motion.
///
/// The walls are cut at even heights. For each level, two affine maps are fitted, one from the section at the
/// source and one from the section at the target @cite roca_2010_sweep. The sweep places inner nodes of
/// layers in the same way.
class Follower {
public:
    /// @param lines  matching::side_lines() of the volume
    Follower(const topology::OpenVolume& volume, const std::vector<matching::SideLine>& lines,
             const RunContext& context = {});

    /// Whether some given wall joins source and target, so that there is a motion to follow.
    [[nodiscard]] bool leads() const { return !ways_.empty(); }

    /// Index of the motion that applies at a rim point of the source: that of the point's loop if the loop
    /// has a motion of its own, otherwise 0, the motion of all walls.
    [[nodiscard]] std::size_t walls_at(Index rim_point) const;
    /// Position at relative height t in [0, 1] of the point that moves from `source` to `target`. @pre
    /// leads()
    /// @param walls  index of the motion, see `walls_at()`; 0: the motion of all walls.
    [[nodiscard]] Vec3 morph(const Vec3& source, const Vec3& target, double t, std::size_t walls = 0) const;

    /// Unit directions of the walls' motion at a point of the source, and at a point of the target. @pre
    /// leads()
    [[nodiscard]] Vec3 leaving(const Vec3& source) const;
    [[nodiscard]] Vec3 arriving(const Vec3& target) const;

    /// The image of a source point on the target, by the affine map fitted from the source's section to the
    /// target's. @pre leads()
    [[nodiscard]] Vec3 carried(const Vec3& source) const { return ways_[0].from_source.back()(source); }

    /// Whether the given walls are so far from straight lines between the rims that void walls between
    /// straight edges would enclose a clearly different volume. @pre leads()
    [[nodiscard]] bool leads_astray() const;

    /// Distance of the walls from straight lines between the rims, as a share of the source rim's radius. For
    /// each point of the rim, the largest distance at any height counts; the result is the median of these.
    [[nodiscard]] double bow() const { return bow_; }

    /// Relative height in [0, 1] of a model point on a given wall; NaN for other points.
    [[nodiscard]] double height(Index point) const
    {
        const auto p = static_cast<std::size_t>(point);
        return p < heights_.size() ? heights_[p] : std::numeric_limits<double>::quiet_NaN();
    }

private:
    /// Affine maps, one per level.
    struct Way {
        std::vector<geometry::AffineFit> from_source, from_target;
    };
    static Way way_of(const std::vector<std::vector<Vec3>>& levels, const std::vector<Vec3>& areas,
                      const RunContext& context);

    /// Distance of the given walls of a loop from the motion of all walls, as a share of the loop's radius:
    /// median over the points that this motion makes of the loop's rim.
    [[nodiscard]] double missed_by_all(const topology::Model& model,
                                       const matching::LoopSections& loop) const;

    std::vector<Way> ways_;                         ///< first the motion of all walls, then motions of single
                                                    ///< loops
    std::unordered_map<Index, std::size_t> at_rim_; ///< by rim point of a loop with its own motion: the index
                                                    ///< of that motion in `ways_`
    std::vector<double> heights_;
    bool closed_ = false; ///< whether some walls form a closed ring
    double bow_ = 0;
};

} // namespace lacuna::closure
