// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/matching/detail/problem.h>

namespace lacuna::matching {

/// Algorithm 1 as in the paper (docs/bibliography.md): each vertex is paired with the nearest vertex of the
/// other end.
///
/// The caller does steps 1 to 3 of the paper. Three rules are added where the paper is silent:
/// - of equal distances, the first one found is taken;
/// - if pairs compete for a vertex, the closest pair is taken;
/// - loops of one or two vertices take their direction from their area vectors.
///
/// Departure: step 7 of the paper only accepts a loop if half of its distances are within two standard
/// deviations of the mean. By Chebyshev's inequality at least three quarters always are. Therefore outliers
/// and unpaired vertices are instead paired by the shift and direction on which most vertices of their loop
/// agree; at least half of the vertices must agree. Confidence: 1 − mean distance of the pairs / mean
/// distance to the second nearest vertex, but at most the share of vertices that agree.
/// @param match  a match whose loops of both ends are set.
/// @return  the match with pairs of loops and of vertices.
/// @throw NotClosed  paired loops have different numbers of edges, or the nearest loops or vertices give no
///         one-to-one map that keeps the order along the loops; names them.
Match match_nearest(const Problem& problem, Match match);

} // namespace lacuna::matching
