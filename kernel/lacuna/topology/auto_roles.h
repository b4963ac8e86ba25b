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
    double cost = 0;                  ///< 0: flat parallel ends, square to their walls; lower is more likely
    long irregular = 0;               ///< lower bound of the source's irregular nodes (valence other than 4)
    std::vector<std::string> reasons; ///< sentences for the user
};

/// Limits of the search of role_candidates().
struct RoleOptions {
    /// The cheapest candidate is unambiguous if the next costs more by this much. Rule of thumb.
    double margin = 0.15;
    std::size_t most = 1000; ///< number of candidates that are checked in full, the cheapest first
};

/// Candidates for which faces of `model` are source, target and walls: those that cost at most `margin` more
/// than the cheapest, cheapest first.
///
/// Faces that meet smoothly form one patch, and an end is a patch. If no candidate is valid, flat faces with
/// smooth neighbours become patches of their own, such as the floor of a pocket with a rounded rim; then at
/// most one edge of the walls may leave each vertex of an end.
///
/// Two ends (classes I–III, closed) need equal numbers of loops, no common vertex, and walls that each join
/// one loop of either end. One end (IV) needs walls on its whole rim, each of which leads to a free loop. No
/// end (V) needs tubes of walls with a free loop on either side. A ring of walls may be missing between two
/// ends too. If no face is missing, ends may also consist of all flat patches that face in one direction and
/// in the opposite one, at several heights. Candidates are ranked by how flat the ends are, how square to the
/// walls, how similar and how far apart, and by how many sharp edges between walls do not run from end to
/// end.
///
/// A face meshed with quads has at least |4 (2 − rims) − quarter turns of its rims| irregular nodes
/// (Gauss-Bonnet).
/// @return empty if no candidate is valid.
/// @throw InvalidInput  the faces cannot be oriented.
/// @throw Cancelled
///
/// Pairs of ends are first filtered by Euler numbers, because walls between two ends have no handles. Only
/// few face pairs of a plate with a thousand holes are therefore checked in full.
/// @note  O(facets + checked pairs of patches + candidates checked · edges between patches); memory for
///         candidates is bounded by some 10 MB.
std::vector<RoleCandidate> role_candidates(const Model& model, const std::vector<FaceId>& faces,
                                           const RoleOptions& options = {}, const RunContext& context = {});

/// A candidate as a recipe would name it: class and face tags; long lists are shortened.
std::string in_words(const Model& model, const Roles& roles, VolumeClass value);

} // namespace lacuna::topology
