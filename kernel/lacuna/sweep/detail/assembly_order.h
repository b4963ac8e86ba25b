// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/sweep/assembly.h>

#include <cstddef>
#include <set>
#include <span>
#include <vector>

/// In which order the members of an assembly are meshed. Internal to this folder.
namespace lacuna::sweep {

/// Whether faces of a member came with quads or triangles that stay.
bool came_with_mesh(const AssemblyMember& member);

/// Of each member, those that must come before it: a shared face is what is given before what was made there.
/// @throw NotSweepable "assembly.round"  volumes each of which lacks a face that the next one has
std::vector<std::set<std::size_t>> members_before(std::span<const AssemblyMember> members,
                                                  std::span<const SharedFace> shared);

/// Members by what they wait for; of those that are free to come, fixed ones, then `first` as listed, those
/// that came with meshes, those with boundary layers, those with both ends in parts, those that share an end
/// with one that is there, those whose walls are no one's ends that wait, and by number.
/// @param before  what `members_before()` gives
/// @note  O(members² × shared faces) at most.
std::vector<std::size_t> order_members(std::span<const AssemblyMember> members,
                                       std::span<const SharedFace> shared,
                                       std::span<const std::set<std::size_t>> before,
                                       std::span<const std::size_t> first);

} // namespace lacuna::sweep
