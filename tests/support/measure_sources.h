// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/surface/shared/source_mesh.h>

namespace lacuna::test {

/// How good quads over all source faces together are: as one mesh in space.
struct UnionQuality {
    std::size_t quads = 0, triangles = 0;
    double min_scaled_jacobian = 1; ///< by the sines of corners in space, their sign that of the face there
    double mean_scaled_jacobian = 1;
    std::size_t interior = 0;  ///< nodes inside the union: those of edges that two source faces share too
    std::size_t irregular = 0; ///< of them, those with other than four quads
    std::size_t irregular_shared = 0;    ///< of them, those on edges that two source faces share
    int least_irregular = 0;             ///< by the sum rule over the union, from the angles of its rim
    std::size_t rows = 0, good_rows = 0; ///< sides of the rim, as `measure_plane()` counts them
    std::size_t shared_rows = 0, good_shared_rows = 0; ///< both sides of each side on a shared edge
    std::size_t edges = 0, edges_of_size = 0;          ///< 0.6 to 1.6 times as long as asked
    std::size_t bad_sides = 0; ///< used by three quads or more, or by two in one direction

    static double share(std::size_t part, std::size_t whole)
    {
        return whole == 0 ? 1 : double(part) / double(whole);
    }
};

/// @param size  asked for, the same all over [model length]
UnionQuality measure_union(const surface::SourceMesh& mesh, double size);

} // namespace lacuna::test
