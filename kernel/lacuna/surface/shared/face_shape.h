// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/surface/size_field.h>
#include <lacuna/topology/model.h>

#include <array>
#include <vector>

namespace lacuna::surface {

/// The shape of a face for comparison with others: facets, and the exact face's bulge over each of their
/// sides. A facet with its bulges is a quadratic patch, so the chords of facets neither hide nor fake a
/// deviation.
struct FaceShape {
    std::vector<Vec3> points;
    std::vector<Triangle> triangles;
    std::vector<std::array<Vec3, 3>> bulge; ///< at the middle of the side from each corner; empty: none
    /// Maximum distance of the face's facets from its edges shared with exact faces, for faces without an
    /// exact surface [model length].
    double slack = 0;

    /// Maximum distance of the patch from its facet.
    [[nodiscard]] Vec3 bulge_at(std::size_t triangle, const Vec3& barycentric) const;
    /// Unit normal of a facet; zero if it has no area.
    [[nodiscard]] Vec3 normal(std::size_t triangle) const;
    /// Contribution of the face to the enclosed volume, measured from `origin` [model length³].
    [[nodiscard]] double volume_integral(const Vec3& origin) const;
};

/// @param size  size of the mesh to compare with. A facet is bisected where it deviates from the exact face
///          by more than a twentieth of the size; the error of the patches is then far smaller.
FaceShape face_shape(const topology::Model& model, FaceId face, const SizeField& size);

} // namespace lacuna::surface
