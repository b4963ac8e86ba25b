// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/geometry/shared/flatten.h>
#include <lacuna/surface/shared/imprint.h>
#include <lacuna/surface/shared/linking_surface.h>
#include <lacuna/surface/shared/projector.h>

#include <map>
#include <vector>

namespace lacuna::surface {

/// A source face and a point on its facets.
struct SourcePlace {
    FaceId face;
    Vec3 point = Vec3::Zero();
};

/// Closed edges of both ends that are swept to each other.
struct ClosedPair {
    EdgeId source, target;
    /// Fractions of the target edge at the source edge's ends; may exceed 1 for a closed edge.
    double from = 0, to = 1;
};

/// Both ends of a volume in one plane, the source counter-clockwise.
class EndsMap {
public:
    /// @param volume  referred to; must outlive the map.
    /// @param closed  edges that are made coincident.
    /// @param known   lines that are made coincident.
    EndsMap(const topology::OpenVolume& volume, std::span<const LinkingSurface> links,
            std::span<const ClosedPair> closed = {}, std::span<const KnownLine> known = {});

    /// Whether both ends are mapped one to one.
    [[nodiscard]] bool one_to_one() const { return one_to_one_; }
    /// Positions of points of the source and of the target; a rim point has one of each.
    [[nodiscard]] const Vec2& source(Index point) const { return source_[static_cast<std::size_t>(point)]; }
    [[nodiscard]] const Vec2& target(Index point) const { return target_[static_cast<std::size_t>(point)]; }
    [[nodiscard]] SourcePlace on_source(const Vec2& place) const;
    /// The position on the facets of one face.
    [[nodiscard]] FacetPosition on_face(FaceId face, const Vec2& place) const;

private:
    void lay_source();
    void lay_target(std::span<const LinkingSurface> links, std::span<const ClosedPair> closed,
                    std::span<const KnownLine> known);

    const topology::OpenVolume& volume_;
    std::vector<Vec2> source_, target_; ///< for each model point
    FacetSet source_facets_;
    geometry::PlanarLocator locator_;
    std::map<FaceId, geometry::PlanarLocator> face_locator_;
    bool one_to_one_ = true;
};

} // namespace lacuna::surface
