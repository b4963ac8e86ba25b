// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/geometry/shared/motion.h>
#include <lacuna/surface/shared/imprint.h>
#include <lacuna/surface/shared/source_mesh.h>
#include <lacuna/sweep/detail/morph.h>

#include <optional>
#include <vector>

namespace lacuna::sweep {

/// For each source quad, its face and the target face that it is swept to.
struct EndFaces {
    std::vector<FaceId> source, target;
};

/// @param imprint  empty if the target is one face.
/// @param moved    whether the target's faces are images of the source's faces, in the same order.
EndFaces end_faces(const topology::OpenVolume& volume, const surface::SourceMesh& source,
                   const std::optional<surface::Imprint>& imprint, bool moved);

/// Morph the source mesh onto the target's faces as one surface.
Morphed morph_onto(const topology::OpenVolume& volume, const surface::SourceMesh& source,
                   const RimColumns& columns, const RunContext& context);

/// Morph the source mesh onto the target, one face at a time. Nodes of imprinted edges are placed first:
/// exactly on the target's edges, spaced as on the source. They then bound the inner nodes of each face.
/// @param face  target face of each quad.
Morphed morph_onto_faces(const surface::SourceMesh& source, const RimColumns& columns,
                         const surface::Seeds& seeds, const surface::Imprint& imprint,
                         const std::vector<FaceId>& face, const RunContext& context);

/// The source moved by the motion that made the walls. Rim nodes take the positions of the columns on the
/// target.
Morphed moved_by(const geometry::Motion& motion, const surface::SourceMesh& source,
                 const RimColumns& columns);

} // namespace lacuna::sweep
