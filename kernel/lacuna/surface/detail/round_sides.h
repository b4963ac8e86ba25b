// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/surface/detail/interval_program.h>
#include <lacuna/surface/size_field.h>
#include <lacuna/topology/model.h>

#include <cstddef>
#include <optional>
#include <vector>

/// Faces with a round side, such as sectors and half discs. Internal to this folder.
namespace lacuna::surface {

/// A round, convex side of a face that has only one such side.
struct RoundSide {
    std::size_t side = 0;
    /// Turning angle [radian]; radius [model length]; size at the midpoint of the side.
    double turn = 0, radius = 0, size = 1;
};

/// The round side of a face: a side that turns by 45° or more.
/// @param sides  result of `sides_by_corners()`.
/// @return  empty if no side is round, several sides are, or the round side is concave.
std::optional<RoundSide> bulge_of(const topology::Model& model, FaceId face,
                                  const std::vector<std::vector<EdgeId>>& sides, const SizeField& size);

/// Add two wishes for a face with a round side: rows with a total depth of a third of the radius along that
/// side, and as many sides on the round side as the line behind these rows needs for its length.
/// @param parts  number of equal parts of the side; behind the middle of each part, the line has a corner
/// @param round  variables of the side
/// @param rows   variable of the number of rows
/// @return  for one part: wanted number of sides on half of the line behind it
double wish_rows(const RoundSide& bulge, int parts, const std::vector<std::size_t>& round, std::size_t rows,
                 IntervalProgram& program);

} // namespace lacuna::surface
