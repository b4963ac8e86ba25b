// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

/// Limits that bound the work of a loop: rounds, samples, tasks. Results do not depend on their exact values.

namespace lacuna {

/// Limit on the rounds of an iteration that ends by itself, usually after a few rounds. It keeps an input on
/// which the iteration does not settle from holding the caller.
inline constexpr int kMostRounds = 64;

/// Number of samples along a line, where a quantity is estimated that varies slowly.
inline constexpr int kSamples = 64;

/// Step of a finite difference, as a share of the parameter's range: about the cube root of the rounding
/// error, at which rounding and truncation are equally small.
inline constexpr double kDifference = 1e-5;

/// Number of elements in one task of a parallel loop if an element takes a microsecond or more, as a cell
/// does. For faster elements, `kBetweenPolls` is used.
inline constexpr std::size_t kPerTask = 512;

} // namespace lacuna
