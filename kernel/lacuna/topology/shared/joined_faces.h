// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/topology/model.h>

#include <optional>
#include <vector>

namespace lacuna::topology {

/// A model in which faces that continue each other on one exact surface are one face.
struct JoinedFaces {
    Model model;
    std::vector<FaceId> parent;              ///< for each face of `model`, its largest part
    std::vector<std::vector<FaceId>> joined; ///< the parts of each face that has several, the largest first
};

/// Join faces with the faces beside them on the same plane, cylinder, cone or sphere, such as the narrow
/// faces of a shell's cylinder that a CAD system leaves round the mouth of a nozzle. A face continues another
/// one if both have exact surfaces, the same kind, name, groups and regions, and the corners of its facets
/// lie on the shape that is fitted to the larger one, within the tolerance. The joined face has the tag of
/// its largest part. Each part keeps its exact surface; the facets of a plane are exact.
/// @param apart  for each face, its class: faces of different classes stay apart. Faces that were given as a
///               mesh, and void faces, stay apart as well.
/// @return  empty if no faces continue each other.
/// @note  O(facets).
std::optional<JoinedFaces> join_continued_faces(const Model& model, const std::vector<int>& apart,
                                                const RunContext& context = {});

} // namespace lacuna::topology
