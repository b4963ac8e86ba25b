// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/mesh/hex_mesh.h>
#include <lacuna/mesh/layered_nodes.h>
#include <lacuna/quads/region.h>
#include <lacuna/quality/quality.h>
#include <lacuna/surface/requests.h>
#include <lacuna/surface/size_field.h>
#include <lacuna/sweep/fidelity.h>
#include <lacuna/sweep/improve.h>
#include <lacuna/sweep/second_order_options.h>
#include <lacuna/topology/open_volume.h>

#include <functional>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace lacuna {
struct Crew;
}

namespace lacuna::sweep {

struct LayerPlan;

/// How layer heights are spread.
enum class Spacing { geometric, bell, both_ends };

struct LayerSpec {
    /// Hexes along the sweep, >= 1; 0 with `heights`, or for as many as the walls' own meshes have rows, else
    /// as the length of the sweep asks for at the size, which they follow where it changes along the sweep.
    int count = 0;
    /// Ratio of layer heights, > 0 [-]: last / first (geometric), middle / end (bell), end / middle
    /// (both_ends).
    double bias = 1;
    Spacing spacing = Spacing::geometric;
    /// Instead of a count: rising, in (0, 1], the last 1 up to the rounding of sums.
    std::vector<double> heights;
};

/// @throw InvalidInput  a count below 0, a bias that is not positive, heights that do not rise to 1.
void check(const LayerSpec& spec);

/// Heights in [0, 1] of every layer's nodes: layers + 1 numbers from 0 to 1.
/// @throw InvalidInput  what `check()` refuses; a bias so far from 1 that layers have no height.
/// @pre  a count of at least 1, or heights.
std::vector<double> layer_heights(const LayerSpec& spec);

/// How source faces are meshed.
enum class Quads { automatic, paved, mapped, gmsh, keep };

/// How the inside of the layers is placed.
enum class Interior {
    automatic, ///< the best that is known
    affine,    ///< for comparison: the affine fit alone
    residual,  ///< for comparison: the fit with the rim's residual spread over it
    normals,   ///< for comparison: the paper's advance along local normals
};

/// Nodes of the skin that a neighbour has in the same places but for rounding.
struct SettledNodes {
    std::set<FaceId> faces;                    ///< they are on; their nodes stay from then on
    std::vector<std::pair<Index, Vec3>> nodes; ///< and where the neighbour has them; some more than once
};

/// What a volume's neighbours in an assembly have to say to its sweep.
struct Beside {
    /// Null, or called with each mesh before it is proved, and with the face of each of its patches: finds
    /// nodes that are to be laid onto a neighbour's.
    std::function<SettledNodes(const mesh::SkinNodes&, const std::vector<FaceId>&)> settle;
    /// The shape that the skin is compared with, of the volume's faces; null: the volume itself.
    const topology::OpenVolume* shape = nullptr;
    /// Faces between this volume and others, which are skin of neither; see `FidelityOptions`.
    std::set<FaceId> between{};
    /// Faces whose quads a neighbour made: they stay, whatever way of meshing is named.
    std::set<FaceId> handed{};
};

/// What becomes of a volume that cannot be meshed with hexahedra alone.
enum class Fallback {
    none,     ///< it is an error
    wedges,   ///< it is tried again with `SweepOptions::wedges`
    leave_out ///< the other volumes of an assembly are meshed without it; alone it is an error
};

/// Quads asked for across a narrow place of the source, and least layers, where neither a size nor these are
/// asked for. Paving takes a size for what it is in the mean: for three there are two and more across, by two
/// half of the places tried had one (rings and channels 0.02 to 1 wide).
inline constexpr int kDefaultGap = 3;

struct SweepOptions {
    LayerSpec layers;
    surface::SizeField size; ///< null: `surface::default_size()`, and less as `kDefaultGap` says
    int curvature = 12;      ///< sides for a full turn where `size` is coarser, >= 0; 0: the size alone
    /// Where straight sides on bends leave the mesh's volume further off the sealed one than this share,
    /// bends get more sides, as far as that helps [0, 1); 0: never.
    double volume_share = 0.02;
    int gap = 0; ///< quads at least across a narrow place of the source, >= 0; 0: none, without a size 3
    /// How far the skin may be from the sealed skin, >= 0 [model length]; 0: what `FidelityOptions` says.
    double max_deviation = 0;
    Quads quads = Quads::automatic;
    /// Triangles that an end came with stay, and wedges stand on them. Where all sides of a rim are given and
    /// their number is odd, one triangle makes up for it. Without: such an end is an error, or a side is
    /// divided.
    bool wedges = false;
    Fallback fallback = Fallback::none;
    int rows = 0; ///< exact rows along every loop of the source, >= 0; needs quads automatic or paved
    surface::SizeField row_height; ///< of those rows; null: the size
    /// Thin rows of cells along walls and ends; a face is in one at most.
    std::vector<surface::BoundaryLayer> boundary_layers;
    std::vector<surface::Interval> intervals; ///< numbers of sides
    quads::PlanarQuadMesher quad_mesher;      ///< what `Quads::gmsh` calls for
    Interior interior = Interior::automatic;
    int order = 1;                   ///< of the cells: 1, or 2 for hex27
    SecondOrderOptions second_order; ///< of order 2
    double min_scaled_jacobian = 0;  ///< below it the mesh is refused [0, 1]
    bool improve = true;             ///< move nodes where cells are folded or poor
    ImproveOptions improving;        ///< how far
    Beside beside;                   ///< of volumes in an assembly, which sets it
    /// Whether the nodes of the layers may be left to be made when they are written: `Swept::layers`.
    bool layered = false;
    const Crew* crew = nullptr; ///< others who help with layers that are left to be made; null: nobody
};

/// Whether options can be used, before any work is done. `sweep()` asks it itself; a host may ask first.
/// @throw InvalidInput  names the option, what it must be and what was found: layers, improving,
///                      min_scaled_jacobian, curvature, volume_share, gap, max_deviation; rows below
///                      0 or of quads that are not paved, a row height
///                      without rows; boundary layers and intervals that are no lengths or counts, or go
///                      with rows; threads of the context below 0 or above 1024.
void check(const SweepOptions& options, const RunContext& context = {});

/// Hexahedra and how they came about.
struct Swept {
    mesh::HexMesh mesh;
    /// With `SweepOptions::layered`, where the layers came out good as they were placed: what makes the nodes
    /// that `mesh` does not hold. Proved and compared as all are.
    std::optional<mesh::LayeredNodes> layers;
    std::shared_ptr<const LayerPlan> plan; ///< what `layers` are placed by
    double min_scaled_jacobian = 1;
    quality::Quality quality;        ///< of the cells, as they were proved
    Fidelity fidelity;               ///< the skin against the sealed skin
    std::vector<FaceId> faces;       ///< of the volume's model, that of each patch of the skin
    std::vector<std::string> report; ///< a line a stage: seeds, quads, walls, target, layers, shape
    /// Those lines of the report that say which size and number of layers were taken where none was asked
    /// for, and that cells are poor with it. They are logged as well, once, of an assembly by whoever sweeps
    /// the whole.
    std::vector<std::string> defaults;

