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
    /// Mapped faces with four corners meet `gap` by at least that many quads between opposite sides, without
    /// a smaller size. Rectilinear faces may be submapped although `gap` is set.
    bool counts_across = false;
};

/// The shortest sides that one rule requests.
struct SizeCause {
    double size = 0; ///< requested [model length]
    FaceId face;     ///< face of the source
    /// One of the two edges of a narrow place, on the face's rim; empty: curvature is the cause.
    std::optional<EdgeId> edge;
    std::optional<EdgeId> other; ///< the other edge of the narrow place
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
/// - Curvature: the larger principal curvature k at the facets' vertices gives the size 2π / (k · curvature),
///   as Gmsh's MeshSizeFromCurvature does. It is computed from the curvature tensor (@cite
///   cohensteiner_2003_tensor) of the facets around a vertex. On faces without an exact surface, the size is
///   at least half of the facets' size. Nowhere is it less than half of the requested size; rims have their
///   own numbers of sides.
/// - Width: a ball that touches a rim from inside is shrunk until it contains no rim (@cite ma_2012_ball). If
///   the opposite point faces back at a distance w, the size is w / gap. Where the rim has the curvature k,
///   sides have a sag of at most a quarter of w, so their length is at most √(2 w / k). Edges that share one
///   corner form a wedge, which has no minimum width. Two edges that share both corners, as on a lens, count
///   as no closer than the mean width of the face: twice its area divided by the length of its rim.
///
/// The influence of a place fades with distance. The field does not contain the curvature of edges, because
/// `seed_source()` counts it along each edge.
/// @return  `asked` itself, without causes, if no place requires a smaller size.
/// @return  `asked` itself, and no cause, if nothing is finer.
/// @note    O(n log n) in the facets and rim points of the source; a size is found in O(log n).
ShapeSize shape_size(const topology::OpenVolume& volume, const SizeField& asked, const ShapeSizing& sizing);

} // namespace lacuna::surface
