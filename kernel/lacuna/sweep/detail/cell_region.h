// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/mesh/hex_mesh.h>
#include <lacuna/mesh/shared/incidence.h>
#include <lacuna/sweep/detail/cell_energy.h>
#include <lacuna/sweep/improve.h>

#include <Eigen/Core>

#include <optional>
#include <vector>

namespace lacuna::sweep {

/// The part of a mesh that is improved, with its own numbering: free nodes first, then the fixed ones around
/// them.
struct CellRegion {
    std::vector<Hex> cells; ///< by the region's node numbers
    std::vector<Vec3> box;  ///< for each cell: its initial mean edges
    /// For each cell: the scaled Jacobian aimed at, limited by the cell's fixed nodes.
    std::vector<double> aim;
    std::vector<Index> node;    ///< mesh node of each node
    std::size_t free = 0;       ///< nodes that may move
    std::vector<Index> surface; ///< for each free node; -1: inside
    mesh::Incidence uses;       ///< for each free node: 8 · cell + corner
};

/// Poor cells whose fixed nodes allow a better quality, and `rings` of their neighbours. A corner cannot be
/// better than the angle between two fixed edges allows.
CellRegion poor_region(const mesh::HexMesh& mesh, const ImproveOptions& options, const Sliding& sliding,
                       const RunContext& context);

/// The first cell without volume due to fixed nodes: two sides of a corner are collinear.
std::optional<StuckCorner> stuck_corner(const mesh::HexMesh& mesh, const Sliding& sliding);

/// Quality of a region's cells.
struct RegionQuality {
    double least = 1; ///< scaled Jacobian; 0 at most where a cell is not certified positive
    double mean = 1;
    double lacking = 0; ///< sum over the cells of the shortfall from their targets
};

RegionQuality measure(const CellRegion& region, const std::vector<Vec3>& places, const RunContext& context);

/// Sum of the cells' energies, and its gradient by the free nodes; for sliding nodes the gradient is
/// tangential to the surface. Parallel; the order of summation does not depend on the number of threads.
class RegionEnergy {
public:
    /// @param places  positions of the region's nodes; only those of fixed nodes are used, because free ones
    ///          are passed to each call.
    RegionEnergy(const CellRegion& region, std::vector<Vec3> places, const RunContext& context);

    CellEnergy energy;

    double operator()(const Eigen::VectorXd& x, Eigen::VectorXd& gradient);
    [[nodiscard]] double least_determinant(const Eigen::VectorXd& x);
    /// Update the tangent planes of sliding nodes to the skin at `x`.
    void set_planes(const Eigen::VectorXd& x);

private:
    void put(const Eigen::VectorXd& x);

    const CellRegion& region_;
    const RunContext& context_;
    std::vector<Vec3> places_;
    std::vector<Vec3> slopes_; ///< for each use
    std::vector<Vec3> normal_; ///< of the surface at each free node; zero inside
};

} // namespace lacuna::sweep
