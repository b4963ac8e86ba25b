// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/surface/size_field.h>
#include <lacuna/topology/model.h>

#include <array>
#include <map>
#include <memory>
#include <vector>

namespace lacuna::surface {

/// Facets of one face, with a list of points of their own.
struct FineFacets {
    std::vector<Vec3> points;
    std::vector<Triangle> triangles;
    std::vector<std::array<Vec2, 3>> uv; ///< surface parameters at the corners; empty without `surface`
    std::shared_ptr<const geometry::ExactSurface> surface; ///< null: the facets are the shape

    /// A point on an edge of the face.
    struct OnEdge {
        /// Index of the segment of the edge's polyline, plus the position within this segment [0, 1].
        double at = 0;
        Index point = -1; ///< index in `points`
    };
    std::map<EdgeId, std::vector<OnEdge>> edges; ///< points of each edge from its start to its end
    /// For each side of each facet, the vector from its midpoint to the exact face. Empty if not asked for.
    std::vector<std::array<Vec3, 3>> bulge;
};

/// The facets of a face, refined where they deviate too far from the exact face for quads of the given size.
/// The facets of a CAD file are made for display and are large compared with fine quads: the distance of rim
/// nodes, which lie on the exact edge, from such facets may be as large as a row of quads is high.
///
/// Sides are bisected; the new midpoints lie on the exact edges and the exact surface. A facet with one
/// bisected side is split in two. If two sides of a facet are bisected, the third is bisected as well, and
/// the facet is split in four. Bisection ends when no midpoint is further from the face than 5 % of the size
/// there, after eight rounds, or at 100,000 facets. A face without exact geometry is not refined.
/// @param bulges  compute `FineFacets::bulge`
FineFacets fine_facets(const topology::Model& model, FaceId face, const SizeField& size, bool bulges = false);

} // namespace lacuna::surface
