// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/fill/volume.h>
#include <lacuna/io/deck_file.h>
#include <lacuna/mesh/cell_shape.h>
#include <lacuna/mesh/tet_mesh.h>
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

/// A volume, or a piece of one, that was filled with tetrahedra and pyramids.
struct FilledTets {
    mesh::TetPart mesh;
    std::vector<Index> number; ///< of each of its nodes in the whole mesh, from 0
    std::size_t shared = 0;    ///< number of sides of its skin that meshes before it have
    std::string region;
    quality::Quality quality;        ///< from the proof
    sweep::Fidelity fidelity;        ///< the skin against the sealed skin
    std::vector<FaceId> faces;       ///< face of each patch of the skin, in the volume's model
    std::vector<std::string> report; ///< why it was not swept, sizes, shape
};

/// The mesh of an assembly, or of a volume that was cut or filled with tetrahedra.
struct FilledParts {
    sweep::SweptAssembly swept;         ///< its `nodes` count those of `tets` too
    std::vector<std::string> regions;   ///< one for each part; the pieces of a full turn share one
    std::vector<std::string> materials; ///< one for each part, then for each of `tets`; empty: no material
    std::vector<sweep::LeftOut> left_out;
    std::vector<FilledTets> tets;
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
    /// Corners; for wedges see `mesh::is_wedge()`, for pyramids and tetrahedra `mesh::has_apex()`.
    std::vector<Hex> hexes;
    std::vector<mesh::CellNodes> curved; ///< at order 2: all nodes, as `mesh::merged_nodes()`
    std::vector<Index> column;           ///< column that each cell belongs to, numbered over all parts
};
WholeCells whole_cells(const FilledParts& mesh);

/// All parts as one deck for `io::write_deck()`, with groups as regions and sets: how a mesh with tetrahedra
/// is written.
/// @pre  the parts store their nodes.
/// @param interfaces  as `io::MeshFileOptions::interfaces`
/// @throw  as `io::write_parts()`
io::Deck whole_deck(const FilledParts& mesh, const io::MeshDeckOptions& options, bool interfaces = false,
                    const RunContext& context = {});

quality::Quality measure(const WholeCells& cells, const RunContext& context = {});

/// The coordinates of a node, by its number in the whole mesh. @pre node < mesh.swept.nodes
Vec3 node(const FilledParts& mesh, std::size_t node);

/// Number of hexahedra, wedges, pyramids or tetrahedra. @param shape  hex8, wedge6, pyramid5 or tet4
std::size_t cell_count(const FilledParts& mesh, mesh::CellShape shape);

/// The corners of a cell, by its number among those of its shape; parts are counted in order.
/// @pre  number < cell_count(mesh, shape)
mesh::CellNodes cell(const FilledParts& mesh, mesh::CellShape shape, std::size_t number);

} // namespace lacuna::fill
