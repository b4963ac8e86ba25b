// SPDX-License-Identifier: MIT
#include <lacuna/surface/detail/even_sides.h>

#include <lacuna/core/error.h>
#include <lacuna/quads/shared/pattern_counts.h>
#include <lacuna/surface/detail/sides_asked.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace lacuna::surface {

using namespace topology;

namespace {

bool odd(const Model& model, const Seeds& seeds, FaceId face)
{
    return sides_of(model, seeds, face) % 2 != 0;
}

/// The edge on which a face with an odd number of sides starts, and the edges that each get one more side.
struct WayOut {
    EdgeId edge;
    FaceId into;
    std::vector<EdgeId> raised;
};

/// The edges opposite to an edge of a mapped face.
std::vector<EdgeId> opposite_to(const FaceGrids& grids, FaceId face, EdgeId edge)
{
    for (const SidePair& sides : grids.opposite.at(face)) {
        for (std::size_t k = 0; k < 2; ++k) {
            if (std::ranges::find(sides[k], edge) != sides[k].end()) return sides[1 - k];
        }
    }
    return {};
}

/// Add a side to the edge with the longest sides that belongs to no other face and that the face's symmetries
/// map onto itself. @return false if there is none
bool raise_alike(const SeedTask& task, const AlikeEdges& alike, FaceId face, Seeds& seeds)
{
    const auto sets = alike.find(face);
    if (sets == alike.end()) return false;
    std::optional<EdgeId> best;
    double longest = 0;
    for (const std::vector<EdgeId>& set : sets->second) {
        const EdgeId edge = set.front();
        if (set.size() > 1 || task.users.at(edge).size() > 1 || !task.rim.contains(edge)) continue;
        const SeedPiece& piece = seeds.pieces.at(edge).front();
        if (piece.length <= longest * piece.count) continue;
        longest = piece.length / piece.count;
        best = edge;
    }
    return best && raise(seeds, {*best}, 1);
}

/// Quads cannot fill a rim with an odd number of sides. If all are given, divide the longest side on the rim
/// without kept quads, and add a note.
std::set<FaceId> divide_given_sides(const SeedTask& task, const FaceGrids& grids, Seeds& seeds)
{
    std::set<FaceId> triangles;
    for (const FaceId face : task.faces) {
        if (!is_free(grids, seeds, face) || !odd(task.model, seeds, face)) continue;
        SeedPiece* longest = nullptr;
        EdgeId at;
        for (const EdgeId edge : task.rim) {
            const std::set<FaceId>& users = task.users.at(edge);
            if (!users.contains(face) || users.size() > 1) continue;
            for (SeedPiece& piece : seeds.pieces[edge]) {
                if (piece.asked || (longest != nullptr && piece.length <= longest->length)) continue;
                longest = &piece;
                at = edge;
            }
        }
        if (longest == nullptr) continue;
        const std::string found = formatted("the rim of {} came with {} sides, an odd number",
                                            entity_of(task.model, face), sides_of(task.model, seeds, face));
        if (task.wedges) {
            seeds.notes.push_back(found + ": one cell of the face is a triangle");
            triangles.insert(face);
            continue;
        }
        seeds.notes.push_back(formatted("{}, which quads cannot fill: a side on {} and the wall column above "
                                        "it are split in two; wedges = true keeps them",
                                        found, entity_of(task.model, at)));
        longest->kept.push_back((longest->from + longest->to) / 2);
        longest->count = 2;
    }
    return triangles;
}

void check_even(const SeedTask& task, const FaceGrids& grids, const std::set<FaceId>& triangles,
                const Seeds& seeds)
{
    for (const FaceId face : task.faces) {
        if (!is_free(grids, seeds, face) || !odd(task.model, seeds, face) || triangles.contains(face))
            continue;
        std::vector<NamedEntity> asked;
        for (const EdgeId edge : edges_of(task.model, face)) {
            const auto is_asked = [](const SeedPiece& piece) { return piece.asked; };
            if (std::ranges::any_of(seeds.pieces.at(edge), is_asked))
                asked.push_back(entity_of(task.model, edge));
        }
        if (asked.empty())
            throw NotSweepable(Message("surface.odd_loop",
                                       "the loops of {} have an odd total of sides, and no edge of the face "
                                       "can take another side",
                                       entity_of(task.model, face))
                                   .remedy("give fewer edges a fixed number of sides"));
        throw NotSweepable(Message("surface.sides_asked",
                                   "intervals: the loops of {} have an odd total of {} sides, which quads "
                                   "cannot fill, and no edge can take another side",
                                   entity_of(task.model, face), found(sides_of(task.model, seeds, face)))
                               .remedy("change the number on {} by one", asked));
    }
}

} // namespace

