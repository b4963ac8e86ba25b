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

/// The only side of a face that is round and convex.
struct RoundSide {
    std::size_t side = 0;
    double turn = 0, radius = 0, size = 1; ///< [radian], [model length], size at its midpoint
};

/// The round side of a face, one that turns by 45° or more.
/// @param sides  as `sides_by_corners()` gives them.
/// @return  nothing if no side is round, several are, or it is concave.
std::optional<RoundSide> bulge_of(const topology::Model& model, FaceId face,
                                  const std::vector<std::vector<EdgeId>>& sides, const SizeField& size);

/// Add two wishes for a face with a round side: rows a third of the radius deep along that side, and as many
/// sides on it as the length of the line behind these rows requires.
/// @param parts  number of equal parts of the side; behind each part, the line has a corner
/// @param round  variables of the side
/// @param rows   variable of the number of rows
/// @return  wanted number of sides on half of the line behind a part
double wish_rows(const RoundSide& bulge, int parts, const std::vector<std::size_t>& round, std::size_t rows,
                 IntervalProgram& program);

} // namespace lacuna::surface
