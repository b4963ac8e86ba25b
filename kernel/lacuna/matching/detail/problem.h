// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/matching/detail/loop_shape.h>
#include <lacuna/matching/match.h>

#include <cstddef>
#include <map>
#include <optional>
#include <vector>

namespace lacuna::matching {

/// Points that correspond.
struct PointPairs {
    std::vector<Vec3> from, to;

    void add(const PointPairs& more)
    {
        from.insert(from.end(), more.from.begin(), more.from.end());
        to.insert(to.end(), more.to.begin(), more.to.end());
    }
};

/// What is to be matched, and what walls and recipe settle of it.
struct Problem {
    const topology::OpenVolume& volume;
    const MatchOptions& options;
    const RunContext& context;
    std::vector<LoopShape> source, target;
    std::map<VertexId, VertexId> walls; ///< source vertex → target vertex, joined by walls
    std::map<VertexId, VertexId> hard;  ///< those, and the recipe's
    std::vector<int> forced;            ///< target loop of each source loop, -1: open
    std::vector<bool> on_wall;          ///< of each vertex of the model
    std::optional<bool> backward; ///< known when walls join the ends: target loops run against the source's
    std::vector<bool>
        by_length;  ///< of each source loop and target loop, source by source: how they are paired
    PointPairs led; ///< where the given walls lead from rim to rim; none where every loop has a wall

    [[nodiscard]] bool paired_by_length(std::size_t s, std::size_t t) const
    {
        return by_length[s * target.size() + t];
    }
    [[nodiscard]] bool has_hard(std::size_t s) const;
};

/// @param match  its loops are set; gets its side lines.
/// @throw InvalidInput, NotClosed  a recipe, or walls, that contradict each other; names tags and loops.
Problem problem_of(const topology::OpenVolume& volume, const MatchOptions& options, Match& match,
                   const RunContext& context);

} // namespace lacuna::matching
