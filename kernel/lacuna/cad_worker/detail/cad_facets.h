// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <lacuna/cad_worker/detail/cad_curves.h>
#include <lacuna/cad_worker/exact_geometry.h>

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace lacuna::cad_worker {

/// Facets of one face. Point numbers from `first_added` on refer to `added`, lower numbers to the wire's
/// points.
struct CadFacets {
    std::vector<Vec3> added;             ///< [file length]
    std::vector<Triangle> triangles;     ///< counter-clockwise seen from the file's side of the face
    std::vector<std::array<Vec2, 3>> uv; ///< parameters of the corners; on a seam, those on the triangle's
                                         ///< side of the seam
    ParameterBox box;
    std::string kind;
};

struct FacetOptions {
    Fineness fineness;
    double max_cells = 4000; ///< limit on the grid cells of a face; facets become larger to keep it
    double tolerance = 0;    ///< [file length]
};

/// Triangulate a face in its parameter rectangle. The result is a constrained Delaunay triangulation, in grid
/// coordinates, of the boundary points and of inner grid points, whose spacing follows the turn of the
/// normal.
///
/// @param first_added  number of the first point that is added.
/// @return empty if the polygon of the boundary points intersects itself; the caller then divides the
///         boundary more finely and tries again.
/// @throw  BackendError  the face has no boundary.
std::optional<CadFacets> cut_into_facets(const CadWire& wire, const CadFaceInfo& face,
                                         const FacetOptions& options, Index first_added);

/// The kind of a surface: "plane", "cylinder", "cone", "sphere", "torus", "bspline" or "surface". The kind is
/// the type that Gmsh reports. If Gmsh reports no type, the principal curvatures determine the kind.
std::string kind_of_face(int tag, const ParameterBox& box);

} // namespace lacuna::cad_worker
