// SPDX-License-Identifier: MIT
#include <lacuna/quality/shared/prove_cells.h>

#include <lacuna/core/shared/constants.h>
#include <lacuna/core/shared/same_corners.h>
#include <lacuna/mesh/cell_shape.h>
#include <lacuna/quality/detail/findings.h>
#include <lacuna/quality/detail/other_cells.h>

#include <algorithm>

namespace lacuna::quality {
namespace {

/// The sides of a kind of cell as corners of `Hex`, oriented outward; the fourth is -1 for a triangle.
std::vector<Quad> sides_of(CellKind kind)
{
    constexpr mesh::CellShape kShapes[]{mesh::CellShape::hex8, mesh::CellShape::wedge6,
                                        mesh::CellShape::pyramid5, mesh::CellShape::tet4};
    const std::span<const std::uint8_t> corners = corners_of(kind);
    std::vector<Quad> sides;
    for (Quad side : mesh::face_corners(kShapes[static_cast<std::size_t>(kind)])) {
        for (Index& corner : side) corner = corner < 0 ? -1 : corners[index(corner)];
        sides.push_back(side);
    }
    return sides;
}

std::string name_of(std::span<const Vec3> nodes, Index node)
{
    const NodeName name = node_name(nodes, node, 0);
    return formatted("{} ({})", name.node, name.place);
}

NamedEntity cell_name(std::size_t cell) { return {"cell", static_cast<long long>(cell) + 1}; }

class CellsProver {
public:
    CellsProver(std::span<const Vec3> nodes, std::span<const Hex> cells, const RunContext& context)
        : nodes_(nodes), cells_(cells), context_(context)
    {
        for (std::size_t k = 0; k < sides_.size(); ++k) sides_[k] = sides_of(static_cast<CellKind>(k));
    }

    CellsProof prove()
    {
        CellsProof proof;
        proof.finding = check_corners();
        if (proof.finding) return proof;
        check_cancelled(context_);
        proof.quality = measure_cells(nodes_, cells_, context_);
        proof.finding = check_quality(proof.quality, 0, 0);
        if (!proof.finding) proof.finding = pair_sides();
        if (!proof.finding) proof.finding = check_joints();
        if (!proof.finding) proof.finding = check_edges();
        check_cancelled(context_);
        if (!proof.finding) proof.finding = check_nodes(nodes_, 0, context_);
        if (!proof.finding) proof.skin = std::move(skin_);
        return proof;
    }

private:
    Found check_corners() const
    {
        if (cells_.empty()) return Finding(Fault::empty, "the mesh has no cells");
        std::vector<char> used(nodes_.size(), 0);
        for (std::size_t c = 0; c < cells_.size(); ++c) {
            const std::span<const std::uint8_t> corners = corners_of(kind_of(cells_[c]));
            for (std::size_t k = 0; k < corners.size(); ++k) {
                const Index node = cells_[c][corners[k]];
                if (node < 0 || index(node) >= nodes_.size())
                    return Finding(Fault::unknown_node, "{} refers to node {}, but the nodes are 1 to {}",
                                   cell_name(c), found(std::int64_t(node) + 1), needed(nodes_.size()));
                for (std::size_t other = 0; other < k; ++other)
                    if (cells_[c][corners[other]] == node)
                        return Finding(Fault::collapsed_side, "{} has {} at two corners", cell_name(c),
                                       name_of(nodes_, node));
                used[index(node)] = 1;
            }
        }
        const auto unused = std::ranges::find(used, 0);
        if (unused == used.end()) return std::nullopt;
        return Finding(Fault::unused_node, "{} belongs to no cell",
                       name_of(nodes_, static_cast<Index>(unused - used.begin())));
    }

    /// The side with a given number: 8 × its cell + its index in `sides_of()`.
    [[nodiscard]] Quad side(std::uint64_t number) const
    {
        const Hex& cell = cells_[number / 8];
        Quad side = sides_[static_cast<std::size_t>(kind_of(cell))][number % 8];
        for (Index& corner : side) corner = corner < 0 ? -1 : cell[index(corner)];
        return side;
    }

    /// Whether two sides with the same corners have opposite directions.
    static bool are_opposite(const Quad& a, Quad b)
    {
        const std::ptrdiff_t corners = a[3] < 0 ? 3 : 4;
        std::reverse(b.begin(), b.begin() + corners);
        std::rotate(b.begin(), std::find(b.begin(), b.end(), a[0]), b.begin() + corners);
        return a == b;
    }

