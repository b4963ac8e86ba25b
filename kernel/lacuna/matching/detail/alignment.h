// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/shared/constants.h>
#include <lacuna/core/shared/criteria.h>
#include <lacuna/geometry/shared/affine.h>
#include <lacuna/matching/detail/problem.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace lacuna::matching {

/// Largest mean twist of void edges, as a share of the loop's length. The area halfway up a round wall that
/// is ruled with the twist t is smaller by 1 − cos²(πt), which is here the difference of equal volumes.
inline double most_twist() { return std::asin(std::sqrt(kSameVolume)) / std::numbers::pi; }

/// A cyclic shift and a direction that map a source loop to a target loop.
struct Alignment {
    /// Index of the target vertex that is paired with the source's first vertex. For loops paired by length:
    /// index of the target's sample (or given node) that corresponds to the start of the source.
    std::size_t shift = 0;
    /// For loops paired by length: place that corresponds to the start of the source, as a share of the
    /// target's length.
    double offset = 0;
    bool backward = true; ///< whether the target loop is traversed against its own direction
    double score = kInfinity;
    geometry::RigidFit fit;
};

/// Rotation of the alignment's fit, as a share of half a turn.
double turn_of(const Alignment& alignment);

/// Every alignment of source loop s on target loop t that the hard pairs and the direction allow, best first.
/// @param backward  the direction; empty: both directions.
/// @param known  pairs of points that are matched already; the fit includes them.
std::vector<Alignment> alignments_of(const Problem& problem, std::size_t s, std::size_t t, bool with_scale,
                                     std::optional<bool> backward, const PointPairs& known = {});

/// For loops paired by length: move the start of an alignment to the place of best fit between the previous
/// and the next sample.
Alignment refined(const Problem& problem, std::size_t s, std::size_t t, const Alignment& alignment,
                  const PointPairs& known);

/// Corresponding points of two loops under an alignment.
PointPairs samples(const Problem& problem, std::size_t s, std::size_t t, const Alignment& alignment);

/// Whether two alignments differ by more than a small shift along a smooth loop.
bool differ(const Problem& problem, std::size_t s, std::size_t t, const Alignment& a, const Alignment& b);

/// Number of places where the given meshes of two loops do not match under an alignment. These are edges that
/// are paired with an edge of another number of sides. For loops that are paired by length and measured in
/// sides (count_by_sides()), they are vertices of the loop with fewer vertices that do not coincide with a
/// vertex of the other loop.
std::size_t unlike_sides(const Problem& problem, std::size_t s, std::size_t t, const Alignment& alignment);

} // namespace lacuna::matching
