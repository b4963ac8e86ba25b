// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/mesh/tet_mesh.h>

#include <vector>

namespace lacuna::cad {

/// A side of a face of the skin, directed as in the face. Faces are numbered: first triangles, then quads.
struct SkinSide {
    Index from = -1, to = -1, face = -1;
};
/// All sides, sorted by their ends, then by face.
std::vector<SkinSide> skin_sides(const mesh::ClosedSkin& skin);

/// The triangles that remain to be filled with tetrahedra once each quad has a pyramid.
struct PyramidLayer {
    std::vector<Vec3> points;                      ///< the points of the skin, then the apex of each quad
    std::vector<std::vector<Triangle>> face_sides; ///< for each face of the skin: the triangle itself, or the
                                                   ///< four sides of its pyramid
};

/// Place a pyramid on each quad of a closed skin.
///
/// Gmsh's own pyramids start flat, with the apex in the plane of the quad. On 24 distorted blocks of
/// hexahedra they stayed inverted in 19, needed 2.6 times as many tetrahedra, and gave a minimum scaled
/// Jacobian that was a third as high.
///
/// An apex stands above the centre of its quad. Its height is half the side of a square of the same area. It
/// is lower where the pyramid would take more than a third of the angle to a neighbouring quad, half the
/// angle to a neighbouring triangle, or a third of the distance to the opposite face. It is higher where a
/// warped quad needs it. Pyramids that still cross another face are lowered.
/// @throw NotSweepable  a quad that is not convex ("cad.skin_quad"), or faces of the skin that cross
///                      ("cad.skin_crosses"); both give the place.
PyramidLayer place_pyramids(const mesh::ClosedSkin& skin, const std::vector<SkinSide>& sides,
                            const RunContext& context);

} // namespace lacuna::cad
