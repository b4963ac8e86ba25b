// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/mesh/hex_mesh.h>

#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace lacuna::quality {

/// Smallest scaled Jacobian over the eight corners of a hexahedron, Verdict's without the centre; -1…1, 1 for
/// a cube.
double scaled_jacobian(std::span<const Vec3, 8> corners);

/// True when the Jacobian of the trilinear map is positive everywhere in the cell.
///
/// Algorithm: Bézier coefficients of the Jacobian (Johnen, Weill and Remacle 2017): 27 coefficients, all
/// positive ⇒ valid; a corner not positive ⇒ invalid; else subdivided until decided or `max_depth`, then
/// invalid.
bool certified_positive(std::span<const Vec3, 8> corners, int max_depth = 6);

/// The same of a wedge, nodes as `mesh::Wedge`: Verdict's, times 2/√3, so that it is 1 for an even triangle
/// times a height.
double wedge_scaled_jacobian(std::span<const Vec3, 6> corners);

/// The same of a wedge, whose Jacobian is linear over the triangle and of degree two along the height: nine
/// Bernstein coefficients hold it.
bool wedge_certified_positive(std::span<const Vec3, 6> corners, int max_depth = 6);

/// A cell with what is wrong with it.
struct WorstCell {
    std::size_t cell = 0; ///< from 0
    int layer = -1;       ///< from 0; -1 where cells are a plain list
    Vec3 centre{0, 0, 0};
    double scaled_jacobian = 0;
};

struct Quality {
    std::size_t hexes = 0;  ///< hexahedra
    std::size_t wedges = 0; ///< and wedges, in all that follows too
    double min_scaled_jacobian = 1;
    double mean_scaled_jacobian = 1;
    std::size_t inverted = 0;                ///< cells with a corner that is not positive
    std::size_t uncertified = 0;             ///< cells whose Jacobian could not be shown positive everywhere
    std::array<std::size_t, 20> histogram{}; ///< of the scaled Jacobian, twenty equal bins over [-1, 1]
    std::vector<WorstCell> worst;            ///< at most ten, worst first, one of each column of a sweep
    double volume = 0;                       ///< sum over the cells [model length³]
    /// The scaled Jacobian of every cell, where `measure()` was to keep it; null: not kept.
    std::shared_ptr<const std::vector<float>> of_cells;
};

/// What `measure()` keeps.
enum class Keep {
    sums,    ///< what is known of all cells together
    of_cells ///< the scaled Jacobian of each cell of a mesh of order 1 too, which files have: 4 bytes a cell
};

/// Measure every cell; one of order 2 that is curved by `judge()` (`quality/second_order.h`). Parallel; the
/// same for any thread count. O(cells).
/// @pre  every corner is the number of a node (`prove()` checks it).
Quality measure(const mesh::HexMesh& mesh, const RunContext& context = {}, Keep keep = Keep::sums);

/// The same for hexahedra, and wedges as `mesh::is_wedge()` has them, of any origin.
/// @param columns  of sweeps, that of each cell, for `Quality::worst`; empty: none is known.
Quality measure_cells(std::span<const Vec3> nodes, std::span<const Hex> hexes, const RunContext& context = {},
                      std::span<const Index> columns = {});

/// As a table with a histogram.
std::string to_table(const Quality& quality);

/// What can be wrong with a mesh.
enum class Fault {
    empty,            ///< no cells
    wrong_size,       ///< arrays of a swept mesh that do not fit its counts
    unknown_node,     ///< a corner names no node
    patch_tag,        ///< a patch of the skin without a tag of its own
    no_patch,         ///< a quad of the skin that belongs to no patch
    collapsed_side,   ///< a side of a cell with a node twice
    not_conformal,    ///< a side used by more than two cells, or not alike in both
    pinched,          ///< quads that touch in one node alone
    unused_node,      ///< a node no cell uses
    open_skin,        ///< an edge of the skin without two quads
    skin_differs,     ///< the skin that was handed over is not that of the cells
    not_finite,       ///< a coordinate that is no number
    coincident_nodes, ///< two nodes in one place
    inverted,         ///< cells with a corner that is not positive
    not_certified,    ///< cells whose Jacobian could not be shown positive everywhere
    below_limit,      ///< cells below the least scaled Jacobian that was asked for
};

/// Stable name of a fault, for programs: "quality.not_conformal".
std::string fault_code(Fault fault);

/// Whether moving nodes may cure the fault: cells inverted, not certified or below the limit.
bool can_be_improved(Fault fault);

/// Something wrong with a mesh.
struct Finding {
    Fault fault;
    std::string message; ///< for a person: which nodes or cells, their layer and place, and what to try
};

/// What is known of a mesh that was to be proved.
struct Proof {
    Quality quality;                ///< of the cells; empty where the fault lies in the arrays themselves
    std::optional<Finding> finding; ///< the first fault met; none: the mesh is fit to be written
};

/// Prove a mesh fit to be written: conformal (every side of a cell used once or twice), skin closed and made
/// of exactly the patches, no node twice in one place or unused, every Jacobian certified positive. O(cells).
Proof prove(const mesh::HexMesh& mesh, double min_scaled_jacobian = 0, const RunContext& context = {});

/// Turn the finding of a proof, if there is one, into an error.
/// @throw NotSweepable  with the fault's code and the finding's message.
void require(const Proof& proof);

} // namespace lacuna::quality
