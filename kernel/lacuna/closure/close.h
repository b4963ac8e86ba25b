// SPDX-License-Identifier: MIT
#pragma once

// In: an open volume with its match, or faces without roles; out: a sealed volume, or its pieces for several
// sweeps.
//
// Where to change things:
//   options, order of tries, notes          close.cpp; each class: close_class.cpp
//   void edges; loops of void faces         void_edges.cpp, void_faces.cpp
//   shape of a void face                    void_geometry.cpp, transfinite_fill.cpp, rim_quadrics.cpp
//   void edges along bent walls             follow.cpp
//   missing end like the given one          moved_end.cpp
//   flat faces in free loops                flat_fill.cpp, touching_faces.cpp
//   missing round and straight walls        round_walls.cpp, straight_walls.cpp; part of one: round_patch.cpp
//   holes in ends; ends of walls alone      end_holes.cpp, class_five.cpp
//   whether a closing is ambiguous          guesses.cpp, hole_guesses.cpp, membranes.cpp
//   void faces that cross other faces       sealing.cpp
//   voids of faces without roles            readings.cpp, sealed_voids.cpp
//   error if no roles are found             no_roles.cpp
//   cavities of solids, facts of a model    cavities.cpp, model_facts.cpp
//   best direction of a sweep               void_sweeps.cpp
//   hollows with a round bottom or a floor  hollow_readings.cpp, bowl.cpp
//   a source alone                          along.cpp; its motion: along_motion.cpp, along_normals.cpp
//   one plane cut                           cut.cpp, pieces.cpp; a full turn: full_turn.cpp
//   steps                                   steps.cpp, step_cutter.cpp
//   branches, rounded rims                  branches.cpp, branch_mouths.cpp; round_rims.cpp
//   tubes between two main bodies           connecting_tubes.cpp
//   candidates of cuts                      cut_planes.cpp
//   which cuts are made                     partition.cpp; a block per vertex: midpoint.cpp
//   ends of pieces                          piece_ends.cpp
//   walls that become part of an end        smooth_ends.cpp, stubs.cpp

