// SPDX-License-Identifier: MIT
#include <lacuna/core/error.h>
#include <lacuna/core/shared/criteria.h>
#include <lacuna/quality/shared/second_order.h>
#include <lacuna/sweep/detail/middle_skin.h>
#include <lacuna/sweep/detail/words.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace lacuna::sweep {

namespace {

/// The largest factor in [0, 1] by which the bends of a cell can be multiplied so that the cell is valid.
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

} // namespace

void refuse_middles(const topology::OpenVolume& volume, const mesh::HexMesh& mesh,
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
                .remedy("use a smaller 'size', or order = 1"));
    Argument face = "the skin";
    for (std::size_t i = 0; i < mesh.skin_count(); ++i) {
        const mesh::CellNodes quad = mesh::skin_nodes(mesh, i);
        const auto found = std::find(quad.node.begin() + 4, quad.node.begin() + 8, nodes.node[*worst]);
        if (found == quad.node.begin() + 8) continue;
        face = entity_of(volume.model, faces[index(mesh::skin_quad(mesh, i).patch)]);
        break;
    }
    // The bend of a side, relative to its length, is proportional to the length, so a cell of `share` times
    // the size is valid. The suggestion is a tenth smaller.
    const double share = kSuggestedShare * valid_share(quality::hex27_of(mesh, cell));
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
    // A smaller size helps only if the bend is the cause. That is so if the cell is good with straight sides.
    if (straight < kPoorCell)
        throw NotSweepable(std::move(refusal).remedy(
            "the cell is already poor with straight sides: its scaled Jacobian is {:.2g}", found(straight)));
    const Segment& ends = mesh::kHexEdges[*worst - 8];
    if (ends[0] / 4 == ends[1] / 4) // an edge of a quad
        throw NotSweepable(
            std::move(refusal).remedy("use a size of {:.2g}, which fits the bend", needed(share * side)));
    const int layers = share > 0 ? static_cast<int>(std::ceil(mesh.layers / share)) : 2 * mesh.layers;
    throw NotSweepable(std::move(refusal).remedy("use {} layers, which fit the bend, instead of {}",
                                                 needed(layers), found(mesh.layers)));
}

} // namespace lacuna::sweep
