// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/topology/model.h>

#include <span>
#include <unordered_map>
#include <vector>

namespace lacuna::topology {

/// Points to be put on sides of facets, and the facets cut there.
class SidePoints {
public:
    /// Points between `a` and `b`, in that order. A side that has points already keeps those.
    void add(Index a, Index b, std::vector<Index> between);
    [[nodiscard]] bool empty() const { return between_.empty(); }
    /// The points between `a` and `b`, in that order; none for a side that stays whole.
    [[nodiscard]] std::vector<Index> on(Index a, Index b) const;

private:
    std::unordered_map<std::uint64_t, std::vector<Index>> between_; ///< from the lesser end
};

/// A facet with the surface parameters of its corners.
struct ParamFacet {
    Triangle corner;
    std::array<Vec2, 3> uv{Vec2::Zero(), Vec2::Zero(), Vec2::Zero()};
};

/// The facets a facet becomes, fans from the corner opposite each side that has points; the facet itself
/// where none has. Parameters of new corners lie on the side between its ends', as far along as the points
/// do.
/// @pre  no point to be put on a side is a corner of the facet.
std::vector<ParamFacet> cut_at_sides(std::span<const Vec3> points, const ParamFacet& facet,
                                     const SidePoints& sides);

/// Cut the facets of a face; its given quads stay as they are.
void cut_at_sides(std::span<const Vec3> points, Face& face, const SidePoints& sides);

/// A point close to a segment.
struct NearSegment {
    Index point = -1;   ///< in the list asked about
    Index segment = -1; ///< in the list asked about
};

/// Every pair of a point and a segment whose bounding boxes come within `reach`, ordered by segment, then
/// point.
/// @param segments  their end points.
/// @throw Cancelled
/// @note  O(n log n) where few are close.
std::vector<NearSegment> near_segments(std::span<const Vec3> points,
                                       std::span<const std::array<Vec3, 2>> segments, double reach,
                                       const RunContext& context = {});

/// The place of a segment closest to a point, as the fraction of the way from `a` to `b`, in [0, 1].
double fraction_along(const Vec3& p, const Vec3& a, const Vec3& b);

} // namespace lacuna::topology
