// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/topology/open_volume.h>

namespace lacuna::closure {

/// What lies between a face and the thin plate through its rim [model length³].
///
/// The plate is the surface of least bending over the face's plane, a thin-plate spline through places on
/// the rim; a membrane is that of least stretching. Both are as smooth as their rim, and where they differ
/// the rim leaves open how the inside bends.
double beside_thin_plate(const topology::Model& model, FaceId face);

} // namespace lacuna::closure
