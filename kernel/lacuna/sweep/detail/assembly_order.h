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
/// @throw NotSweepable "assembly.round"  in a cycle of volumes, each lacks a face that another one has.
std::vector<std::set<std::size_t>> members_before(std::span<const AssemblyMember> members,
                                                  std::span<const SharedFace> shared);

/// Sort members topologically. Of the members that may come next, the first one in this order is taken:
/// 1. fixed members;
/// 2. the members of `first`, as listed;
/// 3. members with given meshes;
/// 4. members with boundary layers;
/// 5. members whose ends both have several faces, and members that must precede such a member. In this step,
///    their ends must not be shared with a placed member, nor with a wall of a member still to come, whose
///    rows are meshed first;
/// 6. members that share an end with a placed member, and none with a wall of a member still to come;
/// 7. members that share no end with a wall of a member still to come;
/// 8. other members.
///
/// A member is passed over in steps 5 to 8 as long as it shares a wall with an unplaced member, and this wall
/// lies inside the other member's walls, away from the rims of its ends. If every member is passed over, the
/// first one is taken.
/// @param before  result of `members_before()`
/// @note  O(n log n) for n members and shared faces, where a member has few neighbours.
std::vector<std::size_t> order_members(std::span<const AssemblyMember> members,
                                       std::span<const SharedFace> shared,
                                       std::span<const std::set<std::size_t>> before,
                                       std::span<const std::size_t> first);

} // namespace lacuna::sweep
