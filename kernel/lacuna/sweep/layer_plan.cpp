// SPDX-License-Identifier: MIT
#include <lacuna/sweep/detail/placed_layers.h>

#include <lacuna/sweep/detail/layer_placer.h>

#include <memory>
#include <utility>

namespace lacuna::sweep {

namespace {

/// What a placer refers to, and the placer.
struct Placed {
    mesh::QuadMesh source;
    std::vector<Vec3> target;
    RimColumns columns;
    std::vector<Index> on_rim; ///< of each source node, its place on the rim; -1: inside
    LayerPlacer placer;

    Placed(mesh::QuadMesh own_source, std::vector<Vec3> own_target, RimColumns own_columns,
           const PlacementOptions& options)
        : source(std::move(own_source)),
          target(std::move(own_target)),
          columns(std::move(own_columns)),
          on_rim(source.nodes.size(), -1),
          placer(source, target, columns, options)
    {
        for (std::size_t k = 0; k < columns.rim.size(); ++k)
            on_rim[index(columns.rim[k])] = static_cast<Index>(k);
    }

    [[nodiscard]] Vec3 on_skin(Index node) const
    {
        const auto row = static_cast<Index>(source.nodes.size());
        const int level = node / row;
        const std::size_t at = index(node % row);
        if (on_rim[at] >= 0) return columns.row(level)[index(on_rim[at])];
        return level == 0 ? source.nodes[at] : target[at];
    }
};

} // namespace

PlacedLayers placed_layers(mesh::QuadMesh source, std::vector<Vec3> target, RimColumns columns,
                           const PlacementOptions& options)
{
    const auto placed = std::make_shared<const Placed>(std::move(source), std::move(target),
                                                       std::move(columns), options);
    PlacedLayers result;
    result.placement = placed->placer.placement();
    result.report = placed->placer.report();
    result.nodes.place = [placed](int first, int last, std::span<Vec3> out, const RunContext& context) {
        placed->placer.place(first, last, out, context);
    };
    result.nodes.on_skin = [placed](Index node) { return placed->on_skin(node); };
    return result;
}

} // namespace lacuna::sweep
