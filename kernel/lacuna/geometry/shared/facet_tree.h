// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/core/shared/constants.h>
#include <lacuna/core/types.h>

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace lacuna::geometry {

/// Bounding-volume tree over triangles: closest points, crossings and rays in O(log triangles).
///
/// Holds a copy of the corners, so the points may be changed or destroyed later. Queries are const, do not
/// allocate and are thread-safe. Results are reproducible to the bit; among equally good triangles the one
/// with the lowest index is returned. Degenerate triangles, and no triangles at all, are allowed.
class FacetTree {
public:
    FacetTree() = default;
    /// Build the tree on the threads of the context, by default one thread. The tree does not depend on their
    /// number.
    /// @pre every corner is an index into `points`. O(triangles log triangles). @throw Cancelled
    FacetTree(std::span<const Vec3> points, std::span<const Triangle> triangles,
              const RunContext& context = {1, nullptr, {}, {}});

    /// The point of the facets closest to a given point.
    struct Hit {
        Index triangle = -1; ///< index in the constructor's order; -1: none within the distance
        Vec3 point = Vec3::Zero();
        Vec3 barycentric = Vec3::Zero(); ///< weights of the corners, in [0, 1], sum 1
        double distance2 = kInfinity;    ///< squared distance
    };
    /// Only facets within the squared distance, inclusive, are considered.
    [[nodiscard]] Hit closest(const Vec3& p, double max_distance2 = kInfinity) const;

    /// Call `visit` for every pair (own triangle, triangle of `other`) whose boxes are within `margin`, until
    /// it returns false. If `other` is this tree, each pair of different triangles is visited once, lower
    /// index first.
    /// @return false if `visit` stopped it.
    /// @throw Cancelled
    bool overlaps(const FacetTree& other, const std::function<bool(Index, Index)>& visit, double margin = 0,
                  const RunContext& context = {}) const;

    /// Whether the box of a facet meets the given box. If not, no facet meets it.
    [[nodiscard]] bool may_meet(const Eigen::AlignedBox3d& box) const;

    /// Intersection of a ray with a facet.
    struct RayHit {
        Index triangle = -1;
        double t = kInfinity; ///< the point is origin + t direction, t >= 0
        Vec3 barycentric = Vec3::Zero();
    };
    /// The first intersection; `triangle` is -1 if there is none. A ray that lies in the plane of a facet
    /// does not intersect it.
    [[nodiscard]] RayHit first_along(const Vec3& origin, const Vec3& direction) const;
    /// Visit all intersections in any order, until `visit` returns false. A ray through a shared edge
    /// intersects both facets. @return false if `visit` stopped it.
    bool all_along(const Vec3& origin, const Vec3& direction,
                   const std::function<bool(const RayHit&)>& visit) const;

    /// Generalised winding number: 1 inside a closed surface oriented outward, 0 outside, and values between
    /// near gaps (Jacobson et al. 2013). More robust than counting the intersections of a ray. O(triangles),
    /// since it sums over all facets.
    [[nodiscard]] double winding_number(const Vec3& p) const;

    [[nodiscard]] std::size_t size() const { return id_.size(); }
    [[nodiscard]] const Eigen::AlignedBox3d& bounds() const { return bounds_; }

private:
    struct Node {
        Eigen::AlignedBox3d box;
        std::uint32_t begin = 0, end = 0; ///< range of its triangles, in tree order
        std::uint32_t right = 0;          ///< index of its second child, 0: a leaf; the first child is the
                                          ///< next node
    };
    struct Parts;
    std::uint32_t build(const Parts& parts, std::uint32_t self, std::uint32_t begin, std::uint32_t end,
                        int threads, const RunContext& context);

    /// Visit the leaves below the boxes that `enters` accepts, until `visit` returns false.
    template <class Enters, class Visit>
    bool each_leaf(const Enters& enters, const Visit& visit) const;
    /// Visit all intersections up to `farthest`, which `visit` may reduce.
    /// @return false if `visit` stopped it.
    template <class Visit>
    bool along(const Vec3& origin, const Vec3& direction, const double& farthest, const Visit& visit) const;

    std::vector<Node> node_;
    std::vector<Index> id_;                   ///< given index of each triangle, in tree order
    std::vector<std::array<Vec3, 3>> corner_; ///< in tree order
    Eigen::AlignedBox3d bounds_;
};

/// Closest point of one triangle. The result has no triangle index (-1). Degenerate triangles are allowed.
FacetTree::Hit closest_on_triangle(const Vec3& p, const std::array<Vec3, 3>& corners);

/// Whether two triangles intersect. Contact (a shared point or edge, a point on the other triangle) is no
/// intersection. Conditions for triangles in different planes:
/// - Each triangle extends more than `tolerance` to both sides of the other triangle's plane.
/// - Along the line in which the two planes meet, the triangles overlap by more than `tolerance`.
///
/// Coplanar triangles intersect if they overlap by more than `tolerance`.
/// @param tolerance  [model length], >= 0.
bool triangles_cross(const std::array<Vec3, 3>& a, const std::array<Vec3, 3>& b, double tolerance);

/// The ends of the line in which two triangles in different planes intersect, see `triangles_cross()`; empty
/// otherwise.
std::optional<std::array<Vec3, 2>> crossing_line(const std::array<Vec3, 3>& a, const std::array<Vec3, 3>& b,
                                                 double tolerance);

} // namespace lacuna::geometry
