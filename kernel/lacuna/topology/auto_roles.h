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
    double cost = 0;                  ///< lower is more likely; 0: flat, parallel ends, normal to the sweep
    long irregular = 0;               ///< lower bound of the source's irregular nodes (valence other than 4)
    std::vector<std::string> reasons; ///< sentences for the user
};

/// Limits of the search of role_candidates().
struct RoleOptions {
    /// The cheapest candidate is unambiguous if the next one costs at least this much more. Rule of thumb.
    double margin = 0.15;
    std::size_t most = 1000; ///< number of candidates that are checked in full, the cheapest first
};

/// Find candidates for the roles of `faces` (source, target, walls): the cheapest one and those that cost at
/// most `margin` more, in ascending order of cost.
///
/// Faces that meet smoothly form one patch, and an end is a patch. If no candidate is valid, flat faces with
/// smooth neighbours become patches of their own, such as the floor of a pocket with a rounded rim; then at
/// most one edge of the walls may leave each vertex of an end.
///
/// Two ends (classes I–III, closed) must have equal numbers of loops and no common vertex. Each connected set
/// of walls must join one loop of the source to one loop of the target; a ring of missing walls may lie
/// between. One end (IV) must have walls on its whole rim, and each ring of walls must lead to a free loop.
/// Without ends (V), the walls must be tubes with two free loops each. If no face is missing, the ends may
/// also consist of several flat patches at different heights: one end of all patches that face in one
/// direction, the other of all that face in the opposite direction.
///
/// Candidates are ranked by how flat the ends are, how perpendicular to the walls, how similar in area, and
/// how directly they face each other. Walls whose normals point along the sweep, and sharp edges between
/// walls that do not run from end to end, add to the cost.
///
/// An end meshed with quads has at least |4 (2 − rims) − quarter turns of its rims| irregular nodes
/// (Gauss-Bonnet).
/// @return empty if no candidate is valid.
/// @throw InvalidInput  the faces cannot be oriented.
/// @throw Cancelled
///
/// Pairs of ends are first filtered by Euler numbers, because walls between two ends have no handles. Of the
/// pairs of faces of a plate with a thousand holes, only a few are then checked in full.
/// @note  O(facets + checked pairs of patches + candidates checked · edges between patches); memory for
///         candidates is bounded by some 10 MB.
std::vector<RoleCandidate> role_candidates(const Model& model, const std::vector<FaceId>& faces,
                                           const RoleOptions& options = {}, const RunContext& context = {});

/// A candidate as a recipe would name it: class and face tags; long lists are shortened.
std::string in_words(const Model& model, const Roles& roles, VolumeClass value);

} // namespace lacuna::topology
