// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/message.h>
#include <lacuna/core/run_context.h>
#include <lacuna/mesh/mesh_part.h>
#include <lacuna/sweep/sweep.h>
#include <lacuna/topology/open_volume.h>

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace lacuna::sweep {

/// Faces further apart than the tolerance, but by no more than this factor, were probably meant to touch: CAD
/// kernels leave gaps of up to about a thousandth of a model. Heuristic.
inline constexpr double kNearMiss = 1000;

/// One volume of an assembly.
struct AssemblyMember {
    const topology::OpenVolume* volume = nullptr; ///< sealed
    SweepOptions options;
    std::string region; ///< its name, for messages and groups
    /// A given mesh, which is not changed; or null. With a given mesh, `volume` is its skin and keeps its
    /// quads, and the mesh's `faces` refer to `volume`. Of the options only `order` applies.
    const Swept* fixed = nullptr;
    /// For a piece of a full turn, the region of the whole turn: the volumes of its pieces are checked
    /// together. Empty otherwise.
    std::string turn_of = {};
    /// For a piece of a volume, the volume's name: its cells are in the group of that name, and faces between
    /// two pieces of one volume are in no group. Empty otherwise.
    std::string whole = {};
    /// That volume, whose faces define the roles of the piece's faces in groups. Null if unknown.
    const topology::OpenVolume* piece_of = nullptr;
    bool alone = false;   ///< it is the only volume, or all members are pieces of one volume
    bool unswept = false; ///< not swept: the caller meshes it beside the others; see `Unswept`
    /// Members with the same number share faces and nodes; see `faces_in_contact()` for others.
    std::size_t glue = 0;
};

/// A face shared by two members, one on each side.
struct SharedFace {
    std::size_t a = 0, b = 0; ///< indices in the list of members, a < b
    FaceId face_a, face_b;
};

/// Two members that come close to each other without shared nodes: two faces facing each other, or an edge of
/// one along a face of the other.
struct NearMiss {
    std::size_t a = 0, b = 0;               ///< indices in the list of members, a < b
    FaceId face_a, face_b;                  ///< the two faces; with `edge` one of them bounds it
    std::optional<EdgeId> edge;             ///< the edge of member `edge_of`, if an edge is close
    std::size_t edge_of = 0;                ///< a or b
    int tag_a = 0, tag_b = 0, edge_tag = 0; ///< tags of the faces and the edge, as shown to the user
    double least = 0, width = 0;            ///< smallest and largest distance [model length]
    bool reach_in = false;                  ///< the members overlap, and the distances above are depths
    double area = 0;                        ///< area of the faces within that distance [model length²]
    double length = 0;                      ///< length of the edge within that distance [model length]
    /// Tolerance of both models that would join the faces [model length].
    double tolerance = 0;
    Message message{"assembly.near_miss", "a near miss"}; ///< the fields above as a note
};

/// The faces shared by members. Two faces are shared if they are the same surface within the tolerance,
/// whatever their facets, or if one is void and has the same rim.
/// @throw InvalidInput "assembly.part_of_face"  a face that covers only part of another's;
///                     "assembly.overlap"  two volumes on the same side of a face, or overlapping volumes;
/// "assembly.rims_apart"  one face whose rims are apart by more than the tolerance and less than `kNearMiss`
/// times the tolerance; "assembly.crack"  faces that touch in part, or along an edge, and are apart elsewhere
/// by a distance in that range. Names them.
/// @note  O(facets log facets) over faces whose boxes meet.
std::vector<SharedFace> shared_faces(std::span<const AssemblyMember> members, const RunContext& context = {});

/// Two faces of two members that touch, or face each other within a gap, without shared nodes.
struct FaceContact {
    std::size_t a = 0, b = 0; ///< indices in the list of members, a < b
    FaceId face_a, face_b;
    double least = 0, width = 0; ///< smallest and largest distance within the gap [model length]
    double area = 0;             ///< area of the first face within the gap of the other [model length²]
};

/// The faces of members in contact. Pieces of one volume have none with each other, glued members only where
/// they share no face, and a face that mostly lies on another member only with that.
/// @param gap  of two members: the largest distance of faces in contact [model length].
/// @throw InvalidInput "assembly.overlap"  as `shared_faces()`, of members that are not glued.
/// @note  as `shared_faces()`
std::vector<FaceContact> faces_in_contact(std::span<const AssemblyMember> members,
                                          const std::function<double(std::size_t a, std::size_t b)>& gap,
                                          const RunContext& context = {});

/// Check the names and orders of members that become one mesh, glued or not.
/// @throw InvalidInput "assembly.same_name", "assembly.order"
void check_alike(std::span<const AssemblyMember> members);

/// A volume of an assembly that could not be meshed and was left out.
struct LeftOut {
    std::string region; ///< its name
    Message message;    ///< message of the error
};

/// A volume of an assembly that was not swept, either on request or because its sweep failed with
/// `Fallback::mixed`.
struct Unswept {
    std::size_t member = 0;      ///< its index in the list of members
    topology::OpenVolume volume; ///< where it shares parts of faces, its faces are split as in the swept
                                 ///< volumes
    std::optional<Message> why;  ///< message of the error; empty: it was requested not to be swept
};

/// Hexahedra of several sweeps with common nodes at shared faces.
struct SweptAssembly {
    std::vector<Swept> parts;        ///< in the members' order, each with its own numbering
    std::vector<std::size_t> member; ///< for each part, its index in the list of members
    std::vector<LeftOut> left_out;   ///< members without a part
    std::vector<Unswept> unswept;    ///< members that are not swept
    /// Faces that unswept members share with others and with each other; `a` and `b` index the list of
    /// members.
    std::vector<SharedFace> beside;
    /// For each part, the number of each of its nodes in the whole mesh, from 0. Numbers follow the order of
    /// the parts; a node that an earlier part has keeps that part's number.
    std::vector<mesh::NodeNumbers> numbering;
    std::size_t nodes = 0;                     ///< number of nodes of the whole mesh
    std::vector<mesh::PeriodicNodes> periodic; ///< one for each pair of `SweepOptions::periodic`
    std::vector<SharedFace> shared;            ///< faces with common quads; `a` and `b` index `parts`
    std::vector<NearMiss> near_misses;         ///< `a` and `b` index `parts`
    /// A line for each shared face and each near miss, and the order of meshing.
    std::vector<std::string> report;
};

/// Sweep several sealed volumes with common quads on shared faces.
///
/// First the shared edges get their nodes by one interval assignment over the whole assembly (`layers` of one
/// volume also apply to the volumes beside it). Then volumes are meshed one after the other, each keeping its
/// neighbours' meshes on shared faces, node for node. If a volume cannot keep them, the order is changed so
/// that it comes first. A void face with the same rim as a neighbour's given face is that face. Cells of a
/// member are in a group of its name, cells of all members in `volume`. Groups of roles are prefixed by the
/// member's name, `fluid:source`; groups of a face's name exist with and without the prefix. A single volume
/// has the groups of `sweep()`.
/// Members with the option `layered` may become parts that do not hold their nodes.
/// Fixed members become parts unchanged and first: their neighbours keep their quads on shared faces.
/// A member that cannot be meshed this way is meshed with wedges or left out, as its `fallback` says, and the
/// assembly is then computed again without it. With `Fallback::mixed` it is then one that is not swept.
///
/// Faces of `SweepOptions::periodic` get the same mesh: the edges around them are one edge in the interval
/// assignment, a face of another member gets its image's quads, and nodes of two faces of one member are
/// moved onto each other before the proof, and then fixed. After a translation nodes are equal bit for
/// bit, unless both are given.
/// @throw NotSweepable  as `sweep()`, the region named; "sweep.periodic_unlike"  two faces of a member whose
///         quads are not connected alike; "assembly.layers"  volumes side by side for which
///         other numbers of layers are asked; "assembly.layers_differ", "assembly.layers_rows"  boundary
///         layers of several volumes that cannot be on one edge, or for which it has too few sides;
///         "assembly.round"  volumes each of which lacks a face that the next one has;
///         "assembly.not_shared"  a shared face on which two meshes differ;
///         "assembly.hanging_node"  a node of one mesh within a side of another's.
/// Partially shared faces are split along each other's rims first; the faces of `shared` and of the parts
/// then belong to the split volumes, whose first faces are the members' own.
/// @throw InvalidInput  as `shared_faces()` and `sweep()`; "sweep.periodic_faces"  faces that no motion makes
///         equal; "sweep.periodic_given"  given nodes of such faces that differ; "assembly.part_of_face"
///         where a face that is shared in part keeps its quads, or cannot be split.
/// @post  conformal: every quad of a shared face belongs to both volumes, no node of one lies inside a side
///        or a quad of another, and each volume is proved as in `sweep()`, its shape against its own sealed
///        skin.
SweptAssembly sweep_assembly(std::span<const AssemblyMember> members, const RunContext& context = {});

} // namespace lacuna::sweep
