// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/surface/linking_surface.h>
#include <lacuna/surface/size_field.h>
#include <lacuna/topology/open_volume.h>

#include <map>
#include <memory>
#include <vector>

namespace lacuna::surface {

/// The part of a target edge that a source edge is swept to.
struct EdgeImage {
    EdgeId target; ///< of the volume
    /// Fractions of its length at the source edge's ends, as that runs; of a closed edge past whole turns.
    double from = 0, to = 1;
};

/// Chains of points within both ends that are known to be swept to each other: along the shares named of
/// their lengths, evenly.
struct KnownLine {
    std::vector<Index> source, target;
    double source_from = 0, source_to = 1;
    double target_from = 0, target_to = 1;
};

/// A sealed volume whose source is split as its target is.
struct Imprint {
    /// Faces, edges and vertices of the volume given keep their ids. Parts of split source faces come after,
    /// with the tag and the name of the whole; edges imprinted have the tag of the target's.
    std::unique_ptr<topology::OpenVolume> volume;
    std::vector<LinkingSurface> links;
    std::vector<FaceId> source_of;      ///< of each face: the face of the volume given that it is of
    std::vector<FaceId> target_of;      ///< of each source face: the target face it is swept to
    std::map<EdgeId, EdgeImage> images; ///< of source edges that are swept to the target's inner edges
};

/// Lengths of what source edges are swept to, as `seed_source()` wants them [model length].
std::map<EdgeId, double> image_lengths(const Imprint& imprint);

/// Edges between two faces of one role. A seam, with one face on both sides, is none.
std::vector<EdgeId> inner_edges(const topology::OpenVolume& volume, topology::Role role);

/// Imprint the inner edges of the target on the source.
///
/// Source and target are laid in one plane: the source by `geometry::flatten()`, the target by the harmonic
/// map with its rim where the linking surfaces put it. Smooth closed edges of both ends that enclose about
/// the same become one, their starts turned to each other, and the target is laid anew with its edge on the
/// source's. Then the target's edges are cut against the source's. Edges and vertices of both that lie within
/// a part of a quad's size of each other become one; the source faces are split along the others and their
/// facets made anew.
/// @param known  lines that an imprint before this one has put on either end: they are laid on each other.
/// @throw NotSweepable "surface.not_imprinted"  names the target's edge: the ends cannot be laid on each
///        other one to one, an edge comes too close to another to be told from it, a source face keeps its
///        own quads.
Imprint imprint_target(const topology::OpenVolume& volume, std::span<const LinkingSurface> links,
                       const SizeField& size, std::span<const KnownLine> known = {});

} // namespace lacuna::surface
