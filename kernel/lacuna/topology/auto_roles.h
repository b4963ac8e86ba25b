// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/topology/open_volume.h>

#include <string>
#include <vector>

namespace lacuna::topology {

/// One way to read a set of faces as a volume to be swept.
struct RoleCandidate {
    Roles roles;
    VolumeClass value = VolumeClass::closed;
    double cost = 0;    ///< 0: flat parallel ends, square to their walls; the higher the less likely
    long irregular = 0; ///< nodes of the source's quads with other than four neighbours, at least
    std::vector<std::string> reasons; ///< in words
};

/// How far role_candidates() looks.
struct RoleOptions {
    /// A reading has to cost less than the next by this much to be taken without asking. A choice, not a
    /// measurement.
    double margin = 0.15;
    std::size_t most = 1000; ///< readings that are looked at closely, the cheapest first
};

/// The ways to read some faces of `model` as source, target and walls that cost less than the cheapest and
/// the margin, cheapest first.
///
/// Faces that meet smoothly are one patch; an end is a patch. Where no reading passes so, flat faces that
/// others go on from smoothly are patches of their own, as the floor of a pocket with a rounded rim; then one
/// edge of the walls at most may leave each vertex of an end.
///
/// Two ends (classes I–III, closed) need as many loops on both, no vertex in common, and walls that join one
/// loop of each. One end (IV) needs walls on its whole rim that lead to a free loop each. No end (V) needs
/// walls in tubes with a loop at either side.
/// Between two ends a ring of walls may be missing too. Where nothing is, ends may be all flat patches that
/// face one way and the other, at several heights. What passes is ranked by how flat ends are, how square to
/// the walls, alike and far apart, and how many sharp edges of walls do not lead from end to end.
///
/// The irregular nodes of a face with quads at its corners are 4 (2 − rims) less its rims' quarter turns
/// (Gauss and Bonnet), at least.
/// @return empty where no reading passes.
/// @throw InvalidInput  faces that cannot be oriented. Cancelled.
/// Two ends are weighed where the Euler numbers of what is left do not rule them out: walls between them have
/// no tunnels. So of a plate with a thousand holes few pairs of its faces are.
/// @note  O(facets + pairs of patches that are weighed + readings tried · edges between patches); as many
///        readings are kept at once as fit in some 10 MB.
std::vector<RoleCandidate> role_candidates(const Model& model, const std::vector<FaceId>& faces,
                                           const RoleOptions& options = {}, const RunContext& context = {});

/// A reading as a recipe would name it: its class and the tags of its faces, the first of long lists.
std::string in_words(const Model& model, const Roles& roles, VolumeClass value);

} // namespace lacuna::topology
