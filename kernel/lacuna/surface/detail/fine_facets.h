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
    std::shared_ptr<const geometry::ExactSurface> surface; ///< null where the facets are all there is

    /// A point on an edge of the face.
    struct OnEdge {
        double at = 0;    ///< side of the edge's own polyline, and share of it
        Index point = -1; ///< in `points`
    };
    std::map<EdgeId, std::vector<OnEdge>> edges; ///< as each edge runs, from end to end
    /// How far the middle of each side is from the exact face; where asked for.
    std::vector<std::array<Vec3, 3>> bulge;
};

/// Options of `fine_facets()`.
struct FineFacetOptions {
    /// How far the middle of a side may be off the face, in sizes asked for there, > 0 [-]
    double off = 0.05;
    int rounds = 8;      ///< of halving, >= 0
    double most = 1e5;   ///< facets; with so many no more are made
    bool bulges = false; ///< find those of the facets that are left
};

/// The facets of a face, their sides halved where they miss the exact face by more than quads of this size
/// bear.
///
/// Facets cut for looking at a face are large beside fine quads: the nodes of its rim, which are on the exact
/// edge, then stand up to a row's height off the facets. Midpoints lie on the exact edges and the exact
/// surface; a facet with two sides to be halved is cut in four, with one in two. Without exact geometry the
/// facets stay as they are.
FineFacets fine_facets(const topology::Model& model, FaceId face, const SizeField& size,
                       const FineFacetOptions& options = {});

} // namespace lacuna::surface
