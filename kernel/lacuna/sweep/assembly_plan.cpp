// SPDX-License-Identifier: MIT
#include <lacuna/core/error.h>
#include <lacuna/geometry/union_find.h>
#include <lacuna/surface/linking_surface.h>
#include <lacuna/surface/seeds.h>
#include <lacuna/sweep/detail/assembly_plan.h>
#include <lacuna/sweep/detail/given_meshes.h>

#include <algorithm>
#include <set>

namespace lacuna::sweep {

using namespace topology;

namespace {

Role role_of(const AssemblyMember& member, FaceId face) { return member.volume->role[face.index()]; }

/// Middles of the edges that a wall shares with the ends of its volume.
std::vector<Vec3> rim_middles(const OpenVolume& volume, FaceId wall,
                              const std::vector<std::vector<FaceUse>>& uses)
{
    std::vector<Vec3> middles;
    for (const Loop& loop : volume.model[wall].loops) {
        for (const EdgeUse& use : loop.uses) {
            const bool rim = std::ranges::any_of(uses[use.edge.index()], [&](const FaceUse& user) {
                return volume.role[user.face.index()] != Role::wall;
            });
            if (!rim) continue;
            const std::vector<Index>& points = volume.model[use.edge].points;
            middles.push_back((volume.model.at(points.front()) + volume.model.at(points.back())) / 2);
        }
    }
    return middles;
}

/// Whether two sweeps run the same way along a wall they share: edges of it are rims of both.
bool side_by_side(const AssemblyMember& a, FaceId wall_a, const AssemblyMember& b, FaceId wall_b,
                  const std::vector<std::vector<FaceUse>>& uses_a,
                  const std::vector<std::vector<FaceUse>>& uses_b)
{
    const double tolerance = std::max(a.volume->model.tolerance, b.volume->model.tolerance);
    const std::vector<Vec3> middles = rim_middles(*b.volume, wall_b, uses_b);
    for (const Vec3& p : rim_middles(*a.volume, wall_a, uses_a)) {
        if (std::ranges::any_of(middles, [&](const Vec3& q) { return (p - q).norm() <= tolerance; }))
            return true;
    }
    return false;
}

/// Layers a member asks for; 0: none.
int layers_asked(const AssemblyMember& member)
{
    const LayerSpec& spec = member.options.layers;
    return spec.heights.empty() ? spec.count : static_cast<int>(spec.heights.size());
}

/// Layers it would have by itself.
int layers_wanted(const AssemblyMember& member)
{
    surface::SizeField size = member.options.size;
    if (!size) size = [spacing = surface::rim_spacing(*member.volume)](const Vec3&) { return spacing; };
    const std::vector<surface::LinkingSurface> links = surface::linking_surfaces(*member.volume);
    return static_cast<int>(default_heights(links, size, member.options.layers).size()) - 1;
}

/// The same number of layers for all of a group.
int common_layers(std::span<const AssemblyMember> members, const std::vector<std::size_t>& group)
{
    const AssemblyMember* asked = nullptr;
    for (const std::size_t m : group) {
        if (layers_asked(members[m]) == 0) continue;
        if (asked != nullptr && layers_asked(*asked) != layers_asked(members[m])) {
            throw NotSweepable(
                "assembly.layers",
                asked->region + " and " + members[m].region +
                    " lie side by side and are swept the same way, so they have as many layers; "
                    "asked for are " +
                    std::to_string(layers_asked(*asked)) + " and " +
                    std::to_string(layers_asked(members[m])));
        }
        asked = &members[m];
    }
    if (asked != nullptr) return layers_asked(*asked);
    int most = 1;
    for (const std::size_t m : group) most = std::max(most, layers_wanted(members[m]));
    return most;
}

bool is_free(const std::vector<std::size_t>& after, const std::vector<char>& placed)
{
    return std::ranges::all_of(after, [&](std::size_t m) { return placed[m] != 0; });
}

/// Refuse members that wait for each other; names them.
void check_order(const AssemblyPlan& plan, std::span<const AssemblyMember> members)
{
    std::vector<char> placed(members.size(), 0);
    for (bool more = true; more;) {
        more = false;
        for (std::size_t m = 0; m < members.size(); ++m) {
            if (placed[m] != 0 || !is_free(plan.after[m], placed)) continue;
            placed[m] = 1;
            more = true;
        }
    }
    std::string names;
    for (std::size_t m = 0; m < members.size(); ++m) {
        if (placed[m] == 0) names += (names.empty() ? "" : ", ") + members[m].region;
    }
    if (names.empty()) return;
    throw NotSweepable("assembly.round", "walls of " + names +
                                             " are ends of the next one all round, so none can be meshed "
                                             "first; give one of them another source and target");
}

} // namespace

AssemblyPlan plan_assembly(std::span<const AssemblyMember> members, std::span<const SharedFace> shared)
{
    AssemblyPlan plan;
    plan.after.resize(members.size());
    plan.layers.assign(members.size(), 0);
    std::vector<std::vector<std::vector<FaceUse>>> uses;
    for (const AssemblyMember& member : members) uses.push_back(edge_uses(member.volume->model));
    geometry::UnionFind sides(members.size());
    for (const SharedFace& face : shared) {
        const AssemblyMember &a = members[face.a], &b = members[face.b];
        const bool wall_a = role_of(a, face.face_a) == Role::wall,
                   wall_b = role_of(b, face.face_b) == Role::wall;
        if (wall_a && !wall_b) plan.after[face.b].push_back(face.a);
        if (wall_b && !wall_a) plan.after[face.a].push_back(face.b);
        if (wall_a && wall_b && side_by_side(a, face.face_a, b, face.face_b, uses[face.a], uses[face.b]))
            sides.unite(face.a, face.b);
    }
    check_order(plan, members);
    std::vector<std::vector<std::size_t>> groups(members.size());
    for (std::size_t m = 0; m < members.size(); ++m) groups[sides.find(m)].push_back(m);
    for (const std::vector<std::size_t>& group : groups) {
        if (group.size() < 2) continue;
        const int layers = common_layers(members, group);
        for (const std::size_t m : group) plan.layers[m] = layers;
    }
    return plan;
}

std::vector<std::size_t> order_of(const AssemblyPlan& plan, std::span<const AssemblyMember> members,
                                  std::span<const SharedFace> shared, std::span<const std::size_t> first)
{
    std::vector<char> placed(members.size(), 0);
    std::vector<std::size_t> order;
    const auto joins_end = [&](std::size_t m) {
        return std::ranges::any_of(shared, [&](const SharedFace& face) {
            const bool is_a = face.a == m, is_b = face.b == m;
            if (!is_a && !is_b) return false;
            const FaceId own = is_a ? face.face_a : face.face_b;
            return placed[is_a ? face.b : face.a] != 0 && role_of(members[m], own) != Role::wall;
        });
    };
    while (order.size() < members.size()) {
        std::size_t next = members.size();
        const auto take = [&](std::size_t m) {
            if (next == members.size() && placed[m] == 0 && is_free(plan.after[m], placed)) next = m;
        };
        for (const std::size_t m : first) take(m);
        for (std::size_t m = 0; m < members.size(); ++m)
            if (next == members.size() && joins_end(m)) take(m);
        for (std::size_t m = 0; m < members.size(); ++m) take(m);
        placed[next] = 1;
        order.push_back(next);
    }
    return order;
}

} // namespace lacuna::sweep
