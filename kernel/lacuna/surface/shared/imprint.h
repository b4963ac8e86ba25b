// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/surface/shared/linking_surface.h>
#include <lacuna/surface/size_field.h>
#include <lacuna/topology/open_volume.h>

#include <map>
#include <memory>
#include <span>
#include <vector>

namespace lacuna::surface {

/// Maximum ratio of lengths on one end to those of their image on the other end. Ends that shrink more are
/// refused, because quads on the other end would have to be smaller by the same factor. Examples: the floor
/// edge of a tube that is three radii deep inside an end stays below the limit; at a depth of 16 radii, a
/// ring would need 49,000 sides. Heuristic.
inline constexpr double kMostShrunk = 20;

/// The part of a target edge to which a source edge is swept.
struct EdgeImage {
    EdgeId target; ///< edge of the volume's target
    /// Images of the two ends of the source edge, as fractions of the target edge's length. On a closed
    /// target edge, each whole turn adds 1.
    double from = 0, to = 1;
};

/// Two corresponding lines, one on each end. Each line is a part of a chain of points, between two shares of
/// the chain's length. Points at the same share of the two parts correspond.
struct KnownLine {
    std::vector<Index> source, target; ///< points of the chains
    double source_from = 0, source_to = 1;
    double target_from = 0, target_to = 1;
};

/// A sealed volume whose source is split in the same way as its target.
struct Imprint {
    /// Faces, edges and vertices of the original volume keep their ids. New parts of split source faces
    /// follow them, with the tag and name of the whole face. Imprinted edges have the tags of the target's
    /// edges.
    std::unique_ptr<topology::OpenVolume> volume;
    std::vector<LinkingSurface> links;
    std::vector<FaceId> source_of; ///< for each face: the face of the original volume that contains it
    std::vector<FaceId> target_of; ///< for each source face, the target face to which it is swept
    /// For each source edge that is swept to an inner edge of the target: its image.
    std::map<EdgeId, EdgeImage> images;
    /// Whether inner edges of the target are represented by sides of kept quads.
    bool follows_quads = false;
};

/// Lengths of the images of source edges, as `seed_source()` needs them [model length].
std::map<EdgeId, double> image_lengths(const Imprint& imprint);

/// Edges between two faces of one role. A seam, with one face on both sides, is not included.
std::vector<EdgeId> inner_edges(const topology::OpenVolume& volume, topology::Role role);

/// Closed lines of inner edges of an end that no other inner edge and no edge of the rim touches.
/// @param inner  all inner edges of the end, or some of them.
std::vector<std::vector<topology::EdgeUse>> closed_lines(const topology::OpenVolume& volume,
                                                         topology::Role end, std::span<const EdgeId> inner);

/// Which inner edges of the target are imprinted: all, or only lines that touch its rim or each other.
enum class ImprintedLines { all, open };

/// Imprint the inner edges of the target on the source, so that both ends are split in the same way.
///
/// 1. Source and target are mapped onto one plane: the source by `geometry::flatten()`, the target by a
///    harmonic map, in which the linking surfaces determine the positions of the target's rim.
/// 2. The edges of the target are intersected with those of the source. Edges and vertices closer to each
///    other than a fraction of the quad size are merged.
/// 3. The source faces are split along the edges that exist only on the target, and retriangulated. Closed
///    lines over faces with kept quads are represented by sides of these quads instead: the nodes there stay,
///    and their images on the target lie on the line.
/// @param known  corresponding lines that an earlier imprint created on both ends. They are made to coincide
///         in the plane.
/// @throw NotSweepable "surface.not_imprinted"  the ends cannot be mapped onto each other one to one, an edge
///         is so close to another that quads do not fit between them, or no sides of the quads that a source
///         face keeps fit the line; names the target's edge.
Imprint imprint_target(const topology::OpenVolume& volume, std::span<const LinkingSurface> links,
                       const SizeField& size, std::span<const KnownLine> known = {},
                       ImprintedLines lines = ImprintedLines::all);

} // namespace lacuna::surface
