// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/surface/detail/interval_program.h>
#include <lacuna/surface/size_field.h>
#include <lacuna/topology/model.h>

#include <cstddef>
#include <optional>
#include <vector>

/// Faces with a round side, as sectors and half discs have. Internal to this folder.
namespace lacuna::surface {

/// The one side of a face that is round and bulges outward.
struct RoundSide {
    std::size_t side = 0;
    double turn = 0, radius = 0, size = 1; ///< [radian], [model length], asked for in its middle
};

/// The round side of a face, one that turns by 45° or more.
/// @param sides  as `sides_by_corners()` gives them.
/// @return  nothing where no side is round, several are, or it is bent inward.
std::optional<RoundSide> bulge_of(const topology::Model& model, FaceId face,
                                  const std::vector<std::vector<EdgeId>>& sides, const SizeField& size);

/// Wish for rows along a round side as deep as a third of its radius, and for as many sides on it as the
/// length of the line behind them asks for.
/// @param parts  equal ones that the side is divided into, each with a corner of that line behind it
/// @param round  variables of the side
/// @param rows   variable of the number of rows
/// @return  sides wanted on half of the line behind a part
double wish_rows(const RoundSide& bulge, int parts, const std::vector<std::size_t>& round, std::size_t rows,
                 IntervalProgram& program);

} // namespace lacuna::surface
