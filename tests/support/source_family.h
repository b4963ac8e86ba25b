// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/topology/open_volume.h>

#include <string>
#include <vector>

namespace lacuna::test {

/// A volume whose source has several faces, or a curved one.
struct FamilySource {
    std::string name;
    topology::OpenVolume volume;
    /// Irregular nodes inside the union of the source faces that a person would draw: by the sum rule, from
    /// its corners and holes.
    int least_irregular = 0;
    bool plane = true; ///< all source faces lie in one plane
    bool grid = false; ///< the union and each face are a grid or rings, which need no irregular node
};

/// Sources of several plane faces that share edges (split rings, discs, plates, boards), and of curved faces
/// (parts of cylinder, cone, sphere, saddle and twisted surfaces). All faces are facets; the targets are the
/// same shapes moved or blown up, the walls what is between.
/// @param facets  along each side of the patches the facets are made of, >= 4
std::vector<FamilySource> source_family(int facets = 24);

} // namespace lacuna::test
