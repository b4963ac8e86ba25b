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

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace lacuna::fill {

/// The mesh of one volume.
struct FilledVolume {
    sweep::Swept swept;
    std::string material; ///< material of the volume
    std::string unit{};   ///< as `Volume::unit`
    bool copied = false;  ///< whether moved() made the mesh: in an assembly, its nodes are then moved onto
                          ///< nodes of other members from which they differ by rounding only
    std::vector<io::ColumnSet> columns{}; ///< made from node sets on the source of a path
};

/// A volume, or a piece of one, that was filled with tetrahedra and pyramids.
struct FilledTets {
    mesh::TetPart mesh;
    std::vector<Index> number; ///< for each node of `mesh`, its number in the whole mesh, from 0
    std::size_t shared = 0;    ///< number of sides of its skin that it shares with meshes made before it
    std::string region;
    quality::Quality quality;        ///< measured when the mesh was proved
    sweep::Fidelity fidelity;        ///< distances between its skin and the sealed skin
    std::vector<FaceId> faces;       ///< face of each patch of the skin, in the volume's model
    std::vector<std::string> report; ///< why it was not swept, its sizes and its shape
};

/// Zero-thickness cells between two regions of a mesh, whose nodes are duplicated there.
struct SplitInterface {
    std::string region;  ///< name of the cells
    std::string element; ///< their Abaqus name: "COH3D8"
    /// For each cell, its nodes in the whole mesh, in the order of the cell's shape. The bottom of a cell is
    /// a side of the first region.
    std::vector<mesh::CellNodes> cells;
};

/// Faces of two regions that touch, or face each other within a gap, without common nodes.
struct Contact {
    std::array<std::string, 2> regions;    ///< in the order of the members
    std::vector<std::array<int, 2>> faces; ///< tags of the faces that come together
    double gap = 0;                        ///< distance within which the faces were searched [model length]
    double least = 0, width = 0;           ///< smallest and largest distance between the faces within the gap
                                           ///< [model length]
    double area = 0;                       ///< area of the first region's faces within the gap [model
                                           ///< length²]
    mesh::ContactPair pair;                ///< the groups and the tolerance are set only for a mesh
};

/// The mesh of an assembly, or of a volume that was cut or filled with tetrahedra.
struct FilledParts {
    sweep::SweptAssembly swept;         ///< `nodes` also counts the nodes of `tets`
    std::vector<std::string> regions;   ///< one for each part; the pieces of a full turn share one
    std::vector<std::string> materials; ///< one for each part, then for each of `tets`; empty: no material
    std::vector<sweep::LeftOut> left_out;
    std::vector<FilledTets> tets;
    std::vector<SplitInterface> interfaces{}; ///< from `split_interface()`
    std::vector<Contact> contacts{};
    std::string unit{};                   ///< as `Volume::unit`
    bool copied = false;                  ///< as in `FilledVolume`
    std::vector<io::ColumnSet> columns{}; ///< as in `FilledVolume`; `part` is the index in `swept.parts`
    /// After `split_interface()`: for each node, a part that contains the node, or a node at the same place,
    /// and the number of this node in the part. Without a split, empty.
    std::vector<std::array<Index, 2>> owner{};
};

/// A mesh, and the volumes with the roles that they were swept with.
struct Filled {
    std::vector<Volume> volumes;
    std::variant<FilledVolume, FilledParts> mesh;
};

/// The mesh of one volume as a mesh of parts, with this volume as its single part.
FilledParts as_parts(const FilledVolume& mesh);

/// The sweeps that produced a mesh: a single one, or one for each part.
std::span<const sweep::Swept> parts(const FilledVolume& mesh);
std::span<const sweep::Swept> parts(const FilledParts& mesh);
std::span<const sweep::Swept> parts(const Filled& filled);

/// The report of a mesh, one entry a line; lines about a part start with the name of its region.
std::vector<std::string> report(const FilledParts& mesh);

/// A part of the mesh, swept or of tetrahedra. The pieces of a full turn are one region.
struct Region {
    std::string name;
    int layers = 0;
    sweep::Fidelity fidelity;
};
/// The regions of a mesh, in the order of its parts.
std::vector<Region> regions(const FilledParts& mesh);

/// The fidelity of all parts together, without values of single faces.
sweep::Fidelity fidelity(const FilledParts& mesh);

struct Group {
    std::string name;
    int dim = 3;
    std::size_t cells = 0;
};
/// The groups of the skin, followed by the groups of cells.
std::vector<Group> groups(const FilledVolume& mesh);
std::vector<Group> groups(const FilledParts& mesh);

/// Store the nodes of all parts, also of parts with `layers`, which otherwise make their nodes on demand.
void hold_nodes(FilledParts& mesh, const RunContext& context = {});

/// The nodes and cells of all parts, numbered as one mesh.
struct WholeCells {
    std::vector<Vec3> nodes;
    /// Corners; for wedges see `mesh::is_wedge()`, for pyramids and tetrahedra `mesh::has_apex()`.
    std::vector<Hex> hexes;
    std::vector<mesh::CellNodes> curved; ///< at order 2: all nodes of each cell, see `mesh::merged_nodes()`
    std::vector<Index> column;           ///< column that each cell belongs to, numbered over all parts
};
WholeCells whole_cells(const FilledParts& mesh);

/// All parts as one deck for `io::write_deck()`, with groups as regions and sets. Meshes with tetrahedra are
/// written in this way.
/// @pre  the parts store their nodes.
/// @param interfaces  as `io::MeshFileOptions::interfaces`
/// @throw  the errors of `io::write_parts()`; InvalidInput "fill.interface_order"  the mesh has cells of zero
///         thickness of order 2, and the format has no such element.
io::Deck whole_deck(const FilledParts& mesh, const io::MeshDeckOptions& options, bool interfaces = false,
                    const RunContext& context = {});

/// A deck with the meshes that fill its voids.
struct JoinedDeck {
    io::Deck deck;
    std::vector<mesh::PeriodicNodes> periodic; ///< of the deck's points
};
/// Join the parts of a mesh to a deck, one after the other, by `io::join_deck()`. Nodes that parts share in
/// the mesh are also shared in the deck. Contacts and sets of columns are added to the deck, too.
/// @param model, scale, gone as for `io::join_deck()`; `gone` is null if nothing was left out.
JoinedDeck joined_deck(const io::Deck& deck, const topology::Model& model, double scale,
                       const FilledParts& mesh, io::MeshDeckOptions options, const io::Deck* gone = nullptr,
                       const RunContext& context = {});

/// Faces along which a mesh is split.
struct InterfaceFaces {
    std::vector<std::string> groups{}; ///< faces of these groups that two parts share
    /// Faces between these two regions.
    std::vector<std::pair<std::string, std::string>> pairs{};
    bool all = false; ///< faces between any two regions
    /// Levels at which to split the mesh of a single sweep. A level is the number of layers below it: at
    /// least 1, and less than the number of layers.
    std::vector<int> levels{};
    std::string region = "interface";
    /// Abaqus name of the cells: COH3D8 or GK3D8, or a variant of one of them. "NONE": nodes are duplicated,
    /// and there are no cells.
    std::string element = "COH3D8";
};

/// Split a mesh along cell sides that two parts share: duplicate the nodes, and insert a zero-thickness
/// (cohesive) cell at each side.
///
/// Nodes: at each node, two parts stay connected if they share a side that is not split. Each connected set
/// of parts gets its own node: three regions that meet at split sides get three nodes. If the interface ends
/// inside the mesh, all parts around its end stay connected, so nodes there are not duplicated. Existing
/// nodes keep their numbers; duplicates are numbered after them. Duplicates on a periodic face are paired
/// with nodes of the part at the image of that face.
///
/// Cells: nodes 1 to 4 of a cohesive cell lie on the part that was meshed first. The stacking direction of
/// the cell is from nodes 1-4 to nodes 5-8. At order 2, middle nodes are duplicated in the same way, and the
/// cells have 20 or 27 nodes: there is a further node between each pair of opposite nodes, which cells with
/// the same pair share. Mixed elements have their multipliers at these further nodes.
///
/// Levels: a mesh that is split at levels becomes one part between each two levels. The cell sides on level k
/// form two groups: those of the part below are `level_k:target`, those of the part above `level_k:source`.
/// @throw InvalidInput "fill.interface_none"     no face is named, or no named face is shared by two parts.
///                     "fill.interface_element"  the element is not a zero-thickness one (COH3D8, GK3D8).
///                     "fill.interface_levels"   a level is not inside the mesh, or the mesh has several
///                                               parts.
///                     "fill.interface_split"    the mesh was split before.
/// @note  O(n log n) in the sides of the skins, O(n) in the nodes.
FilledParts split_interface(FilledParts mesh, InterfaceFaces faces, const RunContext& context = {});

quality::Quality measure(const WholeCells& cells, const RunContext& context = {});

/// The coordinates of a node, by its number in the whole mesh. @pre node < mesh.swept.nodes
Vec3 node(const FilledParts& mesh, std::size_t node);

/// Number of hexahedra, wedges, pyramids or tetrahedra. @param shape  hex8, wedge6, pyramid5 or tet4
std::size_t cell_count(const FilledParts& mesh, mesh::CellShape shape);

/// The corners of a cell, by its number among those of its shape; parts are counted in order.
/// @pre  number < cell_count(mesh, shape)
mesh::CellNodes cell(const FilledParts& mesh, mesh::CellShape shape, std::size_t number);

} // namespace lacuna::fill
