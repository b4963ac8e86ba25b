// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/mesh/hex_mesh.h>

#include <string>
#include <vector>

namespace lacuna::test {

/// What is wrong with a mesh, found in the plainest way and without `quality::prove()`: every side of a cell
/// is hashed, Jacobians are sampled, the volume within the skin is set against that of the cells.
std::vector<std::string> faults(const mesh::HexMesh& mesh);

/// The check every test that makes a mesh ends with: no faults.
void check_valid(const mesh::HexMesh& mesh);

} // namespace lacuna::test
