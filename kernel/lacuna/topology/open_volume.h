// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/topology/model.h>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace lacuna::topology {

/// The five classes of the paper's Table 1, and a volume that misses nothing.
enum class VolumeClass { closed, I, II, III, IV, V };

std::string_view to_string(VolumeClass value);

/// What a face is to the sweep.
enum class Role { source, target, wall };

/// Faces by the part they play; every list may be empty.
struct Roles {
    std::vector<FaceId> source, target, walls;
};

/// The faces of one void, with their roles. Its model is its own: only the faces named, one orientation,
/// outward where that can be known, and whatever closing adds.
struct OpenVolume {
    Model model;
    std::vector<Role> role; ///< of each face of `model`
    std::optional<VolumeClass> override_class;
    bool turned_round = false; ///< a target was given and no source: the two have changed places
    bool full_turn = false;    ///< a ring of walls alone, swept round its whole turn onto its own start

    [[nodiscard]] std::vector<FaceId> faces(Role wanted) const;
    /// Of each vertex of the model, whether it is on a wall.
    [[nodiscard]] std::vector<bool> on_wall() const;
};

/// Take the faces named out of `model` and make them a volume.
/// @throw InvalidInput  a face in two roles or named twice, no face at all, faces that cannot be oriented.
///         Cancelled.
OpenVolume open_volume(const Model& model, const Roles& roles, const RunContext& context = {});

/// A model of the faces named alone, in that order, with the edges, vertices and points they use.
Model extract(const Model& model, const std::vector<FaceId>& faces);

/// Which faces use an edge, and which way.
struct FaceUse {
    FaceId face;
    bool reversed = false;
};

/// Uses of every edge by the faces' loops; a seam is used twice by its face.
std::vector<std::vector<FaceUse>> edge_uses(const Model& model);

/// The faces named, as parts that hang together by shared edges; in order of their first face.
std::vector<std::vector<FaceId>> connected_parts(const Model& model, const std::vector<FaceId>& faces);

/// V − E + F of the faces' facets: 0 for a tube, 1 for a disc; 2 less the number of rims for anything
/// without handles.
long euler_number(const Model& model, const std::vector<FaceId>& faces);

/// Turn faces over.
void flip_faces(Model& model, const std::vector<FaceId>& faces);

/// What the facets contribute to the volume enclosed, positive outward; a volume only for a closed skin
/// [model length³].
double volume_integral(const Model& model, const std::vector<FaceId>& faces);

/// A closed walk along the border of a set of faces, the faces on its left.
struct Rim {
    std::vector<EdgeUse> uses;
};

/// The border of a set of faces: edges that the set uses once, as closed walks. At a vertex where several
/// walks meet they are told apart by the fan of facets between them. Longest first.
std::vector<Rim> rims(const Model& model, const std::vector<FaceId>& faces);

/// The loops of a face without its seams: edges it uses both ways are inside of it. A dome whose loop runs up
/// a seam and back is a disc, a tube with a seam has two loops. The loops as they are where there is no seam.
std::vector<Loop> border_loops(const Model& model, FaceId face);

/// Edges used once by all faces of the volume, and the walks they make.
std::vector<EdgeId> free_edges(const OpenVolume& volume);
std::vector<Rim> free_loops(const OpenVolume& volume);

/// Table 1, with the reasons in words.
struct Classification {
    VolumeClass value = VolumeClass::closed;
    std::vector<Rim> free_loops;
    std::vector<VertexId> wall_free_source; ///< source rim vertices on no wall
    std::vector<VertexId> wall_free_target;
    std::vector<std::string> reasons;
};

/// Which class the volume is of, the override obeyed.
/// @throw InvalidInput  an override that contradicts the faces; says which.
Classification classify(const OpenVolume& volume);

/// A face as messages name it: `face 12`, or `face 12 "lid"`.
std::string name_of(const Model& model, FaceId face);
std::string name_of(const Model& model, EdgeId edge);
std::string name_of(const Model& model, VertexId vertex);

} // namespace lacuna::topology
