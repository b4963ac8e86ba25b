// SPDX-License-Identifier: MIT
#pragma once

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
/// Faces that meet smoothly are one patch; an end is a patch. A pair of ends (classes I–III, closed) needs as many loops on
/// both, no shared vertex, and walls that join one loop of each; one end (IV) needs walls on its whole rim that lead to a free loop each; no end
/// (V) needs walls in tubes with a loop at either side. What passes is ranked by how flat the ends are, how square to the walls,
/// how alike, and how far apart. @return empty where no reading passes.
std::vector<RoleCandidate> role_candidates(const Model& model, const std::vector<FaceId>& faces);

/// The most likely reading.
/// @throw InvalidInput  none, or several that are about as likely; names the candidates' faces.
RoleCandidate find_roles(const Model& model, const std::vector<FaceId>& faces);

} // namespace lacuna::topology
