// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/surface/shared/seeds.h>
#include <lacuna/topology/model.h>

#include <span>

/// Rows and numbers of sides requested on edges. Internal to this folder.
namespace lacuna::surface {

/// Place nodes on edges on which rows of boundary layers end, at the heights of these rows.
/// @throw NotSweepable "surface.layers_room".
void end_rows(Seeds& seeds, const topology::Model& model, const RimRows& rows);

/// Fix the nodes on edges whose number of sides is requested.
/// @throw NotSweepable "surface.sides_asked".
void set_sides(Seeds& seeds, const topology::Model& model, std::span<const SidesAsked> sides);

} // namespace lacuna::surface
