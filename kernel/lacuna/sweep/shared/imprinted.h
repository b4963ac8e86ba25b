// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/sweep/assembly.h>

#include <functional>
#include <span>
#include <vector>

namespace lacuna::sweep {

/// Volumes of an assembly, and the faces that they share.
struct ImprintedVolumes {
    std::vector<topology::OpenVolume> volumes; ///< the members'
    std::vector<SharedFace> shared;            ///< as wholes
    /// For each volume: of each face that was split off, the face that it is part of.
    std::vector<std::vector<FaceId>> parents;
};

/// The members' volumes with faces that are shared in part split along each other's rims, as
/// `sweep_assembly()` meshes them; none if no face has to be split.
/// @throw InvalidInput  as `shared_faces()`; "assembly.part_of_face" where a face cannot be split.
ImprintedVolumes imprinted(std::span<const AssemblyMember> members, const RunContext& context = {});

/// As above, for members that may lie inside each other, as the parts of one skin do; all volumes are
/// returned.
/// @param takes  whether a shared pair counts, given whether the two members have a shared face that both
///               lie on the same side of.
ImprintedVolumes imprinted_parts(std::span<const AssemblyMember> members,
                                 const std::function<bool(const SharedFace&, bool)>& takes,
                                 const RunContext& context = {});

} // namespace lacuna::sweep
