// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/sweep/assembly.h>

#include <span>
#include <vector>

namespace lacuna::sweep {

/// What is decided over a whole assembly before anything is meshed.
struct AssemblyPlan {
    /// For each member that it comes after those named: they share a face that is a wall of theirs and an end
    /// of its own.
    std::vector<std::vector<std::size_t>> after;
    std::vector<int> layers; ///< of each member that has others by its side; 0: its own matter
};

/// Numbers of layers that agree along shared walls, and which members must wait for others.
/// @throw NotSweepable "assembly.layers"  other numbers of layers asked for in volumes side by side;
///                     "assembly.round"   walls and ends that wait for each other round a circle. Names them.
AssemblyPlan plan_assembly(std::span<const AssemblyMember> members, std::span<const SharedFace> shared);

/// An order that keeps to the plan; of those that are free to come, `first` as listed, then members that share
/// an end with one already placed, then by number.
std::vector<std::size_t> order_of(const AssemblyPlan& plan, std::span<const AssemblyMember> members,
                                  std::span<const SharedFace> shared, std::span<const std::size_t> first);

} // namespace lacuna::sweep
