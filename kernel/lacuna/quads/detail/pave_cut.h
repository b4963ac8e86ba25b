// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/quads/detail/partial_mesh.h>

#include <optional>
#include <vector>

namespace lacuna::quads::paving {

/// A straight line across a part, between two nodes of its outline, or between two loops.
struct Cut {
    std::size_t from = 0, to = 0; ///< positions in the cycle, or in the two loops that the line joins
    std::size_t edges = 1;        ///< mesh edges along the line
};

/// The cost of a line that divides an angle: 0 if both parts suit whole quads and no quad is added.
double end_cost(double whole, double part, const CutWeights& weights);

/// The length of edges between two points: the number of edges is proportional to the mean of 1 / size.
double local_size(const PartialMesh& partial, const Vec2& a, const Vec2& b);

/// The best line that divides a loop into two even ones, by the weights of `PartialMesh`. It meets the
/// outline at multiples of a right angle, is short relative to the outline it cuts off, leaves parts whose
/// sides agree in number, and stays away from other nodes.
/// @return empty if every line crosses the outline, or none makes both parts smaller.
/// @note  At most about 96 nodes are tried, in all pairs, then the nodes near the best ones.
std::optional<Cut> best_cut(const PartialMesh& partial, const Cycle& cycle,
                            const std::vector<double>& angles);

/// Cut one quad off a loop where it has the best shape: for loops in which `best_cut()` finds no line. Both
/// parts are even and smaller.
Cut blind_cut(const PartialMesh& partial, const Cycle& cycle);

/// Add nodes along a line, spaced as the size at both ends asks. @return all of the line's nodes, both ends
/// included.
Cycle nodes_along(PartialMesh& partial, Index from, Index to, std::size_t edges);

/// The two loops on either side of a cut; `line` runs from position `cut.from` to position `cut.to`.
std::pair<Cycle, Cycle> divide(const Cycle& cycle, const Cut& cut, const Cycle& line);

/// Join two loops to one, which passes the line twice, once in either direction.
Cycle join(const Cycle& a, const Cycle& b, const Cut& cut, const Cycle& line);

} // namespace lacuna::quads::paving
