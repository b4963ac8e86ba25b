// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/core/types.h>

#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <vector>

namespace lacuna::geometry {

/// Bounding-volume tree over triangles: closest points, crossings and rays in O(log triangles).
///
/// A value that keeps its own copy of the corners, so the points it was built over may change or go. Queries
/// are const, allocate nothing and may run on many threads at once. The same triangles give the same answers
/// to the bit; of triangles equally good the one with the lowest index is given. Triangles of no area, and
/// none at all, are fine.
class FacetTree {
public:
    FacetTree() = default;
    /// On one thread.
    /// @pre every corner is an index into `points`. O(triangles log triangles).
    FacetTree(std::span<const Vec3> points, std::span<const Triangle> triangles);
    /// On the context's threads; the same tree. @throw Cancelled
    FacetTree(std::span<const Vec3> points, std::span<const Triangle> triangles, const RunContext& context);

    /// The place of the facets closest to a point.
    struct Hit {
        Index triangle = -1; ///< in the constructor's order; -1: none in reach
        Vec3 point = Vec3::Zero();
        Vec3 barycentric = Vec3::Zero(); ///< weights of the corners, in [0, 1], sum 1
        double distance2 = std::numeric_limits<double>::infinity(); ///< squared distance
    };
    [[nodiscard]] Hit closest(const Vec3& p) const;
    /// Only facets within the squared distance count (that distance included).
    [[nodiscard]] Hit closest(const Vec3& p, double max_distance2) const;

    /// Hand every pair (own triangle, other's triangle) whose boxes come within `margin` to `visit`, until it
    /// returns false. A tree against itself gives each pair of different triangles once, the lower one first.
    /// @return false if `visit` stopped it.
    /// @throw Cancelled
    bool overlaps(const FacetTree& other, const std::function<bool(Index, Index)>& visit, double margin = 0,
                  const RunContext& context = {}) const;

    /// Whether a box comes near some facet: false only where none of their boxes meets it.
    [[nodiscard]] bool may_meet(const Eigen::AlignedBox3d& box) const;

    /// Where a ray meets a facet.
    struct RayHit {
        Index triangle = -1;
        double t = std::numeric_limits<double>::infinity(); ///< the place is origin + t direction, t >= 0
        Vec3 barycentric = Vec3::Zero();
    };
    /// The first facet met, `triangle` -1 if none. A ray along a facet's own plane does not meet it.
    [[nodiscard]] RayHit first_along(const Vec3& origin, const Vec3& direction) const;
    /// Every facet met, in no special order, until `visit` returns false. A ray through a shared edge meets
    /// both its facets. @return false if `visit` stopped it.
    bool all_along(const Vec3& origin, const Vec3& direction,
                   const std::function<bool(const RayHit&)>& visit) const;

    /// How often the facets wind round a point: 1 inside closed facets that face outward, 0 outside them,
    /// between the two where there are gaps (Jacobson et al. 2013). A sum over all facets: O(triangles),
    /// but no ray can slip through an edge.
    [[nodiscard]] double winding_number(const Vec3& p) const;

    [[nodiscard]] std::size_t size() const { return id_.size(); }
    [[nodiscard]] const Eigen::AlignedBox3d& bounds() const { return bounds_; }

private:
    struct Node {
        Eigen::AlignedBox3d box;
        std::uint32_t begin = 0, end = 0; ///< its triangles, in tree order
        std::uint32_t right = 0;          ///< its second child; the first is the next node; 0: a leaf
    };
    struct Parts;
    std::uint32_t build(const Parts& parts, std::uint32_t self, std::uint32_t begin, std::uint32_t end,
                        int threads, const RunContext& context);

    /// Every facet met no further than `farthest`, which `visit` may lessen. @return false if `visit`
    /// stopped it.
    template <class Visit>
    bool along(const Vec3& origin, const Vec3& direction, const double& farthest, const Visit& visit) const;

    std::vector<Node> node_;
    std::vector<Index> id_;                   ///< given index of each triangle, in tree order
    std::vector<std::array<Vec3, 3>> corner_; ///< in tree order
    Eigen::AlignedBox3d bounds_;
};

/// Closest place of one triangle; `triangle` is left at -1. Works for triangles of no area.
FacetTree::Hit closest_on_triangle(const Vec3& p, const std::array<Vec3, 3>& corners);

/// Do two triangles cross: does each reach further than `tolerance` to both sides of the other's plane, and
/// do they share more than `tolerance` of a line? Triangles in one plane cross where they overlap by more
/// than it. Mere touching (a shared point, a shared edge, a point resting on a face) is no crossing.
/// @param tolerance  [model length], >= 0.
bool triangles_cross(const std::array<Vec3, 3>& a, const std::array<Vec3, 3>& b, double tolerance);

} // namespace lacuna::geometry
