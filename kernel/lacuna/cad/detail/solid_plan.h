// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/cad/detail/exact_geometry.h>
#include <lacuna/cad_protocol/shared/messages.h>
#include <lacuna/topology/open_volume.h>

#include <vector>

namespace lacuna::cad {

/// The CAD models that contain the exact faces of a volume, and the entities of each model that a solid
/// needs.
struct SolidSources {
    std::shared_ptr<Worker> worker; ///< holds all the models; null if no face has an exact surface
    std::vector<const CadSource*> order;
    std::vector<cad_protocol::SolidSource> wanted; ///< one for each model
};
/// Load all CAD models of a volume into one process. Before the call, several processes may hold the models,
/// and some of these processes may have ended.
/// @throw BackendError  a file has changed since it was loaded, or cannot be read. Cancelled.
SolidSources sources_of(const topology::Model& model, const RunContext& context);

/// How a sealed volume is made into a solid. Each face becomes an exact face, a plane, spline patches or a
/// filled surface, with the edges that it needs.
struct SolidPlan {
    cad_protocol::MakeSolidRequest request; ///< contains the points, edges, faces and the diagonal
    std::size_t planes = 0, fitted = 0;     ///< number of void faces made as planes, and as fitted surfaces
};
/// Plan the solid of a sealed volume.
/// @param found  the entities of the sources that exist in the CAD process.
/// @throw InvalidInput  a face is curved and has no exact surface; names it.
SolidPlan plan_solid(const topology::OpenVolume& volume, const SolidSources& sources,
                     const cad_protocol::BeginSolidReply& found, const RunContext& context);

} // namespace lacuna::cad
