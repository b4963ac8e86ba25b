// SPDX-License-Identifier: MIT
#include <lacuna/quads/shared/pave.h>

#include <lacuna/core/error.h>
#include <lacuna/geometry/shared/predicates.h>
#include <lacuna/geometry/shared/triangulate.h>
#include <lacuna/quads/detail/mesh_symmetry.h>
#include <lacuna/quads/detail/open_corners.h>
#include <lacuna/quads/detail/pave_choice.h>
#include <lacuna/quads/detail/pave_rows.h>
#include <lacuna/quads/detail/pave_size.h>
#include <lacuna/quads/detail/square_rows.h>
#include <lacuna/quads/shared/pattern_counts.h>

namespace lacuna::quads {
namespace {

using namespace paving;

/// Lay rows of their own height, which stay as they are, and pave what is inside them as a region by itself.
Paved pave_inside_rows(const PlanarRegion& region, const PaveOptions& options, const RunContext& context)
{
    PartialMesh partial{
        region.points, {}, region.points.size(), sizes_with_boundary(region).usual, flat_below(region)};
    std::vector<Cycle> loops = region.loops;
    std::vector<bool> wanted(loops.size(), true);
    int laid = 0;
    std::string missing;
    for (int r = 0; r < options.exact_rows; ++r) {
        const std::vector<bool> had = wanted;
        const int now = lay_rows(partial, loops, wanted, region.row_height, RowKind::exact);
        for (std::size_t l = 0; l < loops.size(); ++l) {
            if (had[l] && !wanted[l])
                missing += ", no room for row " + std::to_string(r + 1) + " along loop " +
                           std::to_string(l + 1);
        }
        if (now == 0) break;
        laid += now;
    }
    const auto [core, own] = region_within(partial.points, loops, region.size);
    PaveOptions inside = options;
    inside.exact_rows = 0;
    auto [filling, report] = pave(core, inside, context);
    PlanarQuads mesh{std::move(partial.points), std::move(partial.quads), filling.how};
    add_filling(mesh, own, filling);
    mesh.how += " inside " + std::to_string(laid) +
                (laid == 1 ? " row of its own height" : " rows of their own height") + missing;
    drop_loose_points(mesh, region.points.size());
    return {std::move(mesh), std::move(report)};
}

} // namespace

void check(const PlanarRegion& region)
{
    std::size_t sides = 0;
    if (region.loops.empty())
        throw InvalidInput("surface.pave_loops", "a region to be filled has no outline");
    std::vector<bool> seen(region.points.size(), false);
    for (std::size_t l = 0; l < region.loops.size(); ++l) {
        const auto& loop = region.loops[l];
        const std::string name = "loop " + std::to_string(l + 1) + " of a region to be filled";
        if (loop.size() < 3) {
            throw InvalidInput("surface.pave_loops",
                               name + " has " + std::to_string(loop.size()) + " nodes; give it 3 or more");
        }
        sides += loop.size();
        for (const Index p : loop) {
            if (p < 0 || index(p) >= seen.size())
                throw InvalidInput("surface.pave_loops", name + " names node " + std::to_string(p + 1) +
                                                             " of " + std::to_string(seen.size()));
            if (seen[index(p)])
                throw InvalidInput("surface.pave_loops", name + " comes to node " + std::to_string(p + 1) +
                                                             " a second time; loops may not touch");
            seen[index(p)] = true;
        }
    }
    if (const auto crossing = geometry::find_crossing(region.points, region.loops)) {
        const auto node = index(region.loops[crossing->loop_a][crossing->segment_a]);
        throw InvalidInput("surface.pave_loops", "loops " + std::to_string(crossing->loop_a + 1) + " and " +
                                                     std::to_string(crossing->loop_b + 1) +
                                                     " of a region to be filled cross or touch near " +
                                                     position_text(region.points[node]));
    }
    const std::vector<Vec2> outline = region_within(region.points, {region.loops[0]}).region.points;
    for (std::size_t l = 0; l < region.loops.size(); ++l) {
        const auto& loop = region.loops[l];
        const bool outer = l == 0;
        if ((twice_area(region.points, loop) > 0) == outer &&
            (outer || geometry::lies_inside(outline, region.points[index(loop.front())])))
            continue;
        throw InvalidInput(
            "surface.pave_loops",
            outer ? "the outer loop of a region to be filled runs clockwise; the first loop goes round the "
                    "others, with the "
                    "region on its left"
                  : "loop " + std::to_string(l + 1) +
                        " of a region to be filled is no hole in loop 1: holes lie inside it and run "
                        "clockwise");
    }
    if (sides % 2 != 0) {
        throw InvalidInput(
            "surface.pave_parity",
            "a region with " + std::to_string(sides) +
                " boundary sides cannot be filled with quads alone; give one of its edges one side more");
    }
}

Paved pave(const PlanarRegion& region, const PaveOptions& options, const RunContext& context)
{
    check(region);
    if (options.exact_rows < 0 || (options.exact_rows > 0 && !region.row_height)) {
        throw InvalidInput("surface.pave_rows", std::to_string(options.exact_rows) +
                                                    " rows of their own height are asked for, of a region " +
                                                    (region.row_height ? "with" : "without") +
                                                    " a row height; give a height and 0 rows or more");
    }
    if (options.exact_rows > 0) return pave_inside_rows(region, options, context);
    AttemptChooser chooser(region, options, context);
    chooser.run();
    Attempt best = chooser.take_best();
    if (best.worst <= 0) {
        throw NotSweepable("surface.pave", "no valid quads were found for a region of " +
                                               std::to_string(region.points.size()) +
                                               " boundary nodes: near " + position_text(best.where) +
                                               " they fold");
    }
    // Between sides that all but touch, or in spikes, there are none but flat ones.
    if (best.worst <= chooser.flat()) {
        log_line(context, "the flattest quad, near " + position_text(best.where) +
                              ", has a scaled Jacobian of " + std::to_string(best.worst) +
                              ": the boundary's sides are long for the gap there");
    }
    if (static_cast<double>(best.mesh.quads.size()) <= kManyQuads) {
        const std::vector<Symmetry> symmetries = mesh_symmetries(best.mesh, region);
        const bool is_symmetric = symmetrise(best.mesh, region.points.size(), symmetries) > 1;
        square_rows(best.mesh, region, is_symmetric ? symmetries : std::vector<Symmetry>());
        if (!is_symmetric) symmetrise(best.mesh, region.points.size(), symmetries);
    }
    best.mesh.how = best.report.used;
    if (best.report.refilled > 0)
        best.mesh.how += ", " + std::to_string(best.report.refilled) + " places by split triangles";
    return {std::move(best.mesh), std::move(best.report)};
}

} // namespace lacuna::quads
