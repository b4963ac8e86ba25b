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
/// If the source has a right angle in its own outline, one quad lies there; that quad degenerates if the
/// target's rim is straight at this node. The mean outline is the mean of the source's rim and the target's
/// after the best rotation, scaling and translation. If the larger angle of both ends is too large for the
/// number of quads that fit into the mean angle, the node is moved inward until one more fits. The quads are
/// mapped to the source by `morph()`.
/// @param source  of a volume with one face on either end; rim nodes are kept, all others are new.
/// @throw NotSweepable "sweep.mean_outline"  ends of several faces; a mean outline that intersects itself; as
///     `mesher`.
surface::SourceMesh laid_between(const topology::OpenVolume& volume, surface::SourceMesh source,
                                 const RimColumns& columns, const surface::SizeField& size,
                                 const quads::PlanarQuadMesher& mesher, const RunContext& context);

} // namespace lacuna::sweep
