// SPDX-License-Identifier: MIT
#include <lacuna/core/error.h>
#include <lacuna/core/shared/criteria.h>
#include <lacuna/mesh/shared/incidence.h>
#include <lacuna/quality/shared/second_order.h>
#include <lacuna/sweep/detail/middle_skin.h>
#include <lacuna/sweep/detail/words.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace lacuna::sweep {

namespace {

/// Maximum number of rounds over the invalid cells. Moves of one round may spoil neighbouring cells, which
/// the next round repairs. Not measured.
constexpr int kRounds = 4;
/// Number of step lengths. Each is half of the previous one, from a tenth of the side down to an eightieth.
/// Not measured.
constexpr int kSteps = 4;
constexpr double kFirstStep = 0.1;

/// Recompute the centres of a cell and its faces from the middles of their sides; settled centres stay.
void place_centres(mesh::HexMesh& mesh, const SkinMiddles& skin, std::size_t cell)
{
    const mesh::CellNodes nodes = mesh::cell_nodes(mesh, cell);
    const auto at = [&](std::size_t n) -> const Vec3& { return mesh.node(index(nodes.node[n])); };
    const auto place = [&](std::size_t n) { return index(nodes.node[n]) - mesh.nodes.size(); };
    std::array<Vec3, 6> faces;
    std::array<Vec3, 12> edges;
    std::array<Vec3, 8> corners;
    for (std::size_t e = 0; e < edges.size(); ++e) edges[e] = at(8 + e);
    for (std::size_t c = 0; c < corners.size(); ++c) corners[c] = at(c);
    for (std::size_t f = 0; f < faces.size(); ++f) {
        if (skin.state(place(20 + f)) != Middle::settled) {
            std::array<Vec3, 4> middle, corner;
            for (std::size_t k = 0; k < 4; ++k) {
                middle[k] = edges[index(mesh::kHexFaceEdges[f][k])];
                corner[k] = corners[index(mesh::kHexFaces[f][k])];
            }
            mesh.middles.nodes[place(20 + f)] = middle_of_quad(middle, corner);
        }
        faces[f] = at(20 + f);
    }
    mesh.middles.nodes[place(26)] = middle_of_cell(faces, edges, corners);
}

class Repair {
public:
    Repair(mesh::HexMesh& mesh, const SkinMiddles& skin) : mesh_(mesh), skin_(skin) {}

    void mend(std::size_t cell)
    {
        for (std::size_t e = 0; e < 12; ++e) {
            const mesh::CellNodes nodes = mesh::cell_nodes(mesh_, cell);
            const std::size_t place = index(nodes.node[8 + e]) - mesh_.nodes.size();
            if (skin_.state(place) == Middle::settled) continue;
            improve(place, cells_round(cell, e), mesh_.node(index(nodes.node[index(mesh::kHexEdges[e][0])])),
                    mesh_.node(index(nodes.node[index(mesh::kHexEdges[e][1])])));
        }
    }

private:
    /// The cells around edge `e` (0 to 11, see `mesh::kHexEdges`) of a cell.
    std::vector<std::size_t> cells_round(std::size_t cell, std::size_t e) const
    {
        const std::size_t quads = mesh_.quads.size(), layer = cell / quads, q = cell % quads;
        std::vector<std::size_t> cells;
        if (e >= 8) {
            for (const Index other : at_node_.of(index(mesh_.quads[q][e - 8])))
                cells.push_back(layer * quads + index(other));
            return cells;
        }
        const std::size_t level = layer + (e < 4 ? 0 : 1);
        for (const Index other : at_side_.of(index(mesh_.middles.side_of[q][e % 4]))) {
            if (level > 0) cells.push_back((level - 1) * quads + index(other));
            if (level < static_cast<std::size_t>(mesh_.layers)) cells.push_back(level * quads + index(other));
        }
        return cells;
    }

    double least(const std::vector<std::size_t>& cells)
    {
        double least = 1;
        for (const std::size_t cell : cells) {
            if (mesh_.middles.full) place_centres(mesh_, skin_, cell);
            const quality::CurvedCell judged = quality::judge(quality::hex27_of(mesh_, cell), 0);
            least = std::min(least, judged.volume > 0 ? judged.bound : -1e3 + judged.bound);
        }
        return least;
    }

    /// Try the straight position, half the bend, and then steps along the axes. Keep the position that is
    /// best for the worst cell.
    void improve(std::size_t place, const std::vector<std::size_t>& cells, const Vec3& a, const Vec3& b)
    {
        Vec3& node = mesh_.middles.nodes[place];
        const Vec3 straight = (a + b) / 2, bend = node - straight;
        Vec3 best = node;
        double value = least(cells);
        const auto offer = [&](const Vec3& at) {
            node = at;
            const double found = least(cells);
            if (found > value) {
                value = found;
                best = at;
            }
            node = best;
        };
        if (!bend.isZero(0))
            for (const double share : {0.0, 0.5, 1.5}) offer(straight + share * bend);
        double step = kFirstStep * (b - a).norm();
        // Middle nodes on the skin that are not settled may only move back towards the straight side.
        for (int i = 0; i < kSteps && skin_.state(place) == Middle::inside; ++i, step /= 2)
            for (int d = 0; d < 6; ++d) offer(Vec3(best + (d % 2 == 0 ? step : -step) * Vec3::Unit(d / 2)));
        least(cells); // restores the centres
    }

