// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/surface/size_field.h>
#include <lacuna/topology/open_volume.h>

#include <optional>

namespace lacuna::surface {

/// How the shape of the source reduces the requested size.
struct ShapeSizing {
    int curvature = 12; ///< sides for a full turn of an edge or a surface, >= 0; 0: the size alone
    int gap = 0;        ///< minimum number of quads across a narrow place, >= 0; 0: no minimum
    /// Meet `gap` on a mapped four-sided face by its number of sides across; the sides along the narrow place
    /// stay long. If no place is narrow, rectilinear faces are submapped.
    bool counts_across = false;
};

/// The shortest sides that one rule requests.
struct SizeCause {
    double size = 0;             ///< requested [model length]
    FaceId face;                 ///< face of the source
    std::optional<EdgeId> edge;  ///< edge of its rim, one side of a narrow place; unset: curvature
    std::optional<EdgeId> other; ///< the edge opposite
    double width = 0;            ///< distance between the two edges [model length]
};

/// Sizes over the source, and the causes of the reduction.
struct ShapeSize {
    SizeField at;
    std::optional<SizeCause> curvature; ///< cause by the curvature of a face
    std::optional<SizeCause> width;     ///< cause by a narrow place
};

/// Reduce the requested size where the source faces are curved or narrow, or so thin that straight sides of
/// one rim would come close to the opposite rim.
///
/// - Curvature: the larger principal curvature k at the facets' vertices gives 2π / (k · curvature), as
///   Gmsh's MeshSizeFromCurvature. It is the facets' curvature tensor (@cite cohensteiner_2003_tensor), over
///   the facets at a vertex. Facets without an exact surface give no less than half their own size, and no
///   bend less than half the requested size: rims have their own count of sides.
/// - Width: the ball that touches a rim from inside is shrunk until it contains no rim (@cite ma_2012_ball).
///   If the opposite point faces back, the distance w gives w / gap and, where the rim has the curvature k, a
///   side with a sag of at most a quarter of w: √(2 w / k). Edges that share one corner form a wedge, which
///   has no minimum width. Two that share both corners, as on a lens, count as no closer than the mean width
///   of the face, twice its area over its rim.
///
/// The influence of a place fades with distance. The curvature of edges is not in the field: `seed_source()`
/// counts it along each edge.
/// @return  `asked` itself, and no cause, if nothing is finer.
/// @note    O(n log n) in the facets and rim points of the source; a size is found in O(log n).
ShapeSize shape_size(const topology::OpenVolume& volume, const SizeField& asked, const ShapeSizing& sizing);

} // namespace lacuna::surface
