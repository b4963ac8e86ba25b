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
    std::string material; ///< of the volume
};

/// The mesh of an assembly, or of a volume that was cut.
struct FilledParts {
    sweep::SweptAssembly swept;
    std::vector<std::string> regions;   ///< of each part; pieces of a full turn have one
    std::vector<std::string> materials; ///< of each part; empty ones: none
    std::vector<sweep::LeftOut> left_out;
};

/// A mesh, and the volumes as they were swept.
struct Filled {
    std::vector<Volume> volumes;
    std::variant<FilledVolume, FilledParts> mesh;
};

/// The sweeps that a mesh is of: one, or one of each part.
std::span<const sweep::Swept> parts(const FilledVolume& mesh);
std::span<const sweep::Swept> parts(const FilledParts& mesh);
std::span<const sweep::Swept> parts(const Filled& filled);

/// The lines of a mesh's report, those of parts after the name of their region.
std::vector<std::string> report(const FilledParts& mesh);

/// A part, or the parts of a full turn.
struct Region {
    std::string name;
    int layers = 0;
    sweep::Fidelity fidelity;
};
/// In the order of the parts.
std::vector<Region> regions(const FilledParts& mesh);

/// Of all parts, without faces.
sweep::Fidelity fidelity(const FilledParts& mesh);

struct Group {
    std::string name;
    int dim = 3;
    std::size_t cells = 0;
};
/// The groups of the skin, then those of cells.
std::vector<Group> groups(const FilledVolume& mesh);
std::vector<Group> groups(const FilledParts& mesh);

/// The nodes and cells of all parts, numbered as one mesh.
struct WholeCells {
    std::vector<Vec3> nodes;
    std::vector<Hex> hexes;              ///< corners; wedges as `mesh::is_wedge()` has them
    std::vector<mesh::CellNodes> curved; ///< of order 2: all nodes
    std::vector<Index> column;           ///< that each cell is of, numbered over all parts
};
WholeCells whole_cells(const sweep::SweptAssembly& swept);

quality::Quality measure(const WholeCells& cells, const RunContext& context = {});

/// The place of a node of the whole. @pre node < swept.nodes
Vec3 node(const sweep::SweptAssembly& swept, std::size_t node);

/// The corners of a cell by its number among hexahedra or among wedges, those of one part after the other.
/// @pre  there is one.
Hex cell(const sweep::SweptAssembly& swept, bool wedge, std::size_t number);

} // namespace lacuna::fill
