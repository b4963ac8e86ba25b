// SPDX-License-Identifier: MIT
#include <lacuna/quality/detail/coincident.h>
#include <lacuna/quality/detail/findings.h>
#include <lacuna/quality/detail/text.h>
#include <lacuna/quality/quality.h>
#include <lacuna/quality/shared/layered.h>

#include <lacuna/core/error.h>
#include <lacuna/core/shared/constants.h>
#include <lacuna/mesh/quad_mesh.h>

#include <algorithm>
#include <limits>
#include <unordered_set>
#include <utility>

// Swept cells need no search for common sides: each side of a cell is a source quad on a level, or a side of
// a source quad times a layer. So the mesh is conforming and its skin closed if and only if the source quads
// are conforming and the rim lists all boundary sides of the source quads.

namespace lacuna::quality {
namespace {

/// Numbers for people start at 1.
template <class Number>
NamedEntity entity(const char* kind, Number number)
{
    return {kind, static_cast<long long>(number) + 1};
}

Found check_sizes(const mesh::HexMesh& mesh, std::size_t nodes)
{
    if (mesh.layers < 1 || mesh.quads.empty() || mesh.nodes_per_layer < 3)
        return Finding(Fault::empty, "the mesh has no cells: {} source quads and {} layers",
                       found(mesh.quads.size()), found(mesh.layers));
    const auto layers = static_cast<std::size_t>(mesh.layers);
    struct Size {
        const char* what;
        std::size_t size, expected;
    };
    for (const auto& [what, size, expected] :
         {Size{"nodes", mesh.nodes.size(), nodes},
          Size{"patches of source quads", mesh.source_patch.size(), mesh.quads.size()},
          Size{"patches of target quads", mesh.target_patch.size(), mesh.quads.size()},
          Size{"patches of wall quads", mesh.wall_patch.size(), layers * mesh.rim.size()}}) {
        if (size != expected)
            return Finding(Fault::wrong_size, "the mesh holds {} {}; expected {}", found(size), what,
                           needed(expected));
    }
    const std::size_t first_triangle = mesh.quads.size() - mesh.triangle_count();
    for (std::size_t q = 0; q < mesh.quads.size(); ++q) {
        if (q < first_triangle && mesh::is_triangle(mesh.quads[q]))
            return Finding(Fault::wrong_size, "{} is a triangle and precedes quads; triangles must come last",
                           entity("source quad", q));
        for (const Index node : mesh.quads[q]) {
            if (node < 0 || node >= mesh.nodes_per_layer)
                return Finding(Fault::unknown_node, "{} refers to node {}, but the nodes are 1 to {}",
                               entity("source quad", q), found(static_cast<long long>(node) + 1),
                               needed(mesh.nodes_per_layer));
        }
    }
    return std::nullopt;
}

Found check_patches(const mesh::HexMesh& mesh)
{
    std::unordered_set<int> tags;
    for (const mesh::SkinPatch& patch : mesh.patches) {
        if (patch.tag <= 0 || !tags.insert(patch.tag).second)
            return Finding(Fault::patch_tag, "tag {} of a skin patch is not positive or not unique",
                           found(patch.tag));
    }
    const auto count = static_cast<Index>(mesh.patches.size());
    for (const auto& [kind, patches] :
         {std::pair("source quad", &mesh.source_patch), std::pair("target quad", &mesh.target_patch),
          std::pair("wall quad", &mesh.wall_patch)}) {
        const auto wrong = std::find_if(patches->begin(), patches->end(),
                                        [&](Index p) { return p < 0 || p >= count; });
        if (wrong != patches->end())
            return Finding(Fault::no_patch, "{} has no patch of the skin; set its patch number",
                           entity(kind, wrong - patches->begin()));
    }
    return std::nullopt;
}

std::string place_of(const mesh::HexMesh& mesh, Index node) { return place(mesh.nodes[index(node)]); }

Found check_sides(const mesh::HexMesh& mesh, const std::vector<Index>& opposite)
{
    for (std::size_t side = 0; side < opposite.size(); ++side) {
        const Quad& quad = mesh.quads[side / 4];
        const Index from = quad[side % 4];
        const Index to = quad[(side + 1) % 4];
        if (opposite[side] == mesh::kNoSide || (from != to && opposite[side] != mesh::kBadSide)) continue;
        return Finding(Fault::not_conformal, "the side of {} from {} (at {}) to {} (at {}) {}",
                       entity("source quad", side / 4), entity("source node", from), place_of(mesh, from),
                       entity("source node", to), place_of(mesh, to),
                       from == to ? "has the same node at both ends"
                                  : "is used by more than two quads, or twice in the same direction");
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

/// Check that every node is used, and that the quads around it form one fan; otherwise the mesh is pinched
/// there.
Found check_fans(const mesh::HexMesh& mesh, const std::vector<Index>& opposite)
{
    const std::size_t nodes = index(mesh.nodes_per_layer);
    std::vector<Index> valence(nodes, 0);
    std::vector<Index> first(nodes, -1); // a side that starts at the node; on the rim, if possible
    for (std::size_t side = 0; side < opposite.size(); ++side) {
        if (opposite[side] == mesh::kNoSide) continue;
        const std::size_t node = index(mesh.quads[side / 4][side % 4]);
        ++valence[node];
        if (opposite[side] == mesh::kRimSide || first[node] < 0) first[node] = static_cast<Index>(side);
    }
    for (std::size_t node = 0; node < nodes; ++node) {
        if (valence[node] == 0)
            return Finding(Fault::unused_node, "{} (at {}) belongs to no quad; remove it",
                           entity("source node", node), place(mesh.nodes[node]));
        // Go around the node: the side of a quad that ends at the node is the side of the next quad that
        // starts there.
        Index turned = 1;
        for (Index side = first[node];; ++turned) {
            Index arrives = side % 4 == 0 ? side + 3 : side - 1;
            if (opposite[index(arrives)] == mesh::kNoSide) --arrives;
            side = opposite[index(arrives)];
            if (side < 0 || side == first[node]) break;
        }
        if (turned != valence[node])
            return Finding(Fault::pinched,
                           "the quads around {} (at {}) are connected at this node only; duplicate the node",
                           entity("source node", node), place(mesh.nodes[node]));
    }
    return std::nullopt;
}

Found check_rim(const mesh::HexMesh& mesh, std::vector<Index> follows)
{
    for (const Segment& side : mesh.rim) {
        const bool known = side[0] >= 0 && side[0] < mesh.nodes_per_layer;
        if (!known || follows[static_cast<std::size_t>(side[0])] != side[1] || side[1] < 0)
            return Finding(Fault::open_skin,
                           "the rim side from {} to {} is not a boundary side of the source quads, or is "
                           "listed twice",
                           entity("source node", side[0]), entity("source node", side[1]));
        follows[static_cast<std::size_t>(side[0])] = -1;
    }
    const auto missed = std::find_if(follows.begin(), follows.end(), [](Index to) { return to >= 0; });
    if (missed == follows.end()) return std::nullopt;
    const auto from = static_cast<Index>(missed - follows.begin());
    return Finding(Fault::open_skin,
                   "the boundary side of the source quads from {} (at {}) to {} (at {}) is not listed in the "
                   "rim",
                   entity("source node", from), place_of(mesh, from), entity("source node", *missed),
                   place_of(mesh, *missed));
}

} // namespace

NodeName node_name(const Vec3& at, Index node, Index nodes_per_layer, std::size_t levels)
{
    const NamedEntity named = entity("node", node);
    if (nodes_per_layer <= 0) return {named, "at " + place(at)};
    return {named, formatted("level {} of {}, at {}", node / nodes_per_layer + 1, levels, place(at))};
}

NodeName node_name(std::span<const Vec3> nodes, Index node, Index nodes_per_layer)
{
    const std::size_t levels = nodes_per_layer > 0 ? nodes.size() / index(nodes_per_layer) : 0;
    return node_name(nodes[index(node)], node, nodes_per_layer, levels);
}

Finding not_finite(const NodeName& node)
{
    return {Fault::not_finite, "{} ({}) has coordinates that are not finite", node.node, node.place};
}

Finding coincident_nodes(const NodeName& a, const NodeName& b)
{
    return Finding(Fault::coincident_nodes,
                   "{} ({}) and {} ({}) coincide (within 1e-9 of the diagonal of the mesh)", a.node, a.place,
                   b.node, b.place);
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
        std::vector<NamedEntity> cells;
        for (const WorstCell& cell : quality.worst)
            if (!(cell.scaled_jacobian >= below)) cells.push_back(entity("cell", cell.cell));
        return cells;
    };
    const std::size_t cells = quality.cells();
    const WorstCell first = quality.worst.empty() ? WorstCell{} : quality.worst.front();
    const std::string where = place_in_mesh(first, layers);
    if (quality.inverted > 0)
        return Finding(Fault::inverted,
                       "{} of {} cells are inverted. The worst are {}, the first ({}) with scaled Jacobian "
                       "{:.6g}",
                       found(quality.inverted), cells, worst(std::numeric_limits<double>::denorm_min()),
                       where, first.scaled_jacobian);
    if (quality.uncertified > 0)
        return Finding(Fault::not_certified,
                       "{} of {} cells have a Jacobian that is positive at their corners but not everywhere. "
                       "The worst cells of the mesh are {}, the first ({}) with scaled Jacobian {:.6g}",
                       found(quality.uncertified), cells, worst(kInfinity), where, first.scaled_jacobian);
    if (quality.min_scaled_jacobian < min_scaled_jacobian)
        return Finding(Fault::below_limit,
                       "the smallest scaled Jacobian is {:.6g}, below the limit of {:.6g}. The worst are {}, "
                       "the first ({})",
                       found(quality.min_scaled_jacobian), needed(min_scaled_jacobian),
                       worst(min_scaled_jacobian), where);
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
    if (proof.finding) throw NotSweepable(proof.finding->message);
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
    Proof proof;
    const std::size_t levels = static_cast<std::size_t>(std::max(mesh.layers, 0)) + 1;
    const std::size_t nodes = levels * index(std::max<Index>(mesh.nodes_per_layer, 0));
    proof.finding = check_arrays(mesh, nodes);
    if (proof.finding) return proof;
    check_cancelled(context);
    proof.quality = measure(mesh, context, Keep::of_cells);
    proof.finding = check_quality(proof.quality, min_scaled_jacobian, mesh.layers);
    if (!proof.finding) proof.finding = check_nodes(mesh.nodes, mesh.nodes_per_layer, context);
    return proof;
}

} // namespace lacuna::quality
