// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/surface/size_field.h>
#include <lacuna/topology/model.h>

#include <array>
#include <vector>

namespace lacuna::surface {

/// The shape of a face, for comparison with a mesh: the facets, and the bulge of the exact face over each
/// side of a facet (the vector from the side's midpoint to the exact face). A facet with its bulges is a
/// quadratic patch. A comparison of a mesh with plain facets would include the sag of the facets.
struct FaceShape {
    std::vector<Vec3> points;
    std::vector<Triangle> triangles;
    std::vector<std::array<Vec3, 3>> bulge; ///< for each side of each facet, at its middle; empty: no bulges
    /// For a face without an exact surface: maximum distance between the facets and the exact curves of the
    /// face's edges [model length].
    double slack = 0;

    /// Displacement from a point of a facet to the quadratic patch over this facet.
    [[nodiscard]] Vec3 bulge_at(std::size_t triangle, const Vec3& barycentric) const;
    /// Unit normal of a facet; zero if it has no area.
    [[nodiscard]] Vec3 normal(std::size_t triangle) const;
    /// Contribution of the face to the enclosed volume, measured from `origin` [model length³].
    [[nodiscard]] double volume_integral(const Vec3& origin) const;
    /// Add the facets of another face.
    void append(const FaceShape& other);
};

/// @param size  size of the mesh to compare with. A facet is bisected if it deviates from the exact face by
///         more than a twentieth of the size. The quadratic patches then deviate far less.
FaceShape face_shape(const topology::Model& model, FaceId face, const SizeField& size);

} // namespace lacuna::surface
