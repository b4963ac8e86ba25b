// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/mesh/hex_mesh.h>
#include <lacuna/quads/region.h>
#include <lacuna/surface/size_field.h>
#include <lacuna/sweep/improve.h>
#include <lacuna/topology/open_volume.h>

#include <optional>
#include <string>
#include <vector>

namespace lacuna::sweep {

/// How layer heights are spread.
enum class Spacing { geometric, bell, both_ends };

struct LayerSpec {
    int count = 0; ///< hexes along the sweep, >= 1; 0 with `heights`
    double bias =
        1; ///< last / first layer height (geometric), middle / end (bell), end / middle (both_ends), > 0 [-]
    Spacing spacing = Spacing::geometric;
    std::vector<double> heights; ///< rising, in (0, 1], the last 1; instead of a count
};

/// Heights in [0, 1] of every layer's nodes: layers + 1 numbers from 0 to 1.
/// @throw InvalidInput  a count below 1, a bias that is not positive, heights that do not rise to 1.
std::vector<double> layer_heights(const LayerSpec& spec);

/// How source faces are meshed.
enum class Quads { automatic, paved, mapped, gmsh, keep };

/// How the inside of the layers is placed: the best that is known; or, for comparison, the affine fit alone, with the rim's
/// residual spread over it, or the paper's advance along local normals.
enum class Interior { automatic, affine, residual, normals };

struct SweepOptions {
    LayerSpec layers;
    surface::SizeField size; ///< null: from the rim's own spacing
    Quads quads = Quads::automatic;
    /// Rows of quads from every loop of the source that stay as they are laid; 0: none but what the paver lays. Paved faces alone.
    int rows = 0;
    surface::SizeField row_height;       ///< of those rows, one at least; null: the size
    quads::PlanarQuadMesher quad_mesher; ///< what `Quads::gmsh` calls for
    Interior interior = Interior::automatic;
    double min_scaled_jacobian = 0; ///< below it the mesh is refused [-1, 1]
    bool improve = true;            ///< move nodes where cells are folded or poor
    ImproveOptions improving;       ///< how far
};

/// Hexahedra and how they came about.
struct Swept {
    mesh::HexMesh mesh;
    double min_scaled_jacobian = 1;
    std::vector<std::string> report; ///< a line a stage: seeds, quads, walls, target, layers
};

/// Fill a sealed volume with hexahedra. What goes with what is read off the sealed walls.
/// @throw InvalidInput   options out of range.
/// @throw NotSweepable   names the face, wall or cells, what was expected and found, and what to try.
/// @post  the mesh is proved: conformal, skin closed, every Jacobian certified positive.
Swept sweep(const topology::OpenVolume& volume, const SweepOptions& options, const RunContext& context = {});

} // namespace lacuna::sweep
