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

/// The place of an edge's exact curve beside a place of one of its chords: their difference is square to the
/// chord. Two models that get a vertex at one place of a curve get it there exactly, whatever their chords.
/// @param segment  of the chord. @param fraction  of its length, in [0, 1].
/// @pre  the edge has a curve and parameters.
CurvePlace curve_beside(const Model& model, const Edge& edge, std::size_t segment, double fraction);

} // namespace lacuna::topology
