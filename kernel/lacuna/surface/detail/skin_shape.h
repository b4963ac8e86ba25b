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

/// For each facet, unit normals of the face at its three corners. The normal at a corner is the mean over
/// those facets at the point whose normals differ little from that of the facet, so that tips and creases
/// stay sharp. For a facet without area, it is the mean over all facets at the point.
std::vector<std::array<Vec3, 3>> corner_normals(std::span<const Vec3> points,
                                                std::span<const Triangle> triangles);

/// The shape of a face, onto which moved nodes are projected.
class FaceShapeTree {
public:
    /// @param size  size of the triangles. Facets with an exact surface are refined to a fraction of it.
    FaceShapeTree(const topology::Model& model, FaceId face, const SizeField& size);

    struct Place {
        Vec3 point, normal;
    };
    /// The closest point of the facets.
    [[nodiscard]] Place closest(const Vec3& p) const;
    /// Move points to the exact surface. Points of a face without an exact surface do not move.
    void make_exact(std::span<Vec3> points, const RunContext& context) const;

private:
    FineFacets facets_;
    std::vector<std::array<Vec3, 3>> normals_;
    geometry::FacetTree tree_;
    bool plane_ = false;
};

/// A line whose nodes stay on it: an edge of the model, or a crease between facets of one face.
struct SkinLine {
    EdgeId edge;               ///< not valid for a crease
    std::vector<Index> points; ///< points of the model, from end to end
    std::vector<double> arc;   ///< for each point, the running length up to it
    bool kept = false;         ///< whether its points are nodes that must stay
    std::vector<double> s{};   ///< running lengths of the points `at`
    std::vector<Vec3> at{};    ///< sample points, on the exact curve if there is one

    /// Set `s` and `at`. @param size  size of the triangles; exact curves are sampled at a fraction of it.
    void sample(const topology::Model& model, const SizeField& size);
    [[nodiscard]] Vec3 point(double where) const;
};

/// The lines of a model, not sampled yet: edges except smooth seams, and creases of faces without an exact
/// surface.
std::vector<SkinLine> skin_lines(const topology::Model& model);

} // namespace lacuna::surface
