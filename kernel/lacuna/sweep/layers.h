// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/mesh/quad_mesh.h>

#include <functional>
#include <span>
#include <string>
#include <vector>

namespace lacuna::sweep {

/// The walls' node columns over the source rim.
struct Columns {
    int layers = 0;
    std::vector<Index> rim;    ///< source node under each column
    std::vector<Vec3> points;  ///< (layers + 1) × rim.size(), layer-major; row 0 is the source rim itself
};

/// Moves points onto the target surface, each to the closest place near where it is.
using SurfaceProjector = std::function<void(std::span<Vec3>)>;

/// Carry the source mesh to the target: rim nodes to the last row of the columns, the rest by the affine fit
/// of the rims and the harmonic residual, then onto the surface, then smoothed there where that betters it.
///
/// @return  target position of each source node [model length].
/// @post  rim nodes are those of the columns, bit for bit.
std::vector<Vec3> carry_to_target(const mesh::QuadMesh& source, const Columns& columns,
                                  const SurfaceProjector& project, const RunContext& context = {});

/// How the inside of the layers was found.
enum class Placement { straight, affine, fitted };

struct PlacementOptions {
    bool straight_lines = false;  ///< Class I: nodes on the straight line between their ends
};

/// Node coordinates of all layers.
struct LayerNodes {
    std::vector<Vec3> nodes;  ///< (layers + 1) × source.nodes, layer-major from the source
    Placement placement = Placement::affine;
    std::string report;       ///< one line for a person: which method, which residual
};

/// Place the nodes of every layer between the source and the target mesh.
///
/// Tier 1: rims related by an affine motion exactly. Tier 2: two-sided least-squares affine fit with
/// pseudo-normals (Roca and Sarrate 2010). Tier 3: rim residual spread harmonically over the source mesh
/// (uniform Laplacian, factored once), both ends blended by height. Layers go in parallel.
///
/// @param target  position of each source node on the target.
/// @post  rim nodes are those of the columns and end layers those given, bit for bit; same result for any thread count.
LayerNodes place_layers(const mesh::QuadMesh& source, std::span<const Vec3> target, const Columns& columns,
                        const PlacementOptions& options = {}, const RunContext& context = {});

} // namespace lacuna::sweep
