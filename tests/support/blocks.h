// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/mesh/hex_mesh.h>

#include <functional>
#include <vector>

namespace lacuna::test {

/// A swept mesh of the unit cube, for tests of what comes after meshing.
struct BlockOptions {
    int columns = 3; ///< quads along x
    int rows = 3;    ///< quads along y
    int layers = 3;
    std::function<Vec3(const Vec3&)> map = nullptr;               ///< moves every node; none: the cube itself
    std::function<bool(int column, int row)> leave_out = nullptr; ///< quads that are not there
};

/// SkinPatches: 0 the source (tag 1), 1 the target (tag 2), 2 the walls (tag 3).
mesh::HexMesh block(const BlockOptions& options = {});

/// A tube: a source with a hole, `around` quads about it and two across.
mesh::HexMesh ring(int around, int layers);

/// The same with two wedges for every hexahedron over each `every`-th quad of the source.
mesh::HexMesh with_wedges(mesh::HexMesh mesh, std::size_t every = 3);

std::vector<Hex> all_hexes(const mesh::HexMesh& mesh);

} // namespace lacuna::test
