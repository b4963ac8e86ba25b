// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/surface/detail/interval_program.h>
#include <lacuna/surface/size_field.h>
#include <lacuna/topology/model.h>

#include <cstddef>
#include <optional>
#include <vector>

/// Faces with one round side: sectors (three sides) and half discs (two sides). Internal to this folder.
namespace lacuna::surface {

/// A convex round side of a face that has no other round side.
struct RoundSide {
    std::size_t side = 0; ///< index of the side
    /// Angle by which the side turns [radian], its mean radius [model length], and the requested size at the
    /// midpoint of its longest edge [model length].
    double turn = 0, radius = 0, size = 1;
};

/// The round side of a face: a side that turns by 45° or more.
/// @param sides  result of `sides_by_corners()`.
/// @return  empty if no side is round, several sides are, or the round side is concave.
std::optional<RoundSide> bulge_of(const topology::Model& model, FaceId face,
                                  const std::vector<std::vector<EdgeId>>& sides, const SizeField& size);

/// Rows of quads run along the round side of a face and end at an inner line. Add two wishes:
/// - The number of rows suits a total depth of a third of the radius.
/// - The round side has as many sides as the inner line needs for its length.
///
/// @param parts  number of equal parts of the round side. For each part, the inner line has a corner on the
///         ray through the middle of the part
/// @param round  variables of the round side
/// @param rows   variable of the number of rows
/// @return  wanted number of sides from a corner of the inner line to the end of its part
double wish_rows(const RoundSide& bulge, int parts, const std::vector<std::size_t>& round, std::size_t rows,
                 IntervalProgram& program);

} // namespace lacuna::surface
