// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/sweep/assembly.h>

#include <functional>
#include <span>
#include <vector>

namespace lacuna::sweep {

/// Volumes of an assembly, and the faces that they share.
struct ImprintedVolumes {
    std::vector<topology::OpenVolume> volumes; ///< the volumes of the members
    std::vector<SharedFace> shared;            ///< faces that are shared as a whole
    /// For each volume: for each face that was split off, the face that it is a part of.
    std::vector<std::vector<FaceId>> parents;
};

/// The members' volumes as `sweep_assembly()` meshes them: faces that are shared in part are split along each
/// other's rims.
/// @throw InvalidInput  as `shared_faces()`; "assembly.part_of_face"  a face cannot be split.
ImprintedVolumes imprinted(std::span<const AssemblyMember> members, const RunContext& context = {});

/// `imprinted()` for members that may lie inside each other, as the parts of one skin may.
/// @param takes  decides whether a pair of faces counts as shared. Its second argument tells whether both
///         members lie on the same side of some face that they share.
ImprintedVolumes imprinted_parts(std::span<const AssemblyMember> members,
                                 const std::function<bool(const SharedFace&, bool)>& takes,
                                 const RunContext& context = {});

} // namespace lacuna::sweep
