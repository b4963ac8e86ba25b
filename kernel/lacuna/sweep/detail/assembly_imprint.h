// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/sweep/detail/shared_faces.h>

#include <span>
#include <string>
#include <vector>

/// Partially shared faces of volumes. Internal to this folder.
namespace lacuna::sweep {

/// What `imprint_faces()` did.
struct FaceImprint {
    std::vector<std::string> report;          ///< a line for each pair
    std::vector<std::vector<FaceId>> parents; ///< for each volume: of each new face, the face it is part of
};

/// Split both faces of each pair along the other's rim, so that the common part is one face of both.
///
/// Where rims cross, or a corner of one lies on the other, both rims get a vertex. The parts of one rim that
/// run across the other face are projected onto its facets, which are cut along them, chord by chord; new
/// points lie on the exact surface if there is one. The face is split along the chains by
/// `topology::imprint_walks()`. Parts have the tag, name and role of the whole; new edges have no exact
/// curve, but the coincident edge of the other volume keeps its own.
/// @param volumes  copies of the members' volumes, changed; face ids of pairs are those before the call.
/// @throw InvalidInput "assembly.part_of_face"  a face that keeps its quads, or onto whose facets the rim
///        cannot be projected; names both.
/// @note  O(pairs × (facets of both × points of both rims)).
FaceImprint imprint_faces(std::span<topology::OpenVolume> volumes, std::span<const AssemblyMember> members,
                          std::span<const PartlyShared> pairs, const RunContext& context);

/// The sag of all faces after an imprint. Parts get the sag of the whole face, because their own facets no
/// longer show it.
/// @param sag  for each member: sag of each of its faces before the imprint.
std::vector<std::vector<double>> with_sag_of_parts(std::vector<std::vector<double>> sag,
                                                   const FaceImprint& imprint);

/// Give swept members a vertex wherever an edge of an unswept member ends on the rim of a face that both
/// share. The mesh of that face then has the node that the unswept member's skin needs.
/// @param volumes  copies of the members' volumes, changed; face ids stay the same.
/// @note  O(vertices of shared rims × points of the edges of all members).
void add_vertices_beside(std::span<topology::OpenVolume> volumes, std::span<const AssemblyMember> members,
                         std::span<const SharedFace> shared, const RunContext& context);

} // namespace lacuna::sweep
