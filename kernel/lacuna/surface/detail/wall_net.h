// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/surface/detail/linking_map.h>

#include <optional>
#include <vector>

namespace lacuna::surface {

/// The edges inside a linking surface, as a net that the walls' nodes follow.
/// - Long edge: runs along the sweep. Consecutive long edges form a column.
/// - Cross edge: runs around the sweep. Connected cross edges form a level.
/// - Stop: a vertex at which a node must lie, because edges of the net meet, turn or end there.
///
/// Side lines and rims are not part of the net. If an edge ends on a side line or rim, a node lies there.
struct WallNet {
    /// A vertex at which a node must lie.
    struct Stop {
        VertexId vertex;
        Vec2 place = Vec2::Zero(); ///< position (s, t) in the strip
        std::size_t column = 0;    ///< index in `columns`
        int level = -1;            ///< kSource, kTarget or an index in `levels`
    };
    static constexpr int kSource = -1, kTarget = -2;

    /// Consecutive long edges, or a single vertex at which cross edges turn or end.
    struct Column {
        double at = 0;                   ///< its s in [0, 1)
        double low = 1, high = 0;        ///< its range of t
        std::optional<std::size_t> line; ///< the side line with which it coincides
        /// Running lengths of its ends on the source's and the target's rim.
        std::optional<double> source_at, target_at{};
        EdgeId edge; ///< an edge of the column, for messages
    };
    /// Connected cross edges, or a single vertex at which only long edges meet.
    struct Level {
        double height = 0;               ///< mean t
        std::optional<std::size_t> ring; ///< index of the ring in the map
        /// Whether the level is a ring that meets no long edge, and turns or ends on side lines only. Such a
        /// ring needs no stops.
        bool plain = false;
        std::vector<std::size_t> stops;
        std::vector<std::size_t> lines; ///< side lines that the ring meets
        EdgeId edge;                    ///< an edge of the level, for messages
    };
    struct LongEdge {
        const LinkingMap::Upright* upright;
        std::size_t low, high; ///< stops
        bool reversed;         ///< whether the edge is directed from target to source
    };

    std::vector<Stop> stops;
    std::vector<Column> columns; ///< in order of increasing s
    std::vector<Level> levels;   ///< in order of increasing height
    std::vector<LongEdge> long_edges;

    /// Whether two levels overlap along the rim, so that they need different layers.
    [[nodiscard]] bool over_each_other(const LinkingMap& map, std::size_t a, std::size_t b) const;

    /// For each level: the levels below it that overlap it along the rim, and therefore need different
    /// layers.
    [[nodiscard]] std::vector<std::vector<std::size_t>> levels_below(const LinkingMap& map) const;
};

/// The largest number of levels above each other. @param below  from `WallNet::levels_below()`
int most_levels(const std::vector<std::vector<std::size_t>>& below);

/// @throw NotSweepable "surface.wall_edge"  an edge runs neither along the sweep nor around it, or it ends on
///         a rim or between two side lines where it must not end; names the edge.
/// @note  O(edges² + facets of rings) of the linking surface.
WallNet wall_net(const topology::Model& model, const LinkingSurface& link, const LinkingMap& map);

/// @throw NotSweepable "surface.wall_edge"  names the edge and the walls beside it.
[[noreturn]] void refuse_wall_edge(const topology::Model& model, EdgeId edge, const char* why,
                                   const char* remedy);

} // namespace lacuna::surface