    [[nodiscard]] mesh::SkinNodes skin() const { return {mesh, layers ? &*layers : nullptr}; }
};

/// Fill a sealed volume with hexahedra, and with wedges where those are asked for. What goes with what is
/// read off the sealed walls.
///
/// Meshes that faces came with stay, node for node: the source's quads, rows of quads on walls, the target's
/// quads where they are laid out as the source's, and the nodes of all their rims. The report counts them.
/// What is a mesh and what a shape: a face that came with quads is a mesh, so that triangles among them are
/// cells too. A face of triangles alone is a shape, whose inside is meshed anew; with `wedges` it is a mesh
/// as well, if it keeps its nodes. Who names a way of meshing (`Quads::paved`) has all meshed anew.
///
/// Edges between the faces of an end, and those that run round the walls or up them, become chains of mesh
/// edges. The sweep runs from source to target, or back where that is better, or with the quads laid out
/// between both outlines where both are poor; the report says which, and `mesh` counts its layers from the
/// end it started at.
/// @throw InvalidInput   what `check()` refuses; a size that is no positive length, or too many cells to
///                       number.
/// @throw NotSweepable   names the face, wall or cells, what was expected and found, and what to try. With
///                       boundary layers what `surface::rim_rows()`, `seed_source()` and `mesh_source()`
///                       throw, and "sweep.layers_thickness": rows that could not have their thickness.
/// @post  the mesh is proved: conformal, skin closed, every Jacobian certified positive, its skin on the
///        sealed skin as far as `max_deviation` says.
Swept sweep(const topology::OpenVolume& volume, const SweepOptions& options, const RunContext& context = {});

} // namespace lacuna::sweep
