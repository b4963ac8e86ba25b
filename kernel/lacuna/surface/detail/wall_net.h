// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/surface/detail/linking_map.h>

#include <optional>
#include <vector>

namespace lacuna::surface {

/// The edges inside a linking surface as a net that the walls' nodes follow. Long edges, which run along the
/// sweep, become columns; cross edges, which run around it, become levels. A node lies where they meet, turn
/// or end.
///
/// Side lines and rims are not part of the net; edges that end on them end in their nodes.
struct WallNet {
    /// A vertex with a node.
    struct Stop {
        VertexId vertex;
        Vec2 place = Vec2::Zero(); ///< in the strip
        std::size_t column = 0;
        int level = -1; ///< kSource, kTarget or a number of `levels`
    };
    static constexpr int kSource = -1, kTarget = -2;

    /// Consecutive long edges, or a vertex where cross edges turn or end.
    struct Column {
        double at = 0;                                ///< s in [0, 1)
        double low = 1, high = 0;                     ///< extent in t
        std::optional<std::size_t> line;              ///< the side line it coincides with
        std::optional<double> source_at, target_at{}; ///< running lengths of its ends on the rims
        EdgeId edge;                                  ///< an edge of the column, for messages
    };
    /// Connected cross edges, or a vertex between long edges.
    struct Level {
        double height = 0;               ///< mean t
        std::optional<std::size_t> ring; ///< index of the ring in the map
        bool plain = false; ///< a ring that turns and ends on side lines only, and meets no long edge
        std::vector<std::size_t> stops;
        std::vector<std::size_t> lines; ///< side lines that the ring meets
        EdgeId edge;                    ///< an edge of the level, for messages
    };
    struct LongEdge {
        const LinkingMap::Upright* upright;
        std::size_t low, high; ///< stops
        bool reversed;         ///< the edge runs from target to source
    };

    std::vector<Stop> stops;
    std::vector<Column> columns; ///< by rising s
    std::vector<Level> levels;   ///< by rising height
    std::vector<LongEdge> long_edges;

    /// Whether two levels overlap along the rim, so that each needs its own layer.
    [[nodiscard]] bool over_each_other(const LinkingMap& map, std::size_t a, std::size_t b) const;

    /// For each level: the levels below it that overlap it and therefore need layers of their own.
    [[nodiscard]] std::vector<std::vector<std::size_t>> levels_below(const LinkingMap& map) const;
};

/// The largest number of levels above each other. @param below  from `WallNet::levels_below()`
int most_levels(const std::vector<std::vector<std::size_t>>& below);

/// @throw NotSweepable "surface.wall_edge"  names an edge that is neither long nor cross: round, slanted, or
///        with an end on a rim or between two side lines where it must not end.
/// @note  O(edges² + facets of rings) of the linking surface.
WallNet wall_net(const topology::Model& model, const LinkingSurface& link, const LinkingMap& map);

/// @throw NotSweepable "surface.wall_edge"  names the edge and the walls beside it.
[[noreturn]] void refuse_wall_edge(const topology::Model& model, EdgeId edge, const char* why,
                                   const char* remedy);

} // namespace lacuna::surface
