// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/io/load_facets.h>
#include <lacuna/quads/region.h>
#include <lacuna/topology/model.h>

#include <optional>
#include <string>
#include <vector>

namespace lacuna::cad {

using io::LoadOptions;

/// Read files into one model: STEP, IGES, BREP, GEO, and what io::load_facets() reads.
///
/// CAD faces get facets (chord error and turn bounded by curvature), exact curves and surfaces, and the tags
/// Gmsh shows for the file; loose faces are sewn; orientation is made consistent. Gmsh sees CAD files alone.
/// What then still does not share edges is joined by healing::stitch(); what it left out or apart is in
/// Model::notes.
/// @throw InvalidInput  as io::load_facets(); names the file.
/// @throw BackendError  Gmsh's own words, with the file.
topology::Model load(const std::vector<std::string>& paths, const LoadOptions& options = {},
                     const RunContext& context = {});

/// Gmsh's recombination of a planar region into quads, boundary nodes kept.
/// @throw NotSweepable  an odd number of boundary sides ("cad.odd_rim"), or triangles left ("cad.recombine").
quads::PlanarQuads recombine(const quads::PlanarRegion& region, const RunContext& context = {});

/// Version of the Gmsh library linked.
std::string gmsh_version();

} // namespace lacuna::cad
