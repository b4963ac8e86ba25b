// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/sweep/detail/harmonic_spread.h>

#include <Eigen/Core>

#include <cstddef>
#include <span>

namespace lacuna::sweep {

/// The affine map of an inner layer, before the rim residual is added: from_source · source node +
/// from_target · target node + shift.
struct LayerMap {
    Eigen::Matrix3d from_source, from_target;
    Vec3 shift;
};

/// Compute nodes [begin, end) of some layers, with their residuals.
///
/// A layer's result is bit-identical for any vector width, and independent of the other layers of the call.
/// @param maps       maps of up to `HarmonicSpread::kFields` layers
/// @param residuals  null: none
/// @param out        the first node of the first layer; each next layer begins `stride` nodes later
void map_nodes(std::span<const LayerMap> maps, const Vec3* source, const Vec3* target, std::size_t begin,
               std::size_t end, const HarmonicSpread::Fields* residuals, Vec3* out, std::size_t stride);

} // namespace lacuna::sweep
