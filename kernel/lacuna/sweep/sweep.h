// SPDX-License-Identifier: MIT
#pragma once

// In: one or several sealed volumes with options; out: hexahedra and wedges that were proved valid, and a
// report.
//
// Where to change things:
//   checks of options                          check_options.cpp
//   candidates of a single sweep, their trial  plans.cpp, sweep.cpp; steps of one: sweep_between.cpp
//   heights of layers, sizes by default        plan_heights.cpp, heights.cpp, volume_share.cpp
//   source quads; their outline                source_quads.cpp, mean_outline.cpp
//   source mesh on the target                  morph.cpp, morph_ends.cpp
//   inner nodes of layers                      layers.cpp; on demand: layer_plan.cpp
//   thickness of boundary layers               keep_thickness.cpp
//   improving cells: when, which, how          prove_or_improve.cpp, cell_region.cpp, improve.cpp
//   given meshes of walls and rims             given_meshes.cpp
//   middle nodes of order 2                    second_order.cpp, middle_placer.cpp, side_middles.cpp
//   skin against the sealed skin               fidelity.cpp, compare_face.cpp
//   quads turned around an axis                turn_at_axis.cpp
//   quads without layers                       shell_quads.cpp
//   assembly: steps; order of members          assembly.cpp, assembly_order.cpp
//   assembly: shared faces, gaps               shared_faces.cpp, assembly_imprint.cpp, near_misses.cpp
//   assembly: lines through members            carry_lines.cpp
//   assembly: which edges are the same         same_edges.cpp
//   assembly: numbers of sides                 edge_counts.cpp; heights of layers: assembly_levels.cpp
//   assembly: places of edge nodes             assembly_plan.cpp
//   assembly: common node numbers              assembly_nodes.cpp; periodic faces: periodic.cpp

#include <lacuna/core/run_context.h>
#include <lacuna/mesh/hex_mesh.h>
#include <lacuna/mesh/layered_nodes.h>
#include <lacuna/mesh/tet_mesh.h>
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

/// Distribution of layer heights.
enum class Spacing { geometric, bell, both_ends };

struct LayerSpec {
    /// Number of layers, >= 1. With 0, the number follows from `heights`, from the rows of given meshes on
    /// walls, or from the length of the sweep and the size. If the size varies along the sweep, the layer
    /// heights vary with it.
    int count = 0;
    /// Ratio of layer heights, > 0 [-]: last / first (geometric), middle / end (bell), end / middle
    /// (both_ends).
    double bias = 1;
    Spacing spacing = Spacing::geometric;
    /// Heights instead of a count: increasing numbers in (0, 1]; the last one is 1 within rounding errors.
    std::vector<double> heights;
};

/// @throw InvalidInput  the count is negative, the bias is not positive, or the heights do not increase to 1.
void check(const LayerSpec& spec);

/// Heights in [0, 1] of every layer's nodes: layers + 1 numbers from 0 to 1.
/// @throw InvalidInput  as `check()`, or the bias is so far from 1 that some layers have no height.
/// @pre  a count of at least 1, or heights.
std::vector<double> layer_heights(const LayerSpec& spec);

/// How source faces are meshed.
enum class Quads { automatic, paved, mapped, gmsh, keep };

/// Nodes of periodic faces, and the positions that make them exact images of each other.
struct SettledNodes {
    std::set<FaceId> faces; ///< the periodic faces; all nodes of these faces are then fixed
    std::vector<std::pair<Index, Vec3>> nodes; ///< node and new position; only where nodes are stored
};

/// Constraints from neighbouring volumes of an assembly.
struct Beside {
    /// Called with each mesh before it is proved, and with the face of each of its patches. Not null if the
    /// volume is part of an assembly.
    std::function<SettledNodes(const mesh::SkinNodes&, const std::vector<FaceId>&)> settle;
    /// The shape with which the skin is compared; its faces have the ids of the volume's faces. Null: the
    /// volume.
    const topology::OpenVolume* shape = nullptr;
    /// The volume as it was given, before it got nodes and quads of its neighbours; its faces have the ids of
    /// the volume's faces. The report counts its given nodes in the mesh. Null: the volume.
    const topology::OpenVolume* given = nullptr;
    /// Faces between this volume and others, which are not part of the outer skin; see `FidelityOptions`.
    std::set<FaceId> between{};
    /// Faces with quads copied from a neighbour. These quads are kept whatever the option `quads` is.
    std::set<FaceId> handed{};
    /// Whether the volume itself may have given meshes; true if unknown. If so, errors may suggest to load
    /// the volume without its meshes.
    bool own_mesh = true;
};

/// Action for a volume that cannot be meshed with hexahedra only.
enum class Fallback {
    none,      ///< an error
    wedges,    ///< repeat with `SweepOptions::wedges`
    leave_out, ///< leave it out and mesh the other volumes of an assembly; an error for a single volume
    mixed      ///< as `leave_out`, for a caller that fills the volume with tetrahedra: `fill::sweep()`
};

/// Default number of quads across a narrow place of the source, and of layers. Paving meets a size only on
/// average: with a default of three, all tested places (rings and channels 0.02 to 1 wide) had at least two
/// quads across; with a default of two, half of them had only one.
inline constexpr int kDefaultGap = 3;

