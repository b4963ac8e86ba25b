// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/mesh/quad_mesh.h>
#include <lacuna/sweep/carry.h>
#include <lacuna/sweep/columns.h>
#include <lacuna/sweep/harmonic_spread.h>

#include <Eigen/Core>

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace lacuna::sweep {

/// How the inside of the layers was found.
enum class Placement { straight, affine, fitted, normals };

struct PlacementOptions {
    bool straight_lines = false; ///< Class I: nodes on the straight line between their ends
    std::vector<double> heights; ///< layers + 1 numbers from 0 to 1; empty: from the columns' lengths [-]
    bool spread_residual = true; ///< false: the affine fit alone, for comparison
};

/// Node coordinates of all layers.
struct LayerNodes {
    std::vector<Vec3> nodes; ///< (layers + 1) × source.nodes, layer-major from the source
    Placement placement = Placement::affine;
    std::string report; ///< one line for a person: which method, which residual
};

/// Place the nodes of every layer between the source and the target mesh.
///
/// Tier 1: rims related by an affine motion exactly. Tier 2: two-sided least-squares affine fit with
/// pseudo-normals (Roca and Sarrate 2010). Tier 3: rim residual spread harmonically over the source mesh
/// (factored once), both ends blended by height. Layers go in parallel. The weights of the Laplacian are those of finite
/// volumes: equal ones folded every graded mesh tried, and were no better on even ones.
///
/// @param target  position of each source node on the target.
/// @post  rim nodes are those of the columns and end layers those given, bit for bit; same result for any thread count.
/// @throw InvalidInput  columns that do not fit the source or the target; names the node.
LayerNodes place_layers(const mesh::QuadMesh& source, std::span<const Vec3> target, const Columns& columns,
                        const PlacementOptions& options = {}, const RunContext& context = {});

/// `place_layers()` for those who take the layers a few at a time: fits and factors once, then places any layer alone.
/// Refers to the source, the target and the columns; they must outlive it.
class LayerPlacer {
public:
    LayerPlacer(const mesh::QuadMesh& source, std::span<const Vec3> target, const Columns& columns,
                const PlacementOptions& options = {});

    /// Nodes of layers [first, last), 0 the source and `columns.layers` the target: bit for bit those of `place_layers()`.
    /// @param out  (last - first) × source.nodes, layer-major.
    void place(int first, int last, std::span<Vec3> out, const RunContext& context = {}) const;

    [[nodiscard]] Placement placement() const { return placement_; }
    [[nodiscard]] std::string report() const;

private:
    /// An inner layer before its residual: from_source · source node + from_target · target node + shift.
    struct Motion {
        Eigen::Matrix3d from_source, from_target;
        Vec3 shift;
    };
    void fit_straight(std::span<const double> heights);
    void fit_rims(std::span<const double> heights, const PlacementOptions& options);

    const mesh::QuadMesh& source_;
    std::span<const Vec3> target_;
    const Columns& columns_;
    Placement placement_ = Placement::affine;
    double residual_ = 0;                  ///< largest distance of a rim node from its fit [model length]
    double size_ = 0;                      ///< across the rim where that was found [model length]
    std::vector<Motion> motions_;          ///< of the inner layers 1 … layers - 1
    std::vector<Vec3> residuals_;          ///< of the inner layers' rims; only where fitted
    std::optional<HarmonicSpread> spread_; ///< only where fitted
};

} // namespace lacuna::sweep
