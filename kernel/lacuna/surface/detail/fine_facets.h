// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/surface/size_field.h>
#include <lacuna/topology/model.h>

#include <array>
#include <map>
#include <memory>
#include <vector>

namespace lacuna::surface {

/// Facets of one face, with points of their own.
struct FineFacets {
    std::vector<Vec3> points;
    std::vector<Triangle> triangles;
    std::vector<std::array<Vec2, 3>> uv; ///< surface parameters at the corners; empty without `surface`
    std::shared_ptr<const geometry::ExactSurface> surface; ///< null: the facets are the shape

    /// A point on an edge of the face.
    struct OnEdge {
        double at = 0;    ///< side of the edge's own polyline, and share of it
        Index point = -1; ///< in `points`
    };
    std::map<EdgeId, std::vector<OnEdge>> edges; ///< in the direction of each edge, from end to end
    /// Distance from the midpoint of each side to the exact face; on request.
    std::vector<std::array<Vec3, 3>> bulge;
};

/// Options of `fine_facets()`.
struct FineFacetOptions {
    /// Maximum distance of a side's midpoint from the face, relative to the size there, > 0 [-]
    double off = 0.05;
    int rounds = 8;      ///< rounds of bisection, >= 0
    double most = 1e5;   ///< number of facets at which refinement stops
    bool bulges = false; ///< compute the bulges of the final facets
};

/// The facets of a face, refined where their deviation from the exact face is too large for quads of this
/// size.
///
/// Facets made for display are large compared with fine quads: rim nodes, which lie on the exact edge, then
/// stand up to a row's height off the facets. Midpoints lie on the exact edges and the exact surface; a facet
/// with two sides to be bisected is split in four, with one in two. Without exact geometry the facets are not
/// refined.
FineFacets fine_facets(const topology::Model& model, FaceId face, const SizeField& size,
                       const FineFacetOptions& options = {});

} // namespace lacuna::surface
