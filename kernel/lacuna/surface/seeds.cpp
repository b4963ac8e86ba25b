// SPDX-License-Identifier: MIT
#include <lacuna/surface/shared/seeds.h>

#include <lacuna/surface/detail/alike_edges.h>
#include <lacuna/surface/detail/even_sides.h>
#include <lacuna/surface/detail/face_grids.h>
#include <lacuna/surface/detail/fit_grids.h>
#include <lacuna/surface/detail/seed_edges.h>
#include <lacuna/surface/detail/seed_program.h>
#include <lacuna/surface/detail/seed_task.h>
#include <lacuna/surface/detail/sides_asked.h>
#include <lacuna/surface/detail/square_lines.h>

namespace lacuna::surface {

Seeds seed_source(const topology::OpenVolume& volume, std::span<const LinkingSurface> links,
                  const SizeField& size, QuadStyle style, const ShapeSizing& sizing,
                  const std::map<EdgeId, double>& lengths, bool wedges, const EdgeDemands& demands,
                  const RunContext& context)
{
    const SeedTask task(volume, links, size, style, sizing, wedges);
    Seeds seeds = ask_edges(task, links, lengths, demands.kept);
    end_rows(seeds, volume.model, demands.rows);
    set_sides(seeds, volume.model, demands.sides);
    const AlikeEdges alike = ask_alike(seeds, volume.model, task.faces);
    FaceGrids grids = choose_grids(task, seeds);
    std::set<EdgeId> settled = solve_together(task, grids, alike, seeds);
    free_unequal(task, grids, seeds);
    settled = fit_grids(task, grids, std::move(settled), seeds, context);
    make_halvable(task, grids, settled, seeds);
    make_even(task, grids, alike, settled, seeds);
    free_unequal(task, grids, seeds);
    finish_even(task, grids, seeds);
    square_mapped_lines(seeds, volume, links, context);
    return seeds;
}

} // namespace lacuna::surface
