// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/sweep/assembly.h>

#include <memory>
#include <span>
#include <string>
#include <vector>

/// Faces that volumes share in part. Internal to this folder.
namespace lacuna::sweep {

/// A pair of faces of which one covers part of the other.
struct PartlyShared {
    SharedFace faces;
    double limit = 0;  ///< how far the facets may be off each other [model length]
    std::string words; ///< how much of each lies on the other
};

/// Faces that members have in common, as a whole or in part.
struct FacesInCommon {
    std::vector<SharedFace> whole;
    std::vector<PartlyShared> partly;
};

/// @throw InvalidInput "assembly.overlap"  as `shared_faces()`
FacesInCommon faces_in_common(std::span<const AssemblyMember> members, const RunContext& context);

/// Split both faces of each pair along the other's rim, so that what they share is one face of both.
///
/// Where rims cross, and where a corner of one lies on the other, both rims get a vertex. The parts of one
/// rim that run across the other face are laid onto its facets, which are cut there, chord by chord; new
/// points are on the exact surface where there is one. The face is split along the chains by
/// `topology::imprint_walks()`. Parts have the tag, name and role of the whole; new edges have no exact
/// curve, but the edge of the other volume that they lie on keeps its own.
/// @param volumes  of the members, changed; each pair's face ids count from before the call.
/// @return  a line for each pair, for the report.
/// @throw InvalidInput "assembly.part_of_face"  a face whose own quads are its mesh, or along whose facets
///         the rim cannot be laid; names both.
/// @note  O(pairs × (facets of both × points of both rims)).
std::vector<std::string> imprint_faces(std::span<topology::OpenVolume> volumes,
                                       std::span<const std::string> regions,
                                       std::span<const PartlyShared> pairs, const RunContext& context);

} // namespace lacuna::sweep
