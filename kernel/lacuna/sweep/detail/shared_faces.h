// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/sweep/assembly.h>

#include <span>
#include <string>
#include <vector>

/// Faces that members of an assembly have in common. Internal to this folder.
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
    std::vector<NearMiss> near; ///< of faces that are no one's as a whole
};

/// @throw InvalidInput "assembly.overlap", "assembly.rims_apart", "assembly.crack"  as `shared_faces()`
FacesInCommon faces_in_common(std::span<const AssemblyMember> members, const RunContext& context);

/// @throw InvalidInput "assembly.part_of_face"  where faces are shared in part.
void refuse_partly_shared(const FacesInCommon& found);

/// How far the facets of a face may be off what they stand for, by the angles between them [model length].
/// O(facets).
double facet_sag(const topology::Model& model, const topology::Face& face);

/// A face of a member as messages name it.
std::string name_in(const AssemblyMember& member, FaceId face);

} // namespace lacuna::sweep
