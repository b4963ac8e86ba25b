// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/surface/shared/linking_surface.h>
#include <lacuna/surface/size_field.h>
#include <lacuna/topology/open_volume.h>

#include <map>
#include <memory>
#include <vector>

namespace lacuna::surface {

/// The part of a target edge to which a source edge is swept.
struct EdgeImage {
    EdgeId target; ///< edge of the volume's target
    /// Fractions of the target edge at the source edge's ends, in the source edge's direction; whole turns
    /// are counted for closed edges.
    double from = 0, to = 1;
};

/// Two chains of points, one inside each end, that are known to be swept to each other, uniformly between the
/// given shares of their lengths.
struct KnownLine {
    std::vector<Index> source, target;
    double source_from = 0, source_to = 1;
    double target_from = 0, target_to = 1;
};

/// A sealed volume whose source is split as its target is.
struct Imprint {
    /// Faces, edges and vertices of the original volume keep their ids. The parts of split source faces
    /// follow, with the tag and the name of the whole face; imprinted edges have the tag of the target's.
    std::unique_ptr<topology::OpenVolume> volume;
    std::vector<LinkingSurface> links;
    std::vector<FaceId> source_of;      ///< for each face: the face of the original volume that contains it
    std::vector<FaceId> target_of;      ///< for each source face: the target face it is swept to
    std::map<EdgeId, EdgeImage> images; ///< images of source edges that are swept to the target's inner edges
};

/// Lengths of the images of source edges, as `seed_source()` needs them [model length].
std::map<EdgeId, double> image_lengths(const Imprint& imprint);

/// Edges between two faces of one role. A seam, with one face on both sides, is not included.
std::vector<EdgeId> inner_edges(const topology::OpenVolume& volume, topology::Role role);

/// Imprint the inner edges of the target on the source.
///
/// Source and target are mapped onto one plane: the source by `geometry::flatten()`, the target by the
/// harmonic map with its rim placed by the linking surfaces. Smooth closed edges of both ends that enclose
/// about the same region are merged, their start points aligned, and the target is mapped again with its edge
/// on the source's. Then the target's edges are intersected with the source's. Edges and vertices closer than
/// a fraction of the quad size are merged; the source faces are split along the others and retriangulated.
/// @param known  lines that an earlier imprint created on both ends: they are made coincident.
/// @throw NotSweepable "surface.not_imprinted"  names the target's edge: the ends cannot be mapped onto each
///        other one to one, an edge is too close to another to be kept apart, or a source face keeps its own
///        quads.
Imprint imprint_target(const topology::OpenVolume& volume, std::span<const LinkingSurface> links,
                       const SizeField& size, std::span<const KnownLine> known = {});

} // namespace lacuna::surface
