// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/cad/detail/exact_geometry.h>
#include <lacuna/cad_protocol/messages.h>
#include <lacuna/topology/open_volume.h>

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace lacuna::cad {

/// The models behind the exact faces of a volume, and what of each a solid needs.
struct SolidSources {
    std::shared_ptr<Worker> worker; ///< the one that holds them all; null where no face has an exact surface
    std::vector<const CadSource*> order;
    std::vector<cad_protocol::SolidSource> wanted; ///< of each
};
/// The models may be held by several processes, some of which have ended; then one reads what it has not.
/// @throw BackendError  a file has changed since, or cannot be read. Cancelled.
SolidSources sources_of(const topology::Model& model, const RunContext& context);

/// How a sealed volume is to be made as a solid: every face an exact one, a plane, spline patches or a
/// filling, with the edges those need.
struct SolidPlan {
    std::vector<Vec3> points;
    std::vector<cad_protocol::SolidEdge> edges;
    std::vector<cad_protocol::SolidFace> faces;
    double diagonal = 0;                ///< [model length]
    std::size_t planes = 0, fitted = 0; ///< void faces made
};
/// @param found  which of the sources' entities there are.
/// @throw InvalidInput  a bent face that has facets alone; names it.
SolidPlan plan_solid(const topology::OpenVolume& volume, const SolidSources& sources,
                     const cad_protocol::BeginSolidReply& found, const RunContext& context);

} // namespace lacuna::cad
