// SPDX-License-Identifier: MIT
#include <lacuna/surface/detail/seed_edges.h>

#include <lacuna/core/error.h>
#include <lacuna/core/shared/criteria.h>
#include <lacuna/geometry/shared/polyline.h>
#include <lacuna/surface/detail/edge_turning.h>
#include <lacuna/surface/shared/edge_nodes.h>
#include <lacuna/topology/shared/names_of.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace lacuna::surface {

using namespace topology;

namespace {

/// Minimum number of sides for a full turn if no number is requested. With fewer sides, quads of a round face
/// have corners of 120° or more.
constexpr int kFewestPerTurn = 6;

/// Number of points on each piece at which the size is sampled. With 16, necks are missed.
constexpr int kSizeSamples = 32;

/// Turns of the target's rim over even steps along a segment [radian].
std::vector<double> opposite_turning(const EdgeTurning& target, const RimSegment& segment)
{
    const double whole = target.length(), step = (segment.target_to - segment.target_from) / kSizeSamples;
    std::vector<double> turning;
    for (int i = 0; i < kSizeSamples; ++i) {
        double from = segment.target_from + i * step;
        while (from >= whole) from -= whole;
        const double past = std::max(from + step - whole, 0.0);
        turning.push_back(target.between(from, from + step - past) + target.between(0, past));
    }
    return turning;
}

/// Add the segments of the source's rim as pieces.
void add_rim(const Model& model, const LinkingSurface& link, Seeds& seeds)
{
    const EdgeTurning target(model, link.target.uses());
    for (const RimSegment& segment : link.segments) {
        const EdgeUse use = link.source.uses()[segment.use];
        const auto [from, to] = edge_part(link, segment);
        SeedPiece piece{from, to, segment.source_to - segment.source_from, 1};
        if (!segment.target_follows) piece.opposite = opposite_turning(target, segment);
        if (use.reversed) std::ranges::reverse(piece.opposite);
        piece.fixed = segment.given;
        piece.follows = segment.follows;
        seeds.pieces[use.edge].push_back(std::move(piece));
    }
    for (auto& [edge, pieces] : seeds.pieces) {
        std::ranges::sort(pieces, {}, &SeedPiece::from);
    }
}

/// Hexahedra cannot be swept from a given mesh of quads and triangles. If the style does not keep given
/// meshes, add a note that the mesh of the face is not kept. Triangles of a face without quads are not a
/// mesh: they only define its shape.
/// @throw NotSweepable  the face has a mesh of quads and triangles, and quads = "auto".
void note_mixed(const SeedTask& task, FaceId face, Seeds& seeds)
{
    const Face& f = task.model[face];
    const std::size_t quads = f.given_quads.size(), triangles = f.triangles.size() - 2 * quads;
    if (!f.keeps_nodes || quads == 0 || triangles == 0) return;
    const Message mixed("surface.given_triangles",
                        "{} was given with {} quads and {} triangles, which cannot be swept to hexahedra",
                        entity_of(task.model, face), quads, found(triangles));
    if (task.style == QuadStyle::automatic)
        throw NotSweepable(mixed.remedy("use wedges = true to keep them all, quads = \"paved\" to "
                                        "remesh the face inside its rim, or load with keep_mesh = "
                                        "false"));
    seeds.notes.push_back(formatted("{}: it is remeshed inside its rim", mixed.text()));
}

/// Whether a face's given quads are kept.
bool keeps(const SeedTask& task, FaceId face, const std::set<FaceId>& kept)
{
    const Face& f = task.model[face];
    const bool whole = has_cells_to_keep(f, task.wedges);
    if (task.style == QuadStyle::kept && !whole) {
        const std::size_t quads = f.given_quads.size();
        throw NotSweepable(
            Message("surface.not_kept",
                    "{} has {} quads of its own and {} triangles; quads = \"keep\" needs quads "
                    "only",
                    entity_of(task.model, face), quads,
                    found(f.triangles.size() - std::min(f.triangles.size(), 2 * quads)))
                .remedy("use wedges = true to keep triangles too, or quads = \"auto\" to "
                        "remesh"));
    }
    return whole &&
           (task.style == QuadStyle::kept || task.style == QuadStyle::automatic || kept.contains(face));
}

/// Give the pieces of an edge its given nodes.
void keep_nodes(const Model& model, FaceId face, EdgeId edge, Seeds& seeds)
{
    const std::vector<double> arc = geometry::arc_lengths(edge_line(model, edge));
    for (SeedPiece& piece : seeds.pieces[edge]) {
        const double slack = model.tolerance / arc.back();
        const std::size_t sides = piece.kept.size();
        piece.kept.clear();
        bool from = false, to = false;
        for (const double length : arc) {
            const double f = length / arc.back();
            from = from || std::abs(f - piece.from) <= slack;
            to = to || std::abs(f - piece.to) <= slack;
            if (f > piece.from + slack && f < piece.to - slack) piece.kept.push_back(f);
        }
        // Check the given nodes inside the piece. If the piece is already fixed by another face, the numbers
        // must agree; a piece that is one side between two given nodes has none inside.
        if (!from || !to || (piece.fixed && piece.kept.size() != sides)) {
            throw NotSweepable(
                Message("surface.kept_rim",
                        "{} of {}, which keeps its quads, has no node opposite a corner of the "
                        "other end",
                        entity_of(model, edge), entity_of(model, face))
                    .remedy("mesh both ends alike, or load with keep_mesh = false"));
        }
        piece.fixed = true;
        piece.wanted.clear();
        piece.count = static_cast<int>(piece.kept.size()) + 1;
    }
}

/// Find the number of sides that size and curvature require, and their distribution.
void ask_size(const SeedTask& task, EdgeId edge, SeedPiece& piece)
{
    const int per_turn = task.sizing.curvature > 0 ? task.sizing.curvature : kFewestPerTurn;
    std::vector<double> at;
    for (int i = 0; i < kSizeSamples; ++i)
        at.push_back(piece.from + (i + 0.5) / kSizeSamples * (piece.to - piece.from));
    const EdgeTurning turning(task.model, edge);
    const double step = (piece.to - piece.from) * turning.length() / kSizeSamples;
    // If the target's rim turns more than this rim, only the excess is added. Turns are compared over the
    // whole piece, because on an oblique end the rim turns unevenly, but by the same total.
    const auto turn_between = [&](double from, double to) {
        return piece.follows ? 0 : turning.between(from, to);
    };
    const double own = turn_between(piece.from * turning.length(), piece.to * turning.length());
    const double opposite = std::accumulate(piece.opposite.begin(), piece.opposite.end(), 0.0);
    const double more = opposite > own ? (opposite - own) / opposite : 0;
    double by_turn = 0, by_size = 0, sides = 0;
    double least = kInfinity, most = 0;
    piece.wanted = {0};
    const std::vector<Vec3> points = edge_points(task.model, edge, at);
    for (std::size_t i = 0; i < points.size(); ++i) {
        const double from = piece.from * turning.length() + static_cast<double>(i) * step;
        double turn = turn_between(from, from + step);
        if (more > 0) turn += more * piece.opposite[i];
        const double size = piece.length / kSizeSamples / task.size(points[i]);
        const double bend = turn * per_turn / kFullTurn;
        const double here = std::max(size, bend);
        by_turn += bend;
        by_size += size;
        sides += here;
        piece.wanted.push_back(sides);
        least = std::min(least, here);
        most = std::max(most, here);
    }
    if (most < least * (1 + kVisible)) piece.wanted.clear();
    if (sides > std::numeric_limits<Index>::max() / 8) {

        throw NotSweepable(Message("surface.too_many_sides",
                                   "{} would have {:.3g} sides at this size, more than node numbers allow",
                                   entity_of(task.model, edge), found(sides))
                               .remedy("use a larger 'size'"));
    }
    const double nearest = std::round(by_turn);
    const auto bends = static_cast<int>(
        std::abs(by_turn - nearest) <= kAlikeSizes * nearest ? nearest : std::ceil(by_turn));
    piece.count = std::max({1, static_cast<int>(std::lround(sides)), bends});
    piece.bends = piece.count > std::max(1L, std::lround(by_size));
    piece.sides = std::max(sides, by_turn);
    piece.least = std::max(1, bends);
}

/// Add a note if edges of given triangles whose nodes are kept, and which no face with given quads uses, have
/// sides longer than twice the size.
void note_coarse_edges(const SeedTask& task, Seeds& seeds)
{
    const auto has_quads = [&](const FaceUse& use) { return !task.model[use.face].given_quads.empty(); };
    const auto is_given = [&](const FaceUse& use) { return task.model[use.face].keeps_nodes; };
    const auto is_coarse = [&](EdgeId edge, const SeedPiece& piece) {
        if (!piece.fixed) return false;
        SeedPiece by_size = piece;
        ask_size(task, edge, by_size);
        return by_size.count > 2 * std::ssize(piece.kept) + 2;
    };
    std::vector<EdgeId> coarse;
    for (const auto& [edge, pieces] : seeds.pieces)
        if (std::ranges::any_of(task.model.uses_of_edge(edge), is_given) &&
            std::ranges::none_of(task.model.uses_of_edge(edge), has_quads) &&
            std::ranges::any_of(pieces, [&](const SeedPiece& piece) { return is_coarse(edge, piece); }))
            coarse.push_back(edge);
    if (!coarse.empty())
        seeds.notes.push_back(formatted("the nodes of given triangles are kept on {}, so the size does not "
                                        "apply there; load with keep_mesh = false to mesh by size",
                                        entities_of(task.model, coarse)));
}

} // namespace

