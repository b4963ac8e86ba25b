// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/surface/size_field.h>
#include <lacuna/topology/model.h>

#include <array>
#include <vector>

namespace lacuna::surface {

/// The shape of a face, to compare others with: facets, and how far the exact face bulges over each of their
/// sides. Facet and bulges together are a quadratic patch, so the chords of the facets neither hide a
/// deviation nor look like one.
struct FaceShape {
    std::vector<Vec3> points;
    std::vector<Triangle> triangles;
    std::vector<std::array<Vec3, 3>> bulge; ///< at the middle of the side from each corner; empty: none
    /// How far the face's own facets may be off the edges it shares with exact faces: where it has no exact
    /// surface [model length].
    double slack = 0;

    /// How far the patch lies from its facet.
    [[nodiscard]] Vec3 bulge_at(std::size_t triangle, const Vec3& barycentric) const;
    /// Of a facet, a unit vector; zero where it has no area.
    [[nodiscard]] Vec3 normal(std::size_t triangle) const;
    /// What the face contributes to the volume enclosed, measured from `origin` [model length³].
    [[nodiscard]] double volume_integral(const Vec3& origin) const;
};

/// @param size  of what is compared with it: facets are halved where they miss the exact face by more than a
///              twentieth of it. What the patches then miss is less by far.
FaceShape face_shape(const topology::Model& model, FaceId face, const SizeField& size);

} // namespace lacuna::surface
