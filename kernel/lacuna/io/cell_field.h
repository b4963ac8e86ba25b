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

/// A value for every hexahedron, such as its quality. In files, each quad of the skin gets the value of its
/// hexahedron, because readers expect a value for every element.
struct CellField {
    std::string name; ///< no quotes, no line ends
    std::vector<double> values;
    /// Alternative to `values`: writes the values of the cells with the given numbers to `out`. It must give
    /// the same values in every call. Several threads call it at once while the file is written.
    std::function<void(std::span<const std::uint32_t> cells, double* out)> make{};
};

/// @throw InvalidInput  a field has the wrong number of values, or a name that cannot be written or is used
///        twice.
void check_fields(const mesh::HexMesh& mesh, const std::vector<CellField>& fields);

/// The hexahedron of every quad of the skin; quads are numbered as in `mesh::skin_quad()`.
std::vector<std::uint32_t> cells_of_skin(const mesh::HexMesh& mesh);

} // namespace lacuna::io