    /// Check for cancellation in every kBetweenPolls-th call.
    void count_step()
    {
        if (++steps_ % kBetweenPolls == 0) check_cancelled(context_);
    }

    /// Find the skin: the sides of one cell only. Every other side must belong to two cells, in opposite
    /// directions.
    Found pair_sides()
    {
        Found fault;
        const auto each = [&](const auto& visit) {
            for (std::size_t c = 0; c < cells_.size(); ++c) {
                count_step();
                const std::size_t count = sides_[static_cast<std::size_t>(kind_of(cells_[c]))].size();
                for (std::size_t s = 0; s < count; ++s) visit(side(8 * c + s), 8 * c + s);
            }
        };
        each_with_same_corners(nodes_.size(), each, [&](std::span<const NumberedCell> alike) {
            count_step();
            if (fault) return;
            const Quad first = side(alike[0].number);
            if (alike.size() == 1) {
                skin_.push_back(first);
                if (first[3] < 0) skin_.back()[3] = first[2];
                return;
            }
            if (alike.size() == 2 && are_opposite(first, side(alike[1].number))) return;
            const std::string between = formatted("between {} and {}", name_of(nodes_, first[0]),
                                                  name_of(nodes_, first[2]));
            fault = alike.size() > 2
                        ? Finding(Fault::not_conformal, "the side of {} {} is shared by {} cells",
                                  cell_name(alike[0].number / 8), between, found(alike.size()))
                        : Finding(Fault::not_conformal, "the side of {} {} does not match the side of {}",
                                  cell_name(alike[0].number / 8), between, cell_name(alike[1].number / 8));
        });
        return fault;
    }

    /// Check that no triangle of the skin has its corners on a quad of the skin: there a quad of one cell
    /// lies against triangles of others.
    Found check_joints()
    {
        Found fault;
        const auto each = [&](const auto& visit) {
            for (std::size_t q = 0; q < skin_.size(); ++q) {
                const Quad& quad = skin_[q];
                if (mesh::is_triangle(quad)) {
                    visit(Quad{quad[0], quad[1], quad[2], -1}, 2 * q);
                    continue;
                }
                for (std::size_t k = 0; k < 4; ++k)
                    visit(Quad{quad[k], quad[(k + 1) % 4], quad[(k + 2) % 4], -1}, 2 * q + 1);
            }
        };
        each_with_same_corners(nodes_.size(), each, [&](std::span<const NumberedCell> alike) {
            count_step();
            const auto triangle = std::ranges::find(alike, 0u, [](const auto& of) { return of.number % 2; });
            const auto quad = std::ranges::find(alike, 1u, [](const auto& of) { return of.number % 2; });
            if (fault || triangle == alike.end() || quad == alike.end()) return;
            const Quad& nodes = skin_[quad->number / 2];
            fault = Finding(Fault::not_conformal,
                            "the quad between {} and {} lies against triangles; expected a quad or a pyramid",
                            name_of(nodes_, nodes[0]), name_of(nodes_, nodes[2]));
        });
        return fault;
    }

    /// Check that every edge of the skin joins two of its sides, in opposite directions.
    Found check_edges() const
    {
        const std::vector<Index> opposite = mesh::opposite_sides(skin_, static_cast<Index>(nodes_.size()));
        const auto bad = std::ranges::find_if(
            opposite, [](Index side) { return side == mesh::kRimSide || side == mesh::kBadSide; });
        if (bad == opposite.end()) return std::nullopt;
        const auto at = static_cast<std::size_t>(bad - opposite.begin());
        const Quad& side = skin_[at / 4];
        return Finding(
            Fault::open_skin, "the edge of the skin from {} to {} is used by {}; expected two sides",
            name_of(nodes_, side[at % 4]), name_of(nodes_, side[(at + 1) % 4]),
            found(*bad == mesh::kRimSide ? "one side" : "more than two sides, or by two in one direction"));
    }

    std::span<const Vec3> nodes_;
    std::span<const Hex> cells_;
    const RunContext& context_;
    std::array<std::vector<Quad>, 4> sides_; ///< by kind
    std::vector<Quad> skin_;
    std::size_t steps_ = 0;
};

} // namespace

CellsProof prove_cells(std::span<const Vec3> nodes, std::span<const Hex> cells, const RunContext& context)
{
    return CellsProver(nodes, cells, context).prove();
}

} // namespace lacuna::quality
