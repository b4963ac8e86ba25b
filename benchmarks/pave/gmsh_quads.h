// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "support/plane_domains.h"

#include <cstddef>
#include <string>
#include <vector>

namespace lacuna::bench {

/// How Gmsh is asked for quads.
struct GmshWay {
    int algorithm = 6;     ///< 6: frontal, 8: frontal for quads along a cross field
    int recombination = 3; ///< 0: greedy, 1: Blossom, 2 and 3: the same to all quads by a division into four
    bool subdivision = false; ///< triangles and quads cut at their middles
};

struct GmshQuads {
    quads::PlanarQuads mesh;
    std::size_t triangles = 0; ///< left
    double seconds = 0;        ///< of the surface mesh alone, the outline being meshed
};

/// Gmsh's quads over a domain, with the same nodes on its outline.
GmshQuads gmsh_quads(const test::PlaneDomain& domain, const test::SeededDomain& seeded, const GmshWay& way);

/// A plane face of a CAD file as a domain of the plane.
/// @param face  Gmsh's tag of it
test::PlaneDomain face_domain(const std::string& file, int face);

} // namespace lacuna::bench
