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

namespace lacuna::closure {
struct SweptSource;
}

namespace lacuna::fill {

/// A volume at any stage between its faces and its mesh.
struct Volume {
    topology::OpenVolume volume;             ///< sealed if `closure` is set
    std::vector<std::string> role_reasons;   ///< why the faces got their roles; empty if they were named
    topology::Classification classification; ///< of the volume as given, before closing
    std::optional<matching::Match> match;
    std::optional<closure::Closure> closure;
    std::optional<closure::SealedVolume> as_read; ///< default closure, if the roles were found
    /// If the roles were found: the alternative sweep directions of the same void.
    std::shared_ptr<const closure::OtherSweeps> others;
    /// Why no ends to sweep between were found. If set, the volume is sealed, all its faces are walls, and
    /// only a fallback can mesh it.
    std::optional<Message> no_roles;
    std::shared_ptr<const closure::SweptSource> along; ///< for class 0: its source and the motion; else null
    bool roles_found = false;                          ///< all roles were found; the user named none
    closure::RolesBy roles_by = closure::RolesBy::person; ///< of a chosen reading: `finding`
    bool told = false;                                    ///< whether the notes of the closure were logged
    /// For a piece cut at steps: pieces of level 0 run from source to target; the others take the remaining
    /// layers.
    int level = 0;
    double turn_from = 0, turn_to = 1; ///< for a piece of a full turn: its range, as fractions of the turn
    std::string turn_of;               ///< for a piece of a full turn: region of the whole turn
    std::string name;                  ///< region of its cells; empty: the default
    std::string material;              ///< name or number of its material; empty: none
    std::vector<std::shared_ptr<const io::Deck>> decks; ///< meshes that the model was read from
    double scale = 1;                                   ///< model coordinates / coordinates of `decks`
    std::string unit;  ///< declared unit of its lengths, by a name that `io::metres_of()` knows; empty: none
    bool glued = true; ///< whether it shares nodes with its neighbours in an assembly
};

/// The faces of a model that bound the volume, and their roles. Without `roles`, the roles are found.
struct RoleRequest {
    std::optional<topology::Roles> roles;
    bool find_walls = false;                  ///< find the walls from the rim of the one named end
    std::optional<std::vector<FaceId>> faces; ///< without `roles`: the faces to use; not set: all faces
    int reading = 0; ///< number of the possible void to use, from 1; 0: there must be only one. With `roles`,
                     ///< 1 accepts ambiguous geometry
    std::optional<topology::VolumeClass> override_class;
    bool full_turn = false;                 ///< the volume makes a full turn: all faces are walls
    std::optional<geometry::Plane> fill_to; ///< if set, only the part of the void behind this plane is kept
    /// Path along which the source is swept. The target must not be given; given walls replace walls that the
    /// sweep would make.
    std::optional<closure::Along> along;
    /// With `along`: decks that the model was read from. Their sets of edges become sets of the swept walls.
    std::vector<std::shared_ptr<const io::Deck>> decks;
    double scale = 1; ///< model coordinates / coordinates of `decks`
    std::string name; ///< region of its cells
    std::string material;
    bool glued = true; ///< as `Volume::glued`
};

/// Open a volume from named faces, or find the roles of its faces. A closed volume without ends to sweep
/// between is an error only for the stages that need them: match(), cut() and a sweep without a fallback.
/// @throw InvalidInput "lua.walls_without_ends"  walls are to be found and no end is named;
///         "lua.class_of_found_roles"  a class is given for faces whose roles were found;
///         "closure.fill_to"  the plane leaves several parts;
///         "closure.along_roles"  a path is given without a source, or with roles other than source and
///         walls; "closure.along_…" or "geometry.path_…"  the source cannot be swept along the path;
///         or the errors of `topology::open_volume()`, `topology::find_walls()`,
///         `closure::find_reading()`, `require_none_left_out()` and, with a plane, of cut().
Volume open(const topology::Model& model, const RoleRequest& request = {}, const RunContext& context = {});

/// Open each closed body of a model, as a volume of its name; see `topology::bodies()`. Notes name faces that
/// bound no closed body.
/// @throw InvalidInput "topology.bodies_overlap"  a body lies inside another. Or the errors of open().
std::vector<Volume> open_bodies(const topology::Model& model, const RunContext& context = {});

/// Replace the class that was found.
/// @throw InvalidInput "lua.sealed"  the volume is closed already. Or the errors of `topology::classify()`.
Volume override_class(Volume volume, topology::VolumeClass value);

/// Match source and target. A volume with a match is matched again only if options are given.
/// @throw InvalidInput "lua.sealed"  the volume is closed already. Or the errors of `matching::match()`.
Volume match(Volume volume, const std::optional<matching::MatchOptions>& options = {},
             const RunContext& context = {});

/// Seal the volume, unless it is sealed already. If sealing needs a match and there is none, source and
/// target are matched first. A volume that was sealed to find its roles is sealed anew if options are given.
/// @throw InvalidInput "lua.sealed"  options are given and close() was called before. Or the errors of
///         `matching::match()` and `closure::close()`.
Volume close(Volume volume, const std::optional<closure::CloseOptions>& options = {},
             const RunContext& context = {});

/// Where to cut a volume. If no member is set, the volume is cut at its steps, its branches and its full
/// turn.
struct Cut {
    std::optional<geometry::Plane> plane;
    const topology::Model* model = nullptr; ///< model that `face` belongs to
    FaceId face;
    bool automatic = false; ///< search for cuts into pieces that can be swept; the volume is sealed first
};

/// Cut a volume into pieces.
/// @throw NotSweepable  the errors of `closure::cut_by_plane()`, `cut_by_face()`, `cut_into_pieces()` and
///         close().
std::vector<Volume> cut(const Volume& volume, const Cut& where = {}, const RunContext& context = {});

} // namespace lacuna::fill
