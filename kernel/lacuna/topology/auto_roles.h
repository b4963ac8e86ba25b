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
    double cost = 0; ///< 0: flat parallel ends, square to their walls; the higher the less likely
    std::vector<std::string> reasons; ///< in words
};

/// Every way to read some faces of `model` as source, target and walls, most likely first.
///
/// Faces that meet smoothly are one patch; an end is a patch. Two ends (classes I–III, closed) need as many
/// loops on both, no vertex in common, and walls that join one loop of each. One end (IV) needs walls on
/// its whole rim that lead to a free loop each. No end (V) needs walls in tubes with a loop at either side.
/// What passes is ranked by how flat the ends are, how square to the walls, how alike, and how far apart.
/// @return empty where no reading passes.
/// @throw InvalidInput  faces that cannot be oriented. Cancelled.
/// @note  O(facets + patches² · edges between patches).
std::vector<RoleCandidate> role_candidates(const Model& model, const std::vector<FaceId>& faces,
                                           const RunContext& context = {});

/// The most likely reading. Only readings about as likely as the best are looked at closely.
/// @throw InvalidInput  none, or several that are about as likely; names the candidates' faces. Cancelled.
RoleCandidate find_roles(const Model& model, const std::vector<FaceId>& faces,
                         const RunContext& context = {});

} // namespace lacuna::topology
