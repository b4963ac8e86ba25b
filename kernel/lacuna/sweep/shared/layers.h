// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/mesh/quad_mesh.h>
#include <lacuna/sweep/shared/rim_columns.h>

#include <span>
#include <string>
#include <vector>

namespace lacuna::sweep {

/// The method by which the inside of the layers was placed.
enum class Placement { straight, affine, fitted };

struct PlacementOptions {
    bool straight_lines = false; ///< nodes lie on straight lines from source to target: class I of Roca and
                                 ///< Sarrate (2010)
    std::vector<double> heights; ///< layers + 1 numbers from 0 to 1; empty: from the columns' lengths [-]
};

/// Node coordinates of all layers.
struct LayerNodes {
    std::vector<Vec3> nodes; ///< (layers + 1) × source.nodes, layer-major from the source [model length]
    Placement placement = Placement::affine;
    std::string report; ///< one line of text: the method and the residual
};

/// Place the nodes of every layer between the source and the target mesh.
///
/// - Tier 1: if affine motions relate the rims exactly, these place the layers.
/// - Tier 2: otherwise, a two-sided least-squares affine fit with pseudo-normals (Roca and Sarrate 2010).
/// - Tier 3: the distances of the rim nodes from this fit are spread harmonically over the inside of the
///   source mesh. The Laplacian is factored once.
///
/// The placements from both ends are blended by height. Layers are placed in parallel. The Laplacian has
/// finite-volume weights: equal weights folded every graded mesh tried, and were no better on uniform ones.
///
/// @param target  position of each source node on the target.
/// @post  rim nodes are those of the columns, and the first and last layer are the given ends, bit for bit.
///         The result is the same for any thread count.
/// @throw InvalidInput  the columns do not fit the source or the target; names the node.
LayerNodes place_layers(const mesh::QuadMesh& source, std::span<const Vec3> target, const RimColumns& columns,
                        const PlacementOptions& options = {}, const RunContext& context = {});

} // namespace lacuna::sweep
