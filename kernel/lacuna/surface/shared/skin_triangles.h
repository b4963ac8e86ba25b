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
/// Algorithm: isotropic remeshing of the facets (@cite botsch_2004_remeshing), all faces at once. Long sides
/// are split, the longest first, and short sides are collapsed. Flips increase the smaller angle of two
/// triangles. Nodes move to the centres of their triangles and back to the face. Nodes on edges stay on their
/// edge, and vertices do not move. At the end nodes are moved onto exact curves and surfaces where there are
/// any. No step turns a triangle away from the normal of the facets. Departure from the paper: the remaining
/// small angles are then improved one by one (@cite hu_2017_remeshing).
///
/// Sides are shorter than requested where faces are narrow, down to a tenth of the requested size, and where
/// they are curved, so that the volume within the skin differs from that of the model by at most about half a
/// percent. Sizes grow by `kGrading` away from these places and from the nodes of fixed faces.
///
/// Where facets of a face meet at an angle of more than `kCreaseAngle`, the crease between them is kept.
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
