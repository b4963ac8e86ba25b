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
enum class Placement { straight, affine, fitted, normals };

struct PlacementOptions {
    bool straight_lines = false; ///< Class I: nodes on the straight line between their ends
    std::vector<double> heights; ///< layers + 1 numbers from 0 to 1; empty: from the columns' lengths [-]
    bool spread_residual = true; ///< false: the affine fit alone, for comparison
};

/// Node coordinates of all layers.
struct LayerNodes {
    std::vector<Vec3> nodes; ///< (layers + 1) × source.nodes, layer-major from the source [model length]
    Placement placement = Placement::affine;
    std::string report; ///< one line of text: the method and the residual
};

/// Place the nodes of every layer between the source and the target mesh.
///
/// Tier 1: rims related by an affine motion exactly. Tier 2: two-sided least-squares affine fit with
/// pseudo-normals (Roca and Sarrate 2010). Tier 3: the rim residual spread harmonically over the source mesh
/// (factored once), both ends blended by height. Layers are placed in parallel. The Laplacian has
/// finite-volume weights: equal ones folded every graded mesh tried, and were no better on even ones.
///
/// @param target  position of each source node on the target.
/// @post  rim nodes are those of the columns and end layers those given, bit for bit; same result for any
///        thread count.
/// @throw InvalidInput  columns that do not fit the source or the target; names the node.
LayerNodes place_layers(const mesh::QuadMesh& source, std::span<const Vec3> target, const RimColumns& columns,
                        const PlacementOptions& options = {}, const RunContext& context = {});

} // namespace lacuna::sweep
