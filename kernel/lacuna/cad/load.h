// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/cad/limits.h>
#include <lacuna/core/run_context.h>
#include <lacuna/io/load_facets.h>
#include <lacuna/quads/region.h>
#include <lacuna/topology/model.h>

#include <string>
#include <vector>

namespace lacuna::cad {

using io::LoadOptions;

/// Read files into one model: STEP, IGES, BREP, GEO, and what io::load_facets() reads.
///
/// CAD faces get facets (chord error and turn bounded by curvature), exact curves and surfaces, and the
/// tags Gmsh shows for the file; loose faces are sewn; orientation is made consistent. What then still does
/// not share edges is joined by healing::stitch(); what it left out or apart is in Model::notes.
///
/// CAD files are read by a process of their own (lacuna-cad), started at the first of them, which may
/// crash, hang or be cancelled without harm; it holds the exact geometry for as long as the model lives. A
/// GEO script runs no commands, writes nothing, and includes and merges only files beside it. Other files
/// start no process.
/// @param limits  of that process.
/// @throw InvalidInput  as io::load_facets(); a file that is no CAD file of its kind, a script that asks
///                      for more than geometry ("cad.script"); names the file.
/// @throw BackendError  Gmsh's own words, with the file; what became of the process ("cad.worker_ended",
///                      "cad.time_limit", "cad.memory_limit"), or that there is none ("cad.no_worker").
topology::Model load(const std::vector<std::string>& paths, const LoadOptions& options = {},
                     const RunContext& context = {}, const Limits& limits = {});
/// load() that hands over the meshes of finite element files as well.
io::LoadedFiles load_files(const std::vector<std::string>& paths, const LoadOptions& options = {},
                           const RunContext& context = {}, const Limits& limits = {});

/// Gmsh's recombination of a planar region into quads, boundary nodes kept, by the same process. Sizes are
/// asked on a raster of 96 crossings along the longer side, within the region.
/// @throw NotSweepable  an odd number of boundary sides ("cad.odd_rim"), or triangles left
///                      ("cad.recombine"). InvalidInput  as quads::check(). BackendError  the process ended.
quads::PlanarQuads recombine(const quads::PlanarRegion& region, const RunContext& context = {});

/// Version of Gmsh in the CAD process, and what this system lacks to confine it; "none" where there is no
/// such process.
std::string gmsh_version();

} // namespace lacuna::cad
