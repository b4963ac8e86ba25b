// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/matching/match.h>
#include <lacuna/topology/open_volume.h>

#include <string>
#include <utility>
#include <vector>

namespace lacuna::closure {

/// How a void edge runs between its two vertices.
enum class EdgeShape {
    /// Straight; `follow` where straight would stray from the walls. Where that crosses the given faces or
    /// encloses no volume, the first of straight, `follow` and `smooth` that seals.
    automatic,
    straight, ///< the paper's
    follow,   ///< as the side edges next to it
    smooth,   ///< a cubic that leaves both ends along the walls there, else along the faces' normals
};

/// How a missing end (class IV) is shaped.
enum class Cap {
    automatic, ///< flat; parallel where flat would cross the given faces
    flat,      ///< in the plane of its rim, or between its rim's heights (Algorithm 4)
    parallel,  ///< the given end's shape, moved to the rim as the walls lead
};

/// What becomes of holes of a given end that have no walls.
enum class Holes {
    automatic, ///< refused where the other end is missing; else closed as the match says
    cover,     ///< covered in the end's surface
    through,   ///< taken through to the other end
};

/// A void edge given by hand.
struct VoidEdge {
    int from = 0, to = 0;     ///< tags of vertices on the free rims
    std::vector<Vec3> points; ///< between the two, in that order; none: straight [model length]
};

struct CloseOptions {
    EdgeShape edge_shape = EdgeShape::automatic;
    std::vector<VoidEdge> void_edges{}; ///< given by hand, with those of the match that are not
    Cap cap = Cap::automatic;
    Holes holes = Holes::automatic;
    bool take_guess = false; ///< take what nothing given tells as it closes; an option above takes it as well
};

/// Something that closing assumed, without which the volume would differ by more than 2 %.
struct Assumption {
    std::string code; ///< stable, for programs: "closure.end_moved"
    std::string text; ///< one of the closure's notes
};

/// What was added to seal the volume, and how.
struct Closure {
    topology::VolumeClass value = topology::VolumeClass::closed;
    std::vector<EdgeId> void_edges;
    std::vector<FaceId> void_faces;
    std::vector<std::string> algorithms; ///< of the paper, in the order used: "Algorithm 8", "Algorithm 4", …
    bool watertight = false;
    std::vector<std::string> notes;      ///< what was taken though something else may have been meant
    std::vector<Assumption> assumptions; ///< those notes that say what matters
};

/// Seal the volume: add void edges and faces with their geometry, and give every face its role.
///
/// Algorithms 2–6 and one closer a class, 8–11. Classes IV and V have no target before, and both ends after.
/// Departure: where walls stand for part of the way between source and target, a void edge joins what they
/// leave open of each matched pair; the paper joins only vertices that are on no wall.
/// @param volume  out: with the void entities added.
/// @param match   of source and target; not read for classes IV and V, which have no two ends to match.
/// @throw NotClosed  names the free loop, face or edge that cannot be sealed, and why; and another shape or
///         direction that was found to seal it. "closure.shape_open": nothing given tells the shape of
///         what is missing, and neither a shape nor a guess was asked for; names the faces round it.
///         "closure.holes_open": an end is missing and the given one has holes without walls; says what is
///         enclosed with these covered and taken through.
/// @throw InvalidInput  a void edge given by hand that cannot be one; names its vertices. An option that the
///         volume has no use for.
/// @throw Cancelled
/// @post  every edge is used twice, in opposite directions, and the volume enclosed is positive.
Closure close(topology::OpenVolume& volume, const matching::Match& match, const CloseOptions& options = {},
              const RunContext& context = {});

/// Hand a closure's notes to the log, those of assumptions as `note: … [code]`, as close() does.
void log_notes(const Closure& closure, const RunContext& context);

/// The void edges given by hand that join the rims of source and target, as pairs (source, target) of vertex
/// tags: what a match has to keep to.
std::vector<std::pair<int, int>> pairs_by_hand(const topology::OpenVolume& volume,
                                               const CloseOptions& options);

/// True when every edge is used twice in opposite directions and the facets enclose a positive volume.
bool is_watertight(const topology::OpenVolume& volume);

/// Volume the facets enclose, positive when they are oriented outward [model length³].
double enclosed_volume(const topology::OpenVolume& volume);

} // namespace lacuna::closure
