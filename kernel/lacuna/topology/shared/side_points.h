// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/topology/model.h>

#include <functional>
#include <span>
#include <unordered_map>
#include <vector>

namespace lacuna::topology {

/// Points to be inserted on facet sides, at which facets are then split.
class SidePoints {
public:
    /// Set the points of the side between `a` and `b`, in that order. If the side has points already, nothing
    /// changes.
    void add(Index a, Index b, std::vector<Index> between);
    [[nodiscard]] bool empty() const { return between_.empty(); }
    /// The points between `a` and `b`, in that order; empty if the side is not split.
    [[nodiscard]] std::vector<Index> on(Index a, Index b) const;

private:
    std::unordered_map<std::uint64_t, std::vector<Index>> between_; ///< key: both ends; value: points from
                                                                    ///< the lower end
};

/// A facet with the surface parameters of its corners.
struct ParamFacet {
    Triangle corner;
    std::array<Vec2, 3> uv{Vec2::Zero(), Vec2::Zero(), Vec2::Zero()};
};

/// Split a facet at the points on its sides. A fan from the corner opposite the first side with points splits
/// the facet; the pieces are then split in the same way at the other sides. Surface parameters of new corners
/// are interpolated along the side.
/// @return  the pieces; the facet itself if no side has points.
/// @pre  no inserted point is a corner of the facet.
std::vector<ParamFacet> cut_at_sides(std::span<const Vec3> points, const ParamFacet& facet,
                                     const SidePoints& sides);

/// Remove the facets whose number `gone` accepts from a face, with their surface parameters.
/// @return whether any was removed.
bool erase_facets(Face& face, const std::function<bool(std::size_t facet)>& gone);

/// Whether two corners of a cell are the same point.
bool repeats(std::span<const Index> corners);

/// Split the facets of a face; its given quads do not change.
void cut_at_sides(std::span<const Vec3> points, Face& face, const SidePoints& sides);

/// Insert a point into a side between two facets of a face. If the face has an exact surface, the point lies
/// on this surface.
/// @return  the point; -1 if the side is on the face's rim: then nothing changes.
Index point_on_side(ModelBuilder& model, FaceId face, Index a, Index b, double fraction);

/// The point of a face's facets closest to a place. A corner of a facet within the tolerance of this point is
/// returned. Otherwise a new point is inserted, on a side as by `point_on_side()` or inside a facet.
/// @note  O(facets).
Index point_on_face(ModelBuilder& model, FaceId face, const Vec3& place);

/// A point close to a segment.
struct NearSegment {
    Index point = -1;   ///< in the list passed in
    Index segment = -1; ///< in the list passed in
};

/// Every pair of a point and a segment whose bounding boxes come within `reach`, ordered by segment, then
/// point.
/// @param segments  their end points.
/// @throw Cancelled
/// @note  O(n log n) if few pairs are close.
std::vector<NearSegment> near_segments(std::span<const Vec3> points,
                                       std::span<const std::array<Vec3, 2>> segments, double reach,
                                       const RunContext& context = {});

/// Position of the segment's closest point to `p`, as a fraction of the length from `a` to `b`, in [0, 1].
double fraction_along(const Vec3& p, const Vec3& a, const Vec3& b);

} // namespace lacuna::topology
