// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/sweep/assembly.h>

#include <cstddef>
#include <set>
#include <span>
#include <vector>

/// Order in which the members of an assembly are meshed. Internal to this folder.
namespace lacuna::sweep {

/// Whether a member has faces with kept quads or triangles.
bool came_with_mesh(const AssemblyMember& member);

/// For each member, the members that must come before it: a given face is meshed before its void counterpart.
/// @throw NotSweepable "assembly.round"  volumes in a cycle, each of which lacks a face that the next one has
std::vector<std::set<std::size_t>> members_before(std::span<const AssemblyMember> members,
                                                  std::span<const SharedFace> shared);

/// Sort members topologically. Among those without open dependencies, the order is: fixed ones, then `first`
/// as listed, those with given meshes, those with boundary layers, those whose ends both have several faces,
/// those that share an end with a member already placed, those whose walls are not ends of waiting members,
/// and by number.
/// @param before  result of `members_before()`
/// @note  O(members² × shared faces) at most.
std::vector<std::size_t> order_members(std::span<const AssemblyMember> members,
                                       std::span<const SharedFace> shared,
                                       std::span<const std::set<std::size_t>> before,
                                       std::span<const std::size_t> first);

} // namespace lacuna::sweep
