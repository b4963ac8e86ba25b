// SPDX-License-Identifier: MIT
#include <lacuna/sweep/detail/assembly_nodes.h>

#include <lacuna/core/error.h>
#include <lacuna/core/shared/edge_key.h>
#include <lacuna/sweep/detail/place_order.h>
#include <lacuna/sweep/detail/words.h>
#include <lacuna/topology/shared/side_points.h>
#include <lacuna/topology/shared/skin_groups.h>

#include <algorithm>
#include <array>
#include <map>
#include <string>
#include <unordered_set>
#include <utility>

namespace lacuna::sweep {

using namespace topology;

namespace {

/// A node of a part.
struct PartNode {
    std::size_t part;
    Index node;
    friend auto operator<=>(const PartNode&, const PartNode&) = default;
};

/// For each node that coincides with an earlier node: the pair of this node and the first node at that
/// position.
std::vector<std::pair<PartNode, PartNode>> in_same_places(const SweptAssembly& assembly,
                                                          const std::vector<PartNode>& nodes)
{
    struct Placed {
        Vec3 place;
        PartNode node;
    };
    std::vector<Placed> placed;
    placed.reserve(nodes.size());
    for (const PartNode& node : nodes) placed.push_back({assembly.parts[node.part].skin()[node.node], node});
    std::ranges::sort(placed, [&](const Placed& a, const Placed& b) {
        if (before(a.place, b.place)) return true;
        if (before(b.place, a.place)) return false;
        return a.node < b.node;
    });
    std::vector<std::pair<PartNode, PartNode>> same;
    for (std::size_t i = 0, first = 0; i < placed.size(); ++i) {
        if (i == 0 || before(placed[first].place, placed[i].place)) first = i;
        if (first != i) same.emplace_back(placed[i].node, placed[first].node);
    }
    return same;
}

/// Add the middle nodes of the skin.
void add_middles(const mesh::HexMesh& mesh, std::size_t part, std::vector<PartNode>& nodes)
{
    std::vector<bool> known(mesh.middles.nodes.size(), false);
    for (std::size_t i = 0; i < mesh.skin_count(); ++i) {
        for (const Index n : mesh::skin_nodes(mesh, i)) {
            if (index(n) < mesh.nodes.size() || known[index(n) - mesh.nodes.size()]) continue;
            known[index(n) - mesh.nodes.size()] = true;
            nodes.push_back({part, n});
        }
    }
}

/// Give the patches of a piece the groups that the same faces have in the whole volume.
void take_roles(const OpenVolume& whole, std::vector<mesh::SkinPatch>& patches)
{
    std::map<int, std::vector<std::string>> of_tag;
    std::vector<std::vector<std::string>> groups = skin_groups(whole);
    for (std::size_t f = 0; f < groups.size(); ++f)
        if (whole.model.faces[f].origin == Origin::given)
            of_tag.try_emplace(whole.model.faces[f].tag, std::move(groups[f]));
    for (mesh::SkinPatch& patch : patches)
        if (const auto found = of_tag.find(patch.face); patch.face != 0 && found != of_tag.end())
            patch.groups = found->second;
}

} // namespace

void number_nodes(SweptAssembly& assembly)
{
    std::vector<std::vector<Index>> shared(assembly.parts.size());
    for (const SharedFace& face : assembly.shared) {
        for (const auto& [p, id] : {std::pair(face.a, face.face_a), std::pair(face.b, face.face_b)})
            for (const Quad& quad : quads_on(assembly.parts[p].mesh, assembly.parts[p].faces, id))
                shared[p].insert(shared[p].end(), quad.begin(), quad.end());
    }
    std::vector<PartNode> by_place;
    for (std::size_t p = 0; p < assembly.parts.size(); ++p) {
        const mesh::HexMesh& mesh = assembly.parts[p].mesh;
        for (const Segment& side : patch_borders(mesh))
            shared[p].insert(shared[p].end(), side.begin(), side.end());
        std::ranges::sort(shared[p]);
        const auto again = std::ranges::unique(shared[p]);
        shared[p].erase(again.begin(), again.end());
        for (const Index n : shared[p]) by_place.push_back({p, n});
        if (mesh.order() > 1) add_middles(mesh, p, by_place);
    }
    std::vector<std::pair<PartNode, PartNode>> same = in_same_places(assembly, by_place);
    std::ranges::sort(same);
    Index next = 0;
    auto twin = same.begin();
    assembly.numbering.clear();
    for (std::size_t p = 0; p < assembly.parts.size(); ++p) {
        const mesh::HexMesh& mesh = assembly.parts[p].mesh;
        const std::size_t nodes = mesh::corner_count(mesh) + mesh.middles.nodes.size();
        std::vector<std::pair<Index, Index>> known;
        for (; twin != same.end() && twin->first.part == p; ++twin) {
            if (!known.empty() && known.back().first == twin->first.node) continue;
            known.emplace_back(twin->first.node, assembly.numbering[twin->second.part].of(twin->second.node));
        }
        assembly.numbering.emplace_back(next, std::move(known), nodes);
        next += static_cast<Index>(assembly.numbering.back().fresh());
    }
    assembly.nodes = index(next);
}

void check_no_hanging_nodes(const SweptAssembly& assembly, std::span<const AssemblyMember> members)
{
    struct EdgeSide {
        std::size_t part;
        Segment nodes;
    };
    // Collect each side and each node once, identified by the node numbers of the whole mesh.
    std::vector<EdgeSide> sides;
    std::vector<std::array<Vec3, 2>> segments;
    std::vector<std::pair<std::size_t, Index>> at;
    std::vector<Vec3> points;
    std::unordered_set<std::uint64_t> known_sides;
    std::unordered_set<Index> known;
    double tolerance = 0;
    for (std::size_t p = 0; p < members.size(); ++p) {
        tolerance = std::max(tolerance, members[p].volume->model.tolerance);
        const mesh::SkinNodes skin = assembly.parts[p].skin();
        const mesh::NodeNumbers& number = assembly.numbering[p];
        for (const Segment& side : patch_borders(skin.mesh)) {
            if (!known_sides.insert(edge_key(number.of(side[0]), number.of(side[1]))).second) continue;
            sides.push_back({p, side});
            segments.push_back({skin[side[0]], skin[side[1]]});
            for (const Index n : side) {
                if (!known.insert(number.of(n)).second) continue;
                at.emplace_back(p, n);
                points.push_back(skin[n]);
            }
        }
    }
    for (const NearSegment& near : near_segments(points, segments, tolerance)) {
        const auto& [part, node] = at[index(near.point)];
        const EdgeSide& side = sides[index(near.segment)];
        if (part == side.part) continue;
        const Index number = assembly.numbering[part].of(node);
        const Segment ends{assembly.numbering[side.part].of(side.nodes[0]),
                           assembly.numbering[side.part].of(side.nodes[1])};
        if (number == ends[0] || number == ends[1]) continue;
        const Vec3& p = points[index(near.point)];
        const auto& [a, b] = segments[index(near.segment)];
        const double f = fraction_along(p, a, b);
        if ((p - ((1 - f) * a + f * b)).norm() > tolerance) continue;
        const std::string &region = members[part].region, &other = members[side.part].region;
        const auto miss = std::ranges::find_if(assembly.near_misses, [&](const NearMiss& near_miss) {
            return near_miss.a == std::min(part, side.part) && near_miss.b == std::max(part, side.part);
        });
        if (miss == assembly.near_misses.end())
            throw NotSweepable(
                Message(
                    "assembly.hanging_node",
                    "{} has a node at {}, where {} has none: they touch along an edge without a shared face",
                    region, place_in_short(p), other)
                    .remedy("give both the same size along it"));
        throw NotSweepable(
            Message("assembly.hanging_node",
                    "{} has a node at {}, where {} has none: {} are up to {:.2g} apart and share no nodes",
                    region, place_in_short(p), other, miss->message.entities(), found(miss->width))
                .remedy("{}", miss->message.remedy())
                .attempt(miss->message));
    }
}

void name_groups(SweptAssembly& assembly, std::span<const AssemblyMember> members)
{
    for (std::size_t m = 0; m < members.size(); ++m) {
        const AssemblyMember& member = members[m];
        const std::string& name = member.whole.empty() ? member.region : member.whole;
        mesh::HexMesh& mesh = assembly.parts[m].mesh;
        mesh.volume_groups = {name};
        if (name != "volume") mesh.volume_groups.emplace_back("volume");
        if (member.piece_of != nullptr) take_roles(*member.piece_of, mesh.patches);
        if (member.alone) continue;
        for (mesh::SkinPatch& patch : mesh.patches) patch.groups = groups_in_assembly(name, patch.groups);
    }
    for (const SharedFace& face : assembly.shared) {
        const std::string& whole = members[face.a].whole;
        if (whole.empty() || whole != members[face.b].whole) continue;
        for (const auto& [p, id] : {std::pair(face.a, face.face_a), std::pair(face.b, face.face_b)})
            for (std::size_t patch = 0; patch < assembly.parts[p].faces.size(); ++patch)
                if (assembly.parts[p].faces[patch] == id)
                    assembly.parts[p].mesh.patches[patch].groups.clear();
    }
}

} // namespace lacuna::sweep
