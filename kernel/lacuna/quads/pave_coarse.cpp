// SPDX-License-Identifier: MIT
#include <lacuna/quads/detail/pave_coarse.h>

#include <lacuna/core/error.h>
#include <lacuna/mesh/quad_mesh.h>
#include <lacuna/quads/detail/corner_sine.h>
#include <lacuna/quads/detail/row_heights.h>
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
    for (std::size_t i = first, n = loop.size(); i < n; i += 2) {
        const auto at = [&](std::size_t k) { return region.points[index(loop[k % n])]; };
        const double angle = turn_between(at(i + 1) - at(i), at(i + n - 1) - at(i));
        if (std::abs(angle - std::numbers::pi) > kTurnsLeftOut) return false;
    }
    return true;
}

} // namespace

std::optional<CoarseRegion> coarse_region(const PlanarRegion& region)
{
    CoarseRegion made;
    for (const auto& loop : region.loops) {
        if (loop.size() % 2 != 0) return std::nullopt;
        const bool later = can_leave_out(region, loop, 0);
        if (!later && !can_leave_out(region, loop, 1)) return std::nullopt;
        // The first node stays where either may, for it is often one of a symmetry.
        const std::size_t first = can_leave_out(region, loop, 1) ? 0 : 1;
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

std::optional<Paved> pave_in_four(const PlanarRegion& region, const PaveOptions& options,
                                  const std::function<double(const Vec2&)>& size, const RunContext& context)
{
    const std::optional<CoarseRegion> coarse = coarse_region(region);
    if (!coarse) return std::nullopt;
    // Many quads of a pattern are stretched where few irregular nodes cost little.
    PaveOptions inside = options;
    inside.grids = false;
    Paved made;
    const auto mesher = [&](const PlanarRegion& own, const RunContext& its_context) {
        auto [mesh, report] = pave(own, inside, its_context);
        made.report = std::move(report);
        return std::move(mesh);
    };
    try {
        made.mesh = cut_in_four(region, *coarse, fill_odd_region(coarse->region, mesher, context));
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
