// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/topology/model.h>

#include <cstddef>

namespace lacuna::topology {

/// A place on an exact curve.
struct CurvePlace {
    double param = 0;
    Vec3 place;
};

/// The point where an edge's exact curve meets the plane that is normal to a chord at a given point of the
/// chord. Models may have different chords for the same edge. A vertex that they share is placed at the same
/// point of the exact curve in all of them.
/// @param segment   index of the chord, a segment of the edge's polyline.
/// @param fraction  position on the chord, in [0, 1].
/// @pre  the edge has a curve and parameters.
CurvePlace curve_beside(const Model& model, const Edge& edge, std::size_t segment, double fraction);

} // namespace lacuna::topology
