// SPDX-License-Identifier: MIT
#include <lacuna/surface/detail/even_sides.h>

#include <lacuna/core/error.h>
#include <lacuna/quads/shared/pattern_counts.h>

#include <algorithm>
#include <set>
#include <string>
#include <vector>

namespace lacuna::surface {

using namespace topology;

namespace {

bool odd(const Model& model, const Seeds& seeds, FaceId face)
{
    return sides_of(model, seeds, face) % 2 != 0;
}

/// Quads cannot fill a face with an odd number of sides in total. For each such face, divide the longest
/// piece of its rim that only this face uses and whose number of sides the user did not request. With wedges,
/// nothing is divided, and one cell of the face becomes a triangle. A note reports either change.
/// @return  the faces that get a triangle.
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
        const std::string found = formatted("the rim of {} has {} sides, an odd number",
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
                                   .remedy("give another 'size', cut the volume otherwise, or load a mesh it "
                                           "keeps with keep_mesh = false"));
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
            if (!piece.fixed && piece.rows() == 0) piece.count = quads::even_sides(piece.sides, piece.least);
        }
    }
}

void finish_even(const SeedTask& task, const FaceGrids& grids, Seeds& seeds)
{
    check_even(task, grids, divide_given_sides(task, grids, seeds), seeds);
}

} // namespace lacuna::surface