#include <lacuna/core/message.h>
#include <lacuna/core/run_context.h>
#include <lacuna/matching/match.h>
#include <lacuna/topology/open_volume.h>

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace lacuna::closure {

/// Shape of a void edge between its two vertices.
enum class EdgeShape {
    /// `smooth` between ends that no wall joins and that are at more than 100° to each other. Otherwise
    /// `straight`, or `follow` if void walls between straight edges would be far from the given walls. If the
    /// chosen shape crosses given faces or encloses no volume, the other shapes are tried in order, and the
    /// first one that seals the volume is taken.
    automatic,
    straight, ///< as in the paper (docs/bibliography.md)
    follow,   ///< bent like the given walls beside the edge
    smooth,   ///< a cubic; at each end it is tangent to the walls or, without walls, normal to the end face
};

/// Shape of a missing end (class IV).
enum class Cap {
    automatic, ///< `flat`, or `parallel` if a flat end would cross the given faces
    flat,      ///< in the plane of the end's rim; if the rim is not planar, interpolated (Algorithm 4)
    parallel,  ///< the shape of the given end, moved to the rim of the missing end along the walls
};

/// Treatment of a given end's holes without walls.
enum class Holes {
    automatic, ///< an error if the other end is missing; otherwise each hole is joined to the loop of the
               ///< other end with which it is matched
    cover,     ///< each hole is closed by a face in the end's surface
    through,   ///< each hole is extended to the other end
};

/// A void edge given by the user.
struct VoidEdge {
    int from = 0, to = 0;     ///< tags of vertices on the free rims
    std::vector<Vec3> points; ///< inner points, in order from `from` to `to` [model length]; empty: the edge
                              ///< is straight
};

/// Whether the user or the program chose the roles of the faces. The user chooses among the readings of the
/// program, so an ambiguous closing is accepted there; with the user's own roles it is an error.
enum class RolesBy { person, finding };

struct CloseOptions {
    EdgeShape edge_shape = EdgeShape::automatic;
    std::vector<VoidEdge> void_edges{}; ///< given by the user; the match adds the others
    Cap cap = Cap::automatic;
    Holes holes = Holes::automatic;
    RolesBy roles_by = RolesBy::person;
};

/// The path along which a source alone is swept (class 0).
struct Along {
    struct Vector {
        Vec3 way; ///< displacement from the source to the target [model length]
    };
    struct Axis {
        Vec3 point, direction;
        double angle = 0; ///< up to a full turn either way, by the right-hand rule [degree]
    };
    struct Helix {
        Vec3 point, direction; ///< of the axis of the helix
        double pitch = 0;      ///< advance along the axis for each turn [model length]
        double turns = 0;      ///< negative: by the left-hand rule
    };
    /// A path that is a list of points with a corner at each, edges of the model in order, or a curve over
    /// [0, 1]. It need not start at the source.
    struct Path {
        std::vector<Vec3> points{};
        std::vector<int> edges{}; ///< tags
        std::function<Vec3(double)> curve{};
        bool fixed = false; ///< whether the section keeps its orientation; otherwise rotation-minimising
                            ///< frames turn it
    };
    /// Along the normals of the source, by a thickness that depends on the place [model length].
    struct Normals {
        std::function<double(const Vec3&)> inside{}; ///< thickness against the normals; null: 0
        std::function<double(const Vec3&)> outside{};
    };
    /// Along the mean normal of the source, up to a face.
    struct ToFace {
        const topology::Model* model = nullptr; ///< model that `face` belongs to
        FaceId face;
    };
    /// A value that changes along the sweep: either linear, with the value `last` at the target, or a
    /// function of the relative height in [0, 1].
    struct Profile {
        double last = 0;
        std::function<double(double height)> at{}; ///< null: linear
    };

    std::variant<Vector, Axis, Helix, Path, Normals, ToFace> course;
    std::optional<Profile> twist; ///< angle by which the section is turned, 0 at the source [degree]
    std::optional<Profile> scale; ///< size of the section relative to the source, 1 at the source [-]
};

/// What is assumed about missing faces.
enum class Assumed {
    shape,
    straight,   ///< that they are flat, or walls that are straight
    round_wall, ///< that a straight round wall joins two given rims
    rim,        ///< that no more faces are missing at a rim than it shows
};

/// An assumption about missing faces that changes the volume by more than 2 % if it is wrong.
struct Assumption {
    std::size_t note; ///< index in `Closure::notes`
    Assumed what = Assumed::shape;
};

/// The void entities added to seal the volume, and how they were made.
struct Closure {
    topology::VolumeClass value = topology::VolumeClass::closed;
    std::vector<EdgeId> void_edges;
    std::vector<FaceId> void_faces;
    std::vector<std::string> algorithms; ///< names as in the paper, in the order used: "Algorithm 8",
                                         ///< "Algorithm 4", …
    bool watertight = false;
    std::vector<Message> notes; ///< assumptions and alternatives, one sentence each
    std::vector<Assumption> assumptions;
};

/// A sealed volume, and how it was sealed. The given faces come first, then the void faces.
struct Closed {
    topology::OpenVolume volume;
    Closure closure;
};

/// Seal a volume: add void edges and faces with their geometry, and give every face its role.
///
/// Uses Algorithms 2–6 of the paper (docs/bibliography.md) and, for classes II to V, one of its Algorithms
/// 8–11. In class IV the missing end is added, in class V both ends. Departure: the paper joins only matched
/// vertices that are on no wall. Here, if wall edges lead part of the way from a matched vertex to its
/// partner, a void edge joins the end of these wall edges to the partner.
/// @param match  the match of source and target; ignored for classes IV and V, which lack an end.
/// @throw NotClosed  names the free loop, face or edge that cannot be sealed, the reason, and a shape or
///         direction that would seal it. "closure.shape_open": the user chose the roles, the shape of the
///         missing faces is ambiguous, and no shape was given; names the adjacent faces.
///         "closure.holes_open": an end is missing and the given one has holes without walls; reports the
///         volume with the holes covered and the volume with the holes extended to the other end.
/// @throw InvalidInput  a user's void edge is impossible (names its vertices), or an option does not apply to
///         the volume.
/// @throw Cancelled
/// @post  every edge is used twice, in opposite directions, and the volume enclosed is positive.
Closed close(const topology::OpenVolume& volume, const matching::Match& match,
             const CloseOptions& options = {}, const RunContext& context = {});

/// Log the notes of a closure as close() does. Assumptions are logged as `note: … [code]`.
void log_notes(const Closure& closure, const RunContext& context);

/// The user's void edges that join the rims of source and target, as pairs (source, target) of vertex tags,
/// which a match must contain.
std::vector<std::pair<int, int>> pairs_by_hand(const topology::OpenVolume& volume,
                                               const CloseOptions& options);

/// True when every edge is used twice in opposite directions and the facets enclose a positive volume.
bool is_watertight(const topology::OpenVolume& volume);

/// Volume enclosed by the facets, positive if they face outward [model length³].
double enclosed_volume(const topology::OpenVolume& volume);

} // namespace lacuna::closure
