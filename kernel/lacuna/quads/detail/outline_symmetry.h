// SPDX-License-Identifier: MIT
#pragma once

/// Rotations and reflections that map the boundary nodes of a region onto each other, and the part of a
/// region between its mirror axes. Only sources of this folder include it.

#include <lacuna/quads/detail/region_loops.h>

#include <cmath>
#include <optional>
#include <vector>

namespace lacuna::quads {

/// A rotation about a centre. If `mirrors`, a reflection that reverses y is applied before it.
struct Isometry {
    Vec2 centre;
    double cosine = 1, sine = 0;
    bool mirrors = false;

    [[nodiscard]] Vec2 operator()(const Vec2& p) const
    {
        const Vec2 d = p - centre;
        const double y = mirrors ? -d.y() : d.y();
        return centre + Vec2(cosine * d.x() - sine * y, sine * d.x() + cosine * y);
    }
    /// Rotation angle [radian].
    [[nodiscard]] double angle() const { return std::atan2(sine, cosine); }
    [[nodiscard]] Vec2 back(const Vec2& p) const
    {
        const Vec2 d = p - centre;
        const Vec2 turned(cosine * d.x() + sine * d.y(), -sine * d.x() + cosine * d.y());
        return centre + Vec2(turned.x(), mirrors ? -turned.y() : turned.y());
    }
};

/// A symmetry and the image of each node.
struct Symmetry {
    Isometry map;
    std::vector<Index> to;
};

/// The symmetries of a region's boundary nodes, except the identity. If the region has more than 64
/// rotations, only a subgroup with at most 64 of them is returned. The subgroup includes the quarter turns,
/// if these are symmetries. It includes reflections only if the axis of one passes through the first node of
/// the outer loop.
/// @note  O(nodes) for each node of the outer loop that has the largest distance from the centre. Most of
///         these candidates are not symmetries and are rejected at once.
std::vector<Symmetry> outline_symmetries(const PlanarRegion& region);

/// The part of a symmetric region between two adjacent mirror axes, or on one side of a single axis. The
/// images of the part make up the region.
struct MirrorPart {
    PlanarRegion region;
    /// For each node, its number in the whole region; -1: the node is only on an axis.
    std::vector<Index> whole;
    /// For the side from each node to the next: the piece of an axis on which the side lies; -1: the side is
    /// on no axis.
    std::vector<int> axis;
    /// For each node: 0 if it is on no axis, 1 or 2 if it is on that axis, 3 if it is the centre.
    std::vector<char> ray;
    bool has_centre = false;    ///< whether the centre lies in the region
    bool is_some = false;       ///< whether the region has symmetries besides those that map the part onto
                                ///< its images
    std::vector<double> wanted; ///< number of sides that the size requires on each piece of an axis
    /// The images, in order around the centre. The first image is the part itself. The second, fourth and so
    /// on are mirrored.
    std::vector<Symmetry> images;

    /// Add a node to the last loop.
    void add(const Vec2& p, Index of_whole, int on_axis, char on_ray)
    {
        region.loops.back().push_back(static_cast<Index>(region.points.size()));
        region.points.push_back(p);
        whole.push_back(of_whole);
        axis.push_back(on_axis);
        ray.push_back(on_ray);
    }
};

/// Cut a region along mirror axes. An axis can be used if it passes through boundary nodes, crosses no side,
/// and divides no corner into halves that are far from multiples of 90°.
///
/// If the centre is outside the region or in a hole, up to eight axes are used. Otherwise two perpendicular
/// axes are used, or one if no two are perpendicular: with more axes, six or more quads would meet at the
/// centre. Pairs of perpendicular axes are ranked. A pair that cuts more loops ranks higher, because a loop
/// that is cut need not be placed in the grid. Among equal pairs, one through the first node of the outer
/// loop ranks higher.
/// Nodes are placed along the axes at the spacing of `size`.
/// @param symmetries  the symmetries of the region, or those of a subgroup; only these are used.
/// @param size        spacing of the nodes on the axes.
/// @param choice      rank of the perpendicular pair of axes, from 0.
/// @return  empty if there is no such axis, or `choice` is too large.
std::optional<MirrorPart> mirror_part(const PlanarRegion& region, const std::vector<Symmetry>& symmetries,
                                      const SizeField& size, std::size_t choice);

/// Set the number of sides of each piece of an axis, >= 1.
void divide_axes(MirrorPart& part, const std::vector<int>& sides, const SizeField& size);

/// The quads of the whole region: the images of the quads of its part, joined along the axes.
PlanarQuads unfold(const MirrorPart& part, const PlanarQuads& mesh, const PlanarRegion& region);

} // namespace lacuna::quads
