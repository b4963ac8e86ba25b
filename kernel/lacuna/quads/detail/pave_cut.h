// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/quads/detail/partial_mesh.h>

#include <optional>
#include <vector>

namespace lacuna::quads::paving {

/// A straight line across a part of the region, between two nodes of its outline or between two loops.
struct Cut {
    std::size_t from = 0, to = 0; ///< positions in the cycle, or in the two loops that the line joins
    std::size_t edges = 1;        ///< mesh edges along the line
};

/// The cost of dividing an angle by a line. It is 0 if each part of the angle suits a whole number of quads,
/// and both numbers together are the number that suits the whole angle.
/// @param whole, part  the angle, and its part on one side of the line [radian].
double end_cost(double whole, double part, const CutWeights& weights);

/// The length that edges along a line between two points should have: the inverse of the mean of 1 / size.
double local_size(const PartialMesh& partial, const Vec2& a, const Vec2& b);

/// The best line that divides a loop into two loops with even numbers of nodes, according to the weights of
/// `PartialMesh`. A good line meets the outline at multiples of a right angle, is short relative to the part
/// of the outline that it cuts off, leaves parts whose opposite sides have equal numbers of edges, and stays
/// away from other nodes.
/// @return  empty if every line crosses the outline, or no line makes both parts smaller than the loop.
/// @note  At most about 96 nodes are tried, in all pairs, then the nodes near the best ones.
std::optional<Cut> best_cut(const PartialMesh& partial, const Cycle& cycle,
                            const std::vector<double>& angles);

/// Add nodes along a line, spaced according to the size at its ends. @return  all nodes of the line,
/// including both ends.
Cycle nodes_along(PartialMesh& partial, Index from, Index to, std::size_t edges);

/// The two loops on either side of a cut; `line` runs from position `cut.from` to position `cut.to`.
std::pair<Cycle, Cycle> divide(const Cycle& cycle, const Cut& cut, const Cycle& line);

/// Join two loops to one, which passes the line twice, once in either direction.
Cycle join(const Cycle& a, const Cycle& b, const Cut& cut, const Cycle& line);

} // namespace lacuna::quads::paving
