// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <vector>

/// Integer numbers of sides on coupled edges (interval assignment). Internal to this folder.
namespace lacuna::surface {

/// A number of sides to be chosen.
struct IntervalVariable {
    int least = 1; ///< >= 1
    int given = 1; ///< the value if `fixed`
    bool fixed = false;
};

/// Equal sums over two lists of variables.
struct IntervalEquation {
    /// Indices of variables; a variable that occurs twice in a list counts twice.
    std::vector<std::size_t> one, other;
};

/// Cost of each side by which a sum is below its floor: larger than any other term of the objective. A wish
/// of the reciprocal weight only determines where the search starts. Heuristic.
constexpr double kDecides = 1e6;

/// A wanted sum of some variables.
struct IntervalWish {
    std::vector<std::size_t> variables;
    double wanted = 1; ///< not rounded, > 0
    double weight = 1; ///< > 0
};

/// A lower bound on the sum of some variables.
struct IntervalFloor {
    std::vector<std::size_t> variables;
    int least = 1;
};

/// The constraints and the objective for all edges of a source.
struct IntervalProgram {
    std::vector<IntervalVariable> variables;
    std::vector<IntervalEquation> equations;
    std::vector<IntervalWish> wishes;
    std::vector<IntervalFloor> floors;
};

/// Find integers that satisfy all equations and floors, and minimize Σ weight (n − wanted)² / n over the
/// wishes. n is the sum of a wish's variables. With this term, sides that are too long and sides that are too
/// short by the same ratio cost the same. Sides shorter than 0.6 times or longer than 1.6 times the wanted
/// length cost more, in proportion to the excess.
///
/// Algorithm, for each set of equations with common variables:
/// 1. Bring the equations to reduced row echelon form in integers, with sparse rows, as in @cite
///    mitchell_2021_intervals. An equation that contradicts earlier equations is left out.
/// 2. For each free variable, find the vector along which this variable changes and all equations stay
///    satisfied. If there are at most 64 free variables, add sums and differences of two such vectors.
/// 3. Start from the rounded wishes. Move along one of the vectors, by a power of two, as long as this
///    reduces the objective; take the step with the largest gain each time.
///
/// The result is not always the minimum: among 143 random programs with solutions, one result was a tenth
/// above it (tests/surface/test_interval_program.cpp).
/// @return  a number for each variable. All variables of a set are 0 if no result was found: the equations
///         contradict a floor or a lower bound, or step 3 has no integer start.
/// @note    Deterministic. O(equations · entries of the rows) per set, and O(free² · wishes) per step.
std::vector<int> solve_intervals(const IntervalProgram& program);

/// The objective of a solution, as minimized by `solve_intervals()`.
double cost_of_intervals(const IntervalProgram& program, std::span<const int> counts);

} // namespace lacuna::surface