void make_halvable(const SeedTask& task, const FaceGrids& grids, const std::set<EdgeId>& settled,
                   Seeds& seeds)
{
    const auto is_many = [&](FaceId face) {
        return is_free(grids, seeds, face) && quads_asked(task.model, seeds, face) > quads::kManyQuads;
    };
    for (const auto& [edge, faces] : task.users) {
        if (settled.contains(edge) || !std::ranges::all_of(faces, is_many)) continue;
        for (SeedPiece& piece : seeds.pieces.at(edge)) {
            if (!piece.fixed && piece.rows() == 0 && piece.sides >= quads::kFewestEven)
                piece.count = quads::even_sides(piece.sides, piece.least);
        }
    }
}

void make_even(const SeedTask& task, const FaceGrids& grids, const AlikeEdges& alike, Seeds& seeds)
{
    std::vector<WayOut> exits;
    std::set<std::pair<EdgeId, FaceId>> known;
    const auto push = [&](EdgeId edge, FaceId from, std::vector<EdgeId> raised) {
        raised.push_back(edge);
        for (const FaceId into : task.users.at(edge)) {
            if (into == from || is_fixed(seeds, edge) || !known.insert({edge, into}).second) continue;
            exits.push_back({edge, into, raised});
        }
    };
    std::vector<EdgeId> rim(task.rim.begin(), task.rim.end());
    std::ranges::stable_sort(
        rim, [&](EdgeId a, EdgeId b) { return edge_length(task.model, a) > edge_length(task.model, b); });
    for (const EdgeId edge : rim) push(edge, {}, {});
    std::map<FaceId, std::vector<EdgeId>> way_out;
    std::vector<FaceId> order;
    const auto settle = [&](FaceId face, const std::vector<EdgeId>& raised) {
        if (!way_out.try_emplace(face, raised).second) return;
        order.push_back(face);
        for (const EdgeId edge : edges_of(task.model, face)) push(edge, face, {});
    };
    std::size_t next = 0;
    const auto spread = [&] {
        for (; next < exits.size(); ++next) {
            const WayOut way = exits[next];
            if (seeds.kept.contains(way.into)) continue;
            if (is_free(grids, seeds, way.into)) {
                settle(way.into, way.raised);
                continue;
            }
            for (const EdgeId edge : opposite_to(grids, way.into, way.edge)) push(edge, way.into, way.raised);
        }
    };
    spread();
    // Free faces with an odd count that cannot reach the rim pass their odd sides to one of them, where two
    // cancel.
    for (const FaceId face : task.faces) {
        if (!is_free(grids, seeds, face)) continue;
        settle(face, {});
        spread();
    }
    for (auto face = order.rbegin(); face != order.rend(); ++face) {
        if (!odd(task.model, seeds, *face) || raise_alike(task, alike, *face, seeds)) continue;
        for (const EdgeId edge : way_out.at(*face)) raise(seeds, {edge}, 1);
    }
}

void finish_even(const SeedTask& task, const FaceGrids& grids, Seeds& seeds)
{
    check_even(task, grids, divide_given_sides(task, grids, seeds), seeds);
}

} // namespace lacuna::surface
