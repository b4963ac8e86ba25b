// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/types.h>

#include <array>
#include <optional>
#include <span>
#include <vector>

namespace lacuna::sweep {

/// Closest points on facets, found by walking from a nearby facet: a few operations per query if consecutive
/// queries are close together. Answers that may be wrong are marked (`Foot::nearest`) and must be checked
/// with a tree.
class FacetWalk {
public:
    /// @param triangles  consistently oriented. O(triangles).
    FacetWalk(std::span<const Vec3> points, std::span<const Triangle> triangles);

    /// A position above the interior of a facet.
    struct Foot {
        Index facet = -1;
        Vec3 barycentric = Vec3::Zero(); ///< weights of the corners, 0 to 1 to rounding, sum 1
        double height = 0;               ///< over the facet, along its normal [model length]
        /// Whether no other facet can be closer to the point, if facets are folded by at most 90°: the foot
        /// point is at least as far from the facet's sides as the point is high. If false, the distance is
        /// still an upper bound.
        bool nearest = false;
    };
    /// The facet below a point.
    /// @return  empty if no facet is found, for example above a convex edge.
    [[nodiscard]] std::optional<Foot> over(const Vec3& point, Index start) const;

    /// Unit normal; zero if the facet has no area.
    [[nodiscard]] const Vec3& normal(Index facet) const { return frame_[index(facet)].normal; }
    /// The neighbour across each side of a facet; -1 at the border. Side k runs from corner k to the next
    /// corner, and in the opposite direction in the neighbour.
    [[nodiscard]] const std::array<Index, 3>& across(Index facet) const { return across_[index(facet)]; }
    [[nodiscard]] std::size_t size() const { return frame_.size(); }

private:
    struct Frame {
        Vec3 corner = Vec3::Zero(), normal = Vec3::Zero();
        Vec3 to_first = Vec3::Zero(), to_second = Vec3::Zero(); ///< gradients of the second and third weight
        /// Altitude of each corner over the opposite side; zero: the facet is too thin.
        Vec3 altitude = Vec3::Zero();
        double rounding = 0; ///< tolerance of distances [model length]
    };
    void set_frame(std::size_t facet, const std::array<Vec3, 3>& corners);

    std::vector<Frame> frame_;
    std::vector<std::array<Index, 3>> across_;
};

} // namespace lacuna::sweep
