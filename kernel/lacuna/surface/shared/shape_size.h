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
    /// How `gap` is met. If set, mapped faces with four corners get at least `gap` quads between opposite
    /// sides, and the size is not reduced there. Rectilinear faces may then be submapped although `gap` is
    /// set.
    bool counts_across = false;
};

/// The smallest size that one rule requests.
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
    std::optional<SizeCause> curvature; ///< place where curvature of a face requests the smallest size
    std::optional<SizeCause> width;     ///< narrow place that requests the smallest size
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
///   sides have a sag of at most a quarter of w, so their length is at most √(2 w / k). If w is less than the
///   requested size, the sides that the curvature of one rim asks for limit those of a straight edge
///   opposite, too; otherwise quads between the two would be slivers. Edges that share one corner form a
///   wedge, which has no minimum width. For two edges that share both corners, as on a lens, the distance w
///   is at least the mean width of the face: twice its area divided by the length of its rim.
///
/// The influence of a place decreases with the distance from it. The field does not contain the curvature of
/// edges, because `seed_source()` counts it along each edge.
/// @return  `asked` itself, without causes, if no place requires a smaller size.
/// @note    O(n log n) in the facets and rim points of the source; a size is found in O(log n).
ShapeSize shape_size(const topology::OpenVolume& volume, const SizeField& asked, const ShapeSizing& sizing);

} // namespace lacuna::surface
