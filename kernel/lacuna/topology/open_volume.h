// SPDX-License-Identifier: MIT
#pragma once

// In: a model of vertices, edges and faces; out: its faces with roles as an open volume, and the class of
// the volume.
//
// Where to change things:
//   arrays of a model, building them     model.h, model.cpp
//   checks of an open volume, its class  open_volume.cpp
//   roles if none are named              auto_roles.cpp, end_costs.cpp, wall_parts.cpp
//   walls of given ends                  auto_walls.cpp
//   candidates for ends                  patches.cpp
//   free loops, rims of faces            rims.cpp
//   hollows of a solid, bodies inside    hollows.cpp
//   narrow gaps between parts            gaps.cpp
//   splitting faces along a plane        section.cpp; points on facet sides: side_points.cpp
//   splitting an edge                    split_edge.cpp
//   given nodes and quads                give_mesh.cpp
//   selecting faces, facts about them    select_faces.cpp, face_facts.cpp, face_radius.cpp
//   groups of faces in files             skin_groups.cpp
//   faces left out of a CAD file         left_out.cpp

#include <lacuna/core/message.h>
#include <lacuna/core/run_context.h>
#include <lacuna/topology/model.h>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace lacuna::topology {

/// The five classes of open volumes (Table 1 of @cite mukherjee_2014_open), `closed` for a volume without
/// missing faces, and class 0, which is not in that table: a source alone, swept along a path that the caller
/// gives.
enum class VolumeClass { closed, I, II, III, IV, V, zero };

std::string_view to_string(VolumeClass value);

/// Role of a face in the sweep.
enum class Role { source, target, wall };

/// Faces by role; every list may be empty.
struct Roles {
    std::vector<FaceId> source, target, walls;
};

/// The faces of one void, with their roles. The model contains only these faces. They are oriented
/// consistently, and outward if they enclose a volume. Closing the volume adds void entities to the model.
struct OpenVolume {
    Model model;
    std::vector<Role> role; ///< for each face of `model`
    std::optional<VolumeClass> override_class;
    bool turned_round = false; ///< whether only a target was given, so that it became the source
    bool full_turn = false;    ///< whether the walls form a closed ring, swept by 360° onto its start

    [[nodiscard]] std::vector<FaceId> faces(Role wanted) const;
    /// For each vertex of the model, whether it is on a wall.
    [[nodiscard]] std::vector<bool> on_wall() const;
};

/// Extract the named faces from `model` and make a volume of them.
/// @throw InvalidInput  a face has two roles or is named twice; there are no faces; faces cannot be oriented.
/// @throw Cancelled
OpenVolume open_volume(const Model& model, const Roles& roles, const RunContext& context = {});

/// A model of the named faces only, in that order, with the edges, vertices and points they use.
Model extract(const Model& model, const std::vector<FaceId>& faces);

/// The connected parts of the named faces, by shared edges; in the order of their first faces.
std::vector<std::vector<FaceId>> connected_parts(const Model& model, const std::vector<FaceId>& faces);

/// V − E + F of the faces' facets: 0 for a tube, 1 for a disc. For connected faces without handles, it is 2
/// minus the number of rims.
long euler_number(const Model& model, const std::vector<FaceId>& faces);

/// Reverse the orientation of faces.
void flip_faces(Model& model, const std::vector<FaceId>& faces);

/// The facets' contribution to the enclosed volume, positive if they face outward; equals the volume only for
/// a closed skin [model length³].
double volume_integral(const Model& model, const std::vector<FaceId>& faces);

/// The volume between the facets and an apex: what the faces enclose if their rims are closed by cones to the
/// apex [model length³]. Negative where the facets face the apex.
double volume_of_cones(const Model& model, const std::vector<FaceId>& faces, const Vec3& apex);

/// A closed chain along the border of a set of faces, with the faces on its left.
struct Rim {
    std::vector<EdgeUse> uses;
};

/// The border of a set of faces as closed chains of the edges that the set uses once; longest first. Where
/// several chains meet in a vertex, a chain arrives and leaves on the two sides of one fan of faces (faces
/// round the vertex that are connected over edges).
std::vector<Rim> rims(const Model& model, const std::vector<FaceId>& faces);

/// The loops of a face without its seams, which are inside the face. A tube with a seam has two border loops;
/// a dome whose loop runs up and down a seam has one. Without a seam, these are the face's own loops.
std::vector<Loop> border_loops(const Model& model, FaceId face);

/// Edges used once by the faces of the volume, and the loops they form.
std::vector<EdgeId> free_edges(const OpenVolume& volume);
std::vector<Rim> free_loops(const OpenVolume& volume);

/// The class of a volume, with the reasons for the user.
struct Classification {
    VolumeClass value = VolumeClass::closed;
    std::vector<Rim> free_loops;
    std::vector<VertexId> wall_free_source; ///< vertices on the source's rims that are on no wall
    std::vector<VertexId> wall_free_target;
    std::vector<std::string> reasons;
};

/// Find the class of a volume. If `override_class` is set, that is the class.
/// @throw InvalidInput  `override_class` contradicts the faces; names the contradiction.
Classification classify(const OpenVolume& volume);

/// A face, an edge or a vertex for a message: `face 12`, `face 12 "lid"`, `edge 3 (vertices 4-9)`,
/// `vertex 4`.
NamedEntity entity_of(const Model& model, FaceId face);
NamedEntity entity_of(const Model& model, EdgeId edge);
NamedEntity entity_of(const Model& model, VertexId vertex);
/// The text of `entity_of()`.
std::string name_of(const Model& model, FaceId face);
std::string name_of(const Model& model, EdgeId edge);
std::string name_of(const Model& model, VertexId vertex);

} // namespace lacuna::topology
