// SPDX-License-Identifier: MIT
#include <lacuna/sweep/detail/assembly_order.h>

#include <lacuna/core/error.h>
#include <lacuna/core/shared/constants.h>
#include <lacuna/geometry/shared/union_find.h>
#include <lacuna/topology/shared/face_parts.h>

#include <algorithm>
#include <iterator>
#include <string>
#include <tuple>
#include <utility>

namespace lacuna::sweep {

using namespace topology;

namespace {

/// For each member, whether both its ends have several faces, or whether it must come before such a member. A
/// member whose ends both have several faces imprints one end on the other, which must happen before a
/// neighbour meshes these faces.
std::vector<bool> split_at_both_ends(std::span<const AssemblyMember> members,
                                     std::span<const std::set<std::size_t>> before)
{
    std::vector<bool> early(members.size(), false);
    std::vector<std::size_t> open;
    const auto add = [&](std::size_t m) {
        if (early[m]) return;
        early[m] = true;
        open.push_back(m);
    };
    for (std::size_t m = 0; m < members.size(); ++m) {
        const OpenVolume& volume = *members[m].volume;
        if (volume.faces(Role::source).size() > 1 && volume.faces(Role::target).size() > 1) add(m);
    }
    while (!open.empty()) {
        const std::size_t m = open.back();
        open.pop_back();
        for (const std::size_t other : before[m]) add(other);
    }
    return early;
}

bool is_wall(const AssemblyMember& member, FaceId face)
{
    return member.volume->role[face.index()] == Role::wall;
}

/// Whether a face lies within a member's walls without touching the rims of its ends. An example is the part
/// of a pin inside a plate. If the neighbour meshed this face first, the face's rows of quads would end in
/// the middle of the member's columns.
bool in_middle(const AssemblyMember& member, FaceId face)
{
    const Model& model = member.volume->model;
    return is_wall(member, face) && std::ranges::all_of(uses_of(model[face]), [&](const EdgeUse& use) {
               return std::ranges::all_of(model.uses_of_edge(use.edge),
                                          [&](const FaceUse& user) { return is_wall(member, user.face); });
           });
}

} // namespace

bool came_with_mesh(const AssemblyMember& member)
{
    return std::ranges::any_of(member.volume->model.faces, [&](const Face& face) {
        return face.keeps_nodes && has_cells_to_keep(face, member.options.wedges);
    });
}

std::vector<std::set<std::size_t>> members_before(std::span<const AssemblyMember> members,
                                                  std::span<const SharedFace> shared)
{
    const auto is_void = [&](std::size_t m, FaceId face) {
        return members[m].volume->model[face].origin == Origin::made_void;
    };
    std::vector<std::set<std::size_t>> before(members.size());
    for (const SharedFace& face : shared) {
        const bool void_a = is_void(face.a, face.face_a), void_b = is_void(face.b, face.face_b);
        if (void_a && !void_b) before[face.a].insert(face.b);
        if (void_b && !void_a) before[face.b].insert(face.a);
    }
    const std::vector<std::size_t> order = order_members(members, shared, before, {});
    if (order.size() == members.size()) return before;
    std::string names;
    for (std::size_t m = 0; m < members.size(); ++m) {
        if (std::ranges::find(order, m) == order.end())
            names += (names.empty() ? "" : ", ") + members[m].region;
    }
    throw NotSweepable(Message("assembly.round",
                               "{}: each of these volumes lacks a face that comes from the mesh of another "
                               "one, so none of them can be meshed first",
                               names)
                           .remedy("give one of them its missing face"));
}

std::vector<std::size_t> order_members(std::span<const AssemblyMember> members,
                                       std::span<const SharedFace> shared,
                                       std::span<const std::set<std::size_t>> before,
                                       std::span<const std::size_t> first)
{
    const std::size_t count = members.size();
    std::vector<char> placed(count, 0);
    std::vector<std::vector<const SharedFace*>> shared_by(count);
    std::vector<std::set<std::size_t>> near(count); // members whose step depends on this one
    for (const SharedFace& face : shared) {
        shared_by[face.a].push_back(&face);
        if (face.b != face.a) shared_by[face.b].push_back(&face);
        near[face.a].insert(face.b);
        near[face.b].insert(face.a);
    }
    for (std::size_t m = 0; m < count; ++m)
        for (const std::size_t other : before[m]) near[other].insert(m);
    const std::vector<bool> early = split_at_both_ends(members, before);
    // Stacks: members that are joined at their ends. The first member of a stack hands its quads on to the
    // others. Two members that are meshed apart would meet in different quads.
    geometry::UnionFind joined(count);
    for (const SharedFace& face : shared)
        if (!is_wall(members[face.a], face.face_a) && !is_wall(members[face.b], face.face_b))
            joined.unite_least(face.a, face.b);
    std::vector<std::vector<std::size_t>> stack(count); // by root; emptied when its first member is placed
    for (std::size_t m = 0; m < count; ++m) stack[joined.find(m)].push_back(m);
    const auto has = [&](std::size_t m, bool wall, bool other_wall, bool there) {
        return std::ranges::any_of(shared_by[m], [&](const SharedFace* face) {
            const bool is_a = face->a == m;
            const std::size_t other = is_a ? face->b : face->a;
            return (placed[other] != 0) == there &&
                   is_wall(members[m], is_a ? face->face_a : face->face_b) == wall &&
                   is_wall(members[other], is_a ? face->face_b : face->face_a) == other_wall;
        });
    };
    // Whether an end of a member is a wall of a neighbour, and whether a stack has such a member (by root).
    // This member comes first in its stack, because the wall's rows determine the quads of all of them.
    std::vector<char> on_wall(count, 0), led(count, 0);
    for (const SharedFace& face : shared) {
        const bool a = is_wall(members[face.a], face.face_a), b = is_wall(members[face.b], face.face_b);
        if (a != b) on_wall[a ? face.b : face.a] = led[joined.find(a ? face.b : face.a)] = 1;
    }
    // For each member, the neighbours that should be placed before it: the wall shared with such a neighbour
    // lies in the middle of the neighbour's walls, away from the rims of the neighbour's ends.
    std::vector<std::set<std::size_t>> below(count);
    for (const SharedFace& face : shared) {
        const bool a = in_middle(members[face.a], face.face_a), b = in_middle(members[face.b], face.face_b);
        if (a && !b && is_wall(members[face.b], face.face_b)) below[face.b].insert(face.a);
        if (b && !a && is_wall(members[face.a], face.face_a)) below[face.a].insert(face.b);
    }
    const auto all_placed = [&](const std::set<std::size_t>& others) {
        return std::ranges::all_of(others, [&](std::size_t other) { return placed[other] != 0; });
    };
    using Step = std::tuple<std::size_t, std::size_t, std::size_t>; // the step, the place in it, the member
    const auto step_of = [&](std::size_t m) -> Step {
        if (!all_placed(before[m])) return {kNoIndex, m, m};
        if (members[m].fixed != nullptr) return {1, m, m};
        if (const auto at = std::ranges::find(first, m); at != first.end())
            return {2, static_cast<std::size_t>(at - first.begin()), m};
        if (came_with_mesh(members[m])) return {3, m, m};
        if (!members[m].options.boundary_layers.empty()) return {4, m, m};
        const bool first_of_stack = !stack[joined.find(m)].empty();
        if (!all_placed(below[m]) || (first_of_stack && led[joined.find(m)] != 0 && on_wall[m] == 0))
            return {9, m, m};
        if (has(m, false, true, false)) return {8, m, m};
        if (early[m] && first_of_stack && !has(m, false, true, true)) return {5, m, m};
        return {has(m, false, false, true) ? 6 : 7, m, m};
    };
    std::set<Step> to_come; // of the members that are not placed
    std::vector<Step> steps;
    for (std::size_t m = 0; m < count; ++m) to_come.insert(steps.emplace_back(step_of(m)));
    std::vector<std::size_t> order;
    while (!to_come.empty() && std::get<0>(*to_come.begin()) < kNoIndex) {
        const std::size_t next = std::get<2>(*to_come.begin());
        to_come.erase(to_come.begin());
        placed[next] = 1;
        order.push_back(next);
        std::vector<std::size_t> changed(near[next].begin(), near[next].end());
        std::ranges::copy(std::exchange(stack[joined.find(next)], {}), std::back_inserter(changed));
        for (const std::size_t other : changed) {
            if (placed[other] != 0) continue;
            to_come.erase(steps[other]);
            to_come.insert(steps[other] = step_of(other));
        }
    }
    return order;
}

} // namespace lacuna::sweep
