// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/matching/side_lines.h>
#include <lacuna/surface/shared/edge_nodes.h>
#include <lacuna/topology/open_volume.h>

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace lacuna::surface {

/// A segment of the source rim, and the segment of the target rim to which it is swept. Both are given by
/// running lengths on the linking surface's chains. The source segment lies within one edge.
struct RimSegment {
    double source_from = 0, source_to = 0;
    /// Running lengths on the target chain, increasing from segment to segment. They may exceed the length of
    /// the chain and count modulo this length.
    double target_from = 0, target_to = 0;
    std::size_t use = 0; ///< index in the source chain of the edge use that contains the segment
    bool given = false;  ///< whether the segment is exactly one side of a given quad
    /// Whether both ends of the segment are vertices of coarse facets, and the rim between them bends so
    /// little that one straight side may represent it: on the source (`follows`) and on the target.
    bool follows = false, target_follows = false;
    /// On linking surfaces without side lines: whether the column at the start of the segment runs along a
    /// crease of the walls (`Crease`).
    bool on_crease = false;

    friend bool operator==(const RimSegment&, const RimSegment&) = default;
};

class LinkingMap;

/// A side line with the positions of its ends on the chains of a linking surface.
struct LinkingLine {
    matching::SideLine line;
    double source_at = 0, target_at = 0; ///< running lengths of its ends
};

/// The ring of walls, given and void, between one source loop and one target loop. The literature on sweeping
/// calls it a linking surface; variables are named `link`.
///
/// The chain `source` follows the source's rim, with the source on its left. The chain `target` follows the
/// target's rim in the same sense around the sweep, with the target on its right. If there are side lines,
/// both chains start at the first side line.
struct LinkingSurface {
    std::vector<FaceId> walls;
    Chain source, target;
    std::vector<LinkingLine> lines;   ///< side lines in walking order
    std::vector<RimSegment> segments; ///< segments in walking order; the first one starts at source length 0
    /// For a ring without side lines: how far the walls wind around the sweep. The shortest path along the
    /// walls from the start of `source` to the target rim ends at this position, in turns around the ring;
    /// whole turns are counted. Empty if corresponding vertices of both rims are given.
    std::optional<double> branch{};
    /// The map of the walls, kept by `map_of()`. A linking surface must not be used by two threads at once.
    mutable std::shared_ptr<const LinkingMap> map{};
};

/// Whether a side line of a linking surface bends.
bool has_bent_line(const topology::Model& model, const LinkingSurface& link);

/// The part of the source edge that a segment covers, as fractions of the edge's length in its direction.
std::pair<double, double> edge_part(const LinkingSurface& link, const RimSegment& segment);

/// The edge use of the target's rim to which the middle of a segment is swept.
topology::EdgeUse target_use(const LinkingSurface& link, const RimSegment& segment);

/// How linking surfaces without side lines rotate between source and target.
enum class Turning {
    each,     ///< each one separately, with minimum shear of its walls
    together, ///< all loops as one rigid body; needed if the walls of holes wind around each other
};

/// A vertex of the source's rim, and the vertex of the target's rim to which it is swept. A side line may
/// join them, but need not.
struct RimPair {
    VertexId source, target;
};

/// The linking surfaces of a sealed volume, one for each loop of the source, in the order of the loops.
/// @param pairs  corresponding vertices. Pairs that are not in the same order around both rims, or that
///         contradict the side lines, are ignored.
/// @throw NotSweepable  walls join a source loop to no loop of the target, or to several; names them.
std::vector<LinkingSurface> linking_surfaces(const topology::OpenVolume& volume,
                                             Turning turning = Turning::each,
                                             std::span<const RimPair> pairs = {},
                                             const RunContext& context = {});

/// The linking surface of a face that is a tube (`is_tube()`), from its first loop to its second.
LinkingSurface tube_link(const topology::OpenVolume& volume, FaceId face, const RunContext& context = {});

} // namespace lacuna::surface
