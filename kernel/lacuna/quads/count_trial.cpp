// SPDX-License-Identifier: MIT
#include <lacuna/quads/detail/count_trial.h>

#include <lacuna/core/shared/criteria.h>
#include <lacuna/quads/detail/face_pattern.h>
#include <lacuna/quads/detail/pave_choice.h>
#include <lacuna/quads/detail/pave_size.h>
#include <lacuna/quads/shared/measure_plane.h>

#include <algorithm>

namespace lacuna::quads {
namespace {

/// The region after dividing every segment into its number of sides.
PlanarRegion divided(const PlanarRegion& region, std::span<const int> segment, std::span<const int> counts)
{
    PlanarRegion made;
    made.size = region.size;
    made.row_height = region.row_height;
    for (const std::vector<Index>& loop : region.loops) {
        const std::size_t n = loop.size();
        const auto own = [&](std::size_t i) { return segment[index(loop[i % n])]; };
        // Start at the start of a segment; if the loop is a single segment, start at its first node.
        std::size_t start = 0;
        while (start < n && own(start) == own(start + n - 1)) ++start;
        if (start == n) start = 0;
        made.loops.emplace_back();
        const std::size_t first = made.points.size();
        for (std::size_t from = start, to = start; from < start + n; from = to) {
            while (to < start + n && own(to) == own(from)) ++to;
            add_divided(region.points, loop, from, to, counts[index(own(from))], made.points);
        }
        while (made.loops.back().size() + first < made.points.size())
            made.loops.back().push_back(static_cast<Index>(first + made.loops.back().size()));
    }
    return made;
}

} // namespace

std::optional<double> score_of_counts(const PlanarRegion& region, std::span<const int> segment,
                                      std::span<const int> counts, double asked)
{
    // Penalty for the number of quads: kWorth at a deviation of a quarter from the number asked, and
    // quadratic in the deviation. Mean scaled Jacobians usually differ by less than kWorth.
    constexpr double kWorth = 0.2;
    PlanarRegion made = divided(region, segment, counts);
    const std::vector<PlanarQuads> meshes = fill_patterns(made);
    made.size = paving::sizes_with_boundary(made).ring;
    std::optional<double> best;
    for (const PlanarQuads& mesh : meshes) {
        const double off = (static_cast<double>(mesh.quads.size()) / asked - 1) / kQuadsOff;
        best = std::max(best.value_or(-1), paving::score_of(measure_plane(mesh, made)) - kWorth * off * off);
    }
    return best;
}

} // namespace lacuna::quads
