// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/core/types.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

namespace lacuna::geometry {

/// A triangulated surface in space with a boundary, for flipping, refinement and smoothing.
///
/// Side i of a triangle lies opposite corner i and runs from corner i + 1 to corner i + 2. The boundary and
/// its points are never changed.
class PatchMesh {
public:
    /// @param next  the triangle across each side, -1 on the boundary.
    PatchMesh(std::vector<Vec3> points, std::vector<Triangle> triangles, std::vector<Triangle> next);

    /// Flip sides that connect the same two points as another side, until there are none.
    /// @return false if this is impossible.
    bool resolve_doubled();

    /// Flip inner sides whose opposite angles sum to more than π, unless the flip duplicates a side or folds
    /// the surface. Every flip increases the smallest angles; a few rounds suffice.
    void make_delaunay();

    /// Split inner sides until all have the desired length at their points: the mean length of the boundary
    /// sides there, growing inwards by `grading`. Sides are flipped and points smoothed in between.
    void refine(double grading, std::size_t max_points, const RunContext& context);

    /// Smooth inner points towards the centre of their neighbours along the surface,
    /// unless their triangles get worse.
    void relax();

    /// Move inner points to a harmonic surface: minimal Dirichlet energy with the present cotangent weights.
    void place_harmonic(const RunContext& context);

    [[nodiscard]] double area() const;
    [[nodiscard]] const std::vector<Vec3>& points() const { return points_; }
    [[nodiscard]] const std::vector<Triangle>& triangles() const { return triangles_; }

private:
    [[nodiscard]] const Vec3& at(Index point) const { return points_[static_cast<std::size_t>(point)]; }
    [[nodiscard]] Index corner(Index triangle, int i) const
    {
        return triangles_[static_cast<std::size_t>(triangle)][static_cast<std::size_t>(i % 3)];
    }
    [[nodiscard]] Index across(Index triangle, int side) const
    {
        return next_[static_cast<std::size_t>(triangle)][static_cast<std::size_t>(side)];
    }
    /// A triangle a-b-c with its side b → c, the triangle d-c-b across that side, and the neighbours across
    /// the four other sides.
    struct TrianglePair {
        Index other, a, b, c, d, over_ca, over_ab, over_bd, over_dc;
    };
    [[nodiscard]] TrianglePair pair_at(Index triangle, int side) const;
    [[nodiscard]] int side_towards(Index triangle, Index neighbour, Index from) const;
    [[nodiscard]] Vec3 area_vector(const Triangle& triangle) const;
    [[nodiscard]] double cotangent(Index triangle, int i) const;
    [[nodiscard]] std::size_t joined(Index a, Index b) const;
    [[nodiscard]] bool may_flip(Index triangle, int side) const;
    void count_side(Index a, Index b, int change);
    void flip(Index triangle, int side);
    void relink(Index triangle, Index before, Index after, Index from);
    void split(Index triangle, int side, double wanted);
    [[nodiscard]] double shape(const Triangle& triangle, const Vec3& normal) const;
    [[nodiscard]] double wanted_between(Index a, Index b, double grading) const;
    std::vector<double> rim_sizes() const;

    std::vector<Vec3> points_;
    std::vector<Triangle> triangles_;
    std::vector<Triangle> next_;
    std::vector<bool> fixed_; ///< boundary points and given points
    std::vector<double> size_;
    std::unordered_map<std::uint64_t, int> sides_; ///< number of sides that connect two points
};

} // namespace lacuna::geometry
