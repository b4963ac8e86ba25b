// SPDX-License-Identifier: MIT
#include <lacuna/quality/detail/coincident.h>
#include <lacuna/quality/detail/findings.h>
#include <lacuna/quality/detail/text.h>
#include <lacuna/quality/quality.h>
#include <lacuna/quality/shared/layered.h>

#include <lacuna/core/error.h>
#include <lacuna/core/shared/background.h>
#include <lacuna/mesh/quad_mesh.h>

#include <algorithm>
#include <limits>
#include <unordered_set>
#include <utility>

// Swept cells need no search for common sides: each side of the mesh is a source quad on a level, or a side
// of a source quad times a layer. So the mesh is conforming and its skin closed if and only if this holds for
// the source quads.

namespace lacuna::quality {
namespace {

std::string person(std::size_t number) { return std::to_string(number + 1); }

Found check_sizes(const mesh::HexMesh& mesh, std::size_t nodes)
{
    if (mesh.layers < 1 || mesh.quads.empty() || mesh.nodes_per_layer < 3)
        return Finding{Fault::empty, "the mesh has no cells: " + std::to_string(mesh.quads.size()) +
                                         " source quads and " + std::to_string(mesh.layers) + " layers"};
    const auto layers = static_cast<std::size_t>(mesh.layers);
    struct Size {
        const char* what;
        std::size_t found, expected;
    };
    for (const auto& [what, found, expected] :
         {Size{"nodes", mesh.nodes.size(), nodes},
          Size{"patches of source quads", mesh.source_patch.size(), mesh.quads.size()},
          Size{"patches of target quads", mesh.target_patch.size(), mesh.quads.size()},
          Size{"patches of wall quads", mesh.wall_patch.size(), layers * mesh.rim.size()}}) {
        if (found != expected)
            return Finding{Fault::wrong_size, std::string("the mesh holds ") + std::to_string(found) + " " +
                                                  what + "; expected " + std::to_string(expected)};
    }
    const std::size_t first_triangle = mesh.quads.size() - mesh.triangle_count();
    for (std::size_t q = 0; q < mesh.quads.size(); ++q) {
        if (q < first_triangle && mesh::is_triangle(mesh.quads[q]))
            return Finding{Fault::wrong_size,
                           "source quad " + person(q) +
                               " is a triangle and precedes quads; triangles must come last"};
        for (const Index node : mesh.quads[q]) {
            if (node < 0 || node >= mesh.nodes_per_layer)
                return Finding{Fault::unknown_node, "source quad " + person(q) + " has node number " +
                                                        std::to_string(node + 1) + " of " +
                                                        std::to_string(mesh.nodes_per_layer)};
        }
    }
    return std::nullopt;
}

Found check_patches(const mesh::HexMesh& mesh)
{
    std::unordered_set<int> tags;
    for (const mesh::SkinPatch& patch : mesh.patches) {
        if (patch.tag <= 0 || !tags.insert(patch.tag).second)
            return Finding{Fault::patch_tag, "tag " + std::to_string(patch.tag) +
                                                 " of a skin patch is not positive or not unique"};
    }
    const auto count = static_cast<Index>(mesh.patches.size());
    for (const auto& [where, patches] :
         {std::pair("source", &mesh.source_patch), std::pair("target", &mesh.target_patch),
          std::pair("wall", &mesh.wall_patch)}) {
        const auto wrong = std::find_if(patches->begin(), patches->end(),
                                        [&](Index p) { return p < 0 || p >= count; });
        if (wrong != patches->end())
            return Finding{Fault::no_patch, std::string(where) + " quad " +
                                                person(static_cast<std::size_t>(wrong - patches->begin())) +
                                                " has no patch of the skin; set its patch number"};
    }
    return std::nullopt;
}

std::string source_node(const mesh::HexMesh& mesh, Index node)
{
    return "source node " + std::to_string(node + 1) + " (at " +
           place(mesh.nodes[static_cast<std::size_t>(node)]) + ")";
}

Found check_sides(const mesh::HexMesh& mesh, const std::vector<Index>& opposite)
{
    for (std::size_t side = 0; side < opposite.size(); ++side) {
        const Quad& quad = mesh.quads[side / 4];
        const Index from = quad[side % 4];
        const Index to = quad[(side + 1) % 4];
        if (opposite[side] == mesh::kNoSide || (from != to && opposite[side] != mesh::kBadSide)) continue;
        return Finding{Fault::not_conformal,
                       "the side of source quad " + person(side / 4) + " from " + source_node(mesh, from) +
                           " to " + source_node(mesh, to) +
                           (from == to ? " has the same node at both ends"
                                       : " is used by more than two quads, or twice in the same direction")};
    }
    return std::nullopt;
}

/// The next node along the rim for each node; -1 for inner nodes.
std::vector<Index> rim_followers(const mesh::HexMesh& mesh, const std::vector<Index>& opposite)
{
    std::vector<Index> follows(index(mesh.nodes_per_layer), -1);
    for (std::size_t side = 0; side < opposite.size(); ++side) {
        if (opposite[side] == mesh::kRimSide)
            follows[index(mesh.quads[side / 4][side % 4])] = mesh.quads[side / 4][(side + 1) % 4];
    }
    return follows;
}

/// Check that every node is used, and that the quads around it form one fan;
/// otherwise the mesh is pinched there.
Found check_fans(const mesh::HexMesh& mesh, const std::vector<Index>& opposite)
{
    const std::size_t nodes = index(mesh.nodes_per_layer);
    std::vector<Index> valence(nodes, 0);
    std::vector<Index> first(nodes, -1); // a side that starts at the node; one on the rim if there is one
    for (std::size_t side = 0; side < opposite.size(); ++side) {
        if (opposite[side] == mesh::kNoSide) continue;
        const std::size_t node = index(mesh.quads[side / 4][side % 4]);
        ++valence[node];
        if (opposite[side] == mesh::kRimSide || first[node] < 0) first[node] = static_cast<Index>(side);
    }
    for (std::size_t node = 0; node < nodes; ++node) {
        if (valence[node] == 0)
            return Finding{Fault::unused_node,
                           source_node(mesh, static_cast<Index>(node)) + " belongs to no quad; remove it"};
        // Go around the node: the side of a quad that ends at the node is the side of
        // the next quad that starts there.
        Index turned = 1;
        for (Index side = first[node];; ++turned) {
            Index arrives = side % 4 == 0 ? side + 3 : side - 1;
            if (opposite[index(arrives)] == mesh::kNoSide) --arrives;
            side = opposite[index(arrives)];
            if (side < 0 || side == first[node]) break;
        }
        if (turned != valence[node])
            return Finding{Fault::pinched, "the quads around " + source_node(mesh, static_cast<Index>(node)) +
                                               " are connected at this node only; duplicate the node"};
    }
    return std::nullopt;
}

Found check_rim(const mesh::HexMesh& mesh, std::vector<Index> follows)
{
    for (const Segment& side : mesh.rim) {
        const bool known = side[0] >= 0 && side[0] < mesh.nodes_per_layer;
        if (!known || follows[static_cast<std::size_t>(side[0])] != side[1] || side[1] < 0)
            return Finding{Fault::open_skin,
                           "the rim side from node " + std::to_string(side[0] + 1) + " to " +
                               std::to_string(side[1] + 1) +
                               " is not a boundary side of the source quads, or is listed twice"};
        follows[static_cast<std::size_t>(side[0])] = -1;
    }
    const auto missed = std::find_if(follows.begin(), follows.end(), [](Index to) { return to >= 0; });
    if (missed != follows.end())
        return Finding{Fault::open_skin, "the boundary side of the source quads from " +
                                             source_node(mesh, static_cast<Index>(missed - follows.begin())) +
                                             " to " + source_node(mesh, *missed) +
                                             " is not listed in the rim"};
    return std::nullopt;
}

} // namespace

std::string node_name(const Vec3& at, Index node, Index nodes_per_layer, std::size_t levels)
{
    std::string text = "node " + std::to_string(node + 1) + " (";
    if (nodes_per_layer > 0)
        text += "level " + std::to_string(node / nodes_per_layer + 1) + " of " + std::to_string(levels) +
                ", ";
    return text + "at " + place(at) + ")";
}

std::string node_name(std::span<const Vec3> nodes, Index node, Index nodes_per_layer)
{
    const std::size_t levels = nodes_per_layer > 0 ? nodes.size() / index(nodes_per_layer) : 0;
    return node_name(nodes[index(node)], node, nodes_per_layer, levels);
}

Finding not_finite(const std::string& node)
{
    return {Fault::not_finite, node + " has coordinates that are not finite"};
}

Finding coincident_nodes(const std::string& a, const std::string& b)
{
    return {Fault::coincident_nodes, a + " and " + b + " coincide (within 1e-9 of the diagonal of the mesh)"};
}

Index first_not_finite(std::span<const Vec3> nodes)
{
    const auto wrong = std::ranges::find_if(nodes, [](const Vec3& p) { return !p.allFinite(); });
    return static_cast<Index>(wrong - nodes.begin());
}

Found check_nodes(std::span<const Vec3> nodes, Index nodes_per_layer, const RunContext& context)
{
    const Eigen::AlignedBox3d bounds = finite_bounds(nodes, context);
    if (bounds.isEmpty()) return not_finite(node_name(nodes, first_not_finite(nodes), nodes_per_layer));
    if (const auto pair = find_coincident(nodes, index(std::max<Index>(nodes_per_layer, 0)),
                                          coincidence_tolerance(bounds), bounds, context))
        return coincident_nodes(node_name(nodes, (*pair)[0], nodes_per_layer),
                                node_name(nodes, (*pair)[1], nodes_per_layer));
    return std::nullopt;
}

Found check_quality(const Quality& quality, double min_scaled_jacobian, int layers)
{
    const auto worst = [&](double below) {
        std::string text;
        for (const WorstCell& cell : quality.worst)
            if (!(cell.scaled_jacobian >= below)) text += "\n  " + describe(cell, layers);
        return text;
    };
    const std::string cells = " of " + std::to_string(quality.hexes + quality.wedges) + " cells ";
    if (quality.inverted > 0)
        return Finding{Fault::inverted,
                       std::to_string(quality.inverted) + cells +
                           "are inverted. The worst:" + worst(std::numeric_limits<double>::denorm_min())};
    if (quality.uncertified > 0)
        return Finding{Fault::not_certified,
                       std::to_string(quality.uncertified) + cells +
                           "have a Jacobian that is positive at their corners but not everywhere. "
                           "The worst cells of the mesh:" +
                           worst(std::numeric_limits<double>::infinity())};
    if (quality.min_scaled_jacobian < min_scaled_jacobian)
        return Finding{Fault::below_limit, "the smallest scaled Jacobian is " +
                                               number(quality.min_scaled_jacobian) + ", below the limit of " +
                                               number(min_scaled_jacobian) +
                                               ". The worst:" + worst(min_scaled_jacobian)};
    return std::nullopt;
}

std::string fault_code(Fault fault)
{
    static constexpr std::array kNames{
        "empty",          "wrong_size",    "unknown_node",     "patch_tag",   "no_patch",
        "collapsed_side", "not_conformal", "pinched",          "unused_node", "open_skin",
        "skin_differs",   "not_finite",    "coincident_nodes", "inverted",    "not_certified",
        "below_limit",
    };
    static_assert(kNames.size() == static_cast<std::size_t>(Fault::below_limit) + 1);
    return std::string("quality.") + kNames[static_cast<std::size_t>(fault)];
}

bool can_be_improved(Fault fault)
{
    return fault == Fault::inverted || fault == Fault::not_certified || fault == Fault::below_limit;
}

void require(const Proof& proof)
{
    if (proof.finding) throw NotSweepable(fault_code(proof.finding->fault), proof.finding->message);
}

Found check_arrays(const mesh::HexMesh& mesh, std::size_t nodes)
{
    Found found = check_sizes(mesh, nodes);
    if (!found) found = check_patches(mesh);
    if (found) return found;
    const std::vector<Index> opposite = mesh::opposite_sides(mesh.quads, mesh.nodes_per_layer);
    found = check_sides(mesh, opposite);
    if (!found) found = check_fans(mesh, opposite);
    if (!found) found = check_rim(mesh, rim_followers(mesh, opposite));
    return found;
}

Proof prove(const mesh::HexMesh& mesh, double min_scaled_jacobian, const RunContext& context)
{
    return prove(mesh, std::nullopt, min_scaled_jacobian, context);
}

Proof prove(const mesh::HexMesh& mesh, std::optional<Quality> measured, double min_scaled_jacobian,
            const RunContext& context)
{
    Proof proof;
    const auto found = [&](Found finding) {
        proof.finding = std::move(finding);
        return proof.finding.has_value();
    };
    const std::size_t levels = static_cast<std::size_t>(std::max(mesh.layers, 0)) + 1;
    const std::size_t nodes = levels * index(std::max<Index>(mesh.nodes_per_layer, 0));
    // Arrays of a measured mesh have valid sizes. Check them nevertheless, in
    // parallel with the check of the nodes.
    const bool beside = measured && nodes > 0 && mesh.nodes.size() == nodes &&
                        !check_quality(*measured, min_scaled_jacobian, mesh.layers);
    std::optional<Background<Found>> arrays;
    Found misplaced;
    if (beside) {
        arrays.emplace(context, [&](const RunContext&) { return check_arrays(mesh, nodes); });
        misplaced = check_nodes(mesh.nodes, mesh.nodes_per_layer, context);
    }
    if (found(arrays ? arrays->take() : check_arrays(mesh, nodes))) return proof;
    check_cancelled(context);
    proof.quality = measured ? std::move(*measured) : measure(mesh, context, Keep::of_cells);
    if (beside)
        found(std::move(misplaced));
    else if (!found(check_quality(proof.quality, min_scaled_jacobian, mesh.layers)))
        found(check_nodes(mesh.nodes, mesh.nodes_per_layer, context));
    return proof;
}

} // namespace lacuna::quality
