// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/quality/quality.h>
#include <lacuna/surface/shared/linking_surface.h>
#include <lacuna/sweep/detail/mean_outline.h>
#include <lacuna/sweep/detail/size_words.h>
#include <lacuna/sweep/sweep.h>
#include <lacuna/topology/open_volume.h>

#include <set>
#include <vector>

namespace lacuna::sweep {

/// A mesh and the result of its proof.
struct ProvedSweep {
    Swept swept;
    quality::Proof proof;
    std::vector<FaceId> faces; ///< for each patch of the skin, its face
    std::set<FaceId> kept;     ///< source faces whose own quads were kept
};

/// The shape that the mesh must have: in an assembly, the volume without the nodes and meshes of neighbours.
const topology::OpenVolume& shape_of(const topology::OpenVolume& volume, const SweepOptions& options);

/// Sweep between linking surfaces whose correspondence is known: make seeds, quads, walls, target and layers,
/// and prove the mesh.
/// @param asked  heights of the layers from 0 to 1, from the source; empty: not requested.
/// @throw  as `sweep()`; findings of the proof are returned in the result, not thrown.
ProvedSweep sweep_between(const topology::OpenVolume& volume,
                          std::vector<surface::LinkingSurface> given_links, const std::vector<double>& asked,
                          const SourceSize& sizes, const SweepOptions& options, Outline outline,
                          const RunContext& context);

} // namespace lacuna::sweep
