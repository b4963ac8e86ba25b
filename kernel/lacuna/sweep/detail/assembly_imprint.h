// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/sweep/detail/shared_faces.h>

#include <span>
#include <string>
#include <vector>

/// Partially shared faces of volumes. Internal to this folder.
namespace lacuna::sweep {

/// Result of `imprint_faces()`.
struct FaceImprint {
    std::vector<std::string> report; ///< a line for each pair
    /// For each volume: for each new face, the face it is a part of.
    std::vector<std::vector<FaceId>> parents;
};

/// Split both faces of each pair along the other's rim, so that the common part is one face of both.
///
/// Where rims cross, or a corner of one rim lies on the other, both rims get a vertex. Parts of one rim that
/// run across the other face are projected onto the facets of that face, which are cut along them, chord by
/// chord. If the face has an exact surface, the new points lie on it. `topology::imprint_walks()` then splits
/// the face along these chains. Parts have the tag, name and role of the whole face. New edges have no exact
/// curve; the edge of the other volume in the same position keeps its curve.
/// @param volumes  copies of the members' volumes, changed. The face ids of pairs are those before the call.
/// @throw InvalidInput "assembly.part_of_face"  a face keeps its quads, or the rim cannot be projected onto
///         its facets; names both faces.
/// @note  O(pairs × (facets of both × points of both rims)).
FaceImprint imprint_faces(std::span<topology::OpenVolume> volumes, std::span<const AssemblyMember> members,
                          std::span<const PartlyShared> pairs, const RunContext& context);

/// The sag of all faces after an imprint. Parts of a face get the sag of the whole face, because their own
/// facets are too few to estimate it.
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
