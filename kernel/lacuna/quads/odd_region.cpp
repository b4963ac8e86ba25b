// SPDX-License-Identifier: MIT
#include <lacuna/quads/shared/odd_region.h>

#include <lacuna/core/error.h>
#include <lacuna/core/shared/criteria.h>
#include <lacuna/core/shared/limits.h>
#include <lacuna/core/shared/parallel.h>
#include <lacuna/geometry/shared/pattern_search.h>
#include <lacuna/mesh/quad_mesh.h>
#include <lacuna/mesh/shared/incidence.h>
#include <lacuna/quads/detail/clean_patch.h>
#include <lacuna/quads/shared/measure_plane.h>
#include <lacuna/quads/shared/pattern_counts.h>

#include <algorithm>
#include <numbers>
#include <numeric>
#include <optional>
#include <set>

namespace lacuna::quads {
namespace {

/// Quality of a quad. The quality of a triangle is relative to an equilateral triangle.
double quality_of(std::span<const Vec2> points, const Quad& cell)
{
    if (!mesh::is_triangle(cell)) return scaled_jacobian(points, cell);
    double least = 1;
    for (std::size_t k = 0; k < 3; ++k) {
        const Vec2& p = points[index(cell[k])];
        const Vec2 a = points[index(cell[(k + 1) % 3])] - p, b = points[index(cell[(k + 2) % 3])] - p;
        const double lengths = a.norm() * b.norm();
        const double sine = lengths > 0 ? (a.x() * b.y() - a.y() * b.x()) / lengths : -1;
        least = std::min(least, 2 * std::numbers::inv_sqrt3 * sine);
    }
    return least;
}

/// A mesh of the divided region with a row closed, and the quality of its cells nearby.
struct Closed {
    PlanarQuads mesh;
    std::vector<Index> near; ///< nodes where rows were closed
    double worst = -1, mean = -1;

    [[nodiscard]] bool better_than(const Closed& other) const
    {
        return std::pair(std::min(worst, kPoorQuad), mean) >
               std::pair(std::min(other.worst, kPoorQuad), other.mean);
    }
};

/// Moves nodes one at a time, each so that the worst cell around it improves.
class Smoother {
public:
    Smoother(Closed& closed, std::size_t fixed)
        : closed_(closed),
          points_(closed.mesh.points),
          quads_(closed.mesh.quads),
          at_(mesh::quads_at_nodes(quads_, points_.size()))
    {
        std::set<Index> reached(closed.near.begin(), closed.near.end());
        for (int ring = 0; ring < cleaning::kRings; ++ring) {
            std::set<Index> next = reached;
            for (const Index n : reached) {
                for (const Index q : at_.of(index(n)))
                    next.insert(quads_[index(q)].begin(), quads_[index(q)].end());
            }
            reached = std::move(next);
        }
        std::set<Index> cells;
        for (const Index n : reached) {
            cells.insert(at_.of(index(n)).begin(), at_.of(index(n)).end());
            if (index(n) >= fixed) free_.push_back(n);
        }
        cells_.assign(cells.begin(), cells.end());
    }

    void run()
    {
        // A node is skipped as long as nothing around it moves.
        std::vector<char> awake(points_.size(), 1);
        for (int round = 0; round < kMostRounds; ++round) {
            bool moved = false;
            for (const Index n : free_) {
                if (awake[index(n)] == 0) continue;
                awake[index(n)] = 0;
                if (!move(n)) continue;
                moved = true;
                for (const Index q : at_.of(index(n)))
                    for (const Index other : quads_[index(q)]) awake[index(other)] = 1;
            }
            if (!moved) break;
        }
        closed_.worst = 1;
        closed_.mean = 0;
        for (const Index q : cells_) {
            const double quality = quality_of(points_, quads_[index(q)]);
            closed_.worst = std::min(closed_.worst, quality);
            closed_.mean += quality / static_cast<double>(cells_.size());
        }
    }

private:
    /// Quality of the worst cell at a node; if it does not exceed `floor`, any value from -1 to `floor`.
    [[nodiscard]] double worst_at(Index n, double floor) const
    {
        double worst = 1;
        for (const Index q : at_.of(index(n))) {
            worst = std::min(worst, quality_of(points_, quads_[index(q)]));
            if (worst <= floor) break;
        }
        return worst;
    }

