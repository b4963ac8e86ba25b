// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/surface/detail/face_sides.h>
#include <lacuna/surface/detail/mapped_face.h>
#include <lacuna/surface/detail/seed_task.h>

#include <map>
#include <vector>

/// Which source faces are mapped or submapped. Internal to this folder.
namespace lacuna::surface {

/// Mapped and submapped faces. Beside these `Seeds::corners` has those that are mapped, `Seeds::submapped`
/// the others.
struct FaceGrids {
    std::map<FaceId, std::vector<SidePair>> opposite; ///< pairs of sides that need as many
    std::map<FaceId, MappedFace> mapped;              ///< of four sides
};

/// Choose them by the sides of each face. Where quads across a narrow place are to be counted, sides of
/// mapped faces get so many.
/// @throw NotSweepable "surface.not_four_sided"  where all are to be mapped.
FaceGrids choose_grids(const SeedTask& task, Seeds& seeds);

/// Whether a face is neither mapped nor submapped nor keeps its quads.
bool is_free(const FaceGrids& grids, const Seeds& seeds, FaceId face);

/// Whether all of a face looks one way, so that it can be laid on a plane without folding.
bool faces_one_way(const topology::Model& model, FaceId face, const Vec3& normal);

/// Equal counts on opposite sides of every mapped face. Counts only grow; where they would chase each other,
/// or are fixed, the face is meshed freely.
/// @throw NotSweepable "surface.kept_side"  where all are to be mapped.
void balance(const SeedTask& task, FaceGrids& grids, Seeds& seeds);

} // namespace lacuna::surface
