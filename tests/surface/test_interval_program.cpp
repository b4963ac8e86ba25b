// SPDX-License-Identifier: MIT
#include "support/dice.h"

#include <lacuna/surface/detail/interval_program.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <limits>
#include <numeric>

using namespace lacuna;
using namespace lacuna::surface;

namespace {

constexpr int kMostTried = 12; ///< sides of an edge, where all numbers are tried

int sum_over(const std::vector<std::size_t>& variables, const std::vector<int>& counts)
{
    return std::accumulate(variables.begin(), variables.end(), 0,
                           [&](int sum, std::size_t v) { return sum + counts[v]; });
}

bool is_solution(const IntervalProgram& program, const std::vector<int>& counts)
{
    for (std::size_t v = 0; v < counts.size(); ++v) {
        const IntervalVariable& own = program.variables[v];
        if (own.fixed ? counts[v] != own.given : counts[v] < own.least) return false;
    }
    return std::all_of(program.equations.begin(), program.equations.end(),
                       [&](const IntervalEquation& e) {
                           return sum_over(e.one, counts) == sum_over(e.other, counts);
                       }) &&
           std::all_of(program.floors.begin(), program.floors.end(),
                       [&](const IntervalFloor& f) { return sum_over(f.variables, counts) >= f.least; });
}

/// Up to five edges of one to six sides, some given, that equations of one to three edges a side join.
IntervalProgram random_program(test::Dice& dice)
{
    IntervalProgram program;
    const int edges = dice.whole(3, 5);
    for (int v = 0; v < edges; ++v) {
        const bool fixed = dice.chance(0.15);
        program.variables.push_back({dice.whole(1, 2), dice.whole(2, 6), fixed});
        program.wishes.push_back({{static_cast<std::size_t>(v)}, dice.between(1, 6), 1});
    }
    for (int e = dice.whole(1, 2); e > 0; --e) {
        IntervalEquation equation;
        for (std::size_t v = 0; v < program.variables.size(); ++v) {
            const int side = dice.whole(0, 3);
            if (side == 0) equation.one.push_back(v);
            if (side == 1) equation.other.push_back(v);
        }
        if (equation.one.empty() || equation.other.empty()) continue;
        if (dice.chance(0.3)) program.wishes.push_back({equation.one, dice.between(2, 9), 2});
        if (dice.chance(0.3)) program.floors.push_back({equation.other, dice.whole(2, 5)});
        program.equations.push_back(std::move(equation));
    }
    return program;
}

/// The least cost of all numbers of one to twelve sides; infinite where there is no solution.
double least_cost(const IntervalProgram& program)
{
    double least = std::numeric_limits<double>::infinity();
    std::vector<int> counts(program.variables.size(), 1);
    for (;;) {
        if (is_solution(program, counts)) least = std::min(least, cost_of_intervals(program, counts));
        std::size_t v = 0;
        while (v < counts.size() && counts[v] == kMostTried) counts[v++] = 1;
        if (v == counts.size()) return least;
        ++counts[v];
    }
}

} // namespace

TEST_CASE("numbers of sides that agree are found wherever there are any, and hardly any cost less")
{
    test::Dice dice(16);
    int solved = 0, unsolvable = 0, best = 0;
    double most_above = 1;
    for (int n = 0; n < 150; ++n) {
        CAPTURE(n);
        const IntervalProgram program = random_program(dice);
        const std::vector<int> counts = solve_intervals(program);
        const double least = least_cost(program);
        // An equation that contradicts earlier ones is left out.
        const bool found = is_solution(program, counts);
        // Others may need more sides than are tried here.
        CHECK((found || least == std::numeric_limits<double>::infinity()));
        if (!found) {
            ++unsolvable;
            continue;
        }
        ++solved;
        if (least == std::numeric_limits<double>::infinity()) {
            CHECK(*std::max_element(counts.begin(), counts.end()) > kMostTried);
            ++best;
            continue;
        }
        const double cost = cost_of_intervals(program, counts);
        if (cost <= least + 1e-9) ++best;
        most_above = std::max(most_above, (cost + 1e-9) / (least + 1e-9));
    }
    MESSAGE(solved << " solved, " << best << " at the least cost, " << unsolvable
                   << " without a solution; at most " << most_above << " times the least");
    CHECK(solved > 100);
    CHECK(best >= 0.97 * solved);
    CHECK(most_above < 1.2);
}

TEST_CASE("sides of a row of quads across many faces get the number that suits all of them")
{
    // A strip of 40 faces: the ends want 10 and 20 sides, all between the same.
    IntervalProgram program;
    for (std::size_t v = 0; v <= 40; ++v) {
        program.variables.push_back({1, 10, false});
        program.wishes.push_back({{v}, 10.0 + static_cast<double>(v) / 4, 1});
        if (v > 0) program.equations.push_back({{v - 1}, {v}});
    }
    const std::vector<int> counts = solve_intervals(program);
    for (const int count : counts) CHECK(count == 15);
}

TEST_CASE("given numbers that contradict each other leave only their own edges without a solution")
{
    IntervalProgram program;
    program.variables = {{1, 3, true}, {1, 4, true}, {1, 5, false}, {1, 5, false}, {1, 7, false}};
    program.equations = {{{0, 2}, {1, 2, 3}}, {{4}, {4}}};
    for (std::size_t v = 0; v < 5; ++v) program.wishes.push_back({{v}, 5, 1});
    const std::vector<int> counts = solve_intervals(program); // 3 = 4 + n has no solution
    CHECK(counts[3] == 0);
    CHECK(counts[4] == 5);
}

TEST_CASE("a chain of doublings longer than integers hold leaves edges without a solution")
{
    constexpr std::size_t kLinks = 70;
    IntervalProgram program;
    for (std::size_t v = 0; v <= kLinks; ++v) {
        program.variables.push_back({});
        program.wishes.push_back({{v}, 2, 1});
        if (v > 0) program.equations.push_back({{v}, {v - 1, v - 1}});
    }
    for (const int count : solve_intervals(program)) {
        CHECK(count >= 0);
        CHECK(count < 1 << 21);
    }
}