struct SweepOptions {
    LayerSpec layers;
    surface::SizeField size; ///< null: `surface::default_size()`, smaller in narrow places; see `kDefaultGap`
    int curvature = 12;      ///< least number of sides for a full turn, >= 0; 0: the size alone decides
    /// Allowed volume error because of straight sides on bends, as a share of the volume [0, 1). If the error
    /// is larger, bends get more sides as long as these reduce it. 0: no sides are added.
    double volume_share = 0.02;
    /// Minimum number of quads across a narrow place of the source, >= 0; 0: no minimum, or 3 if no size is
    /// given.
    int gap = 0;
    /// Allowed distance between the skins, >= 0 [model length]; 0: default of `FidelityOptions`.
    double max_deviation = 0;
    Quads quads = Quads::automatic;
    /// Whether given triangles of an end are kept and swept to wedges. A rim whose sides are all given and
    /// odd in number then gets one triangle. If false, given triangles are an error, and a side of such an
    /// odd rim is split.
    bool wedges = false;
    Fallback fallback = Fallback::none;
    int rows = 0; ///< exact rows along every loop of the source, >= 0; only with `quads` automatic or paved
    surface::SizeField row_height; ///< height of these rows; null: the size
    /// Tables of thin rows of cells along walls and ends. A face may be in one table only.
    std::vector<surface::BoundaryLayer> boundary_layers;
    std::vector<surface::Interval> intervals; ///< requested numbers of sides
    /// Pairs of faces that get the same mesh. Applied by `sweep_assembly()`, also for a single volume.
    std::vector<surface::PeriodicPair> periodic;
    quads::PlanarQuadMesher quad_mesher; ///< the mesher of `Quads::gmsh`
    mesh::TetMesher tet_mesher;          ///< the mesher of `Fallback::mixed`
    int order = 1;                       ///< order of the cells: 1 or 2
    SecondOrderOptions second_order;     ///< options of order 2
    double min_scaled_jacobian = 0;      ///< lower bound for accepted meshes [0, 1]
    bool improve = true;                 ///< move nodes of folded or poor cells
    ImproveOptions improving;            ///< limits of that improvement
    Beside beside;                       ///< constraints in an assembly, set by `sweep_assembly()`
    /// Whether nodes of layers may be generated only when they are written; see `Swept::layers`.
    bool layered = false;
    const Crew* crew = nullptr; ///< processes that help with generated layers; null: none
};

/// Check options before any work is done. `sweep()` calls this itself; a host may call it first.
/// @throw InvalidInput  layers, improving, min_scaled_jacobian, curvature, volume_share, gap or max_deviation
///         is out of range; rows are negative, or combined with quads that are not paved; a row height is
///         given without rows; boundary layers or intervals have invalid lengths or counts, or are combined
///         with rows; the context has less than 0 or more than 1024 threads. The message names the option,
///         and the allowed and the given value.
void check(const SweepOptions& options, const RunContext& context = {});

/// Hexahedra with their proof and report.
struct Swept {
    mesh::HexMesh mesh;
    /// The generator of the nodes that `mesh` does not hold. Set with `SweepOptions::layered` if the layers
    /// are good as placed. Such a mesh is proved and compared like all others.
    std::optional<mesh::LayeredNodes> layers;
    std::shared_ptr<const LayerPlan> plan; ///< the plan by which `layers` are placed
    double min_scaled_jacobian = 1;
    quality::Quality quality;        ///< quality of the cells, from the proof
    Fidelity fidelity;               ///< the skin against the sealed skin
    std::vector<FaceId> faces;       ///< face of each patch of the skin, in the volume's model
    std::vector<char> held;          ///< nodes of boundary layers, which must not move; empty: none
    std::vector<std::string> report; ///< a line for each stage: seeds, quads, walls, target, layers, shape
    /// Lines of the report on default sizes, on given sizes that the shape reduces, and on default numbers of
    /// layers. `sweep()` also logs these lines; for volumes of an assembly, `sweep_assembly()` does.
    std::vector<std::string> defaults;
    /// Lines on poor cells and on a changed volume. They are logged like `defaults`, after "note: ".
    std::vector<std::string> notes;
    std::vector<std::string> not_kept; ///< the lines of the report on given meshes that are not kept

    [[nodiscard]] mesh::SkinNodes skin() const { return {mesh, layers ? &*layers : nullptr}; }
};

/// Mesh a sealed volume with hexahedra, and with wedges if requested. The sealed walls determine which parts
/// of the ends correspond.
///
/// Given meshes of faces are kept, node for node: the source's quads, rows of quads on walls, the target's
/// quads if they are connected like the source's, and the nodes of the rims of all these. The report counts
/// the kept nodes. Given triangles become cells too on a face with given quads and, with `wedges`, on a face
/// that keeps its nodes. Other triangles only define the shape of their face, whose inside is remeshed. With
/// an explicit option such as `Quads::paved`, all faces are remeshed.
///
/// Edges between the faces of an end, and edges around or up the walls, become chains of mesh edges. The
/// sweep runs from source to target. If that gives poor cells, a sweep from target to source is tried, and a
/// sweep with the source's quads laid out in the mean of both ends' outlines. The report states the choice,
/// and `mesh` counts its layers from the end where the sweep starts.
/// @throw InvalidInput   as `check()`; or a size is not a positive length, or there are too many cells to
///         number.
/// @throw NotSweepable   names the face, wall or cells, the expected and the actual value, and a remedy. With
///         boundary layers, as `surface::rim_rows()`, `seed_source()` and `mesh_source()`, and
///         "sweep.layers_thickness"  the rows cannot be placed at the requested thickness.
/// @post  the mesh is proved: conformal, skin closed, every Jacobian certified positive, its skin on the
///        sealed skin within `max_deviation`.
Swept sweep(const topology::OpenVolume& volume, const SweepOptions& options, const RunContext& context = {});

} // namespace lacuna::sweep
