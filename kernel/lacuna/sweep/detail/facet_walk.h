// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/types.h>

#include <array>
#include <optional>
#include <span>
#include <vector>

namespace lacuna::sweep {

/// Closest points on facets, by walking from one that is near: a few operations a query where points come in
/// rows, and only where the answer is certain. What is left is for a tree.
class FacetWalk {
public:
    /// @param triangles  oriented alike. O(triangles).
    FacetWalk(std::span<const Vec3> points, std::span<const Triangle> triangles);

    /// A place over the inside of a facet.
    struct Foot {
        Index facet = -1;
        Vec3 barycentric = Vec3::Zero(); ///< weights of the corners, 0 to 1 to rounding, sum 1
        double height = 0;               ///< over the facet, along its normal [model length]
        /// No other facet is nearer: the sides of this one are so far from the foot that the facets beside
        /// it, by the angle they make with it, do not rise to the point. Facets further on are taken to make
        /// no sharper angles within that height; where they do, the foot is still no nearer than the nearest
        /// place.
        bool nearest = false;
    };
    /// The facet that a point is over.
    /// @return nothing where none is found, as beside an edge that sticks out.
    [[nodiscard]] std::optional<Foot> over(const Vec3& point, Index start) const;

    /// A unit vector; zero where the facet has no area.
    [[nodiscard]] const Vec3& normal(Index facet) const { return frame_[index(facet)].normal; }
    /// The facet across each side of a facet: the one that uses it the other way round, side k running from
    /// corner k to the next; -1 at the border.
    [[nodiscard]] const std::array<Index, 3>& across(Index facet) const { return across_[index(facet)]; }
    [[nodiscard]] std::size_t size() const { return frame_.size(); }

private:
    struct Frame {
        Vec3 corner = Vec3::Zero(), normal = Vec3::Zero();
        Vec3 to_first = Vec3::Zero(), to_second = Vec3::Zero(); ///< gradients of the second and third weight
        Vec3 altitude = Vec3::Zero(); ///< of each corner over the side across; zero: too thin to be over
        double rounding = 0;          ///< as long as nothing [model length]
        double fold = 1;              ///< tangent of half the sharpest angle to a facet at one of its corners
    };
    void set_frame(std::size_t facet, const std::array<Vec3, 3>& corners);

    std::vector<Frame> frame_;
    std::vector<std::array<Index, 3>> across_;
};

} // namespace lacuna::sweep
