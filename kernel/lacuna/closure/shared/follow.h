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

/// Morphs the source's section into the target's along the given walls; void edges and faces follow this
/// motion.
///
/// The walls are cut at even heights, and affine maps are fitted from the source's and the target's section
/// to each level, as the sweep places the inner nodes of its layers (Roca and Sarrate 2010).
class Follower {
public:
    /// @param lines  matching::side_lines() of the volume
    Follower(const topology::OpenVolume& volume, const std::vector<matching::SideLine>& lines,
             const RunContext& context = {});

    /// False if no given wall joins source and target, so that there is no motion to follow.
    [[nodiscard]] bool leads() const { return !ways_.empty(); }

    /// Index of the walls whose motion applies near a rim point of the source: those of its loop if the loop
    /// has a motion of its own, otherwise 0, all walls.
    [[nodiscard]] std::size_t walls_at(Index rim_point) const;
    /// Position at height t in [0, 1] of the point that starts at `source` and ends at `target`. @pre leads()
    /// @param walls  `walls_at()` of the adjacent rim; 0: all walls.
    [[nodiscard]] Vec3 morph(const Vec3& source, const Vec3& target, double t, std::size_t walls = 0) const;

    /// Unit directions of the walls' motion at a point of the source, and at a point of the target. @pre
    /// leads()
    [[nodiscard]] Vec3 leaving(const Vec3& source) const;
    [[nodiscard]] Vec3 arriving(const Vec3& target) const;

    /// The image of a source point on the target, by the affine map fitted from the source's section to the
    /// target's. @pre leads()
    [[nodiscard]] Vec3 carried(const Vec3& source) const { return ways_[0].from_source.back()(source); }

    /// True if the walls are so far from straight lines between the rims that void walls between straight
    /// edges would enclose a different volume. @pre leads()
    [[nodiscard]] bool leads_astray(const topology::OpenVolume& volume, const matching::Match& match) const;

    /// Distance of the walls from straight lines between the rims, as a share of the source rim's radius: the
    /// median, over the points of the sections, of the largest distance at any height.
    [[nodiscard]] double bow() const { return bow_; }

    /// Height of a model point on a given wall; NaN for other points.
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

    /// Distance between a loop's given walls and their image under the motion of all walls, as a share of the
    /// loop's radius.
    [[nodiscard]] double missed_by_all(const topology::Model& model,
                                       const matching::LoopSections& loop) const;

    std::vector<Way> ways_;                         ///< the motion of all walls, then motions for single
                                                    ///< loops
    std::unordered_map<Index, std::size_t> at_rim_; ///< by rim point of a loop with its own motion: the index
                                                    ///< of that motion in `ways_`
    std::vector<double> heights_;
    bool closed_ = false; ///< some walls form a closed ring
    bool tells_ = false;  ///< some open walls reach far enough round to extrapolate the rest of their loop
    double bow_ = 0;
};

} // namespace lacuna::closure
