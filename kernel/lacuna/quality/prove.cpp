// SPDX-License-Identifier: MIT
#include <lacuna/quality/detail/coincident.h>
#include <lacuna/quality/detail/findings.h>
#include <lacuna/quality/detail/text.h>
#include <lacuna/quality/quality.h>

#include <lacuna/core/error.h>
#include <lacuna/mesh/quad_mesh.h>

#include <algorithm>
#include <unordered_set>

// Sides of swept cells need no search: the cells stand on quads, so a side of the mesh is a quad on a layer or
// a side of a quad times a layer. The mesh is conformal, and its skin closed, exactly when the quads are so.

namespace lacuna::quality {
namespace {

[[noreturn]] void fail(const char* code, const std::string& message) { throw NotSweepable(code, message); }

std::string person(std::size_t number) { return std::to_string(number + 1); }

void check_sizes(const mesh::HexMesh& mesh)
{
    const auto expect = [](const char* what, std::size_t found, std::size_t expected) {
        if (found == expected) return;
        fail("quality.wrong_size", std::string("the mesh holds ") + std::to_string(found) + " " + what +
                                       " where " + std::to_string(expected) + " were expected");
    };
    if (mesh.layers < 1 || mesh.quads.empty() || mesh.nodes_per_layer < 4)
        fail("quality.empty", "the mesh has no cells: " + std::to_string(mesh.quads.size()) +
                                  " source quads and " + std::to_string(mesh.layers) + " layers");
    const auto layers = static_cast<std::size_t>(mesh.layers);
    expect("nodes", mesh.nodes.size(), (layers + 1) * static_cast<std::size_t>(mesh.nodes_per_layer));
    expect("patches of source quads", mesh.source_patch.size(), mesh.quads.size());
    expect("patches of target quads", mesh.target_patch.size(), mesh.quads.size());
    expect("patches of wall quads", mesh.wall_patch.size(), layers * mesh.rim.size());
    for (std::size_t q = 0; q < mesh.quads.size(); ++q) {
        for (const Index node : mesh.quads[q]) {
            if (node < 0 || node >= mesh.nodes_per_layer)
                fail("quality.unknown_node", "source quad " + person(q) + " names node " +
                                                 std::to_string(node + 1) + " of " +
                                                 std::to_string(mesh.nodes_per_layer));
        }
    }
}

void check_patches(const mesh::HexMesh& mesh)
{
    std::unordered_set<int> tags;
    for (const mesh::SkinPatch& patch : mesh.patches) {
        if (patch.tag <= 0 || !tags.insert(patch.tag).second)
            fail("quality.patch_tag", "the skin patch with tag " + std::to_string(patch.tag) +
                                          " must have a positive tag of its own");
    }
    const auto count = static_cast<Index>(mesh.patches.size());
    const auto check = [&](const char* where, const std::vector<Index>& patches) {
        const auto wrong = std::find_if(patches.begin(), patches.end(),
                                        [&](Index p) { return p < 0 || p >= count; });
        if (wrong == patches.end()) return;
        fail("quality.no_patch", std::string(where) + " quad " +
                                     person(static_cast<std::size_t>(wrong - patches.begin())) +
                                     " belongs to no patch of the skin");
    };
    check("source", mesh.source_patch);
    check("target", mesh.target_patch);
    check("wall", mesh.wall_patch);
}

std::string source_node(const mesh::HexMesh& mesh, Index node)
{
    return "source node " + std::to_string(node + 1) + " (at " +
           place(mesh.nodes[static_cast<std::size_t>(node)]) + ")";
}

void check_sides(const mesh::HexMesh& mesh, const std::vector<Index>& opposite)
{
    for (std::size_t side = 0; side < opposite.size(); ++side) {
        const Quad& quad = mesh.quads[side / 4];
        const Index from = quad[side % 4];
        const Index to = quad[(side + 1) % 4];
        if (from != to && opposite[side] != mesh::kBadSide) continue;
        fail("quality.not_conformal",
             "the side of source quad " + person(side / 4) + " from " + source_node(mesh, from) + " to " +
                 source_node(mesh, to) +
                 (from == to ? " has no length: its ends are one node"
                             : " is used by more than two quads, or twice in the same direction"));
    }
}

/// Every node is used, and the quads around it form one fan: else an edge of the mesh is pinched.
/// @return  the node that follows each node along the rim, -1 inside.
std::vector<Index> check_fans(const mesh::HexMesh& mesh, const std::vector<Index>& opposite)
{
    const auto nodes = static_cast<std::size_t>(mesh.nodes_per_layer);
    std::vector<Index> valence(nodes, 0);
    std::vector<Index> first(nodes, -1); // a side that leaves the node; one on the rim where there is one
    std::vector<Index> follows(nodes, -1);
    for (std::size_t side = 0; side < opposite.size(); ++side) {
        const auto node = static_cast<std::size_t>(mesh.quads[side / 4][side % 4]);
        ++valence[node];
        const bool rim = opposite[side] == mesh::kRimSide;
        if (rim || first[node] < 0) first[node] = static_cast<Index>(side);
        if (rim) follows[node] = mesh.quads[side / 4][(side + 1) % 4];
    }
    for (std::size_t node = 0; node < nodes; ++node) {
        if (valence[node] == 0)
            fail("quality.unused_node", source_node(mesh, static_cast<Index>(node)) + " belongs to no quad");
        // Turn from quad to quad: a quad's side that arrives at the node is the next quad's that leaves it.
        Index turned = 1;
        for (Index side = first[node];; ++turned) {
            const Index arrives = side % 4 == 0 ? side + 3 : side - 1;
            side = opposite[static_cast<std::size_t>(arrives)];
            if (side < 0 || side == first[node]) break;
        }
        if (turned != valence[node])
            fail("quality.pinched", "the quads around " + source_node(mesh, static_cast<Index>(node)) +
                                        " touch in the node alone; give each part a node of its own");
    }
    return follows;
}

void check_rim(const mesh::HexMesh& mesh, std::vector<Index> follows)
{
    for (const Segment& side : mesh.rim) {
        const bool known = side[0] >= 0 && side[0] < mesh.nodes_per_layer;
        if (!known || follows[static_cast<std::size_t>(side[0])] != side[1] || side[1] < 0)
            fail("quality.open_skin", "the rim side from node " + std::to_string(side[0] + 1) + " to " +
                                          std::to_string(side[1] + 1) +
                                          " is not a boundary side of the source quads, or is listed twice");
        follows[static_cast<std::size_t>(side[0])] = -1;
    }
    const auto missed = std::find_if(follows.begin(), follows.end(), [](Index to) { return to >= 0; });
    if (missed != follows.end())
        fail("quality.open_skin", "the boundary side of the source quads from " +
                                      source_node(mesh, static_cast<Index>(missed - follows.begin())) +
                                      " to " + source_node(mesh, *missed) + " carries no wall");
}

} // namespace

std::string node_name(std::span<const Vec3> nodes, Index node, Index nodes_per_layer)
{
    std::string text = "node " + std::to_string(node + 1) + " (";
    if (nodes_per_layer > 0) {
        const std::size_t levels = nodes.size() / static_cast<std::size_t>(nodes_per_layer);
        text += "level " + std::to_string(node / nodes_per_layer + 1) + " of " + std::to_string(levels) +
                ", ";
    }
    return text + "at " + place(nodes[static_cast<std::size_t>(node)]) + ")";
}

void check_nodes(std::span<const Vec3> nodes, Index nodes_per_layer, const RunContext& context)
{
    const Eigen::AlignedBox3d bounds = finite_bounds(nodes, context);
    if (bounds.isEmpty()) {
        const auto wrong = std::find_if(nodes.begin(), nodes.end(),
                                        [](const Vec3& p) { return !p.allFinite(); });
        fail("quality.not_finite",
             node_name(nodes, static_cast<Index>(wrong - nodes.begin()), nodes_per_layer) +
                 " has no finite place");
    }
    if (const auto pair = find_coincident(nodes, bounds, context))
        fail("quality.coincident_nodes", node_name(nodes, (*pair)[0], nodes_per_layer) + " and " +
                                             node_name(nodes, (*pair)[1], nodes_per_layer) +
                                             " lie in one place (within 1e-9 of the mesh's diagonal)");
}

void check_quality(const Quality& quality, double min_scaled_jacobian, int layers)
{
    const auto worst = [&](std::size_t bad) {
        std::string text;
        for (std::size_t i = 0; i < std::min(bad, quality.worst.size()); ++i)
            text += "\n  " + describe(quality.worst[i], layers);
        return text;
    };
    const std::string cells = " of " + std::to_string(quality.hexes) + " cells ";
    if (quality.inverted > 0)
        fail("quality.inverted", std::to_string(quality.inverted) + cells +
                                     "are inverted. The worst:" + worst(quality.inverted) +
                                     "\nTry more layers, a smaller size, or let the sweep improve the mesh");
    if (quality.uncertified > 0)
        fail("quality.not_certified",
             std::to_string(quality.uncertified) + cells +
                 "have a Jacobian that is not positive everywhere, though it is at their corners. "
                 "The worst cells of the mesh:" +
                 worst(quality.worst.size()));
    if (quality.min_scaled_jacobian < min_scaled_jacobian) {
        const auto below = static_cast<std::size_t>(
            std::count_if(quality.worst.begin(), quality.worst.end(),
                          [&](const WorstCell& cell) { return cell.scaled_jacobian < min_scaled_jacobian; }));
        fail("quality.below_limit", "the smallest scaled Jacobian is " + number(quality.min_scaled_jacobian) +
                                        ", below the limit of " + number(min_scaled_jacobian) +
                                        ". The worst:" + worst(below));
    }
}

Quality prove(const mesh::HexMesh& mesh, double min_scaled_jacobian, const RunContext& context)
{
    check_sizes(mesh);
    check_patches(mesh);
    const std::vector<Index> opposite = mesh::opposite_sides(mesh.quads, mesh.nodes_per_layer);
    check_sides(mesh, opposite);
    check_rim(mesh, check_fans(mesh, opposite));
    check_cancelled(context);
    Quality quality = measure(mesh, context);
    check_quality(quality, min_scaled_jacobian, mesh.layers);
    check_nodes(mesh.nodes, mesh.nodes_per_layer, context);
    return quality;
}

} // namespace lacuna::quality
