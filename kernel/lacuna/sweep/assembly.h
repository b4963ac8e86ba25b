// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/mesh/mesh_part.h>
#include <lacuna/sweep/sweep.h>
#include <lacuna/topology/open_volume.h>

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace lacuna::sweep {

/// What is further apart than the tolerance and no further than this many times it is likely to have been
/// meant to touch: CAD kernels leave gaps of up to about a thousandth of a model. A choice.
inline constexpr double kNearMiss = 1000;

/// One volume of an assembly.
struct AssemblyMember {
    const topology::OpenVolume* volume = nullptr; ///< sealed
    SweepOptions options;
    std::string region; ///< its name, for messages and groups
    /// Null, or the mesh it came with, which stays as it is: then `volume` is its skin, whose faces keep
    /// their quads, and `faces` of it are those of `volume`. Of the options `order` alone counts.
    const Swept* fixed = nullptr;
    /// Of a piece of a full turn, the region that the whole is: their volumes are judged together. Empty: it
    /// is no such piece.
    std::string turn_of = {};
    /// Of a piece of a volume, the volume's name: its cells are in the group of that name, and faces between
    /// two pieces of one volume are in no group. Empty: it is no piece.
    std::string whole = {};
    /// That volume, whose faces have the roles that the piece's have in groups. Null: it is not known.
    const topology::OpenVolume* piece_of = nullptr;
    bool alone = false; ///< it, or the volume it is a piece of, is all there is
};

/// A face that two members have in common, each on its own side of it.
struct SharedFace {
    std::size_t a = 0, b = 0; ///< places in the list of members, a < b
    FaceId face_a, face_b;
};

/// A place where two members come near each other and share no nodes: faces over each other, or an edge of
/// one along a face of the other.
struct NearMiss {
    std::size_t a = 0, b = 0;   ///< places in the list of members, a < b
    FaceId face_a, face_b;      ///< that lie over each other, or that the edge bounds and runs along
    std::optional<EdgeId> edge; ///< of the member `edge_of`, if it is an edge's
    std::size_t edge_of = 0;    ///< a or b
    int tag_a = 0, tag_b = 0, edge_tag = 0; ///< of the faces and the edge, as the person knows them
    double least = 0, width = 0; ///< how far they are apart, at the least and at the most [model length]
    bool reach_in = false;       ///< they are not apart there but reach into each other by that
    double area = 0;             ///< over which faces are [model length²]
    double length = 0;           ///< over which an edge is [model length]
    double tolerance = 0;        ///< of both models with which the faces are one [model length]
    std::string message;         ///< all of that in words
};

/// The faces that members have in common: the same surface within the tolerance, however it is faceted; or,
/// of void faces, with the same rim.
/// @throw InvalidInput "assembly.part_of_face"  a face that covers only part of another's;
///                     "assembly.overlap"  two volumes on the same side of a face, or reaching into each
///                     other; "assembly.rims_apart"  one face whose rims are further apart than the
///                     tolerance and nearer than `kNearMiss` times it; "assembly.crack"  faces that touch in
///                     part, or along an edge, and part from there by as little. Names them.
/// @note  O((facets) log) for faces whose boxes meet.
std::vector<SharedFace> shared_faces(std::span<const AssemblyMember> members, const RunContext& context = {});

/// A volume of an assembly that could not be meshed, and the others were without it.
struct LeftOut {
    std::string region, code, message; ///< its name, and the error
};

/// Hexahedra of many sweeps, with one node where several meet.
struct SweptAssembly {
    std::vector<Swept> parts;        ///< in the members' order, each with numbers of its own
    std::vector<std::size_t> member; ///< of each part, its place in the list of members
    std::vector<LeftOut> left_out;   ///< members that are no part
    /// Of each part's nodes, the number in the whole, from 0. Parts come one after the other; a node that
    /// an earlier part has keeps that one's number.
    std::vector<std::vector<Index>> number;
    std::vector<mesh::NodeNumbers> numbering; ///< the same; alone where parts do not hold their nodes
    std::size_t nodes = 0;                    ///< of the whole
    std::vector<SharedFace> shared;           ///< whose quads are one; `a` and `b` are places in `parts`
    std::vector<NearMiss> near_misses;        ///< `a` and `b` are places in `parts`
    /// A line for each shared face and each near miss, and the order they were meshed in.
    std::vector<std::string> report;
};

/// Sweep several sealed volumes so that the quads of faces they share are one.
///
/// First the edges that several volumes have get their nodes, by numbers of sides that agree over the whole
/// assembly (`layers` asked of one volume hold for those at its side). Then volumes are meshed one after the
/// other, each keeping, node for node, what its neighbours' meshes are on the faces they share. Where a
/// volume cannot keep what its neighbours have made, the order is changed so that it goes before them. A void
/// face with the rim of a neighbour's given one is that face.
/// Cells of a member are in a group of its name, of all members in `volume`. Groups of roles begin with its
/// name, `fluid:source`; those of a face's name are there with and without it. Of a volume that is all there
/// is groups are as `sweep()` names them.
/// Members whose options say `layered` may come out as parts that do not hold their nodes; then `number` is
/// empty.
/// A fixed member is a part as it came, before all others: they keep its quads where they share its faces.
/// A member that cannot be meshed so is tried with wedges or left out, as its `fallback` says, and the whole
/// is worked out anew without it: what it would have given others is not there.
/// @throw NotSweepable  as `sweep()`, the region named; "assembly.layers"  volumes side by side for which
///         other numbers of layers are asked; "assembly.layers_differ", "assembly.layers_rows"  boundary
///         layers of several volumes that cannot be on one edge, or for which it has too few sides;
///         "assembly.round"  volumes each of which lacks a face that the next one has;
///         "assembly.not_shared"  a shared face on which two meshes differ;
///         "assembly.hanging_node"  a node of one mesh within a side of another's.
/// Faces that are shared in part are split along each other's rims before; the faces of `shared` and of the
/// parts are then those of the volumes as split, whose first faces are the members' own.
/// @throw InvalidInput  as `shared_faces()` and `sweep()`; "assembly.all_fixed"  no member is to be swept;
///         "assembly.part_of_face" where a face that is
///         shared in part keeps its quads, or cannot be split.
/// @post  conformal: every quad of a shared face is one of both volumes, no node of one lies within a side or
///        a quad of another, and each volume is proved as `sweep()` does, its shape against its own sealed
///        skin.
SweptAssembly sweep_assembly(std::span<const AssemblyMember> members, const RunContext& context = {});

} // namespace lacuna::sweep
