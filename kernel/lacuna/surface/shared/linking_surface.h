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
    /// May exceed the length of the target chain; such values count modulo that length.
    double target_from = 0, target_to = 0;
    std::size_t use = 0; ///< index in the source chain of the edge use that contains the segment
    bool given = false;  ///< whether the segment is exactly one side of a given quad
    /// Whether both ends of the segment are vertices of the rim's facets, and the rim between these vertices
    /// bends no more than one straight side may. `follows` refers to the source, `target_follows` to the
    /// target.
    bool follows = false, target_follows = false;
    /// On surfaces without side lines: whether the column at the start of the segment runs along a crease of
    /// the walls.
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
/// `source` follows the source's rim with the source on its left. `target` follows the target's rim around
/// the sweep in the same sense, with the target on its right. Both start at the first side line, if there is
/// one.
struct LinkingSurface {
    std::vector<FaceId> walls;
    Chain source, target;
    std::vector<LinkingLine> lines;   ///< side lines in walking order
    std::vector<RimSegment> segments; ///< segments in walking order; the first one starts at source length 0
    /// For a ring without side lines: the position on the target rim at which the shortest path from the
    /// source's start ends, as a number of turns around the ring. Empty if corresponding vertices of both
    /// rims are given.
    std::optional<double> branch{};
    /// The map of the walls, kept by `map_of()`. A linking surface must not be used by two threads at once.
    mutable std::shared_ptr<const LinkingMap> map{};
};

/// The part of the source edge that a segment covers, as fractions of the edge's length in its direction.
std::pair<double, double> edge_part(const LinkingSurface& link, const RimSegment& segment);

/// The edge use of the target's rim to which the middle of a segment is swept.
topology::EdgeUse target_use(const LinkingSurface& link, const RimSegment& segment);

/// How linking surfaces without side lines rotate between source and target.
enum class Turning {
    each,     ///< each one separately, with minimum shear of its walls
    together, ///< all loops as one rigid body; needed if holes wind around each other
};

/// A vertex of the source's rim, and the vertex of the target's rim to which it is swept, with or without a
/// side line.
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

} // namespace lacuna::surface