    /// Move a node to the mean of its neighbours if this is better. From there, search for the position with
    /// the best worst cell.
    bool move(Index n)
    {
        Vec2 mean = Vec2::Zero();
        double side = 0, count = 0;
        for (const Index q : at_.of(index(n))) {
            const Quad& cell = quads_[index(q)];
            for (std::size_t k = 0; k < 4; ++k) {
                const Index a = cell[k], b = cell[(k + 1) % 4];
                if (!mesh::is_side(cell, k) || (a != n && b != n)) continue;
                const Vec2& other = points_[index(a == n ? b : a)];
                mean += other;
                side += (other - points_[index(n)]).norm();
                ++count;
            }
        }
        Vec2 best = points_[index(n)];
        const auto value = [&](const Vec2& place, double floor) {
            points_[index(n)] = place;
            return worst_at(n, floor);
        };
        const double before = worst_at(n, -1);
        double worst = value(mean / count, before + kVisible);
        if (worst > before + kVisible)
            best = mean / count;
        else
            worst = before;
        worst = geometry::pattern_search(best, worst, {side / count, kVisible}, value);
        points_[index(n)] = best;
        return worst > before + kVisible;
    }

    Closed& closed_;
    std::vector<Vec2>& points_;
    const std::vector<Quad>& quads_;
    mesh::Incidence at_;
    std::vector<Index> free_, cells_;
};

/// A row that can be closed, in a mesh of the divided region.
struct Row {
    std::vector<Segment> closed; ///< sides, each of which is collapsed to a node
    std::vector<Index> gone;     ///< quads that disappear
    Index last;                  ///< the quad that becomes the triangle
};

/// A window: the part of a mesh that closing rows at a node changes, and the cells around it that influence
/// the result. Nodes and quads keep their order, so operations on the window give the same result as on the
/// whole mesh.
struct Window {
    PlanarQuads mesh;
    std::vector<char> on_rim;        ///< for each node of the part, whether it is on the region's boundary
    std::vector<Index> nodes, quads; ///< numbers of the part's nodes and quads in the mesh
    Index middle;                    ///< the added node; all nodes before it are nodes of the region
};

/// @param divided  the region with nodes added to its boundary. Nodes after `middle` are no longer on the
///         boundary of the mesh.
/// @param middle   the added node; all nodes before it are nodes of the region.
Window window_at(const PlanarQuads& mesh, const PlanarRegion& divided, Index middle)
{
    const mesh::Incidence at = mesh::quads_at_nodes(mesh.quads, mesh.points.size());
    std::vector<Index> number(mesh.points.size(), -1);
    std::vector<char> taken(mesh.quads.size(), 0);
    Window window;
    window.nodes.push_back(middle);
    number[index(middle)] = 0;
    // A row extends at most kCandidates - 1 rings from the middle node, the nodes that move lie up to kRings
    // further, and one more ring contains their cells. The other two rings are a margin.
    for (std::size_t ring = 0, begin = 0; ring < kCandidates + cleaning::kRings + 2; ++ring) {
        const std::size_t end = window.nodes.size();
        for (; begin < end; ++begin) {
            for (const Index q : at.of(index(window.nodes[begin]))) {
                if (taken[index(q)] != 0) continue;
                taken[index(q)] = 1;
                window.quads.push_back(q);
                for (const Index n : mesh.quads[index(q)]) {
                    if (number[index(n)] >= 0) continue;
                    number[index(n)] = 0;
                    window.nodes.push_back(n);
                }
            }
        }
    }
    std::ranges::sort(window.nodes);
    std::ranges::sort(window.quads);
    std::vector<char> on_rim(mesh.points.size(), 0);
    for (const std::vector<Index>& loop : divided.loops)
        for (const Index n : loop)
            if (n <= middle) on_rim[index(n)] = 1;
    for (const Index n : window.nodes) {
        number[index(n)] = static_cast<Index>(window.mesh.points.size());
        window.mesh.points.push_back(mesh.points[index(n)]);
        window.on_rim.push_back(on_rim[index(n)]);
    }
    for (const Index q : window.quads) {
        Quad quad = mesh.quads[index(q)];
        for (Index& n : quad) n = number[index(n)];
        window.mesh.quads.push_back(quad);
    }
    window.middle = number[index(middle)];
    return window;
}

/// All ways to close a row. The row starts at one of the two boundary sides that end at the middle node, and
/// is closed up to one of its first quads.
std::vector<Row> rows_from(const Window& window)
{
    const std::vector<Quad>& quads = window.mesh.quads;
    const std::vector<Index> opposite = mesh::opposite_sides(quads,
                                                             static_cast<Index>(window.mesh.points.size()));
    const auto end_of = [&](Index side, Index next) {
        return quads[index(side / 4)][index((side + next) % 4)];
    };
    std::vector<Row> rows;
    for (Index first = 0; first < static_cast<Index>(opposite.size()); ++first) {
        if (opposite[index(first)] != mesh::kRimSide) continue;
        if (end_of(first, 0) != window.middle && end_of(first, 1) != window.middle) continue;
        Row row;
        std::set<Index> touched;
        Index side = first;
        for (std::size_t step = 0; step < kCandidates && side >= 0; ++step) {
            const Index a = end_of(side, 0), b = end_of(side, 1);
            // Two boundary nodes must not be merged, unless one of them is the added node.
            const bool both = window.on_rim[index(a)] != 0 && window.on_rim[index(b)] != 0;
            if (mesh::is_triangle(quads[index(side / 4)]) || (step > 0 && both)) break;
            if (!touched.insert(a).second || !touched.insert(b).second) break;
            row.closed.push_back({a, b});
            row.last = side / 4;
            rows.push_back(row);
            row.gone.push_back(side / 4);
            side = opposite[index(side / 4 * 4 + (side + 2) % 4)];
        }
    }
    return rows;
}

/// Close a row. Empty if closing would also merge two corners of a cell beside the row.
/// @param middle  the added node; all nodes before it are nodes of the region.
std::optional<Closed> close(const PlanarQuads& mesh, const std::vector<char>& on_rim, const Row& row,
                            Index middle)
{
    std::vector<Vec2> points = mesh.points;
    std::vector<Index> to(points.size());
    std::iota(to.begin(), to.end(), 0);
    Closed result;
    for (const Segment& side : row.closed) {
        Index stays = side[0], goes = side[1];
        const bool swap = stays == middle || (goes != middle && on_rim[index(goes)] != 0);
        if (swap) std::swap(stays, goes);
        if (on_rim[index(stays)] == 0)
            points[index(stays)] = (points[index(stays)] + points[index(goes)]) / 2;
        to[index(goes)] = stays;
        result.near.push_back(stays);
    }
    std::vector<Index> number(points.size(), -1);
    for (std::size_t n = 0; n < points.size(); ++n) {
        if (to[n] != static_cast<Index>(n)) continue;
        number[n] = static_cast<Index>(result.mesh.points.size());
        result.mesh.points.push_back(points[n]);
    }
    for (Index& n : result.near) n = number[index(n)];
    std::optional<Quad> triangle;
    result.mesh.quads.reserve(mesh.quads.size());
    for (std::size_t q = 0; q < mesh.quads.size(); ++q) {
        if (std::ranges::find(row.gone, static_cast<Index>(q)) != row.gone.end()) continue;
        Quad corners;
        std::size_t count = 0;
        for (const Index n : mesh.quads[q]) {
            const Index own = number[index(to[index(n)])];
            const auto end = corners.begin() + static_cast<std::ptrdiff_t>(count);
            if (std::find(corners.begin(), end, own) == end) corners[count++] = own;
        }
        const bool is_last = static_cast<Index>(q) == row.last;
        if (count != mesh::corner_count(mesh.quads[q]) - (is_last ? 1 : 0)) return std::nullopt;
        if (count == 3) corners[3] = corners[2];
        if (is_last)
            triangle = corners;
        else
            result.mesh.quads.push_back(corners);
    }
    result.mesh.quads.push_back(*triangle);
    result.mesh.how = mesh.how;
    Smoother(result, index(middle)).run();
    return result;
}

/// Convert a row of a window to a row of the mesh that contains the window.
Row in_mesh(Row row, const Window& window)
{
    for (Segment& side : row.closed)
        for (Index& n : side) n = window.nodes[index(n)];
    for (Index& q : row.gone) q = window.quads[index(q)];
    row.last = window.quads[index(row.last)];
    return row;
}

/// The best result of closing a row in a mesh of the divided region. Empty if no row can be closed.
/// @param than  if given, only a result that is better than `than` is returned.
std::optional<Closed> close_best(const PlanarQuads& mesh, const PlanarRegion& divided, Index middle,
                                 const std::optional<Closed>& than, const RunContext& context)
{
    const Window window = window_at(mesh, divided, middle);
    const std::vector<Row> rows = rows_from(window);
    std::vector<std::optional<Closed>> found(rows.size());
    parallel_each(context, rows.size(), 1, [&](std::size_t r) {
        found[r] = close(window.mesh, window.on_rim, rows[r], window.middle);
    });
    const Closed* best = than ? &*than : nullptr;
    const Row* row = nullptr;
    for (std::size_t r = 0; r < rows.size(); ++r) {
        if (!found[r] || (best != nullptr && !found[r]->better_than(*best))) continue;
        best = &*found[r];
        row = &rows[r];
    }
    if (row == nullptr) return std::nullopt;
    std::vector<char> on_rim(mesh.points.size(), 0);
    for (std::size_t n = 0; n < window.nodes.size(); ++n) on_rim[index(window.nodes[n])] = window.on_rim[n];
    return close(mesh, on_rim, in_mesh(*row, window), middle);
}

/// The region with the given sides divided, in their order. The new nodes in the middle of these sides are
/// its last points.
PlanarRegion divide(const PlanarRegion& region, std::span<const RegionSide> sides)
{
    PlanarRegion divided = region;
    std::vector<std::pair<RegionSide, Index>> added;
    for (const RegionSide& side : sides) {
        const std::vector<Index>& loop = region.loops[side.loop];
        const Vec2 &a = region.points[index(loop[side.place])],
                   &b = region.points[index(loop[(side.place + 1) % loop.size()])];
        added.emplace_back(side, static_cast<Index>(divided.points.size()));
        divided.points.push_back((a + b) / 2);
    }
    // Insert nodes from the last position to the first, so that the remaining positions stay valid.
    std::ranges::sort(added, [](const auto& a, const auto& b) { return a.first.place > b.first.place; });
    for (const auto& [side, middle] : added) {
        std::vector<Index>& loop = divided.loops[side.loop];
        loop.insert(loop.begin() + static_cast<std::ptrdiff_t>(side.place) + 1, middle);
    }
    return divided;
}

void tell_triangles(PlanarQuads& mesh, std::size_t count)
{
    if (!mesh.how.empty()) mesh.how += ", ";
    mesh.how += count == 1 ? "one triangle" : formatted("{} triangles", count);
}

[[noreturn]] void refuse_rows(std::size_t sides)
{
    throw NotSweepable(Message("surface.odd_region",
                               "a region with {} boundary sides needs one triangle besides quads, but no row "
                               "of quads leads inward from its longest sides",
                               sides)
                           .remedy("change the number of sides by one with 'intervals'"));
}

std::size_t sides_of(const PlanarRegion& region)
{
    std::size_t count = 0;
    for (const std::vector<Index>& loop : region.loops) count += loop.size();
    return count;
}

} // namespace

std::vector<RegionSide> sides_by_length(const PlanarRegion& region)
{
    struct Side {
        RegionSide side;
        double length; ///< relative to the local size
    };
    std::vector<Side> sides;
    for (std::size_t l = 0; l < region.loops.size(); ++l) {
        const std::vector<Index>& loop = region.loops[l];
        for (std::size_t i = 0; i < loop.size(); ++i) {
            const Vec2& a = region.points[index(loop[i])];
            const Vec2& b = region.points[index(loop[(i + 1) % loop.size()])];
            const double size = region.size ? region.size((a + b) / 2) : 1;
            sides.push_back({{l, i}, (b - a).norm() / size});
        }
    }
    std::ranges::stable_sort(sides, std::ranges::greater{}, &Side::length);
    std::vector<RegionSide> result;
    for (const Side& side : sides) result.push_back(side.side);
    return result;
}

PlanarQuads fill_odd_region(const PlanarRegion& region, const PlanarQuadMesher& mesher,
                            const RunContext& context)
{
    if (sides_of(region) % 2 == 0) return mesher(region, context);
    std::optional<Closed> best;
    const std::vector<RegionSide> sides = sides_by_length(region);
    const auto middle = static_cast<Index>(region.points.size());
    for (std::size_t s = 0; s < std::min(sides.size(), kCandidates); ++s) {
        const PlanarRegion divided = divide(region, std::span(&sides[s], 1));
        const PlanarQuads filled = mesher(divided, context);
        if (std::optional<Closed> closed = close_best(filled, divided, middle, best, context))
            best = std::move(closed);
        if (best && best->worst >= kPoorQuad) break;
    }
    if (!best) refuse_rows(sides_of(region));
    tell_triangles(best->mesh, 1);
    return std::move(best->mesh);
}

PlanarQuads fill_divided_region(const PlanarRegion& region, std::span<const RegionSide> sides,
                                const PlanarQuadMesher& mesher, const RunContext& context)
{
    const PlanarRegion divided = divide(region, sides);
    PlanarQuads mesh = mesher(divided, context);
    // Close rows at the last added node first, so that nodes added before it keep their numbers.
    for (std::size_t s = sides.size(); s-- > 0;) {
        const auto middle = static_cast<Index>(region.points.size() + s);
        std::optional<Closed> closed = close_best(mesh, divided, middle, std::nullopt, context);
        if (!closed) refuse_rows(sides_of(region));
        mesh = std::move(closed->mesh);
    }
    if (!sides.empty()) tell_triangles(mesh, sides.size());
    return mesh;
}

} // namespace lacuna::quads
