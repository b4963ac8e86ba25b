// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/quads/detail/partial_mesh.h>

#include <optional>
#include <vector>

namespace lacuna::quads::paving {

/// A straight line across a part, between two nodes of its outline.
struct Cut {
    std::size_t from = 0, to = 0; ///< positions in the cycle; in the first and the second one
    std::size_t edges = 1;        ///< mesh edges along the line
};

/// The best line that divides a loop into two even ones, by the weights of `PartialMesh`. It meets the
/// outline at multiples of a right angle, is short for what it cuts off, leaves parts whose sides agree in
/// number, and keeps clear of other nodes.
/// @return nothing where every line crosses the outline, or none makes both parts smaller.
/// @note  Some 96 nodes are tried at most, in all pairs, then the nodes near the best ones.
std::optional<Cut> best_cut(const PartialMesh& partial, const Cycle& cycle,
                            const std::vector<double>& angles);

/// The best line from one loop to another; nothing where every line crosses one of the loops.
struct LoopBridge {
    std::size_t loop_a = 0, loop_b = 0;
    Cut cut;
    double cost = 0;
};
std::optional<LoopBridge> best_bridge(const PartialMesh& partial, const std::vector<Cycle>& loops,
                                      std::size_t a, std::size_t b);

/// The shortest line from the first loop to another, whatever it crosses: folds are opened later.
LoopBridge blind_bridge(const PartialMesh& partial, const std::vector<Cycle>& loops);

/// Cut one quad off a loop where it is best shaped: for loops that `best_cut()` finds no line in. Both parts
/// are even and smaller.
Cut blind_cut(const PartialMesh& partial, const Cycle& cycle);

/// New nodes along a line, spaced as the size asks at both ends; both ends included.
Cycle nodes_along(PartialMesh& partial, Index from, Index to, std::size_t edges);

/// The two loops on either side of a cut; `line` runs from position `cut.from` to position `cut.to`.
std::pair<Cycle, Cycle> divide(const Cycle& cycle, const Cut& cut, const Cycle& line);

/// One loop of two, joined by a line that is walked there and back.
Cycle join(const Cycle& a, const Cycle& b, const Cut& cut, const Cycle& line);

} // namespace lacuna::quads::paving
