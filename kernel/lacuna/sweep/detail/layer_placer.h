// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/sweep/detail/harmonic_spread.h>
#include <lacuna/sweep/detail/layer_map.h>
#include <lacuna/sweep/shared/layers.h>

#include <Eigen/Core>

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace lacuna::sweep {

/// `place_layers()` in steps: the constructor computes the fits and the factorisation once, and `place()`
/// then places any layers. The source, the target and the columns must outlive this object.
class LayerPlacer {
public:
    /// @param room  memory for all layers. A second thread clears its pages during the factorisation, which
    ///         uses only one thread.
    LayerPlacer(const mesh::QuadMesh& source, std::span<const Vec3> target, const RimColumns& columns,
                const PlacementOptions& options = {}, const RunContext& context = {},
                std::span<Vec3> room = {});

    /// Place the nodes of layers [first, last); layer 0 is the source and layer `columns.layers` the target.
    /// The nodes are bit-identical to those of `place_layers()`.
    /// @param out  (last - first) × source.nodes, layer-major.
    void place(int first, int last, std::span<Vec3> out, const RunContext& context = {}) const;

    [[nodiscard]] Placement placement() const { return placement_; }
    [[nodiscard]] std::string report() const;

private:
    void fit_straight(std::span<const double> heights);
    void fit_rims(std::span<const double> heights, const RunContext& context, std::span<Vec3> room);

    const mesh::QuadMesh& source_;
    std::span<const Vec3> target_;
    const RimColumns& columns_;
    Placement placement_ = Placement::affine;
    double residual_ = 0;        ///< largest distance of a rim node from its fit [model length]
    double size_ = 0;            ///< diameter of the rim with that residual [model length]
    std::vector<LayerMap> maps_; ///< maps of the inner layers 1 … layers - 1
    /// Residuals of the inner layers' rims; empty if affine motions are exact.
    std::vector<Vec3> residuals_;
    std::optional<HarmonicSpread> spread_; ///< spreads the residuals; empty if there are none
};

} // namespace lacuna::sweep
