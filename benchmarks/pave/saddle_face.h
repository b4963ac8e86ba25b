// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "gmsh_quads.h"
#include "plane_figures.h"

#include <lacuna/quads/shared/measure_plane.h>
#include <lacuna/surface/shared/fill_face.h>
#include <lacuna/topology/model.h>

#include <string>
#include <vector>

namespace lacuna::bench {

/// A face of a CAD file with nodes on its outline.
struct SeededFace {
    std::string file;
    topology::Model model;
    FaceId face;
    double size = 0;                              ///< edge length asked for, the same all over [model length]
    std::vector<surface::RimNode> rim;            ///< an even number of sides on every edge, evenly spread
    std::vector<std::vector<Index>> loops;        ///< cycles of places in `rim`
    std::vector<std::pair<int, int>> curve_sides; ///< tag of every edge and its number of sides
};

/// A saddle z = (x² - y²) / 2 with waves on it, as a cubic B-spline surface in a rim of four cubics.
/// @param file  written: the face as Open CASCADE keeps it (.brep)
SeededFace saddle_face(const std::string& file, double quads);

/// Quads over a face.
struct SurfaceQuads {
    std::vector<Vec3> points;
    std::vector<Quad> quads;
    std::size_t triangles = 0; ///< left
    double seconds = 0;        ///< of the surface mesh alone, the outline being meshed
};

/// By the kernel: laid flat, paved, lifted.
SurfaceQuads lacuna_quads(const SeededFace& seeded);
/// By Gmsh, on the same file with as many sides on its curves.
SurfaceQuads gmsh_quads(const SeededFace& seeded, const GmshWay& way);

/// How good quads over a face are, by the measures of `measure_plane()` taken in space.
///
/// Corners are measured between their sides, their sign is that of the face's own normal. The row's height is
/// taken across the boundary side in the plane of the quad's corner normals.
struct SurfaceQuality {
    quads::PlaneQuality quads;
    int least_irregular = 0; ///< by the sum rule, from the angles of the mesh's own rim
    double off_surface = 0;  ///< largest distance of an inner node from the exact surface [model length]
    std::string fault;       ///< what makes them no mesh of the face; empty where nothing does
};

SurfaceQuality measure_surface(const SurfaceQuads& mesh, const SeededFace& seeded);
/// The same of any face of a model, for one size all over; how far off the surface is not looked at.
SurfaceQuality measure_face(const SurfaceQuads& mesh, const topology::Model& model, FaceId face, double size);

} // namespace lacuna::bench
