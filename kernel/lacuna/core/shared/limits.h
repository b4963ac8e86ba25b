// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

/// Numbers of samples, steps, trials and tasks that several folders share.

namespace lacuna {

// Samples

/// Chords with which a curve or a wall is measured or compared. The sag of a chord is 1/256 of the curve's.
/// The length of a half circle is too short by 0.2 %.
inline constexpr int kChords = 16;

/// Chords, sections, points or facets that represent the shape of a curve, a wall, a loop or a face. A bend
/// by 90° turns by less than 1.5° from one chord to the next, a full turn by less than 6°.
inline constexpr int kFineChords = 64;

/// Directions, columns or points around a full turn: one per degree.
inline constexpr int kDegreesPerTurn = 360;

/// Samples for each side of a mesh on a curve. The sag of the chords between them is a sixteenth of the
/// side's.
inline constexpr int kSamplesPerSide = 4;

/// Largest number of samples between two points of a rim or facet. Bounds the time where the size is tiny.
inline constexpr double kMostSamples = 4096;

/// Step of finite differences, as a share of a side's parameter range. Their relative error is about its
/// square; rounding adds less than that.
inline constexpr double kDifference = 1e-3;

/// Points closer to each other than this share of the sides next to them become one point: a side between
/// them would be a sliver.
inline constexpr double kOnePoint = 0.25;

// Steps and trials

/// Largest number of steps of an iteration that converges fast and ends when it has converged.
inline constexpr int kMostSteps = 12;

/// Largest number of candidates that are tried where each trial costs a cut or a closing.
inline constexpr std::size_t kMostTrials = 8;

/// Limit on the number of cells of a mesh that is not swept. It bounds time and memory.
inline constexpr double kMostCells = 1e7;

/// Limit on the rounds of an iteration that ends by itself, usually after a few rounds. It keeps an input on
/// which the iteration does not settle from holding the caller.
inline constexpr int kMostRounds = 64;

/// An iteration that may stagnate ends after this number of consecutive rounds without gain.
inline constexpr int kIdleRounds = 4;

/// Number of elements in one task of a parallel loop if an element takes a microsecond or more, as a cell
/// does. For faster elements, `kBetweenPolls` is used.
inline constexpr std::size_t kPerTask = 512;

} // namespace lacuna
