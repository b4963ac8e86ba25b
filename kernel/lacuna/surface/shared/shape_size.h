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
    /// How the minimum `gap` is reached on four-sided faces and on rings of even width without corners. True:
    /// mapped faces get at least `gap` quads between opposite sides, rings get as many rows, and the size is
    /// not reduced there; rectilinear faces may be submapped. False: the size is reduced; rectilinear faces
    /// are submapped only on request.
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

/// Sizes over the source, and the places that cause the strongest reductions.
struct ShapeSize {
    SizeField at;
    std::optional<SizeCause> curvature; ///< place where the curvature of a face requests the smallest size
    std::optional<SizeCause> width;     ///< narrow place that requests the smallest size
};

/// Reduce the requested size where the source faces are curved or narrow.
///
/// - Curvature: the larger principal curvature k at a vertex of the facets gives the size 2π / (k ·
///   curvature), as Gmsh's MeshSizeFromCurvature does. k is computed from the curvature tensor (@cite
///   cohensteiner_2003_tensor) of the facets around the vertex. On faces without an exact surface, the size
///   is at least half of the facets' size. It is nowhere less than half of the requested size.
/// - Width: a ball that touches a rim from inside is shrunk until no other point of the rims lies in it
///   (@cite ma_2012_ball). It then touches the opposite point, at a distance w. If the rim faces back there,
///   the size is w / gap.
/// - Sag: where the rim has the curvature k, a mesh side may have a sag of at most a quarter of w, so that
///   sides stay away from the opposite rim. Their length is then at most √(2 w / k).
/// - Slivers: if w is less than the requested size, and one rim is divided finer than that because it is
///   curved, a straight edge opposite gets the same size as this rim.
///
/// Two edges with a common corner form a wedge, in which w goes to zero; there the width is ignored. For two
/// edges that share both corners, as on a lens, w is at least the mean width of the face: twice its area
/// divided by the length of its rim.
///
/// From each of these places, the size grows with the distance (`kGrading`). The curvature of edges is not
/// part of the field, because `seed_source()` counts it along each edge.
/// @return  `asked` itself, without causes, if no place requires a smaller size.
/// @note    O(n log n) in the facets and rim points of the source; a size is found in O(log n).
ShapeSize shape_size(const topology::OpenVolume& volume, const SizeField& asked, const ShapeSizing& sizing);

} // namespace lacuna::surface
