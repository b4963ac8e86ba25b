// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/mesh/hex_mesh.h>
#include <lacuna/mesh/layered_nodes.h>
#include <lacuna/mesh/tet_mesh.h>
#include <lacuna/surface/shared/face_shape.h>
#include <lacuna/sweep/fidelity.h>

#include <cstddef>
#include <vector>

namespace lacuna::sweep {

/// The quads of the skin on one face. At order 2, each quad or triangle is divided into four at its middle
/// nodes.
struct SkinOfFace {
    FaceId face;
    std::vector<Quad> quads; ///< corners are indices of `Skin::points`
    /// For each quad, the index of the quad or triangle of the mesh's skin that it is part of.
    std::vector<std::size_t> item;
    std::vector<double> side; ///< the longest side of each quad [model length]
    double mean_side = 0;     ///< mean of `side` [model length]
};

/// The nodes on a mesh's skin, renumbered, with the quads of every face.
struct Skin {
    std::vector<Vec3> points;      ///< in the mesh's order: nodes of the source come first [model length]
    std::vector<SkinOfFace> faces; ///< one entry for each face of the model, in its order
};

/// The quads of a mesh's skin by face of the model; each quad of order 2 becomes four.
/// @param faces       face of each patch of the mesh
/// @param face_count  number of faces of the model
/// @note  O(n log n) in the nodes of the skin.
Skin skin_of(const mesh::SkinNodes& nodes, const std::vector<FaceId>& faces, std::size_t face_count,
             const RunContext& context = {});

/// Allowed distance between a face and its quads: a length, or a share of a quad's side.
struct DeviationLimit {
    double length = 0; ///< the same for all quads [model length]; 0: a share of the side
    /// Allowed distance as a share of the side of a quad. Within two sides of a tip of the face, such as the
    /// apex of a cone, a whole side is allowed, because at most four quads meet there.
    double share = 0;
    double least = 0; ///< lower bound of the allowed distance, for short sides [model length]
    /// Whether inverted quads are reported as folds. False for void faces: if such a face is sharply twisted,
    /// the facet nearest to a quad may have any orientation.
    bool folds = true;
};

/// Set the largest and the mean distance from those of the faces.
void sum_distances(Fidelity& fidelity, const topology::Model& model);

/// The limit for a face of a volume.
DeviationLimit limit_of(const topology::Model& model, FaceId face, const FidelityOptions& options);

/// The skin of tetrahedra and pyramids by face of the model. It contains triangles as well as quads.
Skin skin_of(const mesh::TetPart& mesh, const std::vector<FaceId>& faces, std::size_t face_count);

/// Compare a face with its quads.
/// @param mesh  shows whether a deviating side runs from layer to layer; null: there are no layers.
/// @param sign  -1 if the faces of the model look inward, else 1.
/// @throw Cancelled
/// @note  Deterministic for any thread count. Near linear in quads and facets if they are close to each
///        other.
FaceFidelity compare_face(const mesh::HexMesh* mesh, const Skin& skin, const SkinOfFace& quads,
                          surface::FaceShape shape, double sign, const DeviationLimit& limit,
                          const RunContext& context);

} // namespace lacuna::sweep
