// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/geometry/shared/facet_tree.h>
#include <lacuna/surface/detail/fine_facets.h>

#include <array>
#include <span>
#include <vector>

namespace lacuna::surface {

/// Whether a face has a given mesh.
bool keeps_cells(const topology::Face& face);

/// Unit normals of a face at the corners of its facets. Each is the mean of the facet normals at that point
/// that are close to the facet's own, so that tips and creases stay sharp. A facet without area gets the mean
/// of all normals at the point.
std::vector<std::array<Vec3, 3>> corner_normals(std::span<const Vec3> points,
                                                std::span<const Triangle> triangles);

/// A face as the shape to which nodes return.
class FaceShapeTree {
public:
    /// @param size  of the triangles; facets with an exact surface are refined to a fraction of it.
    FaceShapeTree(const topology::Model& model, FaceId face, const SizeField& size);

    struct Place {
        Vec3 point, normal;
    };
    /// The closest point of the facets.
    [[nodiscard]] Place closest(const Vec3& p) const;
    /// Move points to the exact surface; nothing happens without one.
    void make_exact(std::span<Vec3> points, const RunContext& context) const;

private:
    FineFacets facets_;
    std::vector<std::array<Vec3, 3>> normals_;
    geometry::FacetTree tree_;
    bool plane_ = false;
};

/// A line that nodes on it do not leave: an edge of the model, or a crease between facets of one face.
struct SkinLine {
    EdgeId edge;               ///< not valid for a crease
    std::vector<Index> points; ///< of the model, from end to end
    std::vector<double> arc;   ///< running length at each of them
    bool kept = false;         ///< its points are mesh nodes that stay
    std::vector<double> s{};   ///< running lengths of `at`
    std::vector<Vec3> at{};    ///< points, on the exact curve if there is one

    /// Set the points. @param size  of the triangles; exact curves are sampled at a fraction of it.
    void sample(const topology::Model& model, const SizeField& size);
    [[nodiscard]] Vec3 point(double where) const;
};

/// Edges except smooth seams, and creases of faces without an exact surface; not sampled yet.
std::vector<SkinLine> skin_lines(const topology::Model& model);

} // namespace lacuna::surface
