// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/topology/open_volume.h>

#include <cstddef>
#include <utility>
#include <vector>

namespace lacuna::closure {

/// A closed line between a branch and its main body: of concave edges, the rim of a fillet on the main body,
/// or a line at which a tube leaves a smooth junction. A fillet is part of the branch.
struct Mouth {
    std::vector<EdgeId> edges;
    std::vector<EdgeId> beyond{};     ///< the other rim of the fillet; empty without one
    FaceId fillet{};                  ///< a face of it; none once the rim on the main body is known
    std::size_t host = 0, branch = 0; ///< the regions of the skin on the two sides of the mouth: main body
                                      ///< and branch
};

/// The regions into which the mouths divide the skin, and the ends of each region.
struct Branching {
    std::vector<std::size_t> region;        ///< by face
    std::vector<std::vector<FaceId>> faces; ///< by region
    std::vector<std::vector<Vec3>> ends;    ///< centres of the ends, by region
    std::vector<Mouth> mouths;
    /// A smooth junction and a tube of the main body: no mouth is between them.
    std::vector<std::pair<FaceId, FaceId>> passed;
};

/// The mouths of all branches of a volume.
Branching find_mouths(const topology::OpenVolume& volume, const RunContext& context);

/// Points along some edges; the last point of each edge is left out.
std::vector<Vec3> places(const topology::Model& model, const std::vector<EdgeId>& edges);

} // namespace lacuna::closure
