// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/closure/close.h>
#include <lacuna/closure/readings.h>
#include <lacuna/core/run_context.h>
#include <lacuna/geometry/newell.h>
#include <lacuna/io/deck.h>
#include <lacuna/matching/match.h>
#include <lacuna/topology/open_volume.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace lacuna::fill {

/// A volume on its way from faces to a mesh.
struct Volume {
    topology::OpenVolume volume;             ///< sealed where `closure` is set
    std::vector<std::string> role_reasons;   ///< why the faces got their roles; empty where they were named
    topology::Classification classification; ///< as the volume was given
    std::optional<matching::Match> match;
    std::optional<closure::Closure> closure;
    std::optional<closure::SealedVolume> as_read; ///< where its roles were found: how it is closed by default
    /// Where its roles were found: the other sweeps of the same void.
    std::shared_ptr<const closure::OtherSweeps> others;
    bool take_guess = false; ///< whether ambiguous geometry is taken as it closes
    bool told = false;       ///< whether the closure's notes were logged
    int level = 0; ///< of a piece cut at steps: 0 goes from end to end, others have what layers are left
    double turn_from = 0, turn_to = 1; ///< of a piece of a full turn: where it is, as shares of the turn
    std::string turn_of;               ///< of a piece of a full turn: the region of the whole turn
    std::string name;                  ///< of the region of its cells; empty: the default
    std::string material;              ///< name or number of its material; empty: none
    std::vector<std::shared_ptr<const io::Deck>> decks; ///< the meshes that its model was read from
    double scale = 1;                                   ///< of its coordinates to theirs
};

/// Which faces of a model are the volume, and their roles. Without `roles` these are found.
struct RoleRequest {
    std::optional<topology::Roles> roles;
    bool find_walls = false;                  ///< the walls are found from the rim of the one named end
    std::optional<std::vector<FaceId>> faces; ///< without `roles`; none: all of the model
    int reading = 0; ///< number of one that was found, from 1; with roles 1 takes ambiguous geometry
    std::optional<topology::VolumeClass> override_class;
    bool full_turn = false; ///< it runs round its whole turn: the faces are walls
    std::string name;       ///< of the region of its cells
    std::string material;
};

/// Take the named faces as a volume, or find their roles.
/// @throw InvalidInput "lua.walls_without_ends", "lua.class_of_found_roles"; as `topology::open_volume()`,
///                     `topology::find_walls()`, `closure::find_reading()` and `require_none_left_out()`.
Volume open(const topology::Model& model, const RoleRequest& request = {}, const RunContext& context = {});

/// Take another class than the one found.
/// @throw InvalidInput "lua.sealed"  it is closed already. Else as `topology::classify()`.
Volume override_class(Volume volume, topology::VolumeClass value);

/// Match source and target: anew where options are given, else unless that is done.
/// @throw InvalidInput "lua.sealed"  it is closed already. Else as `matching::match()`.
Volume match(Volume volume, const std::optional<matching::MatchOptions>& options = {},
             const RunContext& context = {});

/// Match what is to be matched, and seal the volume unless that is done.
/// @throw  as `matching::match()` and `closure::close()`.
Volume close(Volume volume, const std::optional<closure::CloseOptions>& options = {},
             const RunContext& context = {});

/// Where a volume is cut; neither: at its steps, branches and full turn.
struct Cut {
    std::optional<geometry::Plane> plane;
    const topology::Model* model = nullptr; ///< of `face`
    FaceId face;
};

/// The pieces of a volume.
/// @throw NotSweepable  as `closure::cut_by_plane()`, `cut_by_face()` and `cut_into_pieces()`.
std::vector<Volume> cut(const Volume& volume, const Cut& where = {}, const RunContext& context = {});

} // namespace lacuna::fill
