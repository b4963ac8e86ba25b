// SPDX-License-Identifier: MIT
#pragma once

/// How patches with few corners can be cut to be filled with quads; only sources of this folder include it.

#include <lacuna/core/types.h>

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace lacuna::quads {

/// Sides of a patch, or of a part of it with the cut, at most.
constexpr std::size_t kMostSides = 6;

/// Numbers of quads along the sides of a patch.
struct SideLengths {
    std::array<int, kMostSides> side{};
    std::size_t count = 0;
};

/// How far from its first corner each side is split when the grids of three or five corners meet at one point inside;
/// side i is split[i] + split[i + 2] long. False where that has no solution in whole numbers above 0.
///
/// Of a part whose last side is a cut, the first may be 0: then the grids meet at a point of the cut.
bool splits(const SideLengths& lengths, bool is_cut, std::array<int, kMostSides>& split);

/// A cut through a patch from one place in its loop to another.
struct Cut {
    std::size_t from = 0, to = 0;
    int pieces = 0;   ///< quads along it; 0: the patch is filled without a cut
    double fault = 0; ///< the less, the straighter and squarer
};

/// The cuts with which a loop of two to six corners is filled with the fewest irregular points, at most `most` (half of that between sides opposite each other), the
/// likeliest first: straight and square to the sides where it may be. One "cut" of no pieces where none is needed.
/// @param loop     in order, the patch on the left
/// @param corners  places in the loop, rising
/// @note  Which cuts there are follows from the numbers of sides alone; places only rank them.
std::vector<Cut> find_cuts(std::span<const Vec2> loop, std::span<const std::size_t> corners,
                           std::size_t most);

/// Irregular points at most of what the cuts of `find_cuts()` give, where it finds one; a large number for other numbers of
/// corners.
int fewest_irregular(std::size_t loop, std::span<const std::size_t> corners);

} // namespace lacuna::quads
