// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/quads/region.h>
#include <lacuna/surface/shared/source_mesh.h>
#include <lacuna/surface/size_field.h>
#include <lacuna/sweep/shared/rim_columns.h>

namespace lacuna::sweep {

/// Which outline the source's quads are laid out in.
enum class Outline {
    source, ///< its own
    mean,   ///< half way to the target's
};

/// Lay the source's quads out anew in the outline half way between both rims, and put them on the source.
///
/// By its own outline alone a source has one quad in a right angle, which is folded flat where the target's
/// rim runs straight on. The mean outline is the mean of the source's rim and the target's, moved onto it
/// by the best rotation, scale and shift. Where the larger angle of both ends is more than the quads that
/// fit into the mean can share, the node is drawn in until one more fits. The quads go to the source by
/// `morph()`.
/// @param source  of a volume with one face on either end; rim nodes stay, all others are new.
/// @throw NotSweepable "sweep.mean_outline"  ends of several faces; a mean outline that crosses itself; what
///                     `mesher` throws.
surface::SourceMesh laid_between(const topology::OpenVolume& volume, surface::SourceMesh source,
                                 const RimColumns& columns, const surface::SizeField& size,
                                 const quads::PlanarQuadMesher& mesher, const RunContext& context);

} // namespace lacuna::sweep
