// SPDX-License-Identifier: MIT
#include <lacuna/quads/detail/coarse_region.h>

#include <lacuna/core/shared/criteria.h>
#include <lacuna/mesh/quad_mesh.h>
#include <lacuna/quads/detail/region_loops.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace lacuna::quads::paving {
namespace {

void add_point(CoarseRegion& made, const Vec2& point, Index own, Index next)
{
    made.region.loops.back().push_back(static_cast<Index>(made.own.size()));
    made.region.points.push_back(point);
    made.own.push_back(own);
    made.next.push_back(next);
}

/// Add the points of one run of a loop, without its last node.
void add_run(CoarseRegion& made, const PlanarRegion& region, const std::vector<Index>& nodes)
{
    const std::size_t sides = nodes.size() - 1;
    if (sides % 2 == 0) {
        for (std::size_t i = 0; i < sides; i += 2)
            add_point(made, region.points[index(nodes[i])], nodes[i], nodes[i + 1]);
        return;
    }
    const WholeRun& run = made.runs.emplace_back(WholeRun{nodes, static_cast<Index>(made.own.size())});
    for (std::size_t i = 0; i < run.points(); ++i) {
        const double place = static_cast<double>(i * sides) / static_cast<double>(run.points());
        add_point(made, point_along(region.points, nodes, 0, place), -1, -1);
    }
}

std::size_t odd_runs(const std::vector<std::size_t>& corners)
{
    std::size_t count = 0;
    for (std::size_t c = 0; c + 1 < corners.size(); ++c) count += (corners[c + 1] - corners[c]) % 2;
    return count;
}

void add_runs(CoarseRegion& made, const PlanarRegion& region, const std::vector<Index>& loop,
              const std::vector<std::size_t>& corners)
{
    for (std::size_t c = 0; c + 1 < corners.size(); ++c) {
        std::vector<Index> nodes;
        for (std::size_t i = corners[c]; i <= corners[c + 1]; ++i) nodes.push_back(loop[i % loop.size()]);
        add_run(made, region, nodes);
    }
}

/// A row of quads that leads from one boundary side to another.
struct Row {
    Index from = -1, to = -1; ///< the boundary sides at its ends
    std::size_t quads = std::numeric_limits<std::size_t>::max();
};

/// Find the boundary side where the row that starts at another boundary side ends. Calls `visit(a, b)` for
/// each quad that the row crosses, with the two opposite sides that the row passes.
/// @return  -1 if the row ends at a triangle.
template <class Visit>
Index follow_row(const std::vector<Quad>& quads, const std::vector<Index>& opposite, Index side,
                 const Visit& visit)
{
    while (true) {
        if (mesh::is_triangle(quads[index(side / 4)])) return -1;
        const Index across = side / 4 * 4 + (side + 2) % 4;
        visit(side, across);
        if (opposite[index(across)] < 0) return across;
        side = opposite[index(across)];
    }
}

/// A set of rows between whole sides. Exactly one row ends at each whole side.
struct Pairing {
    std::vector<Row> rows;
    std::size_t quads = std::numeric_limits<std::size_t>::max(); ///< number of quads of all rows
};

/// Find the pairing with the fewest quads.
/// @param between  the shortest row between two runs, at first · runs + second
/// @param left     for each run, 1 if its whole side has no row yet, otherwise 0
void pair_up(const std::vector<Row>& between, std::vector<char>& left, Pairing& now, Pairing& best)
{
    const std::size_t runs = left.size();
    std::size_t r = runs; // runs are paired in reverse order
    while (r > 0 && left[r - 1] == 0) --r;
    if (r == 0) {
        if (now.quads < best.quads) best = now;
        return;
    }
    --left[--r];
    for (std::size_t other = 0; other < r; ++other) {
        const Row& row = between[other * runs + r];
        if (left[other] == 0 || row.from < 0) continue;
        --left[other];
        now.rows.push_back(row);
        now.quads += row.quads;
        pair_up(between, left, now, best);
        now.quads -= row.quads;
        now.rows.pop_back();
        ++left[other];
    }
    ++left[r];
}

/// Place the points of a run on nodes of the region.
/// @param whole  position of the point that is followed by the whole side
void settle_run(CoarseRegion& made, const WholeRun& run, std::size_t whole)
{
    std::size_t place = 0;
    for (std::size_t i = 0; i < run.points(); ++i) {
        const bool is_whole = i == whole;
        made.own[index(run.first) + i] = run.nodes[place];
        made.next[index(run.first) + i] = is_whole ? -1 : run.nodes[place + 1];
        place += is_whole ? 1 : 2;
    }
}

} // namespace

bool stays(const PlanarRegion& region, const std::vector<Index>& loop, std::size_t place)
{
    // Where both sides belong to one curve, the node may go, so that round holes keep at least nine nodes.
    return -std::cos(corner_angle(region.points, loop, place)) < kOneCurve;
}

