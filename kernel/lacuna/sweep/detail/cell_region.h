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

/// The part of a mesh that is worked on, with numbers of its own: nodes that may move first, then those that
/// hold it.
struct CellRegion {
    std::vector<Hex> cells; ///< by the region's node numbers
    std::vector<Vec3> box;  ///< of each cell: its mean edges when the work began
    /// Of each cell: the scaled Jacobian that is good enough, or the best its held nodes allow.
    std::vector<double> aim;
    std::vector<Index> node;    ///< mesh node of each node
    std::size_t free = 0;       ///< nodes that may move
    std::vector<Index> surface; ///< of each free node; -1: inside
    mesh::Incidence uses;       ///< of each free node: 8 · cell + corner
};

/// Cells that are poor for no fault of the nodes that stay, and `rings` of neighbours.
/// A corner can be no better than the angle between two of its edges that cannot move.
CellRegion poor_region(const mesh::HexMesh& mesh, const ImproveOptions& options, const Sliding& sliding,
                       const RunContext& context);

/// The first cell without volume that nodes that stay keep so: two of a corner's sides lie in one line.
std::optional<StuckCorner> stuck_corner(const mesh::HexMesh& mesh, const Sliding& sliding);

/// What is known of a region's cells.
struct RegionQuality {
    double least = 1; ///< scaled Jacobian; 0 at most where a cell is not certified positive
    double mean = 1;
    double lacking = 0; ///< sum over the cells of what they fall short of their aims
};

RegionQuality measure(const CellRegion& region, const std::vector<Vec3>& places, const RunContext& context);

/// Sum of the cells' energies and its gradient by the free nodes, which for nodes that slide lies along their
/// surface. Parallel; sums are made in an order that does not depend on the threads.
class RegionEnergy {
public:
    /// @param places  of the region's nodes; the held ones are used, the free ones come with each call.
    RegionEnergy(const CellRegion& region, std::vector<Vec3> places, const RunContext& context);

    CellEnergy energy;

    double operator()(const Eigen::VectorXd& x, Eigen::VectorXd& gradient);
    [[nodiscard]] double least_determinant(const Eigen::VectorXd& x);
    /// Turn the planes in which nodes slide along the skin at `x`.
    void set_planes(const Eigen::VectorXd& x);

private:
    void put(const Eigen::VectorXd& x);

    const CellRegion& region_;
    const RunContext& context_;
    std::vector<Vec3> places_;
    std::vector<Vec3> slopes_; ///< of each use
    std::vector<Vec3> normal_; ///< of the surface at each free node; nought inside
};

} // namespace lacuna::sweep
