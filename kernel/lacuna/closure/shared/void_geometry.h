// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/closure/close.h>
#include <lacuna/closure/shared/follow.h>
#include <lacuna/core/message.h>
#include <lacuna/geometry/shared/facet_tree.h>

#include <string>
#include <vector>

namespace lacuna::closure {

/// The subject of a message: words followed by an entity, such as "the cover of a hole of face 3".
struct Subject {
    std::string words;
    std::vector<NamedEntity> entity{};
};

/// Facets of a void face, not yet in the model.
struct VoidFilling {
    std::vector<topology::Loop> loops;
    std::vector<Vec3> points;        ///< new points; point i gets the model index model.points.size() + i
    std::vector<Triangle> triangles; ///< indices of model points; oriented like the loops
    topology::Geometry geometry = topology::Geometry::newell;
    std::string algorithm; ///< name in the paper: "Algorithm 4" …
    std::string name{};    ///< name of the face
};

/// The four logical sides of a loop that runs once along the source rim and once along the target rim:
/// source, side, target, side, in the order of the loop. Empty for any other loop.
std::vector<std::vector<topology::EdgeUse>> logical_sides(const topology::OpenVolume& volume,
                                                          const topology::Loop& loop);

/// Triangulate one void face from its loops (the outer loop and islands).
///
/// The method depends on the face; algorithms are numbered as in the paper (`docs/bibliography.md`).
/// - A bent face with four logical sides, or with four sharp corners if the face is ruled or its rim lies on
///   no quadric: Algorithm 6, a patch between the four sides over arc length (Algorithm 5 if two opposite
///   sides are the same edge, a seam). Departure: the patch is a `geometry::SweptPatch`, whose frame rotates
///   along the sides, not a bilinear Coons patch. The mesh of the face is made on the same surface.
/// - Any other face whose outline does not cross itself in its Newell plane: Algorithm 4, constrained
///   Delaunay in that plane, with inner heights from the harmonic interpolation of the rim's heights.
///   Departure: if the rim determines a quadric, the interior lies on it too. If the rim lies on many
///   quadrics, the interior lies on the one that is a sphere, a circular cylinder, a cone or a pair of
///   planes.
/// - Any other face is refused.
/// @param follower  null, or the motion of the walls. With a motion, a bent face with four logical sides is a
///                  blend of two surfaces: its source side moved towards the target, and its target side
///                  moved towards the source. The blend is shifted to meet the two other sides.
/// @throw NotClosed  names the face and the edges that cross.
VoidFilling fill(const topology::OpenVolume& volume, const std::vector<topology::Loop>& loops,
                 const Follower* follower, const Subject& face, const RunContext& context = {});
/// As `fill()`, for a face that cuts the volume: no quadric that its rim lies on determines it.
VoidFilling fill_cut(const topology::OpenVolume& volume, const std::vector<topology::Loop>& loops,
                     const Subject& face, const RunContext& context = {});

/// Triangulate a missing end with the shape of a given surface. The heights of the end over the Newell plane
/// of the loops are those of the surface, plus the harmonic extension of the difference at the loops.
/// @param shape  the given end, moved along the walls so that it lies near the loops.
/// @throw NotClosed  the loops cross in their Newell plane, or the surface folds over it; names the face.
VoidFilling fill_as(const topology::OpenVolume& volume, const std::vector<topology::Loop>& loops,
                    const geometry::FacetTree& shape, double facet_size, const Subject& face,
                    const RunContext& context = {});

} // namespace lacuna::closure
