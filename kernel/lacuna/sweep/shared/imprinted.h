// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/sweep/assembly.h>

#include <span>
#include <vector>

namespace lacuna::sweep {

/// Volumes of an assembly, and the faces that they share.
struct ImprintedVolumes {
    std::vector<topology::OpenVolume> volumes; ///< the members'
    std::vector<SharedFace> shared;            ///< as wholes
};

/// The members' volumes with faces that are shared in part split along each other's rims, as
/// `sweep_assembly()` meshes them; none if no face has to be split.
/// @throw InvalidInput  as `shared_faces()`; "assembly.part_of_face" where a face cannot be split.
ImprintedVolumes imprinted(std::span<const AssemblyMember> members, const RunContext& context = {});

} // namespace lacuna::sweep