std::vector<std::size_t> runs_of(const PlanarRegion& region, const std::vector<Index>& loop)
{
    std::vector<std::size_t> corners;
    for (std::size_t i = 0; i < loop.size(); ++i)
        if (stays(region, loop, i)) corners.push_back(i);
    if (corners.empty()) corners.push_back(0);
    corners.push_back(corners.front() + loop.size());
    return corners;
}

std::optional<CoarseRegion> coarse_region(const PlanarRegion& region)
{
    CoarseRegion made;
    std::vector<std::vector<std::size_t>> corners;
    std::size_t odd = 0;
    for (const auto& loop : region.loops) odd += odd_runs(corners.emplace_back(runs_of(region, loop)));
    if (odd % 2 != 0 || odd > kMostOddRuns) return std::nullopt;
    for (std::size_t l = 0; l < region.loops.size(); ++l) {
        const std::vector<Index>& loop = region.loops[l];
        made.region.loops.emplace_back();
        if (odd_runs(corners[l]) > 0) {
            add_runs(made, region, loop, corners[l]);
            continue;
        }
        // All runs have even numbers of sides, so the nodes that must stay are all at even or all at odd
        // positions. If no node must stay, the first node stays, because mirror axes often pass through the
        // first node.
        for (std::size_t i = corners[l].front() % 2; i < loop.size(); i += 2)
            add_point(made, region.points[index(loop[i])], loop[i], loop[(i + 1) % loop.size()]);
    }
    if (region.size) made.region.size = [size = region.size](const Vec2& p) { return 2 * size(p); };
    return made;
}

std::optional<std::vector<char>> choose_whole_sides(CoarseRegion& made, const PlanarQuads& coarse)
{
    std::vector<char> whole(4 * coarse.quads.size(), 0);
    const std::size_t runs = made.runs.size();
    if (runs == 0) return whole;
    std::vector<std::size_t> run_of(made.own.size(), runs);
    std::vector<char> left(runs, 1);
    for (std::size_t r = 0; r < runs; ++r) {
        const WholeRun& run = made.runs[r];
        const std::size_t first = index(run.first);
        for (std::size_t p = first; p < first + run.points(); ++p) run_of[p] = r;
    }
    const std::vector<Index> opposite = mesh::opposite_sides(coarse.quads,
                                                             static_cast<Index>(coarse.points.size()));
    // A side of a cell on the boundary has the direction of the loop. It starts at a point of the coarse
    // region.
    const auto point_before = [&](Index side) {
        return index(coarse.quads[index(side / 4)][index(side % 4)]);
    };
    std::vector<Row> between(runs * runs);
    for (Index side = 0; side < static_cast<Index>(opposite.size()); ++side) {
        if (opposite[index(side)] != mesh::kRimSide) continue;
        const std::size_t from = run_of[point_before(side)];
        if (from == runs) continue;
        std::size_t quads = 0;
        const Index end = follow_row(coarse.quads, opposite, side, [&](Index, Index) { ++quads; });
        if (end < 0) continue;
        const std::size_t to = run_of[point_before(end)];
        if (to == runs || to <= from) continue;
        Row& row = between[from * runs + to];
        if (quads < row.quads) row = {side, end, quads};
    }
    Pairing best, now{{}, 0};
    pair_up(between, left, now, best);
    if (best.rows.empty()) return std::nullopt;
    std::vector<std::size_t> place(runs);
    for (const Row& row : best.rows) {
        follow_row(coarse.quads, opposite, row.from,
                   [&](Index a, Index b) { whole[index(a)] = whole[index(b)] = 1; });
        for (const Index side : {row.from, row.to}) {
            const std::size_t r = run_of[point_before(side)];
            place[r] = point_before(side) - index(made.runs[r].first);
        }
    }
    for (std::size_t r = 0; r < runs; ++r) settle_run(made, made.runs[r], place[r]);
    return whole;
}

PlanarQuads cut_in_four(const PlanarRegion& fine, const CoarseRegion& made, const PlanarQuads& coarse,
                        const std::vector<char>& whole)
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
    // New points are numbered in the order of the cells, so that neighbouring points have close numbers.
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
            if (middle[side] < 0 && whole[side] == 0) {
                middle[side] = other < 0 ? made.next[index(a)] : add((from + to) / 2);
                if (other >= 0) middle[index(other)] = middle[side];
            }
            corners[n] = number[index(a)];
            sides[n++] = middle[side];
        }
        if (sides[0] < 0 && sides[1] < 0) {
            result.quads.push_back(corners);
        } else if (sides[0] < 0 || sides[1] < 0) { // cut it in two, along the line between its two cut sides
            const std::size_t k = sides[0] < 0 ? 1 : 0;
            result.quads.push_back({corners[k], sides[k], sides[k + 2], corners[(k + 3) % 4]});
            result.quads.push_back({sides[k], corners[k + 1], corners[k + 2], sides[k + 2]});
        } else {
            const Index centre = add(sum / static_cast<double>(n));
            for (std::size_t k = 0; k < n; ++k)
                result.quads.push_back({corners[k], sides[k], centre, sides[(k + n - 1) % n]});
        }
    }
    return result;
}

} // namespace lacuna::quads::paving
