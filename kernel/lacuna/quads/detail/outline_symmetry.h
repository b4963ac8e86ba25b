// SPDX-License-Identifier: MIT
#pragma once

/// Turns and mirrorings that map the boundary nodes of a region onto each other, and the part of a region
/// between its mirror axes. Only sources of this folder include it.

#include <lacuna/quads/detail/region_loops.h>

#include <cmath>
#include <optional>
#include <vector>

namespace lacuna::quads {

/// A turn about a centre, after mirroring in the first axis where it mirrors.
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
    /// What it turns by [radians].
    [[nodiscard]] double angle() const { return std::atan2(sine, cosine); }
    [[nodiscard]] Vec2 back(const Vec2& p) const
    {
        const Vec2 d = p - centre;
        const Vec2 turned(cosine * d.x() + sine * d.y(), -sine * d.x() + cosine * d.y());
        return centre + Vec2(turned.x(), mirrors ? -turned.y() : turned.y());
    }
};

/// A symmetry and the node that each node goes to.
struct Symmetry {
    Isometry map;
    std::vector<Index> to;
};

/// The symmetries of a region's boundary nodes but the identity. Of more than 64 turns a group of as many
/// or fewer, quarter turns among them, with mirror axes through the outer loop's first node where one does
/// that.
/// @note  O(nodes) for each node of the outer loop that is as far from the centre as the farthest; most
///        that are none fail at once.
std::vector<Symmetry> outline_symmetries(const PlanarRegion& region);

/// The part of a symmetric region between two mirror axes next to each other, or on one side of its only one.
/// Its images about the centre are the region.
struct MirrorPart {
    PlanarRegion region;
    std::vector<Index> whole;   ///< the whole region's node at each node, -1: a node on an axis alone
    std::vector<int> axis;      ///< of the side from each node to the next: a piece of an axis, -1: none
    std::vector<char> ray;      ///< where each node lies: 0 on no axis, 1 or 2 on one, 3 at the centre
    bool has_centre = false;    ///< whether the centre lies in the region
    bool is_some = false;       ///< whether the region has other symmetries than those of the images
    std::vector<double> wanted; ///< sides that the size asks for on each piece of an axis
    /// The images, in order about the centre: the first is the part itself, every other one is mirrored.
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

/// Cut a region along mirror axes that go through boundary nodes, cross no side and halve no corner.
///
/// About a centre outside the region, in a hole, all of them are taken; else two that are square to each
/// other, for more would leave a node of six quads or more, or one. Of several choices that which cuts
/// through most loops, for what is cut need not be placed, and through the outer loop's first node. Axes get
/// nodes as far apart as the size asks.
/// @param symmetries  of the region that may be used, all that it has or a group of them.
/// @param size        that nodes on the axes are spaced by.
/// @param choice      which of these, from 0 on.
/// @return nothing where there is no such axis, nor so many choices.
std::optional<MirrorPart> mirror_part(const PlanarRegion& region, const std::vector<Symmetry>& symmetries,
                                      const SizeField& size, std::size_t choice);

/// Give the pieces of the axes other numbers of sides, >= 1.
void divide_axes(MirrorPart& part, const std::vector<int>& sides, const SizeField& size);

/// The whole region's quads from quads of its part: images of each, joined along the axes.
PlanarQuads unfold(const MirrorPart& part, const PlanarQuads& mesh, const PlanarRegion& region);

} // namespace lacuna::quads
