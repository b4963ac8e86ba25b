// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/sweep/assembly.h>

#include <set>
#include <span>
#include <utility>
#include <vector>

/// Faces shared by members of an assembly. Internal to this folder.
namespace lacuna::sweep {

/// A pair of faces that share only a part of their area.
struct PartlyShared {
    SharedFace faces;
    double limit = 0; ///< maximum distance between the facets of the two faces [model length]
    Message refusal;  ///< error for this pair; names the covered share of each face
};

/// Faces shared by members, completely or in part.
struct FacesInCommon {
    std::vector<SharedFace> whole;
    std::vector<PartlyShared> partly;
    std::vector<NearMiss> near;           ///< near misses of faces that are not shared completely
    std::vector<std::vector<double>> sag; ///< for each member: `facet_sag()` of each of its faces
    /// Pairs of members that lie on the same side of a face that they share: one is inside the other.
    std::set<std::pair<std::size_t, std::size_t>> same_side;
};

/// Whether a member may lie inside another one, as the parts of one skin may. If so, near misses are not
/// searched.
enum class MayOverlap : bool { no, yes };

/// @param sag  for each member, the sag of its first faces; `facet_sag()` is computed for the others. It must
///         be given for faces that were divided, because the facets of their parts are too few to estimate
///         it.
/// @throw InvalidInput "assembly.overlap", "assembly.rims_apart", "assembly.crack"  as `shared_faces()`
FacesInCommon faces_in_common(std::span<const AssemblyMember> members, const RunContext& context,
                              std::vector<std::vector<double>> sag = {},
                              MayOverlap may_overlap = MayOverlap::no);

/// @throw InvalidInput "assembly.part_of_face"  some faces are shared only in part.
void refuse_partly_shared(const FacesInCommon& found);

/// A face or an edge of a member as messages name it.
template <class Id>
NamedEntity entity_in(const AssemblyMember& member, Id id)
{
    return entity_of(member.volume->model, id);
}

} // namespace lacuna::sweep