Seeds ask_edges(const SeedTask& task, std::span<const LinkingSurface> links,
                const std::map<EdgeId, double>& lengths, const std::set<FaceId>& kept)
{
    const Model& model = task.model;
    Seeds seeds;
    for (const LinkingSurface& link : links) add_rim(model, link, seeds);
    for (const FaceId face : task.faces) {
        if (keeps(task, face, kept))
            seeds.kept.insert(face);
        else
            note_mixed(task, face, seeds);
    }
    for (const auto& [edge, faces] : task.users)
        seeds.pieces.try_emplace(edge, std::vector<SeedPiece>{{0, 1, edge_length(model, edge), 1}});
    for (auto& [edge, pieces] : seeds.pieces) {
        const auto swept_to = lengths.find(edge);
        const double longer = swept_to == lengths.end() ? 1 : swept_to->second / edge_length(model, edge);
        for (SeedPiece& piece : pieces) {
            if (piece.fixed) continue;
            ask_size(task, edge, piece);
            piece.count = std::max(piece.count, static_cast<int>(std::lround(longer * piece.count)));
            piece.sides = std::max(1.0, longer) * piece.sides;
        }
    }
    for (const FaceId face : seeds.kept) {
        for (const EdgeId edge : edges_of(model, face)) keep_nodes(model, face, edge, seeds);
    }
    for (const auto& [edge, faces] : task.users) {
        if (model[edge].keeps_nodes && !task.rim.contains(edge))
            keep_nodes(model, *faces.begin(), edge, seeds);
    }
    note_coarse_edges(task, seeds);
    return seeds;
}

} // namespace lacuna::surface
