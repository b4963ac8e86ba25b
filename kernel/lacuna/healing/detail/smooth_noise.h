// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/topology/model.h>

namespace lacuna::healing {

/// How far points were moved [model length].
struct NoiseSmoothed {
    double most = 0, mean = 0;
};

/// Smooth the noise of facets within faces and along edges without shrinking the surface @cite
/// taubin_1995_signal. Each pass moves the points towards the mean of their neighbours, and then a little
/// further in the opposite direction. Vertices and nodes that must be kept do not move; the vertex of a
/// closed edge moves with the edge. Takes time linear in the number of facets.
/// @throw Cancelled
NoiseSmoothed smooth_noise(topology::ModelBuilder& model, const RunContext& context);

} // namespace lacuna::healing
