// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/fill.h>
#include <lacuna/quality/shared/metrics.h>

#include <cstddef>
#include <vector>

/// Nodes and cells of all kinds of meshes under the same names. `fill/filled.h` has those of `FilledParts`.
/// Shapes are those of order 1: tri3, quad4, hex8, wedge6, pyramid5 or tet4.
namespace lacuna::fill {

/// "hex", "wedge", "pyramid", "tet", "quad" or "triangle".
const char* shape_name(mesh::CellShape shape);

inline const FilledParts& as_parts(const FilledParts& mesh) { return mesh; }

/// Order of the cells, 1 or 2.
int order(const FilledVolume& mesh);
int order(const FilledParts& mesh);
int order(const FilledShell& mesh);

std::size_t node_count(const FilledVolume& mesh);
std::size_t node_count(const FilledParts& mesh);
std::size_t node_count(const FilledShell& mesh);

Vec3 node(const FilledVolume& mesh, std::size_t node);
Vec3 node(const FilledShell& mesh, std::size_t node);

std::size_t cell_count(const FilledVolume& mesh, mesh::CellShape shape);
std::size_t cell_count(const FilledShell& mesh, mesh::CellShape shape);

mesh::CellNodes cell(const FilledVolume& mesh, mesh::CellShape shape, std::size_t number);
mesh::CellNodes cell(const FilledShell& mesh, mesh::CellShape shape, std::size_t number);

std::vector<Group> groups(const FilledShell& mesh);

/// The coordinates of all nodes.
std::vector<Vec3> points(const FilledVolume& mesh);
std::vector<Vec3> points(const FilledParts& mesh);
std::vector<Vec3> points(const FilledShell& mesh);

/// The nodes of all cells of a shape, those at mid-sides too: rows of `columns` numbers from 1, in the order
/// of `cell()`.
struct CellRows {
    std::vector<Index> nodes;
    std::size_t columns = 0;
};
CellRows cell_rows(const FilledVolume& mesh, mesh::CellShape shape);
CellRows cell_rows(const FilledParts& mesh, mesh::CellShape shape);
CellRows cell_rows(const FilledShell& mesh, mesh::CellShape shape);

/// The values of a metric for each row of `cell_rows()`.
/// @throw InvalidInput "lua.bad_value"  the metric is defined for hexahedra only.
std::vector<double> cell_values(const FilledVolume& mesh, quality::Metric metric, mesh::CellShape shape,
                                const RunContext& context = {});
std::vector<double> cell_values(const FilledParts& mesh, quality::Metric metric, mesh::CellShape shape,
                                const RunContext& context = {});

} // namespace lacuna::fill
