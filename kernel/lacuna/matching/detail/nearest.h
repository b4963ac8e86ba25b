// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/matching/detail/problem.h>

namespace lacuna::matching {

/// Algorithm 1 as in the paper: each vertex is paired with the nearest vertex of the other end.
///
/// Steps 4 to 7 of the paper are one function each; the caller does steps 1 to 3. Three rules are added where
/// the paper is silent. The first of equal distances wins. If pairs compete for a vertex, the closest wins.
/// Loops of one or two vertices take their direction from their area vectors. Step 7 requires half of the
/// distances to be within two standard deviations of the mean, but by Chebyshev's inequality at least three
/// quarters always are. So whenever there are outliers or unpaired vertices, they are paired by the shift and
/// direction on which most vertices of their loop, at least half of them, agree. The confidence is 1 − mean
/// distance / mean distance to the second nearest, at most the share of vertices that agree.
/// @param match  with the loops of both ends.
/// @return  the match with pairs of loops and of vertices.
/// @throw NotClosed  loops with different numbers of edges; loops or vertices whose distances give no
///         one-to-one map that keeps the order along the loops; names them.
Match match_nearest(const Problem& problem, Match match);

} // namespace lacuna::matching
