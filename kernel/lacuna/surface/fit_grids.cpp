// SPDX-License-Identifier: MIT
#include <lacuna/surface/detail/fit_grids.h>

#include <lacuna/geometry/newell.h>
#include <lacuna/quads/shared/pattern_counts.h>
#include <lacuna/surface/detail/plane_loops.h>
#include <lacuna/surface/shared/edge_nodes.h>

#include <algorithm>
#include <vector>

namespace lacuna::surface {

using namespace topology;

namespace {

/// The faces of the source, sorted by number of loops, most loops first.
std::vector<FaceId> most_loops_first(const SeedTask& task)
{
    std::vector<FaceId> faces = task.faces;
    std::ranges::stable_sort(
        faces, [&](FaceId a, FaceId b) { return task.model[a].loops.size() > task.model[b].loops.size(); });
    return faces;
}

/// Whether the number of sides of an edge is settled: it is already that of a grid, or a mapped or submapped
/// face uses the edge.
bool is_settled(const SeedTask& task, const FaceGrids& grids, const std::set<EdgeId>& settled, EdgeId edge)
{
    const std::set<FaceId>& users = task.users.at(edge);
    return settled.contains(edge) ||
           std::ranges::any_of(users, [&](FaceId user) { return grids.opposite.contains(user); });
}

/// Assign numbers of sides to one face and mark its edges as settled.
void fit_grid(const SeedTask& task, const FaceGrids& grids, FaceId face, std::set<EdgeId>& settled,
              Seeds& seeds, const RunContext& context)
{
    const bool patterns = task.style == QuadStyle::automatic ||
                          (task.style == QuadStyle::rows && task.model[face].loops.size() > 1);
    if (!patterns || (task.sizing.gap > 0 && !task.sizing.counts_across) || !is_free(grids, seeds, face))
        return;
    const Vec3 normal = face_area_vector(task.model, face).stableNormalized();
    if (!faces_one_way(task.model, face, normal)) return;
    const geometry::Plane plane = geometry::plane_across(face_centroid(task.model, face), normal);
    std::vector<quads::BoundarySegment> segments;
    std::vector<SeedPiece*> pieces;
    std::vector<int> segment;
    quads::PlanarRegion region;
    for (const Loop& loop : border_loops(task.model, face)) {
        std::vector<Index>& cycle = region.loops.emplace_back();
        for (const EdgeUse& use : loop.uses) {
            std::vector<SeedPiece>& own = seeds.pieces.at(use.edge);
            const std::vector<Vec3> points = edge_points(task.model, use.edge, seeds.fractions(use.edge));
            std::vector<int> of_side;
            for (SeedPiece& piece : own) {
                of_side.insert(of_side.end(), static_cast<std::size_t>(piece.count),
                               static_cast<int>(segments.size()));
                segments.push_back(
                    {piece.sides, piece.least, piece.fixed || is_settled(task, grids, settled, use.edge)});
                pieces.push_back(&piece);
            }
            const std::size_t sides = of_side.size();
            for (std::size_t i = 0; i < sides; ++i) {
                cycle.push_back(static_cast<Index>(region.points.size()));
                region.points.push_back(geometry::to_plane(plane, points[use.reversed ? sides - i : i]));
                segment.push_back(of_side[use.reversed ? sides - 1 - i : i]);
            }
        }
    }
    sort_outer_first(region.points, region.loops);
    const auto counts = quads::pattern_counts(region, segment, segments, context);
    if (!counts) return;
    for (std::size_t p = 0; p < pieces.size(); ++p) pieces[p]->count = (*counts)[p];
    for (const EdgeId edge : edges_of(task.model, face)) settled.insert(edge);
}

} // namespace

std::set<EdgeId> fit_grids(const SeedTask& task, const FaceGrids& grids, std::set<EdgeId> settled,
                           Seeds& seeds, const RunContext& context)
{
    for (const FaceId face : most_loops_first(task)) fit_grid(task, grids, face, settled, seeds, context);
    return settled;
}

} // namespace lacuna::surface
