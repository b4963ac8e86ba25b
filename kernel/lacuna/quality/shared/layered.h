// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/core/shared/team.h>
#include <lacuna/mesh/layered_nodes.h>
#include <lacuna/quality/quality.h>

#include <Eigen/Geometry>

#include <optional>
#include <span>
#include <vector>

namespace lacuna::quality {

/// Extent of the nodes of some consecutive layers (a slab).
struct SlabPlace {
    Index not_finite = -1; ///< a node that is not finite; the box is then not set; -1: none
    Eigen::AlignedBox3d bounds;
    /// Axes of the box as rows; the first points from the lowest level to the highest.
    Eigen::Matrix3d frame = Eigen::Matrix3d::Identity();
    Eigen::AlignedBox3d box; ///< bounding box of the nodes in this frame
};

/// Quality of a mesh whose nodes are computed on demand, and the extents of its slabs.
struct MeasuredLayers {
    Quality quality;
    std::vector<SlabPlace> slabs; ///< in order from the source
};

/// Measure a mesh whose nodes are computed on demand, some layers at a time. The result is that of
/// `measure()`, but sums may differ in the last digits. Memory does not depend on the number of layers. A
/// team of processes shares the layers. Each process gets the whole result, which does not depend on the
/// number of processes.
/// @throw Cancelled; TeamFailed
MeasuredLayers measure(const mesh::LayeredMesh& layered, const RunContext& context = {},
                       const Team* team = nullptr);

/// Mean cell volume of a mesh whose nodes are computed on demand. If this mean is passed to `metric_values()`
/// for some of the layers, the values of these layers have the same bits as in the whole mesh. A team shares
/// the work as in `measure()`.
/// @throw Cancelled; TeamFailed
double mean_volume(const mesh::LayeredMesh& layered, const RunContext& context = {},
                   const Team* team = nullptr);

/// Find a node that is not finite, or two coincident nodes, of a mesh whose nodes are computed on demand. A
/// team shares the work as in `measure()`.
///
/// Each slab is searched together with the next one. Two slabs that are not neighbours are compared only if
/// their boxes overlap, as at a sharp bend, and only their nodes inside both boxes are compared. If these
/// nodes do not fit into memory at once, they are computed again in parts.
/// @param slabs  from `measure()`
/// @throw Cancelled; TeamFailed
std::optional<Finding> find_misplaced(const mesh::LayeredMesh& layered, std::span<const SlabPlace> slabs,
                                      const RunContext& context = {}, const Team* team = nullptr);

/// Prove that a mesh whose nodes are computed on demand is valid, with the checks of `prove()`.
/// @param measured   the quality from `measure()`
/// @param misplaced  the result of `find_misplaced()`
Proof prove(const mesh::LayeredMesh& layered, Quality measured, std::optional<Finding> misplaced,
            double min_scaled_jacobian = 0);

} // namespace lacuna::quality
