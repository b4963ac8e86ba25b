// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/message.h>
#include <lacuna/matching/detail/loop_shape.h>
#include <lacuna/matching/match.h>

#include <concepts>
#include <cstddef>
#include <map>
#include <optional>
#include <unordered_map>
#include <vector>

namespace lacuna::matching {

/// Loops as entities of a message, numbered from 1 as in recipes.
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
    std::map<VertexId, VertexId> walls; ///< by source vertex: the target vertex to which walls join it
    std::map<VertexId, VertexId> hard;  ///< the pairs of `walls` and those of the user
    std::vector<int> forced;            ///< target loop of each source loop that walls or the user fixed; -1:
                                        ///< not fixed
    std::vector<bool> on_wall;          ///< by vertex of the model: whether it is on a wall
    std::optional<bool> backward; ///< true if walls join the ends, because target loops then run against
                                  ///< source loops; otherwise empty
    /// Results of `paired_by_length()` so far; the key is source · number of targets + target.
    mutable std::unordered_map<std::size_t, bool> by_length;
    PointPairs led; ///< points of the given walls on the source rim and corresponding points on the target
                    ///< rim; empty if all loops have walls

    /// Whether two loops are paired by length rather than vertex by vertex. This is so in these cases:
    /// - the loops have different numbers of vertices, or one vertex each;
    /// - no pairing of vertices keeps the pairs that walls join;
    /// - the best pairing joins a corner with a smooth vertex, although a corner is available;
    /// - the best pairing joins no two corners, and its mean twist exceeds `most_twist()`.
    [[nodiscard]] bool paired_by_length(std::size_t s, std::size_t t) const;
    /// The pairs of `led` whose source points are nearest to the centroid of a source loop.
    [[nodiscard]] PointPairs led_near(std::size_t s) const;
    [[nodiscard]] bool has_hard(std::size_t s) const;
};

/// @param match  a match whose loops are set; the side lines are added to it.
/// @throw InvalidInput, NotClosed pairs of the user or walls contradict each other; names tags and loops.
Problem problem_of(const topology::OpenVolume& volume, const MatchOptions& options, Match& match,
                   const RunContext& context);

} // namespace lacuna::matching
