// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/types.h>

#include <array>
#include <optional>
#include <span>
#include <vector>

namespace lacuna::sweep {

/// The facet across each side of each facet: the one that uses it the other way round, side k running from
/// corner k to corner k + 1; -1 at the border, and where facets are not oriented alike. O(facets).
std::vector<std::array<Index, 3>> facets_across(std::span<const Triangle> triangles, std::size_t point_count);

/// Closest points on facets, by walking from one that is near: a few operations a query where points come in
/// rows, and only where the answer is certain. What is left is for a tree.
class FacetWalk {
public:
    FacetWalk(std::span<const Vec3> points, std::span<const Triangle> triangles);

    /// A place over the inside of a facet.
    struct Foot {
        Index facet = -1;
        Vec3 barycentric = Vec3::Zero(); ///< weights of the corners, 0 to 1 to rounding, sum 1
        double height = 0;               ///< over the facet, along its normal [model length]
    };
    /// The facet that a point is over. The foot is no further from the point than from the facet's sides: no
    /// other facet is nearer, unless facets turn back by more than a right angle within that height.
    /// @return nothing where none is found so.
    [[nodiscard]] std::optional<Foot> over(const Vec3& point, Index start) const;

    /// A unit vector; zero where the facet has no area.
    [[nodiscard]] const Vec3& normal(Index facet) const { return frame_[index(facet)].normal; }
    /// Of a facet, as `facets_across()` gives them.
    [[nodiscard]] const std::array<Index, 3>& across(Index facet) const { return across_[index(facet)]; }
    [[nodiscard]] std::size_t size() const { return frame_.size(); }

private:
    struct Frame {
        Vec3 corner = Vec3::Zero(), normal = Vec3::Zero();
        Vec3 to_first = Vec3::Zero(), to_second = Vec3::Zero(); ///< gradients of the second and third weight
        Vec3 altitude = Vec3::Zero(); ///< of each corner over the side across; zero: too thin to be over
        double rounding = 0;          ///< as long as nothing [model length]
    };

    std::vector<Frame> frame_;
    std::vector<std::array<Index, 3>> across_;
};

} // namespace lacuna::sweep
