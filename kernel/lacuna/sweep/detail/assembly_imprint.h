// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/sweep/detail/shared_faces.h>

#include <span>
#include <string>
#include <vector>

/// Faces that volumes share in part. Internal to this folder.
namespace lacuna::sweep {

/// Split both faces of each pair along the other's rim, so that what they share is one face of both.
///
/// Where rims cross, and where a corner of one lies on the other, both rims get a vertex. The parts of one
/// rim that run across the other face are laid onto its facets, which are cut there, chord by chord; new
/// points are on the exact surface where there is one. The face is split along the chains by
/// `topology::imprint_walks()`. Parts have the tag, name and role of the whole; new edges have no exact
/// curve, but the edge of the other volume that they lie on keeps its own.
/// @param volumes  of the members, changed; each pair's face ids count from before the call.
/// @param fixed  of each volume, whether it is the skin of a mesh that stays as it is, for messages.
/// @return  a line for each pair, for the report.
/// @throw InvalidInput "assembly.part_of_face"  a face whose own quads are its mesh, or along whose facets
///         the rim cannot be laid; names both.
/// @note  O(pairs × (facets of both × points of both rims)).
std::vector<std::string> imprint_faces(std::span<topology::OpenVolume> volumes,
                                       std::span<const std::string> regions, const std::vector<bool>& fixed,
                                       std::span<const PartlyShared> pairs, const RunContext& context);

} // namespace lacuna::sweep
