// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/mesh/tet_mesh.h>
#include <lacuna/surface/size_field.h>
#include <lacuna/topology/model.h>

#include <span>
#include <vector>

namespace lacuna::surface {

/// The mesh of a face that must not change, such as a wall of a swept neighbour.
struct FixedFace {
    FaceId face;
    std::vector<Vec3> nodes; ///< [model length]
    std::vector<Quad> quads; ///< corners are indices in `nodes`; a triangle repeats its last corner
};

/// A meshed skin, and the face of each of its cells.
struct SkinMesh {
    mesh::ClosedSkin skin;
    std::vector<FaceId> triangle_face, quad_face;
};

/// Mesh the closed skin of a model with triangles. Faces with fixed or given meshes keep these.
///
/// Algorithm: isotropic remeshing of the facets (@cite botsch_2004_remeshing), all faces at once. In each
/// round:
/// 1. Long sides are split, the longest first.
/// 2. Short sides are collapsed.
/// 3. Sides are flipped if this increases the smallest angle of their two triangles.
/// 4. Each node moves to the centre of its triangles and is projected back onto the face.
///
/// Nodes on edges stay on their edge, and vertices do not move. At the end, nodes move onto the exact curves
/// and surfaces, if there are any. No step may turn a triangle away from the normal of the facets. Departure
/// from the paper: the remaining small angles are then improved one by one (@cite hu_2017_remeshing).
///
/// Sides are shorter than requested in two cases:
/// - Narrow faces: down to a tenth of the requested size.
/// - Curved faces: so short that the volume within the skin differs from that of the model by at most about
///   half a percent.
///
/// Sizes grow by `kGrading` away from these places and from the nodes of fixed faces. If facets of a face
/// meet at an angle of more than `kCreaseAngle`, the crease between them is kept.
/// @param size  target length of the triangles' sides [model length]
/// @pre   the faces of the model are oriented outward.
/// @post  vertices and given nodes are kept bit for bit.
/// @throw InvalidInput "surface.skin_open"  an edge is not used twice; names it; "sweep.size"  a size is not
///         a positive length; or as `topology::give_mesh()` for the fixed faces.
/// @throw NotSweepable "surface.skin_count"  more than 1e7 triangles are needed; "surface.skin_folds",
///         "surface.skin_crosses"  triangles fold or cross at this size; names the faces.
/// @throw Cancelled
/// @note  Deterministic for any number of threads. O(n log n) in facets and triangles.
SkinMesh triangulate_skin(const topology::Model& model, const SizeField& size,
                          std::span<const FixedFace> fixed = {}, const RunContext& context = {});

} // namespace lacuna::surface
