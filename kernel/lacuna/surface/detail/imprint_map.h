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

/// Both ends of a volume mapped to one plane, in which the source runs counter-clockwise.
class EndsMap {
public:
    /// @param volume  must outlive the map.
    /// @param known   pairs of lines that coincide in the plane.
    EndsMap(const topology::OpenVolume& volume, std::span<const LinkingSurface> links,
            std::span<const KnownLine> known);

    /// Whether both ends are mapped one to one.
    [[nodiscard]] bool one_to_one() const { return one_to_one_; }
    /// Positions in the plane of a model point: as a point of the source, and as a point of the target. A rim
    /// point may have both.
    [[nodiscard]] const Vec2& source(Index point) const { return source_[static_cast<std::size_t>(point)]; }
    [[nodiscard]] const Vec2& target(Index point) const { return target_[static_cast<std::size_t>(point)]; }
    [[nodiscard]] SourcePlace on_source(const Vec2& place) const;
    /// The position on the facets of one face of the source.
    [[nodiscard]] FacetPosition on_face(FaceId face, const Vec2& place) const;

private:
    void lay_source(bool disc);
    void lay_target(std::span<const LinkingSurface> links, std::span<const KnownLine> known);

    const topology::OpenVolume& volume_;
    std::vector<Vec2> source_, target_; ///< plane position of each model point
    FacetSet source_facets_;
    geometry::PlanarLocator locator_;
    std::map<FaceId, geometry::PlanarLocator> face_locator_;
    bool one_to_one_ = true;
};

} // namespace lacuna::surface
