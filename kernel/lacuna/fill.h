// SPDX-License-Identifier: MIT
#pragma once

// The entry point of the library: from the faces of a void to its mesh.
//
//   in   a model, as `healing::split_facets()`, `io::load_facets()` or `cad::load_files()` give it
//   out  hexahedra, proved, with groups, regions and a report; the volume as it was sealed
//
// fill() does what a recipe does with `model:open_volume{}` and `volume:sweep{}`. Its stages can be called
// one by one, and a recipe's calls map onto them:
//
//   open_volume, match, close, cut    fill/volume.h
//   sweep, assembly                   this header
//   tree, describe                    fill/describe.h
//   mesh.regions, groups, node …      fill/filled.h
//
// Stages are functions from values to values: a call that fails or is cancelled changes nothing.
//
// To change how roles are found or named, open open.cpp; how a volume is matched, closed or cut, volume.cpp;
// which sweeps of one void are tried, sweep.cpp; how pieces, volumes and meshes become one, members.cpp.

#include <lacuna/fill/filled.h>
#include <lacuna/fill/volume.h>

#include <optional>
#include <span>
#include <vector>

namespace lacuna::fill {

/// How one volume is swept.
struct SweepRequest {
    sweep::SweepOptions options;
    /// With `options.layered`: the pieces of a volume that is cut may leave nodes to be made as well.
    bool layered_parts = true;
};

/// What becomes of a model.
struct Request {
    RoleRequest roles;
    std::optional<matching::MatchOptions> match; ///< none: as closing needs it
    std::optional<closure::CloseOptions> close;  ///< none: the default shapes
    SweepRequest sweep;
    /// The meshes that the model was read from, whose middle nodes are kept at order 2, and the scale of the
    /// model's coordinates to theirs.
    std::vector<std::shared_ptr<const io::Deck>> decks;
    double scale = 1;
};

/// Fill the void that faces of a model leave: open(), match(), close() and sweep().
/// @throw  as these; the model stays as it is.
Filled fill(const topology::Model& model, const Request& request = {}, const RunContext& context = {});

/// Close a volume, unless it is closed, and sweep it. One with steps or branches and one that runs round a
/// full turn is swept as its pieces. Where its roles were found and it cannot be swept, the other sweeps of
/// the same void are tried in turn, and the report says so.
/// @return  `volumes` is the one volume with the roles it was swept by, sealed unless it was cut.
/// @throw NotSweepable, NotClosed  why the first sweep failed.
/// @throw InvalidInput  as `sweep::sweep()`. Cancelled.
Filled sweep(const Volume& volume, const SweepRequest& request = {}, const RunContext& context = {});

/// A volume of an assembly with its options, or a mesh that stays as it is: one of the three is set.
struct Member {
    const Volume* volume = nullptr;
    const FilledVolume* mesh = nullptr;
    const FilledParts* parts = nullptr;
    sweep::SweepOptions options{}; ///< of the volume
    /// Whether these options were given for this volume alone: then it must have the faces that they name.
    /// Else some volume of the assembly must.
    bool own_boundary_layers = false, own_intervals = false;
};

/// Close volumes and sweep them, or the pieces they are cut into, as one mesh.
/// @return  `volumes` are those of the members that are volumes, in their order. One that was left out, or
///          swept as pieces, is as it was.
/// @throw InvalidInput "surface.no_such_face"  an option names a face that no volume has.
/// @throw  as `sweep::sweep_assembly()` and `closure::close()`.
Filled sweep(std::span<const Member> members, const RunContext& context = {});

} // namespace lacuna::fill
