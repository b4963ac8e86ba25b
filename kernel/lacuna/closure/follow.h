// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/types.h>
#include <lacuna/geometry/affine.h>
#include <lacuna/matching/match.h>
#include <lacuna/topology/open_volume.h>

#include <limits>
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
    [[nodiscard]] bool leads() const { return !from_source_.empty(); }

    /// Where the point that starts at `source` and ends at `target` is at height t in [0, 1]. @pre leads()
    [[nodiscard]] Vec3 morph(const Vec3& source, const Vec3& target, double t) const;

    /// Unit directions in which the walls move a point off the source, and onto the target. @pre leads()
    [[nodiscard]] Vec3 leaving(const Vec3& source) const;
    [[nodiscard]] Vec3 arriving(const Vec3& target) const;

    /// Where the walls' motion alone, from the source up, takes a point of the source. @pre leads()
    [[nodiscard]] Vec3 carried(const Vec3& source) const { return from_source_.back()(source); }

    /// True where a straight line between two matched vertices without walls would run so far from where the
    /// walls lead that the volume it closes would be another: by half a hundredth of the rims' radius where
    /// walls that go all round are bowed as much, by a quarter of it where all are open.
    /// @pre leads()
    [[nodiscard]] bool leads_astray(const topology::OpenVolume& volume, const matching::Match& match) const;

    /// Height of a model point on a given wall; NaN elsewhere.
    [[nodiscard]] double height(Index point) const
    {
        const auto p = static_cast<std::size_t>(point);
        return p < heights_.size() ? heights_[p] : std::numeric_limits<double>::quiet_NaN();
    }

private:
    std::vector<geometry::AffineFit> from_source_, from_target_; ///< one a level
    std::vector<double> heights_;
    bool closed_ = false; ///< some walls go all round
    double bow_ = 0;      ///< how far the walls stray from straight lines between the rims, of their radius
};

} // namespace lacuna::closure
