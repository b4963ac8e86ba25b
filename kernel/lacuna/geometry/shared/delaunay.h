// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/types.h>

#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace lacuna::geometry {

///        2
///       / \        Side i lies opposite corner i and runs from corner i+1 to corner i+2.
///   s1 /   \ s0    next[i] is the triangle across side i, -1 outside the outermost triangle.
///     /     \      Bit i of fixed: side i is a constraint.
///    0--s2---1
struct DelaunayTriangle {
    Triangle corner{-1, -1, -1};
    std::array<Index, 3> next{-1, -1, -1};
    std::uint8_t fixed = 0;
    bool inside = false;

    [[nodiscard]] bool is_fixed(int side) const { return (fixed >> side) & 1; }
    [[nodiscard]] Index from(int side) const { return corner[static_cast<std::size_t>((side + 1) % 3)]; }
    [[nodiscard]] Index to(int side) const { return corner[static_cast<std::size_t>((side + 2) % 3)]; }
    [[nodiscard]] Index across(int side) const { return next[static_cast<std::size_t>(side)]; }
};

/// The incremental constrained Delaunay triangulation used by `triangulate()`.
///
/// The triangulation starts from one huge triangle, whose corners are numbered after the given points. The
/// result is the part inside closed constraints. The constraints separate it from the corners of the huge
/// triangle, so these corners do not affect the result.
class DelaunayMesh {
public:
    /// The Delaunay triangulation of the points in `used`, inserted along a space-filling curve.
    /// @throw InvalidInput  two of the points coincide.
    DelaunayMesh(std::span<const Vec2> points, const std::vector<Index>& used);

    /// Insert the constraint a–b by retriangulating the triangles that it crosses.
    /// @pre both points are inserted; no point lies on the segment and no constraint crosses it.
    void fix_segment(Index a, Index b);

    /// Set `inside` where an odd number of constraints lies between a triangle and the outside.
    void mark_inside();

    /// The triangle with the directed side a → b, and the number of that side; {-1, -1} if there is none.
    [[nodiscard]] std::pair<Index, int> find_side(Index a, Index b) const;

    /// The triangles that the insertion of a point replaces.
    struct Cavity {
        struct Border {
            Index from, to, outer;
            bool fixed;
        };
        std::vector<Index> triangles;
        std::vector<Border> border;                 ///< counter-clockwise, closed
        std::vector<std::pair<Index, int>> pending; ///< work space
    };

    /// Walk from `start` to the triangle that contains p; -1 if constraints block the walk.
    [[nodiscard]] Index locate(const Vec2& p, Index start) const;
    /// Find the triangles whose circumcircle contains p. The search starts at the triangle that contains p
    /// and does not cross constraints. @return false if p is on a constraint or on a point.
    bool find_cavity(const Vec2& p, Index holder, Cavity& cavity);
    /// Replace the cavity by triangles around a new point; `fresh` lists them.
    Index fill_cavity(const Vec2& p, const Cavity& cavity, std::vector<Index>& fresh);

    [[nodiscard]] const std::vector<Vec2>& points() const { return points_; }
    [[nodiscard]] const Vec2& at(Index point) const { return points_[static_cast<std::size_t>(point)]; }
    [[nodiscard]] const std::vector<DelaunayTriangle>& triangles() const { return triangles_; }
    [[nodiscard]] const DelaunayTriangle& operator[](Index t) const
    {
        return triangles_[static_cast<std::size_t>(t)];
    }
    [[nodiscard]] Index given_count() const { return given_; }

private:
    DelaunayTriangle& triangle(Index t) { return triangles_[static_cast<std::size_t>(t)]; }
    void insert_all(const std::vector<Index>& used, const Vec2& low, double extent);
    void fan(Index point, const Cavity& cavity, std::vector<Index>& fresh);
    void relink(Index triangle, Index from, Index to, Index next);
    void mark_fixed(Index a, Index b);
    void replace_strip(const std::vector<Index>& strip, std::vector<Index> left,
                       const std::vector<Index>& right);

    std::vector<Vec2> points_;
    std::vector<DelaunayTriangle> triangles_;
    std::vector<Index> triangle_of_; ///< one of the triangles at each point; -1: the point is not inserted
                                     ///< yet
    std::vector<Index> stamp_;       ///< for each triangle, the number of the last cavity that contained it
    Index stamp_now_ = 0;
    Index given_ = 0;
};

} // namespace lacuna::geometry
