// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/surface/detail/face_sides.h>
#include <lacuna/surface/detail/mapped_face.h>
#include <lacuna/surface/detail/seed_task.h>

#include <map>
#include <vector>

/// Which source faces are mapped or submapped. Internal to this folder.
namespace lacuna::surface {

/// Mapped and submapped faces. `Seeds::corners` lists the mapped faces too, and `Seeds::submapped` the
/// submapped ones.
struct FaceGrids {
    std::map<FaceId, std::vector<SidePair>> opposite; ///< pairs of sides that need equal counts
    std::map<FaceId, MappedFace> mapped;              ///< faces of four sides, with their grids
};

/// Choose mapped and submapped faces by their sides. If a minimum count across narrow places is set, sides of
/// mapped faces get it.
/// @throw NotSweepable "surface.not_four_sided"  if all faces must be mapped.
FaceGrids choose_grids(const SeedTask& task, Seeds& seeds);

/// Whether a face is neither mapped nor submapped nor keeps its quads.
bool is_free(const FaceGrids& grids, const Seeds& seeds, FaceId face);

/// Whether all normals of a face are within a half space, so that it can be projected onto a plane without
/// folds.
bool faces_one_way(const topology::Model& model, FaceId face, const Vec3& normal);

/// Faces whose opposite sides still have different counts, because these are fixed, become free.
/// @throw NotSweepable "surface.kept_side"  if all faces must be mapped.
void free_unequal(const SeedTask& task, FaceGrids& grids, Seeds& seeds);

} // namespace lacuna::surface
