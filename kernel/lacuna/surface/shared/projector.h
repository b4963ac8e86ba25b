// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/geometry/shared/facet_tree.h>
#include <lacuna/topology/model.h>

#include <map>
#include <span>
#include <vector>

namespace lacuna::surface {

/// A position on the facets of a face.
struct FacetPosition {
    Index triangle = -1;             ///< index of a facet of the face
    Vec3 barycentric = Vec3::Zero(); ///< weights of the corners
};

/// The facets of several faces together.
struct FacetSet {
    std::vector<Triangle> triangles;
    std::vector<FaceId> face;  ///< face of each facet
    std::vector<Index> number; ///< index of each facet in its face
};

FacetSet facet_set(const topology::Model& model, std::span<const FaceId> faces);

/// Facets, and the exact surface that they approximate.
struct FacetView {
    std::span<const Vec3> points;
    std::span<const Triangle> triangles;
    std::span<const std::array<Vec2, 3>> uv;         ///< surface parameters at the corners
    const geometry::ExactSurface* surface = nullptr; ///< null: the facets are the shape
};

/// Points at positions on facets: on the exact surface or, if there is none, on the facets.
std::vector<Vec3> points_at(const FacetView& facets, std::span<const FacetPosition> places);
/// As above, for one face.
std::vector<Vec3> points_at(const topology::Model& model, FaceId face, std::span<const FacetPosition> places);

/// A point of a face's facets.
Vec3 point_on_facets(const topology::Model& model, FaceId face, const FacetPosition& place);

class Trimming;

/// Finds the closest points on a set of faces. The closest facet determines the face and the start
/// parameters. From there the point is projected onto the exact surface, if the face has one.
class Projector {
public:
    Projector(const topology::Model& model, std::vector<FaceId> faces);
    Projector(Projector&&) noexcept;
    Projector& operator=(Projector&&) noexcept;
    ~Projector();

    /// Move points to the closest position on the faces. If the point of the exact surface is beyond the
    /// face's border, it moves to the nearest point of the border curves. @return  the face of each point
    std::vector<FaceId> project(std::span<Vec3> points, const RunContext& context = {}) const;

private:
    const topology::Model* model_;
    FacetSet facets_;
    geometry::FacetTree tree_;
    std::map<FaceId, Trimming> trimmed_; ///< borders of the faces that have an exact surface
};

} // namespace lacuna::surface
