// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/mesh/hex_mesh.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace lacuna::io {

/// A number for every hexahedron, by its number: its quality, say. In files a quad of the skin carries the
/// number of the cell it belongs to, as readers want a value for every cell they meet.
struct CellField {
    std::string name; ///< no quotes, no line ends
    std::vector<double> values;
    /// Instead of them: puts the values of some cells, by their numbers, at `out`; the same each time. Called
    /// while the file is written, by several threads at once.
    std::function<void(std::span<const std::uint32_t> cells, double* out)> make{};
};

/// @throw InvalidInput  a field has not a value for every hexahedron, or no name that can be written,
///                      or another's.
void check_fields(const mesh::HexMesh& mesh, const std::vector<CellField>& fields);

/// The cell every quad of the skin belongs to, by number of the quad as in `mesh::skin_quad()`.
std::vector<std::uint32_t> cells_of_skin(const mesh::HexMesh& mesh);

} // namespace lacuna::io
