// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/closure/close.h>
#include <lacuna/closure/follow.h>
#include <lacuna/geometry/facet_tree.h>

#include <string>
#include <vector>

namespace lacuna::closure {

/// Facets for a void face, not yet in the model.
struct VoidFilling {
    std::vector<topology::Loop> loops;
    std::vector<Vec3> points;        ///< new ones; number i stands for model point model.points.size() + i
    std::vector<Triangle> triangles; ///< model points, the loops' side consistent with them
    topology::Geometry geometry = topology::Geometry::newell;
    std::string algorithm; ///< the paper's: "Algorithm 4" …
};

/// The four logical sides of a loop that runs once along the source rim and once along the target rim, in
/// walking order from the source's: source, side, target, side; empty when it has none.
std::vector<std::vector<topology::EdgeUse>> logical_sides(const topology::OpenVolume& volume,
                                                          const topology::Loop& loop);

/// Facets for the loops of one void face (its outer loop and islands).
///
/// A flat face, and a bent one whose outline does not cross itself in its Newell plane: Algorithm 4,
/// constrained Delaunay there, interior lifted by the harmonic interpolation of the rim's heights.
/// Departures: where the rim lies on one quadric, or on a ball, a round cylinder, a cone or two planes among
/// many, so does the interior; where it lies on about one quadratic height, as the mouth of a keyway does on
/// its shaft, the interior has that, and what is left at the rim is harmonic.
/// A bent face with four logical sides: Algorithm 6 (Algorithm 5 where two of them are closed edges), a
/// bilinear Coons patch over arc length.
/// Departure from the paper: a bent four-sided face is transfinite at once, so that its facets and its
/// mesh are the same surface. A bent face of other sides that folds in its Newell plane is an error.
/// @param follower  null, or what a bent four-sided face follows instead: the source side as the given
///                  walls move it up and the target side as they move it down, blended, and shifted to meet
///                  the sides.
/// @param name  of the face, for messages.
/// @throw NotClosed  names the face and the edges that cross.
VoidFilling fill(const topology::OpenVolume& volume, const std::vector<topology::Loop>& loops,
                 const Follower* follower, const std::string& name, const RunContext& context = {});

/// Facets for the loops of a missing end that has the shape of a given surface: that surface's heights over
/// the Newell plane of the loops, moved by the harmonic extension of what is left at the loops.
/// @param shape  the given end where the walls move it, near the loops.
/// @throw NotClosed  the loops cross in their Newell plane, or the surface folds over it; names the face.
VoidFilling fill_as(const topology::OpenVolume& volume, const std::vector<topology::Loop>& loops,
                    const geometry::FacetTree& shape, double facet_size, const std::string& name,
                    const RunContext& context = {});

/// Put a filled face into the volume.
FaceId add_void_face(topology::OpenVolume& volume, VoidFilling filling, topology::Role role);

} // namespace lacuna::closure
