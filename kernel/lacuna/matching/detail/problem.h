// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/message.h>
#include <lacuna/matching/detail/loop_shape.h>
#include <lacuna/matching/match.h>

#include <concepts>
#include <cstddef>
#include <map>
#include <optional>
#include <vector>

namespace lacuna::matching {

/// Loops for a message, numbered from 1 as in the recipe.
NamedEntity source_loop(std::integral auto loop) { return {"source loop", static_cast<long long>(loop) + 1}; }
NamedEntity target_loop(std::integral auto loop) { return {"target loop", static_cast<long long>(loop) + 1}; }

/// Corresponding points.
struct PointPairs {
    std::vector<Vec3> from, to;

    void add(const PointPairs& more)
    {
        from.insert(from.end(), more.from.begin(), more.from.end());
        to.insert(to.end(), more.to.begin(), more.to.end());
    }
};

/// The loops to be matched, and the pairs that walls and the user fix.
struct Problem {
    const topology::OpenVolume& volume;
    const MatchOptions& options;
    const RunContext& context;
    std::vector<LoopShape> source, target;
    std::map<VertexId, VertexId> walls; ///< source vertex → target vertex, joined by walls
    std::map<VertexId, VertexId> hard;  ///< those, and the user's
    std::vector<int> forced;            ///< target loop of each source loop, -1: not fixed
    std::vector<bool> on_wall;          ///< for each vertex of the model
    std::optional<bool> backward; ///< set if walls join the ends: the target loops run against the source's
    std::vector<bool> by_length;  ///< whether loops are paired by length, at source · targets + target
    PointPairs led; ///< source rim points and their images under the given walls; empty if all loops have
                    ///< walls

    [[nodiscard]] bool paired_by_length(std::size_t s, std::size_t t) const
    {
        return by_length[s * target.size() + t];
    }
    [[nodiscard]] bool has_hard(std::size_t s) const;
};

/// @param match  its loops are set; receives its side lines.
/// @throw InvalidInput, NotClosed  user pairs or walls that contradict each other; names tags and loops.
Problem problem_of(const topology::OpenVolume& volume, const MatchOptions& options, Match& match,
                   const RunContext& context);

} // namespace lacuna::matching
