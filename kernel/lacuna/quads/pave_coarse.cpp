// SPDX-License-Identifier: MIT
#include <lacuna/quads/detail/pave_coarse.h>

#include <lacuna/core/error.h>
#include <lacuna/core/shared/attempt.h>
#include <lacuna/core/shared/criteria.h>
#include <lacuna/quads/detail/coarse_region.h>
#include <lacuna/quads/detail/pave_attempt.h>
#include <lacuna/quads/detail/pave_choice.h>
#include <lacuna/quads/detail/pave_size.h>
#include <lacuna/quads/detail/row_heights.h>
#include <lacuna/quads/detail/smooth_plane.h>
#include <lacuna/quads/shared/measure_plane.h>
#include <lacuna/quads/shared/odd_region.h>

namespace lacuna::quads::paving {
namespace {

/// A coarse region with this many quads is coarsened again. This limits the time for paving the coarsest
/// region.
constexpr double kManyStill = 8000;

/// The sides to divide so that every run from corner to corner, and every loop without corners, has an even
/// number of sides. The longest side of each odd run is taken. Empty if there are too many odd runs.
std::optional<std::vector<RegionSide>> sides_to_divide(const PlanarRegion& region)
{
    std::vector<RegionSide> sides;
    for (std::size_t l = 0; l < region.loops.size(); ++l) {
        const std::vector<Index>& loop = region.loops[l];
        const auto length = [&](std::size_t i) {
            return (point_of(region.points, loop, i + 1) - point_of(region.points, loop, i)).norm();
        };
        const std::vector<std::size_t> corners = runs_of(region, loop);
        for (std::size_t c = 0; c + 1 < corners.size(); ++c) {
            const std::size_t from = corners[c], to = corners[c + 1];
            if ((to - from) % 2 == 0) continue;
            std::size_t longest = from;
            for (std::size_t i = from; i < to; ++i)
                if (length(i) > length(longest)) longest = i;
            sides.push_back({l, longest % loop.size()});
            if (sides.size() > kMostOddRuns) return std::nullopt;
        }
    }
    return sides;
}

/// Pave a coarse region with one set of weights.
/// @throw NotSweepable "surface.pave"  some quad is poor, as between sides that nearly touch. The caller then
///         paves the region at full size, where sides are shorter and quads may be better.
PlanarQuads pave_once(const PlanarRegion& region, PaveReport& report, const RunContext& context)
{
    check(region);
    const AttemptSetting setting{region, sizes_with_boundary(region).usual, flat_below(region)};
    Attempt attempt = begin_attempt(setting, RowStyle::by_shape, {}, context);
    finish_attempt(attempt, setting, true, context);
    if (attempt.worst <= kPoorQuad || !find_fault(attempt.mesh, region).empty())
        throw NotSweepable("surface.pave", "quads are poor near {}", position_text(attempt.where));
    report = std::move(attempt.report);
    return std::move(attempt.mesh);
}

/// Fill a coarse region with quads and few triangles. If it has many quads, a still coarser region is filled
/// and its cells are cut in four.
/// @throw NotSweepable  some quad is poor, or rows cannot be closed
PlanarQuads fill_coarse(const PlanarRegion& region, PaveReport& report, const RunContext& context)
{
    const auto sides = quads_within(region) < kManyStill ? std::nullopt : sides_to_divide(region);
    if (!sides) {
        const auto once = [&](const PlanarRegion& even, const RunContext& its_context) {
            return pave_once(even, report, its_context);
        };
        std::vector<RegionSide> longest = sides_by_length(region);
        longest.resize(longest.size() % 2);
        return fill_divided_region(region, longest, once, context);
    }
    const auto in_four = [&](const PlanarRegion& divided, const RunContext& its_context) {
        std::optional<Paved> made = pave_in_four(divided, sizes_with_boundary(divided).ring, its_context);
        if (!made) throw NotSweepable("surface.pave", "internal error: the coarser region has no quads");
        report = std::move(made->report);
        return std::move(made->mesh);
    };
    return fill_divided_region(region, *sides, in_four, context);
}

/// The cells of a coarse region, cut in four and not smoothed. Empty if there is no coarse region, or if its
/// whole sides cannot be joined by rows.
std::optional<Paved> fill_and_cut(const PlanarRegion& region, const RunContext& context)
{
    std::optional<CoarseRegion> coarse = coarse_region(region);
    if (!coarse) return std::nullopt;
    Paved made;
    const PlanarQuads filled = fill_coarse(coarse->region, made.report, context);
    const std::optional<std::vector<char>> whole = choose_whole_sides(*coarse, filled);
    if (!whole) return std::nullopt;
    made.mesh = cut_in_four(region, *coarse, filled, *whole);
    return made;
}

} // namespace

std::optional<Paved> pave_in_four(const PlanarRegion& region, const SizeField& size,
                                  const RunContext& context)
{
    auto found = unless_refused([&] { return fill_and_cut(region, context); });
    if (!found || !*found) return std::nullopt; // for instance, the loops touch if nodes are left out
    Paved& made = **found;
    made.report.used += ", each quad cut in four";
    smooth_plane(made.mesh.points, made.mesh.quads, region.points.size(),
                 {.size = size, .good_enough = kGoodQuad}, context);
    correct_row_heights(made.mesh, region, size);
    return std::move(*found);
}

} // namespace lacuna::quads::paving
