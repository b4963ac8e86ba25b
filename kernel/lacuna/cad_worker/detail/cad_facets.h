// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <lacuna/cad_worker/detail/cad_curves.h>
#include <lacuna/cad_worker/exact_geometry.h>

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace lacuna::cad_worker {

/// Facets of one face. Points from `first_added` on are its own, the others those of the wire.
struct CadFacets {
    std::vector<Vec3> added;             ///< [file length]
    std::vector<Triangle> triangles;     ///< counter-clockwise in the surface's parameters
    std::vector<std::array<Vec2, 3>> uv; ///< at the corners; on a seam, of the triangle's own side
    ParameterBox box;
    std::string kind;
};

struct FacetOptions {
    Fineness fineness;
    double max_cells = 4000; ///< of the grid laid over a face: beyond it the facets grow
    double tolerance = 0;    ///< [file length]
};

/// Cut a face into facets in its parameter rectangle: the wire's points around it, a grid inside whose lines
/// lie as close as the normal turns, joined by a constrained Delaunay triangulation in grid coordinates.
///
/// @param first_added  number the first point added gets.
/// @return nothing where the border, as finely as it is divided, crosses itself: divide it finer.
/// @throw  BackendError  a face with no border.
std::optional<CadFacets> cut_into_facets(const CadWire& wire, const CadFaceInfo& face,
                                         const FacetOptions& options, Index first_added);

/// "plane", "cylinder", "cone", "sphere", "torus", "bspline" or "surface": by Gmsh's word for it, and where
/// Gmsh does not know, by the principal curvatures.
std::string kind_of_face(int tag, const ParameterBox& box);

} // namespace lacuna::cad_worker
