// SPDX-License-Identifier: MIT
#include <lacuna/surface/detail/seed_program.h>

#include <lacuna/core/shared/criteria.h>
#include <lacuna/core/shared/limits.h>
#include <lacuna/surface/detail/interval_program.h>
#include <lacuna/surface/detail/round_sides.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

namespace lacuna::surface {

using namespace topology;

namespace {

/// If the round side of a face turns by at least this (120°), the face is filled by two three-sided patterns
/// side by side. Heuristic.
constexpr double kHalves = kFullTurn / 3;

/// A sector (three sides, of which one is round) next to another free face gets numbers of sides for rows
/// along its round side, if the size requires at least this number of quads. Measured on quarters of a disc.
/// For few wanted quads, the rule gives too many: for 30 wanted quads, 80 with the rule and 45 without; for
/// 12 wanted quads, 86 and 39. For 120 and more wanted quads, the rule comes nearer to the wanted number in
/// all cases.
constexpr double kQuadsForRows = 20;

/// In `make_even()`: weight of edges that should be changed last, relative to other edges. Heuristic.
constexpr double kLastWeight = 10;

/// A grid that fills a face or a part of it: the variables along its sides, in both directions.
using FaceGrid = std::array<std::vector<std::size_t>, 2>;

/// The program, and the pieces to which its variables belong.
struct Program {
    IntervalProgram intervals;
    std::vector<SeedPiece*> pieces;
    std::vector<std::size_t> piece_variable;
    std::map<EdgeId, std::size_t> first; ///< variable of the first piece of each edge
    std::vector<FaceGrid> grids;         ///< all grids with which faces are filled
    double asked = 0;                    ///< number of quads wanted on faces filled by `grids`
    /// In `make_even()`, which changes numbers of sides that exist: the edges to be changed last. Otherwise
    /// null.
    const std::set<EdgeId>* last = nullptr;
};

void add_piece(EdgeId edge, SeedPiece& piece, Program& program)
{
    const bool repairs = program.last != nullptr;
    const double wanted = repairs || piece.rows() > 0 ? piece.count : piece.sides;
    const double weight = repairs && program.last->contains(edge) ? kLastWeight : 1;
    const std::size_t variable = program.intervals.variables.size();
    program.intervals.wishes.push_back({{variable}, wanted, weight});
    program.intervals.variables.push_back(
        {std::max(piece.least, piece.rows() + 1), piece.count, piece.fixed});
    program.pieces.push_back(&piece);
    program.piece_variable.push_back(variable);
}

/// The variables of some edges. They are added to the program if needed.
std::vector<std::size_t> variables_of(Seeds& seeds, const std::vector<EdgeId>& edges, Program& program)
{
    std::vector<std::size_t> variables;
    for (const EdgeId edge : edges) {
        std::vector<SeedPiece>& own = seeds.pieces.at(edge);
        const auto [found, fresh] = program.first.try_emplace(edge, program.intervals.variables.size());
        for (std::size_t i = 0; i < own.size(); ++i) {
            variables.push_back(found->second + i);
            if (fresh) add_piece(edge, own[i], program);
        }
    }
    return variables;
}

std::size_t add_variable(IntervalProgram& intervals)
{
    intervals.variables.push_back({});
    return intervals.variables.size() - 1;
}

/// Require that the total number of sides on some edges is even.
void add_even(Seeds& seeds, const std::vector<EdgeId>& edges, Program& program)
{
    std::vector<std::size_t> all = variables_of(seeds, edges, program);
    const std::size_t half = add_variable(program.intervals);
    program.intervals.wishes.push_back({{half}, total(seeds, edges) / 2.0, 1 / kDecides});
    program.intervals.equations.push_back({std::move(all), {half, half}});
}

/// Require equal numbers of sides on edges that a symmetry of a face maps onto each other.
void add_alike(const AlikeEdges& alike, Program& program)
{
    for (const auto& [face, sets] : alike) {
        for (const std::vector<EdgeId>& set : sets) {
            const auto first = program.first.find(set.front());
            for (std::size_t i = 1; i < set.size() && first != program.first.end(); ++i) {
                const auto other = program.first.find(set[i]);
                if (other != program.first.end())
                    program.intervals.equations.push_back({{first->second}, {other->second}});
            }
        }
    }
}

/// Require that the outer loop of a submapped face has at least two sides more in each direction than each of
/// its holes: the grid runs round the hole in whole rows.
/// @param pairs  `grid_sides()` of the face
void add_rows_round_holes(const SeedTask& task, const std::vector<SidePair>& pairs, Seeds& seeds,
                          Program& program)
{
    const auto along = [&](const SidePair& sides) {
        const Edge& edge = task.model[sides[0].front()];
        return Vec3(task.model.at(edge.points[1]) - task.model.at(edge.points[0])).stableNormalized();
    };
    const auto length = [&](std::size_t k) { return length_of(task.model, pairs[k][0]); };
    std::size_t outer = 0;
    for (std::size_t k = 0; k < pairs.size(); k += 2)
        if (length(k) + length(k + 1) > length(outer) + length(outer + 1)) outer = k;
    const auto is_open = [&](const std::vector<EdgeId>& side) {
        return std::ranges::none_of(side, [&](EdgeId edge) { return is_fixed(seeds, edge); });
    };
    for (std::size_t k = 0; k < pairs.size(); ++k) {
        if (k / 2 == outer / 2) continue;
        const bool same = std::abs(along(pairs[k]).dot(along(pairs[outer]))) > std::sqrt(0.5);
        const std::vector<EdgeId>& round = pairs[same ? outer : outer + 1][0];
        if (!is_open(round)) continue;
        IntervalEquation equation{variables_of(seeds, round, program),
                                  variables_of(seeds, pairs[k][0], program)};
        equation.other.push_back(add_variable(program.intervals));
        program.intervals.variables.back().least = 2;
        program.intervals.equations.push_back(std::move(equation));
    }
}

/// Require equal numbers of sides on opposite sides of mapped and submapped faces.
void add_mapped(const SeedTask& task, const FaceGrids& grids, Seeds& seeds, Program& program)
{
    for (const auto& [face, pairs] : grids.opposite) {
        const auto mapped = grids.mapped.find(face);
        std::array<std::vector<double>, 2> inside;
        if (mapped != grids.mapped.end()) inside = mapped->second.wanted_inside(task.size);
        for (std::size_t k = 0; k < pairs.size(); ++k) {
            IntervalEquation equation{variables_of(seeds, pairs[k][0], program),
                                      variables_of(seeds, pairs[k][1], program)};
            IntervalProgram& intervals = program.intervals;
            if (mapped != grids.mapped.end()) {
                for (const double sides : inside[k]) intervals.wishes.push_back({equation.one, sides});
                if (task.sizing.counts_across) {
                    intervals.floors.push_back({equation.one, task.sizing.gap});
                    intervals.floors.push_back({equation.other, task.sizing.gap});
                }
            }
            intervals.equations.push_back(std::move(equation));
        }
        if (pairs.size() > 2) add_rows_round_holes(task, pairs, seeds, program);
        if (mapped == grids.mapped.end()) continue;
        for (const SidePair& edges : opposite_edges(task.model, face, seeds.corners.at(face)))
            if (!is_fixed(seeds, edges[0].front()) && !is_fixed(seeds, edges[1].front()))
                program.intervals.equations.push_back(
                    {variables_of(seeds, edges[0], program), variables_of(seeds, edges[1], program)});
        program.grids.push_back(
            {variables_of(seeds, pairs[0][0], program), variables_of(seeds, pairs[1][0], program)});
        double quads = quads_asked(task.model, seeds, face);
        for (std::size_t k = 0; task.sizing.counts_across && k < pairs.size(); ++k) {
            // The minimum number across a narrow face increases the number of quads in this direction only.
            double wanted = sides_asked(seeds, pairs[k][0]) + sides_asked(seeds, pairs[k][1]);
            for (const double sides : inside[k]) wanted += sides;
            const auto lines = static_cast<double>(2 + inside[k].size());
            quads *= std::max(1.0, task.sizing.gap * lines / wanted);
        }
        program.asked += quads;
    }
}

/// Whether a face is a large sector next to another free face. Conditions:
/// - The face has three sides, of which one is round.
/// - No number of sides on its edges is given or requested, and no number of quads across narrow places.
/// - The size requires at least `kQuadsForRows` quads, enough for rows along the round side.
/// - It shares an edge with another free face, so that the number of this edge must suit both faces.
bool is_sector_beside(const SeedTask& task, const FaceGrids& grids, const Seeds& seeds, FaceId face,
                      const std::vector<EdgeId>& edges)
{
    const std::vector<std::vector<EdgeId>> sides = sides_by_corners(task.model, face);
    if (task.sizing.gap > 0 || sides.size() != 3 ||
        std::ranges::any_of(edges, [&](EdgeId edge) { return is_fixed(seeds, edge); }))
        return false;
    const auto bulge = bulge_of(task.model, face, sides, task.size);
    if (!bulge || bulge->turn / 2 * std::pow(bulge->radius / bulge->size, 2) < kQuadsForRows) return false;
    return std::ranges::any_of(edges, [&](EdgeId edge) {
        const std::set<FaceId>& users = task.users.at(edge);
        return std::ranges::any_of(users,
                                   [&](FaceId user) { return user != face && is_free(grids, seeds, user); });
    });
}

/// Add the constraints of a free face:
/// - Three sides: three grids meet at an inner node, so the total is even and no side exceeds the sum of the
///   other two.
/// - Two sides, one of them round (half disc): two patterns as for three sides lie side by side, with a
///   square core.
/// - Two other sides: their numbers differ by an even number, as around a grid that has two of its four
///   corners inside the face.
/// - All other faces: the total is even.
///
/// @return  whether one side is round, so that the numbers also determine the rows along it
bool add_free(const SeedTask& task, FaceId face, const std::vector<EdgeId>& edges, Seeds& seeds,
              Program& program)
{
    IntervalProgram& intervals = program.intervals;
    const std::vector<std::vector<EdgeId>> side = sides_by_corners(task.model, face);
    const auto bulge = bulge_of(task.model, face, side, task.size);
    if (side.size() == 3) {
        std::array<std::vector<std::size_t>, 3> own;
        for (std::size_t s = 0; s < 3; ++s) own[s] = variables_of(seeds, side[s], program);
        const std::array<std::size_t, 3> grid{add_variable(intervals), add_variable(intervals),
                                              add_variable(intervals)};
        for (std::size_t s = 0; s < 3; ++s)
            intervals.equations.push_back({own[s], {grid[s], grid[(s + 1) % 3]}});
        for (std::size_t s = 0; s < 3; ++s) program.grids.push_back({{{grid[s]}, {grid[(s + 1) % 3]}}});
        program.asked += quads_asked(task.model, seeds, face);
        if (bulge) {
            const std::size_t rows = grid[(bulge->side + 2) % 3];
            const double core = wish_rows(*bulge, 1, own[bulge->side], rows, intervals);
            for (const std::size_t v : grid) {
                if (v != rows) intervals.wishes.push_back({{v}, core});
            }
            return true;
        }
    } else if (side.size() == 2 && bulge && bulge->turn > kHalves) {
        const std::vector<std::size_t> round = variables_of(seeds, side[bulge->side], program),
                                       other = variables_of(seeds, side[1 - bulge->side], program);
        const std::size_t core = add_variable(intervals), rows = add_variable(intervals);
        intervals.equations.push_back({round, {core, core, core, core}});
        intervals.equations.push_back({other, {core, core, rows, rows}});
        program.grids.push_back({{{core, core}, {core, rows, rows}}});
        program.asked += quads_asked(task.model, seeds, face);
        intervals.wishes.push_back({{core}, wish_rows(*bulge, 2, round, rows, intervals)});
        return true;
    } else if (side.size() == 2) {
        const double a = length_of(task.model, side[0]), b = length_of(task.model, side[1]);
        std::vector<std::size_t> longer = variables_of(seeds, side[a > b ? 0 : 1], program),
                                 shorter = variables_of(seeds, side[a > b ? 1 : 0], program);
        const std::size_t more = add_variable(intervals);
        shorter.insert(shorter.end(), {more, more});
        intervals.equations.push_back({std::move(longer), std::move(shorter)});
    } else {
        add_even(seeds, edges, program);
    }
    return false;
}

/// Add the constraints of free faces that share edges with mapped or submapped faces, and of large sectors.
/// @return  edges whose numbers of sides are those of a grid
std::set<EdgeId> add_beside_mapped(const SeedTask& task, const FaceGrids& grids, Seeds& seeds,
                                   Program& program)
{
    std::set<EdgeId> settled;
    if (task.style != QuadStyle::automatic) return settled;
    for (const FaceId face : task.faces) {
        const std::vector<EdgeId> edges = edges_of(task.model, face);
        const bool beside = std::ranges::any_of(edges, [&](EdgeId edge) {
            const std::set<FaceId>& users = task.users.at(edge);
            return std::ranges::any_of(users, [&](FaceId user) { return grids.opposite.contains(user); });
        });
        if (is_free(grids, seeds, face) && (beside || is_sector_beside(task, grids, seeds, face, edges))) {
            if (add_free(task, face, edges, seeds, program)) settled.insert(edges.begin(), edges.end());
        }
    }
    return settled;
}

/// The numbers of sides with the least cost.
/// @param share  factor on the wanted numbers.
std::vector<int> solve(Program program, double share)
{
    for (IntervalWish& wish : program.intervals.wishes) wish.wanted = share * wish.wanted;
    return solve_intervals(program.intervals);
}

/// Number of quads of all grids; 0 if some grid has no solution.
double quads_of(const Program& program, const std::vector<int>& counts)
{
    double quads = 0;
    for (const FaceGrid& grid : program.grids) {
        double product = 1;
        for (const std::vector<std::size_t>& side : grid) {
            double sum = 0;
            for (const std::size_t v : side) {
                if (counts[v] == 0) return 0;
                sum += counts[v];
            }
            product *= sum;
        }
        quads += product;
    }
    return quads;
}

/// The numbers of sides with the least cost. If they give too many or too few quads, solve again with the
/// wanted numbers multiplied by a factor. Example: three grids around a node have more quads than the lengths
/// of the face's sides suggest.
std::vector<int> solve_for_quads(const Program& program)
{
    // Results within `kQuadsOff` (a quarter) of the requested number of quads are preferred.
    std::vector<int> best = solve(program, 1), counts = best;
    const auto rank = [&](const std::vector<int>& of) {
        const double off = quads_of(program, of) - program.asked;
        return std::pair(std::abs(off) > kQuadsOff * program.asked,
                         cost_of_intervals(program.intervals, of) + kQuadsOff * off * off / program.asked);
    };
    double share = 1;
    for (int idle = 0; idle < kIdleRounds; ++idle) {
        const double quads = quads_of(program, counts);
        if (quads == 0) break;
        share *= std::sqrt(program.asked / quads);
        const std::vector<int> last = std::exchange(counts, solve(program, share));
        if (counts == last) break;
        if (quads_of(program, counts) == 0 || !(rank(counts) < rank(best))) continue;
        best = counts;
        idle = -1;
    }
    return best;
}

} // namespace

std::set<EdgeId> solve_together(const SeedTask& task, const FaceGrids& grids, const AlikeEdges& alike,
                                Seeds& seeds)
{
    Program all;
    add_mapped(task, grids, seeds, all);
    const Program mapped = all;
    std::set<EdgeId> settled = add_beside_mapped(task, grids, seeds, all);
    add_alike(alike, all);
    const std::vector<int> counts = solve_for_quads(all);
    std::vector<int> fewer; // the solution for mapped faces alone; used if the free faces have no solution
    for (std::size_t p = 0; p < all.pieces.size(); ++p) {
        int count = counts[all.piece_variable[p]];
        if (count == 0 && p < mapped.pieces.size()) {
            if (fewer.empty()) fewer = solve_intervals(mapped.intervals);
            count = fewer[mapped.piece_variable[p]];
        }
        if (count > 0) all.pieces[p]->count = count;
    }
    return settled;
}

void make_even(const SeedTask& task, const FaceGrids& grids, const AlikeEdges& alike,
               const std::set<EdgeId>& settled, Seeds& seeds)
{
    std::set<EdgeId> last = settled;
    for (const auto& [face, sets] : alike) {
        for (const std::vector<EdgeId>& set : sets) {
            if (set.size() > 1) last.insert(set.begin(), set.end());
        }
    }
    Program all;
    all.last = &last;
    for (const auto& [face, pairs] : grids.opposite) {
        for (const SidePair& sides : pairs)
            all.intervals.equations.push_back(
                {variables_of(seeds, sides[0], all), variables_of(seeds, sides[1], all)});
    }
    for (const FaceId face : task.faces) {
        if (is_free(grids, seeds, face)) add_even(seeds, edges_of(task.model, face), all);
    }
    const std::vector<int> counts = solve_intervals(all.intervals);
    for (std::size_t p = 0; p < all.pieces.size(); ++p) {
        if (counts[all.piece_variable[p]] > 0) all.pieces[p]->count = counts[all.piece_variable[p]];
    }
}

} // namespace lacuna::surface
