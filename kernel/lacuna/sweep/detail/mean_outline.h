// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/quads/region.h>
#include <lacuna/surface/shared/source_mesh.h>
#include <lacuna/surface/size_field.h>
#include <lacuna/sweep/shared/rim_columns.h>

namespace lacuna::sweep {

/// The outline in which the source's quads are laid out.
enum class Outline {
    source, ///< the source's own outline
    mean,   ///< the mean of the source's and the target's outline
};

/// Lay out the source's quads in the mean outline of both rims, and map them onto the source.
///
/// If the source's outline has a right angle at a node, a single quad lies in that corner. This quad
/// degenerates if the target's rim is straight at the same node. The mean outline averages the source's rim
/// and the target's rim after the best rotation, scaling and translation. At each node, the larger of the two
/// angles on both ends determines how many quads meet there. If the mean angle is too small for this number
/// of quads, the node is moved inward until they fit. The quads are mapped to the source by `morph()`.
/// @param source  of a volume with one face at either end. Rim nodes are kept, all others are new.
/// @throw NotSweepable "sweep.mean_outline"  an end has several faces, or the mean outline intersects itself;
///         or as `mesher`.
surface::SourceMesh laid_between(const topology::OpenVolume& volume, surface::SourceMesh source,
                                 const RimColumns& columns, const surface::SizeField& size,
                                 const quads::PlanarQuadMesher& mesher, const RunContext& context);

} // namespace lacuna::sweep
