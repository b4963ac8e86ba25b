// SPDX-License-Identifier: MIT
#include <lacuna/quads/detail/pave_coarse.h>

#include <lacuna/core/error.h>
#include <lacuna/mesh/quad_mesh.h>
#include <lacuna/quads/detail/corner_sine.h>
#include <lacuna/quads/detail/pave_attempt.h>
#include <lacuna/quads/detail/pave_choice.h>
#include <lacuna/quads/detail/pave_size.h>
#include <lacuna/quads/detail/row_heights.h>
#include <lacuna/quads/measure_plane.h>
#include <lacuna/quads/odd_region.h>
#include <lacuna/quads/smooth_plane.h>

#include <array>
#include <cmath>
#include <numbers>

namespace lacuna::quads::paving {
namespace {

/// Whether the loop is all but straight at every other node, from place `first` on.
bool can_leave_out(const PlanarRegion& region, const std::vector<Index>& loop, std::size_t first)
{
    for (std::size_t i = first; i < loop.size(); i += 2)
        if (stays(region, loop, i)) return false;
    return true;
}

} // namespace

bool stays(const PlanarRegion& region, const std::vector<Index>& loop, std::size_t place)
{
    // 20°, so that round holes keep nine nodes at least. A choice, not a measurement.
    constexpr double kTurnsLeftOut = std::numbers::pi / 9;
    const std::size_t n = loop.size();
    const auto at = [&](std::size_t i) -> const Vec2& { return region.points[index(loop[i % n])]; };
    const double angle = turn_between(at(place + 1) - at(place), at(place + n - 1) - at(place));
    return std::abs(angle - std::numbers::pi) > kTurnsLeftOut;
}

std::optional<CoarseRegion> coarse_region(const PlanarRegion& region)
{
    CoarseRegion made;
    for (const auto& loop : region.loops) {
        if (loop.size() % 2 != 0) return std::nullopt;
        // The first node stays where either may, for it is often one of a symmetry.
        const std::size_t first = can_leave_out(region, loop, 1) ? 0 : 1;
        if (first == 1 && !can_leave_out(region, loop, 0)) return std::nullopt;
        made.region.loops.emplace_back();
        for (std::size_t i = first; i < loop.size(); i += 2) {
            made.region.loops.back().push_back(static_cast<Index>(made.own.size()));
            made.region.points.push_back(region.points[index(loop[i])]);
            made.own.push_back(loop[i]);
            made.next.push_back(loop[(i + 1) % loop.size()]);
        }
    }
    if (region.size) made.region.size = [size = region.size](const Vec2& p) { return 2 * size(p); };
    return made;
}

PlanarQuads cut_in_four(const PlanarRegion& fine, const CoarseRegion& made, const PlanarQuads& coarse)
{
    PlanarQuads result{fine.points, {}, coarse.how};
    result.points.reserve(4 * coarse.points.size());
    result.quads.reserve(4 * coarse.quads.size());
    const std::vector<Index> opposite = mesh::opposite_sides(coarse.quads,
                                                             static_cast<Index>(coarse.points.size()));
    const auto add = [&](const Vec2& p) {
        result.points.push_back(p);
        return static_cast<Index>(result.points.size() - 1);
    };
    // Numbered as cells come to them, so that neighbours have near numbers.
    std::vector<Index> number = made.own, middle(opposite.size(), -1);
    number.resize(coarse.points.size(), -1);
    for (std::size_t q = 0; q < coarse.quads.size(); ++q) {
        const Quad& cell = coarse.quads[q];
        std::array<Index, 4> sides{}, corners{};
        std::size_t n = 0;
        Vec2 sum = Vec2::Zero();
        for (std::size_t k = 0; k < 4; ++k) {
            if (!mesh::is_side(cell, k)) continue;
            const std::size_t side = 4 * q + k;
            const Index a = cell[k], b = cell[(k + 1) % 4], other = opposite[side];
            const Vec2 &from = coarse.points[index(a)], &to = coarse.points[index(b)];
            sum += from;
            if (number[index(a)] < 0) number[index(a)] = add(from);
            if (middle[side] < 0) {
                middle[side] = other < 0 ? made.next[index(a)] : add((from + to) / 2);
                if (other >= 0) middle[index(other)] = middle[side];
            }
            corners[n] = number[index(a)];
            sides[n++] = middle[side];
        }
        const Index centre = add(sum / static_cast<double>(n));
        for (std::size_t k = 0; k < n; ++k)
            result.quads.push_back({corners[k], sides[k], centre, sides[(k + n - 1) % n]});
    }
    return result;
}

namespace {

/// Regions of so many quads are made coarse once more. A choice, not a measurement.
constexpr double kManyStill = 8000;
/// Sides that may be divided for it. Each leaves a triangle, with a few irregular nodes. A choice.
constexpr std::size_t kMostDivided = 8;
/// A worst quad that a coarse mesh is kept with. A choice, not a measurement.
constexpr double kFair = 0.5;

/// The sides to divide for even numbers of them from corner to corner, and round loops without corners: the
/// longest of each. Nothing where they are too many.
std::optional<std::vector<RegionSide>> sides_to_divide(const PlanarRegion& region)
{
    std::vector<RegionSide> sides;
    for (std::size_t l = 0; l < region.loops.size(); ++l) {
        const std::vector<Index>& loop = region.loops[l];
        const std::size_t n = loop.size();
        const auto at = [&](std::size_t i) -> const Vec2& { return region.points[index(loop[i % n])]; };
        std::vector<std::size_t> corners;
        for (std::size_t i = 0; i < n; ++i)
            if (stays(region, loop, i)) corners.push_back(i);
        if (corners.empty()) corners.push_back(0);
        for (std::size_t c = 0; c < corners.size(); ++c) {
            const std::size_t from = corners[c],
                              to = c + 1 < corners.size() ? corners[c + 1] : corners.front() + n;
            if ((to - from) % 2 == 0) continue;
            std::size_t longest = from;
            for (std::size_t i = from; i < to; ++i) {
                if ((at(i + 1) - at(i)).norm() > (at(longest + 1) - at(longest)).norm()) longest = i;
            }
            sides.push_back({l, longest % n});
            if (sides.size() > kMostDivided) return std::nullopt;
        }
    }
    return sides;
}

/// Pave a coarse region in one way, and in all others only where that is poor.
PlanarQuads pave_once(const PlanarRegion& region, const PaveOptions& options, PaveReport& report,
                      const RunContext& context)
{
    check(region);
    const AttemptSetting setting{region, options, size_with_boundary(region), flat_below(region)};
    Attempt attempt = begin_attempt(setting, RowStyle::by_shape, {}, context);
    finish_attempt(attempt, setting, true, context);
    if (attempt.worst > kFair && find_fault(attempt.mesh, region).empty()) {
        report = std::move(attempt.report);
        return std::move(attempt.mesh);
    }
    auto [mesh, other] = pave(region, options, context);
    report = std::move(other);
    return std::move(mesh);
}

double least_without_triangles(const PlanarQuads& mesh)
{
    double least = 1;
    for (const Quad& quad : mesh.quads) {
        if (!mesh::is_triangle(quad)) least = std::min(least, scaled_jacobian(mesh.points, quad));
    }
    return least;
}

/// Quads and few triangles in a coarse region: made of those of a coarser one where they are many still.
PlanarQuads fill_coarse(const PlanarRegion& region, const PaveOptions& options, PaveReport& report,
                        const RunContext& context)
{
    const auto sides = quads_within(region) < kManyStill ? std::nullopt : sides_to_divide(region);
    const auto in_four = [&](const PlanarRegion& divided, const RunContext& its_context) {
        std::optional<Paved> made = pave_in_four(divided, options, size_with_boundary(divided), its_context);
        if (!made) throw NotSweepable("surface.pave", "no quads of a coarser region");
        report = std::move(made->report);
        return std::move(made->mesh);
    };
    if (sides) {
        try {
            PlanarQuads mesh = fill_divided_region(region, *sides, in_four, context);
            if (least_without_triangles(mesh) > kFair) return mesh;
        } catch (const NotSweepable&) {
            // paved as it is
        }
    }
    const auto once = [&](const PlanarRegion& even, const RunContext& its_context) {
        return pave_once(even, options, report, its_context);
    };
    const std::vector<RegionSide> by_length = sides_by_length(region);
    if (by_length.size() % 2 != 0) {
        try {
            PlanarQuads mesh = fill_divided_region(region, std::span(by_length).first(1), once, context);
            if (least_without_triangles(mesh) > kFair) return mesh;
        } catch (const NotSweepable&) {
            // another side may do
        }
    }
    return fill_odd_region(region, once, context);
}

} // namespace

std::optional<Paved> pave_in_four(const PlanarRegion& region, const PaveOptions& options,
                                  const std::function<double(const Vec2&)>& size, const RunContext& context)
{
    const std::optional<CoarseRegion> coarse = coarse_region(region);
    if (!coarse) return std::nullopt;
    // Many quads of a pattern are stretched where few irregular nodes cost little.
    PaveOptions inside = options;
    inside.grids = false;
    Paved made;
    try {
        made.mesh = cut_in_four(region, *coarse, fill_coarse(coarse->region, inside, made.report, context));
    } catch (const InvalidInput&) {
        return std::nullopt; // loops that the nodes left out kept apart
    } catch (const NotSweepable&) {
        return std::nullopt;
    }
    made.report.used += ", each quad cut in four";
    // A few poor quads of so many cost little to improve. A choice, not a measurement.
    constexpr double kFine = 0.8;
    smooth_plane(made.mesh.points, made.mesh.quads, region.points.size(),
                 {.size = size, .good_enough = kFine}, context);
    correct_row_heights(made.mesh, region, size);
    return made;
}

} // namespace lacuna::quads::paving
