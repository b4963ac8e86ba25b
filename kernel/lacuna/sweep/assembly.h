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

/// One volume of an assembly.
struct AssemblyMember {
    const topology::OpenVolume* volume = nullptr; ///< the sealed volume of this member
    SweepOptions options;
    std::string region; ///< its name, for messages and groups
    /// A given mesh, which is not changed; or null. With a given mesh, `volume` is the skin of that mesh and
    /// keeps its quads, and `Swept::faces` refers to `volume`. Only the option `order` applies.
    const Swept* fixed = nullptr;
    /// For a piece of a full turn, the name of the whole turn. The volumes of its pieces are checked together
    /// under that name. Empty otherwise.
    std::string turn_of = {};
    /// For a piece of a volume, the name of that volume. The piece's cells are in the group of that name, and
    /// faces between two pieces are in no group. Empty otherwise.
    std::string whole = {};
    /// The volume of which this member is a piece. The faces of that volume define the groups of the piece's
    /// faces. Null if unknown.
    const topology::OpenVolume* piece_of = nullptr;
    bool alone = false;   ///< this is the only member, or all members are pieces of one volume
    bool unswept = false; ///< not swept: the caller meshes it after the others; see `Unswept`
    /// Members with the same number share faces and nodes. Members with different numbers are not joined;
    /// `faces_in_contact()` finds where they touch.
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
    FaceId face_a, face_b;                  ///< the two faces; if `edge` is set, it bounds one of them
    std::optional<EdgeId> edge;             ///< the edge of member `edge_of`, if an edge is close
    std::size_t edge_of = 0;                ///< a or b
    int tag_a = 0, tag_b = 0, edge_tag = 0; ///< tags of the faces and the edge, as shown to the user
    double least = 0, width = 0;            ///< smallest and largest distance [model length]
    bool reach_in = false;                  ///< the members overlap, and the distances above are depths
    double area = 0;                        ///< area of the faces within that distance [model length²]
    double length = 0;                      ///< length of the edge within that distance [model length]
    /// The tolerance that would join the faces if both models had it [model length].
    double tolerance = 0;
    Message message{"assembly.near_miss", "a near miss"}; ///< the fields above as a note
};

/// The faces shared by members. Two faces are shared if they are the same surface within the tolerance, even
/// if their facets differ, or if one of them is void and has the same rim as the other.
/// @throw InvalidInput "assembly.part_of_face"  a face covers only part of another member's face;
///         "assembly.overlap"  two volumes lie on the same side of a shared face, or overlap;
///         "assembly.rims_apart"  the rims of a shared face differ by more than the tolerance, but by less
///         than a thousand times the tolerance; "assembly.crack"  faces touch in part or along an edge, and
///         elsewhere have a gap in the same range. The message names the faces and members.
/// @note  O(facets log facets) over faces whose boxes overlap.
std::vector<SharedFace> shared_faces(std::span<const AssemblyMember> members, const RunContext& context = {});

/// Two faces of two members that touch, or face each other within a gap, without shared nodes.
struct FaceContact {
    std::size_t a = 0, b = 0; ///< indices in the list of members, a < b
    FaceId face_a, face_b;
    double least = 0, width = 0; ///< smallest and largest distance within the gap [model length]
    double area = 0;             ///< area of the first face within the gap of the other [model length²]
};

/// Find the pairs of faces of two members in contact. These contacts are omitted:
/// - contacts between pieces of one volume;
/// - contacts of touching faces of members with the same `AssemblyMember::glue`;
/// - contacts across a gap, of a face that mostly lies on another member.
/// @param gap  returns the largest distance at which faces of two members are in contact [model length].
/// @throw InvalidInput "assembly.overlap"  members that are not glued overlap, as for `shared_faces()`.
/// @note  cost as for `shared_faces()`.
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
    std::size_t member = 0; ///< its index in the list of members
    /// The volume itself. As in swept volumes, a face that is shared only in part is split.
    topology::OpenVolume volume;
    std::optional<Message> why; ///< message of the error; empty: the caller requested that it is not swept
};

/// Hexahedra of several sweeps with common nodes at shared faces.
struct SweptAssembly {
    std::vector<Swept> parts;        ///< in the members' order, each with its own numbering
    std::vector<std::size_t> member; ///< for each part, its index in the list of members
    std::vector<LeftOut> left_out;   ///< members without a part
    std::vector<Unswept> unswept;    ///< members that are not swept
    /// Faces that an unswept member shares with any other member; `a` and `b` index the list of members.
    std::vector<SharedFace> beside;
    /// For each part, the number of each of its nodes in the whole mesh, from 0. Parts are numbered in order.
    /// A node that also belongs to an earlier part has the number from that part.
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
/// First, one interval assignment over the whole assembly places the nodes of shared edges. Volumes with a
/// common side line get equal numbers of layers, so the `layers` of one volume also apply to its neighbours.
/// Then volumes are meshed one after the other. Each volume keeps the meshes of its neighbours on shared
/// faces, node for node. If a volume cannot keep these meshes, it is moved to the start of the order, and all
/// volumes are meshed again. A void face with the same rim as a neighbour's given face counts as the same
/// face.
///
/// Faces that are shared in part are first split along each other's rims. `shared` and the faces of the parts
/// then refer to the split volumes, in which the members' own faces come first.
///
/// Cells of a member are in a group of its name, and cells of all members in `volume`. Groups of roles are
/// prefixed with the member's name, `fluid:source`; groups of a face's name exist with and without the
/// prefix. A single volume has the groups of `sweep()`.
///
/// Parts of members with the option `layered` may generate their nodes on demand instead of storing them.
/// Fixed members become parts first and unchanged, and their neighbours keep their quads on shared faces. A
/// member that cannot be meshed is meshed with wedges, left out, or listed as not swept, as its `fallback`
/// says; the assembly is then computed again.
///
/// Faces of `SweepOptions::periodic` get the same mesh as their images. An edge and its image count as one
/// edge in the interval assignment. A face whose image is on another member gets the image's quads. If a face
/// and its image are on the same member, the nodes of both faces are moved before the proof, so that they are
/// exact images, and are then fixed. If the motion is a translation, nodes and images are bit-identical
/// unless both are given.
/// @throw NotSweepable  as `sweep()`, with the name of the region; "sweep.periodic_unlike"  the quads of two
///         periodic faces of a member have different connectivity; "assembly.layers"  different numbers of
///         layers are requested for volumes side by side; "assembly.layers_differ"  boundary layers of
///         several volumes end on one edge with different heights; "assembly.layers_rows"  an edge has too
///         few sides for its boundary layers; "assembly.round"  each volume of a cycle lacks a face that the
///         next one has; "assembly.not_shared"  two meshes differ on a shared face;
///         "assembly.hanging_node"  a node of one mesh lies within a side of another mesh.
/// @throw InvalidInput  as `shared_faces()` and `sweep()`; "sweep.periodic_faces"  no motion moves the faces
///         of a pair onto each other; "sweep.periodic_given"  given nodes of such faces differ;
///         "assembly.part_of_face"  a face that is shared in part keeps its quads, or cannot be split.
/// @post  conformal: every quad of a shared face belongs to both volumes, no node of one lies inside a side
///        or a quad of another, and each volume is proved as in `sweep()`, its shape against its own sealed
///        skin.
SweptAssembly sweep_assembly(std::span<const AssemblyMember> members, const RunContext& context = {});

} // namespace lacuna::sweep
