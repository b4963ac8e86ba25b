// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/topology/model.h>

namespace lacuna::healing {

/// Divide smooth faces of facets that are junctions of tubes, such as a scanned artery with three open ends,
/// where the tubes begin: a tube becomes a face of its own. A face is a junction of tubes if it has three or
/// more rims, runs along the normal of each, and has more than half of the curvature of such a junction.
/// Faces with given nodes stay whole.
///
/// A tube ends at a level of the harmonic function that is 0 on its rim and 1 on the other rims. The total
/// Gaussian curvature of a tube is 0, that of a junction of n tubes is -2π (n - 2) (Gauss and Bonnet): the
/// tube ends at the last level up to which the total curvature is less than that of a crease.
/// @throw Cancelled
/// @note  One solution of a sparse system for each such face.
void divide_arms(topology::ModelBuilder& model, const RunContext& context);

} // namespace lacuna::healing
