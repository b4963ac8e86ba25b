// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/cad/limits.h>
#include <lacuna/core/run_context.h>
#include <lacuna/quads/region.h>
#include <lacuna/topology/model.h>

#include <optional>
#include <string>
#include <vector>

namespace lacuna::cad {

struct LoadOptions {
    double tolerance = 0;      ///< gaps below it are sewn [model length]; 0: 1e-6 × the diagonal
    double feature_angle = 40; ///< where facets are cut into faces [degrees]
    bool keep_mesh = true;     ///< quads of FE formats stay as they are
    double scale = 1;          ///< every coordinate times this, > 0 [-]
    Limits limits{};           ///< of the CAD process
};

/// Read files into one model: STEP, IGES, BREP, GEO, STL, OBJ, MSH and what else Gmsh reads as faces.
///
/// CAD faces get facets (chord error and turn bounded by curvature), exact curves and surfaces, and the tags
/// Gmsh shows for the file; loose faces are sewn; orientation is made consistent. Facets are cut into faces
/// by healing::split_facets().
/// What then still does not share edges is joined by healing::stitch(); what it left out or apart is in Model::notes.
/// @throw InvalidInput  a missing, empty or unreadable file, an unknown ending; names the file.
///
/// STEP, IGES, BREP and GEO are read by a process of their own (lacuna-cad), which may crash, hang or be cancelled
/// without harm; it holds the exact geometry for as long as the model lives. A GEO script runs no commands, writes
/// nothing, and includes and merges only files beside it.
/// @throw BackendError  Gmsh's own words, with the file; what became of the process ("cad.worker_ended",
///                      "cad.time_limit", "cad.memory_limit"), or that there is none ("cad.no_worker").
topology::Model load(const std::vector<std::string>& paths, const LoadOptions& options = {},
                     const RunContext& context = {});

/// Gmsh's recombination of a planar region into quads, boundary nodes kept.
/// @throw NotSweepable  an odd number of boundary sides ("cad.odd_rim"), or triangles left ("cad.recombine").
quads::PlanarQuads recombine(const quads::PlanarRegion& region, const RunContext& context = {});

/// Version of Gmsh in the CAD process, and what this system lacks to confine it; "none" where there is no such
/// process.
std::string gmsh_version();

} // namespace lacuna::cad
