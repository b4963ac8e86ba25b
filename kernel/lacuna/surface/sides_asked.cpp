// SPDX-License-Identifier: MIT
#include <lacuna/surface/detail/sides_asked.h>

#include <lacuna/core/error.h>
#include <lacuna/surface/detail/seed_pieces.h>
#include <lacuna/surface/shared/edge_nodes.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace lacuna::surface {

using namespace topology;

namespace {

/// The largest total height of rows for which an edge has room.
double room_on(const Model& model, const SeedPiece& piece, EdgeId edge, bool at_end, const RimRows::End& end)
{
    const std::vector<double>& other = at_end ? piece.low : piece.high;
    const double far = at_end ? (other.empty() ? piece.from : other.back())
                              : (other.empty() ? piece.to : other.front());
    return (edge_points(model, edge, std::array{far}).front() - model.at(model[end.corner].point))
        .dot(end.inward);
}

/// Place nodes at one end of an edge, at the heights of the rows that end there.
void end_rows(Seeds& seeds, const Model& model, EdgeId edge, bool at_end, const RimRows::End& end)
{
    std::vector<SeedPiece>& pieces = seeds.pieces.at(edge);
    SeedPiece& piece = at_end ? pieces.back() : pieces.front();
    if (piece.fixed) return; // given nodes are checked when the rows are placed
    const std::vector<double>& heights = seeds.rows.heights[static_cast<std::size_t>(end.table)];
    std::vector<double>& own = at_end ? piece.high : piece.low;
    own = row_places(model, edge, at_end, end, heights);
    const double low = piece.low.empty() ? piece.from : piece.low.back();
    const double high = piece.high.empty() ? piece.to : piece.high.front();
    if (own.size() < heights.size() || !(low < high)) {
        const bool alone = (at_end ? piece.low : piece.high).empty();
        throw NotSweepable(
            Message(
                "surface.layers_room",
                "the boundary layers of {}, {:.4g} high, end on {} at {}, which has room for only {:.4g}{}",
                entity_of(model, end.wall), needed(heights.back()), entity_of(model, edge),
                entity_of(model, end.corner), found(room_on(model, piece, edge, at_end, end)),
                alone ? "" : " beside the rows that end at its other end")
                .remedy("use fewer or thinner rows"));
    }
    const double share = (high - low) / (piece.to - piece.from);
    const double sides_between = piece.wanted.empty() ? share * piece.count
                                                      : wanted_at(piece, high) - wanted_at(piece, low);
    piece.count = std::max(1, static_cast<int>(std::lround(sides_between))) + piece.rows();
}

/// Number of sides, not rounded, between the start and a share of the length, for a request with bias.
double index_at(double share, const SidesAsked& asked)
{
    if (asked.count < 2 || asked.bias == 1) return share * asked.count;
    const double growth = std::log(asked.bias) / (asked.count - 1);
    return std::log1p(share * std::expm1(growth * asked.count)) / growth;
}

double length_at(double index, const SidesAsked& asked)
{
    if (asked.count < 2 || asked.bias == 1) return index / asked.count;
    const double growth = std::log(asked.bias) / (asked.count - 1);
    return std::expm1(growth * index) / std::expm1(growth * asked.count);
}

/// A requested number of sides is distributed over several pieces. For the end of each piece, choose the
/// number of the node that lies there: the nearest node according to the bias, but so that every piece has at
/// least one side.
std::vector<int> nodes_at(const std::vector<double>& ends, const SidesAsked& asked)
{
    std::vector<int> node{0};
    const auto pieces = static_cast<int>(ends.size()) - 1;
    for (int p = 1; p < pieces; ++p) {
        const double at = index_at(ends[static_cast<std::size_t>(p)] / ends.back(), asked);
        node.push_back(
            std::clamp(static_cast<int>(std::lround(at)), node.back() + 1, asked.count - (pieces - p)));
    }
    node.push_back(asked.count);
    return node;
}

/// For each piece, the request that determined its number of sides.
using Askers = std::map<const SeedPiece*, const SidesAsked*>;

/// Apply a request to a piece of an edge. Refuse a request that contradicts given nodes or an earlier
/// request.
void settle(const Model& model, Askers& askers, SeedPiece& piece, const SeedPiece& own,
            const SidesAsked& asked, EdgeId edge)
{
    const auto before = askers.find(&piece);
    if (piece.fixed && before == askers.end()) {
        if (piece.count == own.count) return;
        throw NotSweepable(Message("surface.sides_asked",
                                   "intervals: {} asks for {} sides on {} ({} of them on this part), but the "
                                   "given mesh there has {}",
                                   asked.name, asked.count, entity_of(model, edge), found(own.count),
                                   needed(piece.count))
                               .remedy("ask for that number"));
    }
    if (piece.fixed) {
        const SidesAsked& other = *before->second;
        if (piece.count != own.count)
            throw NotSweepable(Message("surface.sides_asked",
                                       "intervals: {} asks for {} sides on {} ({} of them on this part), but "
                                       "{} asks for {} sides ({} on this part)",
                                       asked.name, asked.count, entity_of(model, edge), found(own.count),
                                       other.name, other.count, needed(piece.count))
                                   .remedy("leave one of them out"));
        for (std::size_t i = 0; i < own.kept.size(); ++i) {
            if (std::abs(own.kept[i] - piece.kept[i]) * piece.length > model.tolerance)
                throw NotSweepable(
                    Message("surface.sides_asked",
                            "intervals: {} and {} ask for {} and {} sides on {} with different spacing",
                            asked.name, other.name, asked.count, other.count, entity_of(model, edge))
                        .remedy("leave one of them out, or give both the same bias"));
        }
        return;
    }
    if (const int rows = piece.rows(); rows > 0) {
        if (own.count <= rows)
            throw NotSweepable(
                Message("surface.sides_asked",
                        "intervals: {} asks for {} sides on {}, but {} rows of boundary layers "
                        "end there",
                        asked.name, found(asked.count), entity_of(model, edge), rows)
                    .remedy("give {} sides or more", needed(rows + 1)));
        if (asked.bias != 1)
            throw NotSweepable(
                Message("surface.sides_asked",
                        "intervals: {} asks for {} sides on {} with a bias, but boundary layers that "
                        "end there set the lengths",
                        asked.name, asked.count, entity_of(model, edge))
                    .remedy("leave out the bias"));
        piece.count = own.count;
        const std::vector<double> at = piece.fractions();
        piece.kept.assign(at.begin() + 1, at.end());
        piece.fixed = piece.asked = true;
    } else {
        piece = own;
    }
    askers[&piece] = &asked;
}

/// Fix the nodes of a requested number of sides.
void set_sides(Seeds& seeds, const Model& model, Askers& askers, const SidesAsked& asked)
{
    struct Asked {
        SeedPiece* piece;
        const SidesAsked::Part* part;
    };
    std::vector<Asked> pieces;
    for (const SidesAsked::Part& part : asked.parts) {
        std::vector<std::size_t> within;
        std::vector<SeedPiece>& all = seeds.pieces.at(part.edge);
        for (std::size_t i = 0; i < all.size(); ++i) {
            const double middle = (all[i].from + all[i].to) / 2;
            if (middle > part.from && middle < part.to) within.push_back(i);
        }
        if (part.reversed) std::ranges::reverse(within);
        for (const std::size_t i : within) pieces.push_back({&all[i], &part});
    }
    if (static_cast<std::size_t>(asked.count) < pieces.size()) {
        throw NotSweepable(
            "surface.sides_asked",
            "intervals: {} asks for {} sides, but the corners of both ends require at least {}", asked.name,
            found(asked.count), needed(pieces.size()));
    }
    std::vector<double> ends{0}; // running lengths
    for (const auto& [piece, part] : pieces) ends.push_back(ends.back() + piece->length);
    const std::vector<int> node = nodes_at(ends, asked);
    for (std::size_t p = 0; p < pieces.size(); ++p) {
        const auto& [piece, part] = pieces[p];
        SeedPiece own = *piece;
        own.fixed = own.asked = true;
        own.count = node[p + 1] - node[p];
        own.kept.clear();
        const double from = index_at(ends[p] / ends.back(), asked),
                     to = index_at(ends[p + 1] / ends.back(), asked);
        for (int i = 1; i < own.count; ++i) {
            const double at = from + (to - from) * i / own.count;
            double share = (length_at(at, asked) * ends.back() - ends[p]) / (ends[p + 1] - ends[p]);
            if (part->reversed) share = 1 - share;
            own.kept.push_back(own.from + share * (own.to - own.from));
        }
        std::ranges::sort(own.kept);
        settle(model, askers, *piece, own, asked, part->edge);
    }
}

} // namespace

void end_rows(Seeds& seeds, const Model& model, const RimRows& rows)
{
    seeds.rows = rows;
    for (const auto& [at, end] : rows.ends) end_rows(seeds, model, at.first, at.second, end);
}

void set_sides(Seeds& seeds, const Model& model, std::span<const SidesAsked> sides)
{
    Askers askers;
    for (const SidesAsked& asked : sides) set_sides(seeds, model, askers, asked);
}

} // namespace lacuna::surface
