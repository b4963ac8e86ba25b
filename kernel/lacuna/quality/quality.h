// SPDX-License-Identifier: MIT
#pragma once

// In: a mesh or a list of cells; out: metrics, and a proof that the mesh is valid or the first fault in it.
//
// Where to change things:
//   conditions of a valid mesh            prove.cpp; of a list of cells: prove_cells.cpp
//   statistics of cells                   measure.cpp; their table: text.cpp
//   scaled Jacobian, Bézier coefficients  cell_batch.cpp; wedges: wedge.cpp
//   pyramids and tetrahedra               other_cells.cpp
//   whether a Jacobian is positive        positive.cpp
//   cells of order 2                      curved_cell.cpp
//   Verdict's metrics                     metrics.cpp; their formulas: cell_metrics.cpp
//   coincident nodes                      coincident.cpp
//   nodes that are computed on demand     layered.cpp

#include <lacuna/core/message.h>
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

/// Smallest scaled Jacobian at the eight corners of a hexahedron, as in Verdict but without the centre.
/// Between -1 and 1; 1 for a cube.
double scaled_jacobian(std::span<const Vec3, 8> corners);

/// True if the Jacobian of the trilinear map is positive in the whole cell.
///
/// Algorithm: Bézier coefficients of the Jacobian (Johnen, Weill and Remacle 2017). If all 27 coefficients
/// are positive, the cell is valid. If the coefficient at a corner is not positive, the cell is invalid.
/// Otherwise the cell is subdivided, at most `max_depth` times. If this does not decide, the cell counts as
/// invalid.
bool certified_positive(std::span<const Vec3, 8> corners, int max_depth = 6);

/// Verdict's scaled Jacobian of a wedge (nodes as in `mesh::Wedge`), times 2/√3. It is 1 for a right prism on
/// an equilateral triangle.
double wedge_scaled_jacobian(std::span<const Vec3, 6> corners);

/// Whether the Jacobian of a wedge is positive everywhere, decided as by `certified_positive()`. The Jacobian
/// is linear over the triangle and quadratic along the height; it has nine Bernstein coefficients.
bool wedge_certified_positive(std::span<const Vec3, 6> corners, int max_depth = 6);

/// One of the worst cells of a mesh.
struct WorstCell {
    std::size_t cell = 0; ///< from 0
    int layer = -1;       ///< from 0; -1 for a list of cells
    Vec3 centre{0, 0, 0};
    double scaled_jacobian = 0;
};

struct Quality {
    std::size_t hexes = 0;  ///< hexahedra
    std::size_t wedges = 0; ///< wedges; they count in all values below
    double min_scaled_jacobian = 1;
    double mean_scaled_jacobian = 1;
    std::size_t inverted = 0;                ///< cells with a scaled Jacobian <= 1e-12 (rounding) at a corner
    std::size_t uncertified = 0;             ///< cells whose Jacobian is not proved positive everywhere
    std::array<std::size_t, 20> histogram{}; ///< counts by scaled Jacobian, in twenty equal bins over [-1, 1]
    std::vector<WorstCell> worst;            ///< at most ten, worst first; at most one of each column
    double volume = 0;                       ///< sum over the cells [model length³]
    /// The scaled Jacobian of every cell, if requested from `measure()`; else null.
    std::shared_ptr<const std::vector<float>> of_cells;
    std::size_t pyramids = 0; ///< pyramids and tetrahedra count in all values above, as wedges do
    std::size_t tets = 0;     ///< tetrahedra
    /// The smallest scaled Jacobian of the hexahedra, wedges, pyramids and tetrahedra; 1 if there are none.
    std::array<double, 4> least_by_kind{1, 1, 1, 1};

    [[nodiscard]] std::size_t cells() const { return hexes + wedges + pyramids + tets; }
};

/// Which results `measure()` stores.
enum class Keep {
    sums,    ///< statistics only
    of_cells ///< also the scaled Jacobian of each cell of a mesh of order 1, for writing: 4 bytes a cell
};

/// Measure every cell of a mesh. Curved cells of order 2 are measured by `judge()`
/// (`quality/second_order.h`), all others by their corners. Parallel; the result is the same for any number
/// of threads. O(cells).
/// @pre  every corner is a valid node number (`prove()` checks it).
Quality measure(const mesh::HexMesh& mesh, const RunContext& context = {}, Keep keep = Keep::sums);

/// `measure()` for a list of cells. Wedges, pyramids and tetrahedra are stored as hexahedra with merged
/// corners (see `mesh::is_wedge()`, and `mesh::has_apex()` in `mesh/tet_mesh.h`).
/// @param columns  the column of a sweep for each cell, for `Quality::worst`; empty: unknown.
Quality measure_cells(std::span<const Vec3> nodes, std::span<const Hex> hexes, const RunContext& context = {},
                      std::span<const Index> columns = {});

/// The quality as a table with a histogram.
std::string to_table(const Quality& quality);

/// Faults of a mesh.
enum class Fault {
    empty,            ///< no cells
    wrong_size,       ///< arrays of a swept mesh have wrong sizes
    unknown_node,     ///< a corner has an invalid node number
    patch_tag,        ///< a patch of the skin has no unique positive tag
    no_patch,         ///< a quad of the skin has no patch
    collapsed_side,   ///< a cell has the same node at two corners
    not_conformal,    ///< a side is used by more than two cells, or two cells do not match at it
    pinched,          ///< quads are connected at one node only
    unused_node,      ///< no cell uses a node
    open_skin,        ///< an edge of the skin does not belong to exactly two quads
    skin_differs,     ///< the given skin is not the skin of the cells
    not_finite,       ///< a coordinate is not finite
    coincident_nodes, ///< two nodes coincide
    inverted,         ///< cells with a scaled Jacobian <= 1e-12 at a corner
    not_certified,    ///< cells whose Jacobian is not proved positive everywhere
    below_limit,      ///< cells below the required scaled Jacobian
};

/// Stable name of a fault, for programs: "quality.not_conformal".
std::string fault_code(Fault fault);

/// Whether smoothing may remove the fault: cells inverted, not certified or below the limit.
bool can_be_improved(Fault fault);

/// A fault found in a mesh.
struct Finding {
    Fault fault;
    Message message; ///< names the nodes or cells, with layer and position; has the fault's code

    /// @param text  format string, as for `Message`
    template <class... Arguments>
    Finding(Fault of, Format<sizeof...(Arguments)> text, const Arguments&... arguments)
        : fault(of), message(fault_code(of), text, arguments...)
    {
    }
};

/// Result of a proof.
struct Proof {
    Quality quality;                ///< empty if the arrays are faulty
    std::optional<Finding> finding; ///< the first fault found; none: the mesh is valid
};

/// Prove that a mesh is valid. A valid mesh fulfils these conditions:
/// - it is conforming: each side is used once or twice;
/// - its skin is closed, and is the skin that its patches list;
/// - no nodes coincide or are unused;
/// - the Jacobian of every cell is certified positive, and no cell is below `min_scaled_jacobian`.
/// @note  O(cells).
Proof prove(const mesh::HexMesh& mesh, double min_scaled_jacobian = 0, const RunContext& context = {});

/// Throw the finding of a proof, if there is one.
/// @throw NotSweepable  with the finding's message.
void require(const Proof& proof);

} // namespace lacuna::quality
