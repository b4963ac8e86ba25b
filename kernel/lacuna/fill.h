// SPDX-License-Identifier: MIT
#pragma once

// The entry point of the library: meshes the void that a set of faces bounds.
//
//   in   a model from `healing::split_facets()`, `io::load_facets()` or `cad::load_files()`
//   out  validated hexahedra and wedges with groups, regions and a report; the sealed volume
//
// fill() does the same as `model:open_volume{}` followed by `volume:sweep{}` in a recipe. Its stages can be
// called one by one, and each call of a recipe maps onto one of them:
//
//   open_volume, match, close, cut    fill/volume.h
//   sweep, assembly                   this header
//   tree, describe                    fill/describe.h
//   mesh.regions, groups, node …      fill/filled.h
//
// Stages take values and return values: a stage that fails or is cancelled changes nothing.
//
// Where to change things: finding and naming of roles, open.cpp; matching, closing and cutting, volume.cpp;
// alternative sweeps of one void, sweep.cpp; assembling pieces, volumes and meshes into one mesh,
// members.cpp.

#include <lacuna/fill/filled.h>
#include <lacuna/fill/volume.h>

#include <optional>
#include <span>
#include <vector>

namespace lacuna::fill {

/// Options for sweeping one volume.
struct SweepRequest {
    sweep::SweepOptions options;
    /// With `options.layered`: whether the pieces of a cut volume may also create their nodes on writing.
    bool layered_parts = true;
};

/// Options for all stages of `fill()`.
struct Request {
    RoleRequest roles;
    std::optional<matching::MatchOptions> match; ///< none: the volume is matched only if closing needs it
    std::optional<closure::CloseOptions> close;  ///< none: default closing shapes
    SweepRequest sweep;
    /// The meshes that the model was read from, whose mid-side nodes are reused at order 2. `scale` is
    /// the factor from their coordinates to those of the model.
    std::vector<std::shared_ptr<const io::Deck>> decks;
    double scale = 1;
    std::string unit; ///< declared unit of the model's lengths, as `io::metres_of()`; empty: none
};

/// Mesh the void that the faces of a model bound: open(), match(), close() and sweep().
/// @throw  as these; the model is not modified.
Filled fill(const topology::Model& model, const Request& request = {}, const RunContext& context = {});

/// Close a volume if it is still open, and sweep it. A volume with steps or branches, or one that makes a
/// full turn, is cut and its pieces are swept. If the roles were found and the volume cannot be swept with
/// them, the alternative sweeps of the same void are tried in turn; the report names the one used.
/// @return  `volumes` holds the one volume with the roles of the successful sweep, sealed unless it was cut.
/// @throw NotSweepable, NotClosed  the reason why the first sweep failed.
/// @throw InvalidInput  as `sweep::sweep()`. Cancelled.
Filled sweep(const Volume& volume, const SweepRequest& request = {}, const RunContext& context = {});

/// A member of an assembly: a volume with its options, or a finished mesh. Exactly one pointer is set.
struct Member {
    const Volume* volume = nullptr;
    const FilledVolume* mesh = nullptr;
    const FilledParts* parts = nullptr;
    sweep::SweepOptions options{}; ///< for `volume`
    /// Whether these options were given for this volume alone: then this volume must have the faces that they
    /// name. Otherwise at least one volume of the assembly must have them.
    bool own_boundary_layers = false, own_intervals = false;
};

/// Close several volumes and sweep them, cut into pieces where needed, as one conforming mesh.
/// @return  `volumes` holds the member volumes in their order. A volume that was left out or swept in pieces
///          is returned unchanged.
/// @throw InvalidInput "surface.no_such_face"  an option names a face that no volume has.
/// @throw  as `sweep::sweep_assembly()` and `closure::close()`.
Filled sweep(std::span<const Member> members, const RunContext& context = {});

/// A copy of a mesh, rotated, translated or mirrored. Cells of a mirrored mesh stay positive: their quads are
/// turned over. In an assembly, nodes of a copy move by rounding onto those of other members.
/// @param by    keeps all lengths.
/// @param name  region of the copy, or of several regions the start of their names; empty: as they are.
/// @pre  the mesh stores its nodes.
/// @throw InvalidInput "fill.copy_mixed"  the mesh has tetrahedra.
FilledVolume moved(FilledVolume mesh, const Eigen::Affine3d& by, const std::string& name = {});
FilledParts moved(FilledParts mesh, const Eigen::Affine3d& by, const std::string& name = {});

struct PatternOptions {
    int count = 2;         ///< copies, the mesh itself included, >= 1
    bool numbered = false; ///< regions are named `name_1`, `name_2` …; else copies are one region
};

/// A mesh and copies of it, each moved by `step` against the one before, as one mesh.
///
/// Faces that coincide become one, with common nodes, and are in no group. The groups of copies are joined.
/// Copies are compared with the first mesh alone, since two copies lie as that and a third.
/// @throw InvalidInput "fill.pattern_count"; "fill.copy_mixed"; as `sweep::sweep_assembly()`: copies that
///        overlap, or share a face in part. NotSweepable "assembly.not_shared"  faces coincide and their
///        quads differ; "assembly.hanging_node". Cancelled
/// @post  the copies of parts of order 1 do not store their nodes: see `hold_nodes()`.
/// @note  the quads of the source for each copy; 24 bytes per node once they are stored.
FilledParts pattern(FilledParts mesh, const Eigen::Affine3d& step, const PatternOptions& options = {},
                    const RunContext& context = {});

/// Quads on faces, without layers.
struct FilledShell {
    io::Deck deck; ///< quads of 4, 8 or 9 nodes and kept triangles; a region for each face or name of faces
    double min_scaled_jacobian = 1, mean_scaled_jacobian = 1; ///< of the quads' corners, in their planes
    double area = 0, face_area = 0; ///< of the quads, and of the faces' facets [model length²]
    std::vector<std::string> report;
};

/// Mesh faces of a model with quads that conform along common edges. Given quads are kept.
/// @param options  those of the source's quads: size, curvature, gap, quads, order, second_order
/// @throw InvalidInput  as `sweep::check()`; "fill.no_faces"  there are no faces. NotSweepable  as
///        `surface::mesh_source()`; "sweep.folded_quads"  names the face and the place. Cancelled
FilledShell quads(const topology::Model& model, const std::vector<FaceId>& faces,
                  const sweep::SweepOptions& options = {}, const RunContext& context = {});

/// The quads as a model, one face for each region, that keeps them: to be shown, or swept.
topology::Model model_of(const FilledShell& shell, const RunContext& context = {});

} // namespace lacuna::fill
