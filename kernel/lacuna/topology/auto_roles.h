// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/topology/open_volume.h>

#include <string>
#include <vector>

namespace lacuna::topology {

/// An assignment of source, target and walls to some faces.
struct RoleCandidate {
    Roles roles;
    VolumeClass value = VolumeClass::closed;
    double cost = 0;                  ///< lower: more likely; 0: flat, parallel ends, normal to the sweep
    long irregular = 0;               ///< lower bound of the source's irregular nodes (valence other than 4)
    std::vector<std::string> reasons; ///< sentences for the user
};

/// Cost of a candidate without ends. Any other cost is relative to that of an end that bends by 180°.
inline constexpr double kNoEnd = 0.1;

/// Limits of the search of role_candidates().
struct RoleOptions {
    /// The cheapest candidate is unambiguous if the next one costs at least this much more. Rule of thumb.
    double margin = 0.15;
    std::size_t most = 1000; ///< number of candidates that are checked in full, the cheapest first
    bool branches = false; ///< whether walls beside ends at several heights may lean, as those of branches do
};

/// Find candidates for the roles of `faces` (source, target, walls): the cheapest one and those that cost at
/// most `margin` more, in ascending order of cost.
///
/// Faces that meet smoothly form one patch, and an end is a patch. If no candidate is valid, the search is
/// repeated in another way: flat faces with smooth neighbours, such as the floor of a pocket with a rounded
/// rim, become patches of their own, and at most one edge of the walls may leave each vertex of an end.
///
/// Conditions by class:
/// - Two ends (classes I–III, closed): the ends have equal numbers of loops and no common vertex. Each
///   connected set of walls joins one loop of the source to one loop of the target. Where a ring of walls is
///   missing between the ends, the walls on either side of it join a loop of an end to a free loop.
/// - One end (IV): the end has walls on its whole rim, and each ring of walls leads to a free loop.
/// - No end (V): the walls are tubes with two free loops each.
/// - No missing face (closed): the ends may also consist of several flat patches at different heights. One
///   end then has all patches that face in one direction, the other end all patches that face in the opposite
///   direction.
///
/// The cost of a candidate is low if the ends are flat, perpendicular to the walls, of similar area, and
/// opposite to each other. Walls whose normals point along the sweep add to the cost, and so do sharp edges
/// between walls that do not run from end to end.
///
/// `RoleCandidate::irregular` follows from the Gauss-Bonnet theorem: an end meshed with quads has at least
/// |4 (2 − rims) − quarter turns of its rims| irregular nodes.
/// @return empty if no candidate is valid.
/// @throw InvalidInput  the faces cannot be oriented.
/// @throw Cancelled
/// @note  Euler numbers exclude most pairs of ends, because walls between two ends have no handles: for a
///         plate with a thousand holes, only a few pairs are checked in full. O(facets + checked pairs of
///         patches + candidates checked · edges between patches); memory for candidates is bounded by some
///         10 MB.
std::vector<RoleCandidate> role_candidates(const Model& model, const std::vector<FaceId>& faces,
                                           const RoleOptions& options = {}, const RunContext& context = {});

/// A candidate as a recipe would name it: class and face tags; long lists are shortened.
std::string in_words(const Model& model, const Roles& roles, VolumeClass value);

} // namespace lacuna::topology
