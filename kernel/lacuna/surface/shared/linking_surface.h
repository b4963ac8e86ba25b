// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/matching/side_lines.h>
#include <lacuna/surface/shared/edge_nodes.h>
#include <lacuna/topology/open_volume.h>

#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace lacuna::surface {

/// A segment of the source rim and the segment of the target rim it is swept to, in running lengths of the
/// linking surface's chains. It lies within one source edge.
struct RimSegment {
    double source_from = 0, source_to = 0;
    double target_from = 0, target_to = 0; ///< may exceed the target chain's length: modulo it
    std::size_t use = 0;                   ///< index of the use in the source chain
    bool given = false;                    ///< one side of a quad: it lies between given nodes
    /// Whether both ends of the segment are vertices of the rim's facets, and the rim bends no more between
    /// them than a straight side may; on the source, and on the target.
    bool follows = false, target_follows = false;
    bool on_crease = false; ///< without side lines: the column at its start runs along a crease of the walls
};

/// A side line as the linking surface sees it.
struct LinkingLine {
    matching::SideLine line;
    double source_at = 0, target_at = 0; ///< running lengths of its ends
};

/// The ring of walls, given and void, between one source loop and one target loop: what the literature on
/// sweeping calls a linking surface. Here and in the code near it, `link` for short.
///
/// `source` walks along the source's rim with the source on its left; `target` walks along the target's rim
/// in the same sense, so with the target on its right. Both start at the first side line, if there is one.
struct LinkingSurface {
    std::vector<FaceId> walls;
    Chain source, target;
    std::vector<LinkingLine> lines;   ///< in walking order
    std::vector<RimSegment> segments; ///< in walking order, the first from source length 0
    /// For a ring without side lines: where the shortest path from the source's start ends on the target rim,
    /// as a number of turns around the ring. Not set if corresponding vertices of both rims are given.
    std::optional<double> branch{};
};

/// The part of its source edge that a segment covers: fractions of the edge's length, in its direction.
std::pair<double, double> edge_part(const LinkingSurface& link, const RimSegment& segment);

/// The use of the target's rim that a segment is swept to, by its middle.
topology::EdgeUse target_use(const LinkingSurface& link, const RimSegment& segment);

/// How linking surfaces without side lines rotate between source and target.
enum class Turning {
    each,     ///< each on its own, with minimum shear of its walls
    together, ///< all loops as one rigid body; required if holes wind around each other
};

/// Vertices on the rims that are swept to each other, with or without a side line.
struct RimPair {
    VertexId source, target;
};

/// The linking surfaces of a sealed volume: one for each loop of the source, in their order.
/// @param pairs  in the same order around both rims and consistent with the side lines; others are ignored.
/// @throw NotSweepable  walls that join a source loop to none or several of the target's; names them.
std::vector<LinkingSurface> linking_surfaces(const topology::OpenVolume& volume,
                                             Turning turning = Turning::each,
                                             std::span<const RimPair> pairs = {},
                                             const RunContext& context = {});

} // namespace lacuna::surface
