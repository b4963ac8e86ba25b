// SPDX-License-Identifier: MIT
#include <lacuna/mesh/layered_nodes.h>

#include <utility>

namespace lacuna::mesh {

HexMesh make_layers(const LayeredMesh& layered, int first, int last, HexMesh before,
                    const RunContext& context)
{
    const HexMesh& whole = layered.mesh;
    HexMesh cells = std::move(before);
    if (cells.quads.empty()) {
        cells.nodes_per_layer = whole.nodes_per_layer;
        cells.quads = whole.quads;
        cells.middles = whole.middles;
    }
    cells.layers = last - first;
    cells.nodes.resize(corner_count(cells));
    layered.nodes.place(first, last + 1, cells.nodes, context);
    if (cells.order() == 1) return cells;
    cells.middles.nodes.resize(middle_count(cells));
    layered.nodes.place_middles(first, last, cells.middles.nodes, context);
    return cells;
}

} // namespace lacuna::mesh
