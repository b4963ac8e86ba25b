// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/types.h>
#include <lacuna/geometry/affine.h>
#include <lacuna/matching/guides.h>
#include <lacuna/matching/match.h>
#include <lacuna/topology/open_volume.h>

#include <cstddef>
#include <limits>
#include <unordered_map>
#include <vector>

namespace lacuna::closure {

/// How the given walls morph the source's section into the target's: what void edges and faces follow.
///
/// The walls are cut at even heights, and an affine map is fitted from the source's section and from the
/// target's to each (as the sweep itself places the inside of a layer, Roca and Sarrate 2010).
class Follower {
public:
    /// @param lines  matching::side_lines() of the volume
    Follower(const topology::OpenVolume& volume, const std::vector<matching::SideLine>& lines,
             const RunContext& context = {});

    /// False where no given wall joins source and target: there is nothing to follow.
    [[nodiscard]] bool leads() const { return !ways_.empty(); }

    /// The walls that lead what starts at a model point of the source's rim: the given ones of its own loop
    /// where they say how the rest of that loop goes, else all of them.
    [[nodiscard]] std::size_t walls_at(Index rim_point) const;
    /// Where the point that starts at `source` and ends at `target` is at height t in [0, 1]. @pre leads()
    /// @param walls  `walls_at()` of the rim it is beside; 0: all.
    [[nodiscard]] Vec3 morph(const Vec3& source, const Vec3& target, double t, std::size_t walls = 0) const;

    /// Unit directions in which the walls move a point off the source, and onto the target. @pre leads()
    [[nodiscard]] Vec3 leaving(const Vec3& source) const;
    [[nodiscard]] Vec3 arriving(const Vec3& target) const;

    /// Where the walls' motion alone, from the source up, takes a point of the source. @pre leads()
    [[nodiscard]] Vec3 carried(const Vec3& source) const { return ways_[0].from_source.back()(source); }

    /// True where the walls stray so far from straight lines between the rims that void walls between
    /// straight edges would enclose another volume. @pre leads()
    [[nodiscard]] bool leads_astray(const topology::OpenVolume& volume, const matching::Match& match) const;

    /// How far the walls stray from straight lines between the rims, of their radius.
    [[nodiscard]] double bow() const { return bow_; }

    /// Height of a model point on a given wall; NaN elsewhere.
    [[nodiscard]] double height(Index point) const
    {
        const auto p = static_cast<std::size_t>(point);
        return p < heights_.size() ? heights_[p] : std::numeric_limits<double>::quiet_NaN();
    }

private:
    /// Maps of one level each.
    struct Way {
        std::vector<geometry::AffineFit> from_source, from_target;
    };
    static Way way_of(const std::vector<std::vector<Vec3>>& levels, const std::vector<Vec3>& areas,
                      const RunContext& context);

    /// How far all walls together would lead the given ones of a loop off themselves, of their radius.
    [[nodiscard]] double missed_by_all(const topology::Model& model,
                                       const matching::LoopSections& loop) const;

    std::vector<Way> ways_;                         ///< of all walls, then of loops
    std::unordered_map<Index, std::size_t> at_rim_; ///< way of points on loops with one of their own
    std::vector<double> heights_;
    bool closed_ = false; ///< some walls go all round
    bool tells_ = false;  ///< some reach far enough round to say how the rest of their loop goes
    double bow_ = 0;
};

} // namespace lacuna::closure
