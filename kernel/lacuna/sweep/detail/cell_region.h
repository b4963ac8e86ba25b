// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/mesh/hex_mesh.h>
#include <lacuna/mesh/shared/incidence.h>
#include <lacuna/sweep/detail/cell_energy.h>
#include <lacuna/sweep/improve.h>

#include <Eigen/Core>

#include <functional>
#include <optional>
#include <vector>

namespace lacuna::sweep {

/// The cells of one mesh, or of several meshes with common nodes.
struct CellsView {
    const std::vector<Vec3>& nodes;
    std::size_t count = 0;
    std::function<Hex(std::size_t)> hex;

    [[nodiscard]] std::size_t cell_count() const { return count; }
};

/// The part of a mesh that is improved, with node numbers of its own: first the free nodes, then the fixed
/// nodes around them.
struct CellRegion {
    std::vector<Hex> cells; ///< corners of each cell, by the region's node numbers
    std::vector<Vec3> box;  ///< for each cell: its initial mean edges
    /// For each cell, the scaled Jacobian to reach. Fixed nodes may make it less than the required quality.
    std::vector<double> aim;
    std::vector<Index> node;    ///< for each node of the region, its number in the mesh
    std::size_t free = 0;       ///< nodes that may move
    std::vector<Index> surface; ///< for each free node, the surface that it slides on; -1: inside
    mesh::Incidence uses;       ///< for each free node, its cells as 8 · cell + corner
};

/// Select poor cells whose quality is not already at the bound set by their fixed nodes, and `rings` rings of
/// cells around them. The angle between two fixed edges bounds the quality of the corner between them.
CellRegion poor_region(const CellsView& mesh, const std::vector<char>& locked, const ImproveOptions& options,
                       const Sliding& sliding, const RunContext& context);

/// Improve the cells of a region around poor cells (`improve()`); moves `nodes`, of which `cells` is a view.
Improved improve_cells(std::vector<Vec3>& nodes, const CellsView& cells, const std::vector<char>& locked,
                       const ImproveOptions& options, const Sliding& sliding, const RunContext& context);

/// The nodes of a mesh that are fixed: those of the skin that do not slide.
std::vector<char> locked_nodes(const mesh::HexMesh& mesh, const Sliding& sliding);

/// The first cell that has no volume because of fixed nodes: two of its sides that meet in a corner are
/// collinear.
std::optional<StuckCorner> stuck_corner(const mesh::HexMesh& mesh, const Sliding& sliding);

/// Quality of a region's cells.
struct RegionQuality {
    double least = 1; ///< minimum scaled Jacobian; 0 or less if a cell is not certified positive
    double mean = 1;
    double lacking = 0; ///< sum over the cells of the amount by which they miss `CellRegion::aim`
    double folded = 0;  ///< sum over the cells with negative scaled Jacobians of their absolute values
};

RegionQuality measure(const CellRegion& region, const std::vector<Vec3>& places, const RunContext& context);

/// Sum of the cells' energies, and its gradient with respect to the free nodes. For sliding nodes the
/// gradient is tangential to the surface. Runs in parallel; the order of summation does not depend on the
/// number of threads.
class RegionEnergy {
public:
    /// @param places  positions of the region's nodes. Only those of fixed nodes are used, because free nodes
    ///         are passed to each call.
    RegionEnergy(const CellRegion& region, std::vector<Vec3> places, const RunContext& context);

    CellEnergy energy;

    double operator()(const Eigen::VectorXd& x, Eigen::VectorXd& gradient);
    [[nodiscard]] double least_determinant(const Eigen::VectorXd& x);
    /// Update the tangent planes of sliding nodes to the skin at `x`.
    void set_planes(const Eigen::VectorXd& x, const Sliding& sliding);

private:
    void put(const Eigen::VectorXd& x);

    const CellRegion& region_;
    const RunContext& context_;
    std::vector<Vec3> places_;
    std::vector<Vec3> slopes_; ///< gradient at each use of a free node
    std::vector<Vec3> normal_; ///< normal of the surface at each free node; zero inside
    std::vector<Vec3> along_;  ///< direction of the curve at each free node; zero: it is on none
};

} // namespace lacuna::sweep
