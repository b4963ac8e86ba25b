// SPDX-License-Identifier: MIT
#pragma once

// In: CAD files, a sealed volume, a closed skin or a plane region; out: a model with exact geometry, a CAD
// file, tetrahedra or quads.
//
// Where to change things:
//   a model from the process's reply     load.cpp
//   which files are opened; GEO scripts  cad_files.cpp, script.cpp
//   the process: start, limits, end      worker.cpp; where it is found: worker_program.cpp
//   exact curves and surfaces            exact_geometry.cpp
//   writing STEP or BREP                 write_cad.cpp; plan of the solid: solid_plan.cpp
//   splines of void faces and edges      void_patch.cpp, edge_shape.cpp, spline_patch.cpp
//   tetrahedra inside a skin             fill_skin.cpp; pyramids on its quads: pyramid_layer.cpp
//   quads by Gmsh                        recombine.cpp

#include <lacuna/cad/limits.h>
#include <lacuna/core/run_context.h>
#include <lacuna/io/load_facets.h>
#include <lacuna/quads/region.h>
#include <lacuna/topology/model.h>

#include <string>
#include <vector>

namespace lacuna::mesh {
struct ClosedSkin;
struct TetMesh;
} // namespace lacuna::mesh

namespace lacuna::cad {

using io::LoadOptions;

/// Read files into one model: STEP, IGES, BREP, GEO, and the formats of io::load_facets().
///
/// CAD faces get facets (chord error and angle bounded by curvature), exact curves and surfaces, and the tags
/// that Gmsh shows for the file. Loose faces are sewn and oriented consistently. healing::stitch() joins
/// faces that still do not share edges. Model::notes lists the faces that were left out or stay unconnected.
///
/// CAD files are read by a separate process (lacuna-cad), which is started at the first CAD file. The CAD
/// process can crash, hang or be cancelled without harm to the calling process. It holds the exact geometry
/// for the lifetime of the model. A GEO script can neither run commands nor write; it can include and merge
/// only files of its own folder. Other formats do not need the process.
/// @param limits  limits of the CAD process.
/// @throw InvalidInput  as for io::load_facets(); a file does not have the CAD format of its extension; or a
///        script has a forbidden command ("cad.script"). Names the file.
/// @throw BackendError  an error of Gmsh, with the name of the file; or the CAD process ended
///        ("cad.worker_ended", "cad.time_limit", "cad.memory_limit") or was not found ("cad.no_worker").
topology::Model load(const std::vector<std::string>& paths, const LoadOptions& options = {},
                     const RunContext& context = {}, const Limits& limits = {});
/// As load(), and also returns the meshes of finite element files.
io::LoadedFiles load_files(const std::vector<std::string>& paths, const LoadOptions& options = {},
                           const RunContext& context = {}, const Limits& limits = {});

/// Fill a planar region with quads by Gmsh's recombination, in the CAD process; boundary nodes are kept.
/// Target sizes are sampled inside the region, on a raster with 96 points along its longer side.
/// @throw NotSweepable  the number of boundary segments is odd or less than four ("cad.odd_rim"), or
///                      triangles remain ("cad.recombine").
/// @throw InvalidInput  as for quads::check().
/// @throw BackendError  the process ended.
quads::PlanarQuads recombine(const quads::PlanarRegion& region, const RunContext& context = {});

/// Fill a closed skin with tetrahedra by Gmsh, in the CAD process, and put a pyramid on each quad of the
/// skin. Cells have about the size of the skin's faces, and each face belongs to one cell. A skin with
/// cavities consists of one outer part and one part for each cavity. The same skin gives the same result to
/// the bit.
/// @pre   every point is a corner of a face.
/// @post  the nodes are the skin's points, then the apexes of its quads in order, then the inner nodes. The
///        cells are the pyramids in the order of the quads, then the tetrahedra. All cells are positive.
/// @throw InvalidInput  the skin is open, inside out or in several parts ("cad.skin_open").
/// @throw NotSweepable  faces of the skin cross ("cad.skin_crosses"), a quad is not convex
///                      ("cad.skin_quad"), Gmsh fails ("cad.fill_skin"), or more than 1e7 tetrahedra are
///                      needed ("cad.tet_count").
/// @throw BackendError  as for load().
mesh::TetMesh fill_skin(const mesh::ClosedSkin& skin, const RunContext& context = {});

/// Version of Gmsh in the CAD process, and the confinement features that this system lacks; "none" if the
/// CAD process is not installed.
std::string gmsh_version();

} // namespace lacuna::cad
