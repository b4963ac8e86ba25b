// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/quads/detail/pave_draft.h>

#include <optional>
#include <vector>

namespace lacuna::quads::paving {

/// A straight line across a part, between two places of its outline.
struct Cut {
    std::size_t from = 0, to = 0; ///< places in the cycle, or in the first and the second cycle
    std::size_t edges = 1;        ///< mesh edges along the line
};

/// The best line that divides a loop in two even ones: square to the outline or halving its corners rightly,
/// short for what it divides, leaving sides whose counts agree, clear of other nodes.
/// @return nothing where no line sees its other end, or none makes both parts smaller.
std::optional<Cut> best_cut(const Draft& draft, const Cycle& cycle, const std::vector<double>& angles);

/// The line that joins a loop to another best; nothing where they do not see each other past `all`.
struct Bridge {
    std::size_t loop_a = 0, loop_b = 0;
    Cut cut;
    double cost = 0;
};
std::optional<Bridge> best_bridge(const Draft& draft, const std::vector<Cycle>& loops, std::size_t a,
                                  std::size_t b);

/// The shortest line from the first loop to another, whatever it crosses: its nodes move later.
Bridge blind_bridge(const Draft& draft, const std::vector<Cycle>& loops);

/// Divide a loop of even length by the shortest way round: where no line is seen. Both parts are even and
/// smaller.
Cut blind_cut(const Draft& draft, const Cycle& cycle);

/// New nodes along a line, spaced as the size asks at both ends; both ends included.
Cycle nodes_along(Draft& draft, Index from, Index to, std::size_t edges);

/// The two loops on either side of a cut; `line` runs from place `cut.from` to place `cut.to`.
std::pair<Cycle, Cycle> divide(const Cycle& cycle, const Cut& cut, const Cycle& line);

/// One loop of two, joined by a line run there and back.
Cycle join(const Cycle& a, const Cycle& b, const Cut& cut, const Cycle& line);

} // namespace lacuna::quads::paving