    mesh::HexMesh& mesh_;
    const SkinMiddles& skin_;
    /// The quads at each node and at each side of the source.
    const mesh::Incidence at_node_ = mesh::quads_at_nodes(mesh_.quads, index(mesh_.nodes_per_layer));
    const mesh::Incidence at_side_ = mesh::quads_at_nodes(mesh_.middles.side_of, mesh_.middles.sides.size());
};

/// The largest factor in [0, 1] on all bends of a cell for which the cell is valid.
double valid_share(const std::array<Vec3, 27>& nodes)
{
    const std::array<Vec3, 27> straight = mesh::as_hex27(std::span(nodes).first<8>());
    double low = 0, high = 1;
    for (int i = 0; i < 12; ++i) {
        const double share = (low + high) / 2;
        std::array<Vec3, 27> cell;
        for (std::size_t n = 0; n < 27; ++n) cell[n] = straight[n] + share * (nodes[n] - straight[n]);
        (quality::judge(cell).positive ? low : high) = share;
    }
    return low;
}

/// Refuse the mesh because of a cell: name the most bent of those sides of the cell that the skin fixes.
[[noreturn]] void refuse(const topology::OpenVolume& volume, const mesh::HexMesh& mesh,
                         const std::vector<FaceId>& faces, const SkinMiddles& skin, std::size_t cell,
                         std::size_t count)
{
    const mesh::CellNodes nodes = mesh::cell_nodes(mesh, cell);
    std::optional<std::size_t> worst;
    double most = 0, side = 0;
    for (std::size_t e = 0; e < 12; ++e) {
        if (skin.state(index(nodes.node[8 + e]) - mesh.nodes.size()) != Middle::settled) continue;
        const Vec3 &a = mesh.node(index(nodes.node[index(mesh::kHexEdges[e][0])])),
                   &b = mesh.node(index(nodes.node[index(mesh::kHexEdges[e][1])]));
        const double bend = (mesh.node(index(nodes.node[8 + e])) - (a + b) / 2).norm();
        if (bend <= most) continue;
        most = bend;
        side = (b - a).norm();
        worst = 8 + e;
    }
    constexpr const char* kCode = "sweep.second_order";
    const Argument cells = count == 1 ? "cell is" : "cells are";
    const NamedEntity own{"cell", static_cast<long long>(cell) + 1};
    const std::size_t layer = cell / mesh.quads.size() + 1;
    if (!worst)
        throw NotSweepable(
            Message(
                kCode,
                "{} {} not valid at order 2: the Jacobian is not positive everywhere in {} (layer {} of {}). "
                "Its skin is straight",
                count, cells, own, layer, mesh.layers)
                .remedy("try a smaller size, or use order = 1"));
    Argument face = "the skin";
    for (std::size_t i = 0; i < mesh.skin_count(); ++i) {
        const mesh::CellNodes quad = mesh::skin_nodes(mesh, i);
        const auto found = std::find(quad.node.begin() + 4, quad.node.begin() + 8, nodes.node[*worst]);
        if (found == quad.node.begin() + 8) continue;
        face = entity_of(volume.model, faces[index(mesh::skin_quad(mesh, i).patch)]);
        break;
    }
    // The relative bend of a side is proportional to its length. The suggested size is a tenth smaller than
    // needed.
    constexpr double kBelow = 0.9;
    const double share = kBelow * valid_share(quality::hex27_of(mesh, cell));
    constexpr std::size_t kFirstUpright = 16;
    const Hex hex = mesh.hex(cell);
    std::array<Vec3, 8> corners;
    for (std::size_t c = 0; c < 8; ++c) corners[c] = mesh.nodes[index(hex[c])];
    const double straight = quality::scaled_jacobian(corners);
    Message refusal(
        kCode,
        "{} {} not valid at order 2: the Jacobian is not positive everywhere in {} (layer {} of {}). "
        "The middle node of a side on {} must lie at {}, {:.2g} off a side of length {:.2g}",
        count, cells, own, layer, mesh.layers, face, place_in_short(mesh.node(index(nodes.node[*worst]))),
        found(most), side);
    // A smaller size helps only if the bend is the cause, that is, if the cell is good with straight sides.
    if (straight < kPoorCell)
        throw NotSweepable(std::move(refusal).remedy(
            "the cell is already poor with straight sides: its scaled Jacobian is {:.2g}", found(straight)));
    if (*worst < kFirstUpright)
        throw NotSweepable(
            std::move(refusal).remedy("use a size of {:.2g}, which fits the bend", needed(share * side)));
    const int layers = share > 0 ? static_cast<int>(std::ceil(mesh.layers / share)) : 2 * mesh.layers;
    throw NotSweepable(std::move(refusal).remedy("use {} layers, which fit the bend, instead of {}",
                                                 needed(layers), found(mesh.layers)));
}

} // namespace

std::size_t repair_middles(const topology::OpenVolume& volume, mesh::HexMesh& mesh,
                           const std::vector<FaceId>& faces, const SkinMiddles& skin,
                           const RunContext& context)
{
    std::vector<std::size_t> invalid = quality::invalid_cells(mesh, context);
    const std::size_t before = invalid.size();
    if (invalid.empty()) return 0;
    Repair repair(mesh, skin);
    for (int round = 0; round < kRounds && !invalid.empty(); ++round) {
        for (const std::size_t cell : invalid) {
            check_cancelled(context);
            repair.mend(cell);
        }
        invalid = quality::invalid_cells(mesh, context);
    }
    if (!invalid.empty()) refuse(volume, mesh, faces, skin, invalid.front(), invalid.size());
    return before;
}

} // namespace lacuna::sweep
