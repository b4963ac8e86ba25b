// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/core/team.h>
#include <lacuna/mesh/layered_nodes.h>
#include <lacuna/quality/quality.h>

#include <Eigen/Geometry>

#include <optional>
#include <span>
#include <vector>

namespace lacuna::quality {

/// Where the nodes of some layers, made together, lie.
struct SlabPlace {
    Index not_finite = -1; ///< a node that has no finite place, after which nothing else is known; -1: none
    Eigen::AlignedBox3d bounds;
    /// Axes as rows, the first from the lowest level to the highest.
    Eigen::Matrix3d frame = Eigen::Matrix3d::Identity();
    Eigen::AlignedBox3d box; ///< in that frame
};

/// What is found of a mesh whose nodes are made while they are there.
struct MeasuredLayers {
    Quality quality;
    std::vector<SlabPlace> slabs; ///< from the source up
};

/// `measure()` of a mesh whose nodes are made when they are asked for: each layer once, some layers at a
/// time. Sums may differ from those of `measure()` in the last digits. Memory does not depend on the layers.
/// A team shares the layers; what is found is the same for any number, and each of the team gets it.
/// @throw Cancelled; TeamFailed
MeasuredLayers measure(const mesh::LayeredMesh& layered, const RunContext& context = {},
                       const Team* team = nullptr);

/// The mean volume of such a mesh's cells, by which `metric_values()` of some of its layers are those of the
/// whole mesh, to the bit; shared by a team as `measure()`.
/// @throw Cancelled; TeamFailed
double mean_volume(const mesh::LayeredMesh& layered, const RunContext& context = {},
                   const Team* team = nullptr);

/// A node of such a mesh that is not finite, or two in one place; shared by a team as `measure()`.
///
/// Nodes in one place are sought among layers next to each other, and, where boxes of layers further apart
/// meet, as those of a sharp bend do, among the nodes in both boxes: layers are made anew for each share of
/// these that has room at once.
/// @param slabs  of `measure()`
/// @throw Cancelled; TeamFailed
std::optional<Finding> find_misplaced(const mesh::LayeredMesh& layered, std::span<const SlabPlace> slabs,
                                      const RunContext& context = {}, const Team* team = nullptr);

/// `prove()` of such a mesh: the same checks.
/// @param measured   the quality that measure() found
/// @param misplaced  find_misplaced() in it
Proof prove(const mesh::LayeredMesh& layered, Quality measured, std::optional<Finding> misplaced,
            double min_scaled_jacobian = 0);

/// `prove()` of a mesh whose cells were measured since its nodes last moved: they are not measured again.
/// @param measured  what `measure()` found; nothing: they are measured.
Proof prove(const mesh::HexMesh& mesh, std::optional<Quality> measured, double min_scaled_jacobian,
            const RunContext& context = {});

} // namespace lacuna::quality
