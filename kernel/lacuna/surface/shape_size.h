// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/surface/size_field.h>
#include <lacuna/topology/open_volume.h>

#include <optional>

namespace lacuna::surface {

/// How the shape of the source makes its quads smaller where the size asked for is coarser.
struct ShapeSizing {
    int curvature = 12; ///< sides for a full turn of an edge or a surface, >= 0; 0: the size alone
    int gap = 0;        ///< quads at least across a narrow place, >= 0; 0: none are asked for
    /// A face of four sides that is to be mapped gets the gap's quads by counting them across, and no finer
    /// ones along. Where nothing is narrow, faces of right angles are submapped.
    bool counts_across = false;
};

/// What asks for the shortest sides by one rule.
struct SizeCause {
    double size = 0;             ///< asked for [model length]
    FaceId face;                 ///< of the source
    std::optional<EdgeId> edge;  ///< of its rim, one side of a narrow place; without: the face itself bends
    std::optional<EdgeId> other; ///< the edge opposite
    double width = 0;            ///< between the two [model length]
};

/// Sizes over the source, and what made them smaller than was asked.
struct ShapeSize {
    SizeField at;
    std::optional<SizeCause> curvature; ///< of a face
    std::optional<SizeCause> width;     ///< of a narrow place
};

/// The size asked for, made smaller where the source faces are curved, narrow, or so thin that straight sides
/// of one rim would come near the rim opposite.
///
/// - Curvature: the larger principal curvature k at the facets' points asks for 2π / (k · curvature), as
///   Gmsh's MeshSizeFromCurvature. It is the facets' curvature tensor (@cite cohensteiner_2003_tensor), over
///   the facets at a point. Facets without an exact surface ask for nothing finer than half of themselves,
///   and no bend for less than half the size asked for: rims have their own count of sides.
/// - Width: the ball that touches a rim from within is shrunk until it holds no rim
///   (@cite ma_2012_ball). Where the place opposite faces back, their distance w asks for w / gap, and, where
///   the rim has the curvature k, for a side whose sag is a quarter of w at most: √(2 w / k). Edges that
///   share one corner are a wedge, in which no width is the least. Two that share both, as a lens has them,
///   count as no nearer than the face is wide in the mean, twice its area over its rim.
///
/// What is asked for at a place fades with distance from it. The curvature of edges is not in the field:
/// `seed_source()` counts it along each edge.
/// @return  `asked` itself, and no cause, where nothing is finer.
/// @note    O(n log n) in the facets and rim points of the source; a size is found in O(log n).
ShapeSize shape_size(const topology::OpenVolume& volume, const SizeField& asked, const ShapeSizing& sizing);

} // namespace lacuna::surface
