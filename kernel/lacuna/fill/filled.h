// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/fill/volume.h>
#include <lacuna/quality/quality.h>
#include <lacuna/sweep/assembly.h>
#include <lacuna/sweep/sweep.h>

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

namespace lacuna::fill {

/// The mesh of one volume.
struct FilledVolume {
    sweep::Swept swept;
    std::string material; ///< material of the volume
};

/// The mesh of an assembly, or of a volume that was cut.
struct FilledParts {
    sweep::SweptAssembly swept;
    std::vector<std::string> regions;   ///< one for each part; the pieces of a full turn share one
    std::vector<std::string> materials; ///< one for each part; empty: no material
    std::vector<sweep::LeftOut> left_out;
};

/// A mesh, and the volumes with the roles that they were swept with.
struct Filled {
    std::vector<Volume> volumes;
    std::variant<FilledVolume, FilledParts> mesh;
};

/// The sweeps that produced a mesh: a single one, or one for each part.
std::span<const sweep::Swept> parts(const FilledVolume& mesh);
std::span<const sweep::Swept> parts(const FilledParts& mesh);
std::span<const sweep::Swept> parts(const Filled& filled);

/// The report of a mesh, one entry a line; lines about a part start with the name of its region.
std::vector<std::string> report(const FilledParts& mesh);

/// One part, or all parts of one full turn.
struct Region {
    std::string name;
    int layers = 0;
    sweep::Fidelity fidelity;
};
/// The regions of a mesh, in the order of its parts.
std::vector<Region> regions(const FilledParts& mesh);

/// The fidelity of all parts together, without that of single faces.
sweep::Fidelity fidelity(const FilledParts& mesh);

struct Group {
    std::string name;
    int dim = 3;
    std::size_t cells = 0;
};
/// The groups of the skin, followed by the groups of cells.
std::vector<Group> groups(const FilledVolume& mesh);
std::vector<Group> groups(const FilledParts& mesh);

/// The nodes and cells of all parts, numbered as one mesh.
struct WholeCells {
    std::vector<Vec3> nodes;
    std::vector<Hex> hexes;              ///< corners; for wedges see `mesh::is_wedge()`
    std::vector<mesh::CellNodes> curved; ///< at order 2: all nodes of each cell
    std::vector<Index> column;           ///< column that each cell belongs to, numbered over all parts
};
WholeCells whole_cells(const sweep::SweptAssembly& swept);

quality::Quality measure(const WholeCells& cells, const RunContext& context = {});

/// The coordinates of a node, by its number in the whole mesh. @pre node < swept.nodes
Vec3 node(const sweep::SweptAssembly& swept, std::size_t node);

/// The corners of a cell, by its number among the hexahedra or among the wedges; parts are counted in order.
/// @pre  such a cell exists.
Hex cell(const sweep::SweptAssembly& swept, bool wedge, std::size_t number);

} // namespace lacuna::fill
