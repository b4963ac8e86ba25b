// SPDX-License-Identifier: MIT
#include <lacuna/surface/detail/face_grids.h>

#include <lacuna/core/error.h>
#include <lacuna/core/shared/criteria.h>
#include <lacuna/topology/shared/facet_area.h>
#include <lacuna/topology/shared/names_of.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace lacuna::surface {

using namespace topology;

namespace {

/// Minimum mean scaled Jacobian, and minimum share of even sides (`MappedFace::Shape`), of the grid on a
/// mapped face. A face whose grid is worse is paved. The values are low, because hexahedra swept from a grid
/// are better than the grid itself suggests. Example, on the flat rings of a bent pipe: paving has the better
/// quads (mean 0.95 against 0.80), but the grid gives the better hexahedra (mean 0.94 against 0.88, worst
/// 0.67 against 0.58). Strips whose middle is sheared have a worst quad of 0.36 as a grid, of 0.8 if paved.
/// Heuristic.
constexpr double kFairMean = 0.7, kFairEven = 0.6;

/// Whether the size requires similar numbers of quads on opposite sides of the face. Otherwise a grid would
/// force the larger number on both sides.
bool counts_alike(const Seeds& seeds, const std::vector<SidePair>& pairs)
{
    return std::ranges::all_of(pairs, [&](const SidePair& sides) {
        const int a = total(seeds, sides[0]), b = total(seeds, sides[1]);
        return std::max(a, b) <= kUnlike * std::min(a, b);
    });
}

/// Whether a four-sided face is mapped. One of these conditions is enough:
/// - the style is not `automatic`, or a number of quads across narrow places is requested;
/// - the grid has at least the quality `kFairMean`, `kFairEven`;
/// - some facet is inclined by more than 60° to the face's mean normal, so that flattening for the paver may
///   fail, or makes good quads poor.
bool is_fairly_mapped(const SeedTask& task, FaceId face, const MappedFace& mapped)
{
    if (task.style != QuadStyle::automatic || task.sizing.gap > 0) return true;
    const MappedFace::Shape shape = mapped.shape(task.size);
    return (shape.mean_scaled_jacobian >= kFairMean && shape.even_share >= kFairEven) ||
           !faces_one_way(task.model, face, face_area_vector(task.model, face).stableNormalized());
}

void choose(const SeedTask& task, FaceId face, FaceGrids& grids, Seeds& seeds)
{
    if (task.style == QuadStyle::free || task.style == QuadStyle::rows || seeds.kept.contains(face)) return;
    if (is_tube(task.model, face)) {
        SidePair loops;
        for (const std::size_t l : {0, 1})
            for (const EdgeUse& use : task.model[face].loops[l].uses) loops[l].push_back(use.edge);
        const std::vector<SidePair> ends{loops};
        if (!counts_alike(seeds, ends)) return;
        grids.opposite[face] = ends;
        seeds.tubes.insert(face);
        return;
    }
    const auto corners = four_corners(task.model, face);
    // A submapped face cannot be given a number of quads across its narrow places, because this number
    // follows from several sides.
    if (!corners && task.sizing.gap > 0 && !task.sizing.counts_across && task.style == QuadStyle::automatic)
        return;
    const std::vector<SidePair> opposite = corners ? side_pairs(task.model, face, *corners)
                                                   : grid_sides(task.model, face);
    if (task.style == QuadStyle::mapped && opposite.empty()) {
        throw NotSweepable(
            Message("surface.not_four_sided",
                    "{} cannot be mapped: it needs one loop with four corners (inner angles below 135°), or "
                    "loops with right angles only",
                    entity_of(task.model, face))
                .remedy("use quads = \"auto\""));
    }
    if (opposite.empty() || (task.style == QuadStyle::automatic &&
                             !(alike(task.model, opposite) && counts_alike(seeds, opposite))))
        return;
    if (!corners) {
        grids.opposite[face] = opposite;
        seeds.submapped.insert(face);
        return;
    }
    MappedFace mapped(task.model, face, *corners);
    if (!is_fairly_mapped(task, face, mapped)) return;
    grids.opposite[face] = opposite;
    seeds.corners[face] = *corners;
    grids.mapped.try_emplace(face, std::move(mapped));
    if (!task.sizing.counts_across) return;
    for (const SidePair& sides : opposite) {
        for (const std::vector<EdgeId>& side : sides)
            raise(seeds, side, task.sizing.gap - total(seeds, side));
    }
}

[[noreturn]] void refuse_counts(const Model& model, const Seeds& seeds, FaceId face,
                                const std::vector<SidePair>& pairs)
{
    const auto& [a, b] = *std::ranges::max_element(pairs, {}, [&](const SidePair& sides) {
        return std::abs(total(seeds, sides[0]) - total(seeds, sides[1]));
    });
    throw NotSweepable(Message("surface.kept_side",
                               "{} cannot be mapped: opposite sides have fixed counts of {} ({}) and {} ({})",
                               entity_of(model, face), found(total(seeds, a)), entities_of(model, a),
                               found(total(seeds, b)), entities_of(model, b))
                           .remedy("use quads = \"auto\", or give both sides the same count"));
}

} // namespace

FaceGrids choose_grids(const SeedTask& task, Seeds& seeds)
{
    FaceGrids grids;
    for (const FaceId face : task.faces) choose(task, face, grids, seeds);
    return grids;
}

bool is_free(const FaceGrids& grids, const Seeds& seeds, FaceId face)
{
    return !grids.opposite.contains(face) && !seeds.kept.contains(face);
}

bool faces_one_way(const Model& model, FaceId face, const Vec3& normal)
{
    const std::vector<Triangle>& facets = model[face].triangles;
    return std::ranges::all_of(facets, [&](const Triangle& t) {
        const Vec3 area = facet_area_vector(model, t);
        return area.dot(normal) >= kPoorQuad * area.norm();
    });
}

void free_unequal(const SeedTask& task, FaceGrids& grids, Seeds& seeds)
{
    std::erase_if(grids.opposite, [&](const auto& grid) {
        const auto& [face, pairs] = grid;
        const bool equal = std::ranges::all_of(
            pairs, [&](const SidePair& sides) { return total(seeds, sides[0]) == total(seeds, sides[1]); });
        if (equal) return false;
        if (task.style == QuadStyle::mapped) refuse_counts(task.model, seeds, face, pairs);
        seeds.corners.erase(face);
        seeds.submapped.erase(face);
        seeds.tubes.erase(face);
        grids.mapped.erase(face);
        return true;
    });
}

} // namespace lacuna::surface
