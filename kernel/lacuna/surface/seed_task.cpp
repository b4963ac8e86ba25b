// SPDX-License-Identifier: MIT
#include <lacuna/surface/detail/face_sides.h>
#include <lacuna/surface/detail/seed_task.h>
#include <lacuna/topology/shared/use_places.h>

#include <algorithm>
#include <numeric>

namespace lacuna::surface {

using namespace topology;

SeedTask::SeedTask(const OpenVolume& of, std::span<const LinkingSurface> links, const SizeField& asked,
                   QuadStyle as, const ShapeSizing& by, bool with_wedges)
    : volume(of),
      model(of.model),
      size(asked),
      style(as),
      sizing(by),
      wedges(with_wedges),
      faces(of.faces(Role::source))
{
    for (const FaceId face : faces) {
        for (const EdgeId edge : edges_of(model, face)) users[edge].insert(face);
    }
    for (const LinkingSurface& link : links) {
        for (const RimSegment& segment : link.segments) {
            const EdgeId edge = link.source.uses()[segment.use].edge;
            rim.insert(edge);
            users[edge];
        }
    }
}

std::vector<EdgeId> edges_of(const Model& model, FaceId face)
{
    std::vector<EdgeId> edges;
    for (const EdgeUse& use : uses_of(model[face])) edges.push_back(use.edge);
    return edges;
}

int total(const Seeds& seeds, const std::vector<EdgeId>& edges)
{
    return std::accumulate(edges.begin(), edges.end(), 0,
                           [&](int sum, EdgeId e) { return sum + seeds.count(e); });
}

int sides_of(const Model& model, const Seeds& seeds, FaceId face)
{
    return total(seeds, edges_of(model, face));
}

double sides_asked(const Seeds& seeds, const std::vector<EdgeId>& edges)
{
    double sides = 0;
    for (const EdgeId edge : edges) {
        for (const SeedPiece& piece : seeds.pieces.at(edge)) sides += piece.fixed ? piece.count : piece.sides;
    }
    return sides;
}

double quads_asked(const Model& model, const Seeds& seeds, FaceId face)
{
    const std::vector<EdgeId> edges = edges_of(model, face);
    const double length = length_of(model, edges), sides = sides_asked(seeds, edges);
    return face_area(model, face) * (sides / length) * (sides / length);
}

bool is_fixed(const Seeds& seeds, EdgeId edge)
{
    const std::vector<SeedPiece>& pieces = seeds.pieces.at(edge);
    return std::ranges::all_of(pieces, [](const SeedPiece& piece) { return piece.fixed; });
}

bool raise(Seeds& seeds, const std::vector<EdgeId>& edges, int by)
{
    for (; by > 0; --by) {
        SeedPiece* longest = nullptr;
        for (const EdgeId edge : edges) {
            for (SeedPiece& piece : seeds.pieces[edge]) {
                if (piece.fixed) continue;
                if (longest == nullptr || piece.length / piece.count > longest->length / longest->count)
                    longest = &piece;
            }
        }
        if (longest == nullptr) return false;
        ++longest->count;
    }
    return true;
}

} // namespace lacuna::surface
