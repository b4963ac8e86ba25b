// SPDX-License-Identifier: MIT
#include <lacuna/quads/shared/pave.h>

#include <lacuna/core/error.h>
#include <lacuna/geometry/shared/predicates.h>
#include <lacuna/geometry/shared/triangulate.h>
#include <lacuna/quads/detail/face_pattern.h>
#include <lacuna/quads/detail/mesh_symmetry.h>
#include <lacuna/quads/detail/pave_choice.h>
#include <lacuna/quads/detail/pave_rows.h>
#include <lacuna/quads/detail/pave_size.h>
#include <lacuna/quads/detail/square_rows.h>
#include <lacuna/quads/shared/pattern_counts.h>

namespace lacuna::quads {
namespace {

using namespace paving;

/// Place rows of the exact height, whose nodes do not move afterwards. Pave the rest as a separate region.
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
                missing += formatted(", no room for row {} along loop {}", r + 1, l + 1);
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
    mesh.how += formatted(" inside {} {} height{}", laid, laid == 1 ? "row of its own" : "rows of their own",
                          missing);
    drop_loose_points(mesh, region.points.size());
    return {std::move(mesh), std::move(report)};
}

} // namespace

void check(const PlanarRegion& region)
{
    std::size_t sides = 0;
    if (region.loops.empty()) throw InvalidInput("surface.pave_loops", "the region has no outline");
    std::vector<bool> seen(region.points.size(), false);
    for (std::size_t l = 0; l < region.loops.size(); ++l) {
        const auto& loop = region.loops[l];
        const NamedEntity name{"loop", static_cast<long long>(l) + 1};
        if (loop.size() < 3) {
            throw InvalidInput(
                Message("surface.pave_loops", "{} of the region has {} nodes", name, found(loop.size()))
                    .remedy("give it {} or more", needed(3)));
        }
        sides += loop.size();
        for (const Index p : loop) {
            if (p < 0 || index(p) >= seen.size())
                throw InvalidInput("surface.pave_loops",
                                   "{} of the region names {}, but the region has {} nodes", name,
                                   NamedEntity{"node", static_cast<long long>(p) + 1}, needed(seen.size()));
            if (seen[index(p)])
                throw InvalidInput("surface.pave_loops",
                                   "{} of the region passes {} twice; loops must not touch themselves", name,
                                   NamedEntity{"node", static_cast<long long>(p) + 1});
            seen[index(p)] = true;
        }
    }
    if (const auto crossing = geometry::find_crossing(region.points, region.loops)) {
        const auto node = index(region.loops[crossing->loop_a][crossing->segment_a]);
        const auto loop = [](std::size_t l) { return NamedEntity{"loop", static_cast<long long>(l) + 1}; };
        throw InvalidInput(Message("surface.pave_loops", "{} and {} of the region cross or touch near {}",
                                   loop(crossing->loop_a), loop(crossing->loop_b),
                                   position_text(region.points[node]))
                               .remedy("separate them there, or use a smaller 'size'"));
    }
    const std::vector<Vec2> outline = region_within(region.points, {region.loops[0]}).region.points;
    for (std::size_t l = 0; l < region.loops.size(); ++l) {
        const auto& loop = region.loops[l];
        const bool outer = l == 0;
        if ((twice_area(region.points, loop) > 0) == outer &&
            (outer || geometry::lies_inside(outline, region.points[index(loop.front())])))
            continue;
        if (outer)
            throw InvalidInput("surface.pave_loops", "the region's outer loop runs clockwise; the first loop "
                                                     "must surround the others and run counter-clockwise");
        throw InvalidInput("surface.pave_loops",
                           "{} of the region is not a hole in {}: holes must lie inside it and run clockwise",
                           NamedEntity{"loop", static_cast<long long>(l) + 1}, NamedEntity{"loop", 1});
    }
    if (sides % 2 != 0) {
        throw InvalidInput(
            Message("surface.pave_parity",
                    "a region with an odd number of boundary sides ({}) cannot be filled with quads alone",
                    found(sides))
                .remedy("give one of its edges one side more"));
    }
}

Paved pave(const PlanarRegion& region, const PaveOptions& options, const RunContext& context)
{
    check(region);
    if (options.exact_rows < 0)
        throw InvalidInput("surface.pave_rows", "'exact_rows' must be 0 or more, not {}",
                           found(options.exact_rows));
    if (options.exact_rows > 0 && !region.row_height)
        throw InvalidInput(Message("surface.pave_rows", "exact_rows = {}, but the region has no 'row_height'",
                                   found(options.exact_rows))
                               .remedy("give a 'row_height', or exact_rows = 0"));
    if (options.exact_rows > 0) return pave_inside_rows(region, options, context);
    if (options.across > 0) {
        if (auto ring = fill_narrow_ring(region, options.across, context)) {
            PaveReport report{ring->how};
            return {std::move(*ring), std::move(report)};
        }
    }
    AttemptChooser chooser(region, options, context);
    chooser.run();
    Attempt best = chooser.take_best();
    if (best.worst <= 0) {
        throw NotSweepable(
            Message("surface.pave",
                    "no valid quads were found for a region of {} boundary nodes: they fold near {}",
                    region.points.size(), position_text(best.where))
                .remedy("use a smaller 'size'"));
    }
    // Between sides that nearly touch, and in spikes, all quads are flat.
    if (best.worst <= chooser.flat()) {
        log_line(context, formatted("the flattest quad, near {}, has a scaled Jacobian of {:.6f}: the "
                                    "boundary's sides there are long compared with the gap between them",
                                    position_text(best.where), best.worst));
    }
    if (static_cast<double>(best.mesh.quads.size()) <= kManyQuads) {
        const std::vector<Symmetry> symmetries = mesh_symmetries(best.mesh, region);
        const bool is_symmetric = symmetrise(best.mesh, region.points.size(), symmetries) > 1;
        square_rows(best.mesh, region, is_symmetric ? symmetries : std::vector<Symmetry>());
        if (!is_symmetric) symmetrise(best.mesh, region.points.size(), symmetries);
    }
    best.mesh.how = best.report.used;
    return {std::move(best.mesh), std::move(best.report)};
}

} // namespace lacuna::quads
