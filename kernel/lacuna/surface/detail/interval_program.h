// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <vector>

/// Whole numbers of sides on edges that must agree (interval assignment). Internal to this folder.
namespace lacuna::surface {

/// A number of sides to be chosen.
struct IntervalVariable {
    int least = 1; ///< >= 1
    int given = 1; ///< kept where `fixed`
    bool fixed = false;
};

/// As many sides over some variables as over others.
struct IntervalEquation {
    std::vector<std::size_t> one, other; ///< variables; one that stands twice counts twice
};

/// The least that is wanted of an edge, so that a sum has no pole. A choice, not a measurement.
constexpr double kLeastWish = 0.1;

/// A number of sides that is wanted over some variables together.
struct IntervalWish {
    std::vector<std::size_t> variables;
    double wanted = 1; ///< not rounded, > 0
    double weight = 1; ///< > 0
};

/// At least so many sides over some variables together.
struct IntervalFloor {
    std::vector<std::size_t> variables;
    int least = 1;
};

/// What all edges of a source are to have, at once.
struct IntervalProgram {
    std::vector<IntervalVariable> variables;
    std::vector<IntervalEquation> equations;
    std::vector<IntervalWish> wishes;
    std::vector<IntervalFloor> floors;
};

/// The whole numbers that solve all equations and keep all floors, of least Σ weight (n − wanted)² / n over
/// the wishes, n a wish's own sum: alike for sides too long and too short by one ratio. Sides shorter than
/// 0.6 or longer than 1.6 of what is asked for cost more, by how far they are off that.
///
/// Variables that no equation joins are solved apart. Each such set of equations is brought to reduced row
/// echelon form in whole numbers, as @cite mitchell_2021_intervals does; its free variables then give vectors
/// along which all equations stay solved. From the rounded wishes, and again from the least in real numbers,
/// the program goes down those vectors, alone and by twos, by steps of powers of two, always the one that
/// gains most, until none gains; the better end stays. A set with more than 64 free variables goes down them
/// alone, from the wishes. Where it ends may be a little above the least: from the wishes alone, of 143
/// random programs with solutions one did, by a tenth (tests/surface/test_interval_program.cpp).
/// @return  a number for each variable; 0 for those of a set that is too large, whose equations contradict
///          each other or a floor, or that has no start in whole numbers.
/// @note    Deterministic. O(equations² · variables) a set, and O(free² · wishes) a step.
std::vector<int> solve_intervals(const IntervalProgram& program);

/// What a solution costs: the sum that `solve_intervals()` makes least.
double cost_of_intervals(const IntervalProgram& program, std::span<const int> counts);

} // namespace lacuna::surface
