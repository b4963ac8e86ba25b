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

/// Decide for each face whether it is mapped, submapped or free, by its corners and the lengths of its sides.
/// With `ShapeSizing::counts_across`, the sides of mapped faces get at least `ShapeSizing::gap` mesh sides.
/// @throw NotSweepable "surface.not_four_sided"  a face cannot be mapped although the style requires it.
FaceGrids choose_grids(const SeedTask& task, Seeds& seeds);

/// Whether a face is free: it is neither mapped nor submapped, and it does not keep its own quads.
bool is_free(const FaceGrids& grids, const Seeds& seeds, FaceId face);

/// Whether all facet normals of a face are so close to `normal` that the face can be projected along it
/// without folds.
bool faces_one_way(const topology::Model& model, FaceId face, const Vec3& normal);

/// Make a mapped or submapped face free if opposite sides still have different numbers of sides. This happens
/// if these numbers are given.
/// @throw NotSweepable "surface.kept_side"  the style requires such a face to be mapped.
void free_unequal(const SeedTask& task, FaceGrids& grids, Seeds& seeds);

} // namespace lacuna::surface
