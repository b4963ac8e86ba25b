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

} // namespace lacuna::fill
