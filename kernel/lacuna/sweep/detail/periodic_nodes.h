// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/sweep/detail/periodic.h>

#include <cstddef>
#include <set>
#include <span>
#include <vector>

/// Nodes of periodic faces, while an assembly is meshed and afterwards. Internal to this folder.
namespace lacuna::sweep {

/// The periodic faces of an assembly.
struct ImagesOf {
    std::span<const AssemblyMember> members;
    std::span<const PeriodicFaces> faces;
    double grid = 0; ///< spacing of the grid that nodes of periodic faces are rounded to
};

/// Copy the quads of a member's periodic faces to their images in the same member.
/// @param fixed  the faces with given quads are added to this set
void give_to_images(const ImagesOf& all, std::size_t m, topology::OpenVolume& volume,
                    std::set<FaceId>& fixed);

/// Make the nodes of a member's periodic faces exact images of each other. If the motion is a translation,
/// nodes are also rounded to the grid: their images in other members are then bit-identical.
/// @throw InvalidInput "sweep.periodic_given"; NotSweepable "sweep.periodic_unlike"
SettledNodes tie_images(const ImagesOf& all, std::size_t m, const std::set<FaceId>& fixed,
                        const mesh::SkinNodes& skin, const std::vector<FaceId>& faces);

/// List the nodes of periodic faces in pairs, and make middle nodes equal.
/// @param result  the members are meshed, and their nodes numbered.
/// @throw NotSweepable "sweep.periodic_unlike"
void pair_nodes(const ImagesOf& all, SweptAssembly& result, const RunContext& context);

} // namespace lacuna::sweep
