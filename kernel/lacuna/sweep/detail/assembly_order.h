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

/// For each member, the members that must come before it. A member with a given face comes before a member on
/// which the same face is void.
/// @throw NotSweepable "assembly.round"  each volume of a cycle lacks a face that the next one has.
std::vector<std::set<std::size_t>> members_before(std::span<const AssemblyMember> members,
                                                  std::span<const SharedFace> shared);

/// Sort members topologically. Of the members that may come next, the first one in this order is taken:
/// 1. fixed members;
/// 2. the members of `first`, as listed;
/// 3. members with given meshes;
/// 4. members with boundary layers;
/// 5. members whose ends both have several faces, and members that must precede such a member, provided that
///    no end of theirs is shared with a placed member or with a wall of an unplaced member;
/// 6. members that share an end with an end of a placed member, and no end with a wall of an unplaced member;
/// 7. other members that share no end with a wall of an unplaced member;
/// 8. members that share an end with a wall of an unplaced member, whose rows should be meshed first;
/// 9. members that share a wall with an unplaced member, if this wall lies inside the other member's walls,
///    away from the rims of its ends.
///
/// A member to which item 9 applies is not taken by items 5 to 8.
/// @param before  result of `members_before()`
/// @note  O(n log n) for n members and shared faces, where a member has few neighbours.
std::vector<std::size_t> order_members(std::span<const AssemblyMember> members,
                                       std::span<const SharedFace> shared,
                                       std::span<const std::set<std::size_t>> before,
                                       std::span<const std::size_t> first);

} // namespace lacuna::sweep
