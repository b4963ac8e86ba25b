// SPDX-License-Identifier: MIT
#include <lacuna/sweep/shared/layer_plan.h>

#include <lacuna/quality/shared/layered.h>
#include <lacuna/sweep/detail/layer_placer.h>
#include <lacuna/sweep/detail/middle_placer.h>

#include <memory>
#include <utility>

namespace lacuna::sweep {

namespace {

/// A plan, and the data that are computed from it to place its nodes.
struct Placed {
    std::shared_ptr<const LayerPlan> plan;
    std::vector<Index> on_rim; ///< for each source node, its index on the rim; -1: inside
    LayerPlacer placer;

    Placed(std::shared_ptr<const LayerPlan> own, const RunContext& context)
        : plan(std::move(own)),
          on_rim(plan->source.nodes.size(), -1),
          placer(plan->source, plan->target, plan->columns, plan->options, context)
    {
        const std::vector<Index>& rim = plan->columns.rim;
        for (std::size_t k = 0; k < rim.size(); ++k) on_rim[index(rim[k])] = static_cast<Index>(k);
    }

    [[nodiscard]] Vec3 on_skin(Index node) const
    {
        const auto row = static_cast<Index>(plan->source.nodes.size());
        const int level = node / row;
        const std::size_t at = index(node % row);
        if (on_rim[at] >= 0) return plan->columns.row(level)[index(on_rim[at])];
        return level == 0 ? plan->source.nodes[at] : plan->target[at];
    }
};

template <class A, class Plan>
void put_plan(A& with, Plan& plan)
{
    with(plan.source.nodes), with(plan.source.quads), with(plan.source.loops), with(plan.target);
    with(plan.columns.layers), with(plan.columns.rim), with(plan.columns.points);
    with(plan.options), with(plan.middles);
}

/// The cells of a plan's mesh, without node positions.
mesh::HexMesh cells_of(const LayerPlan& plan)
{
    mesh::HexMesh mesh = cells_over(plan.source, plan.columns.layers);
    mesh.middles = middles_of(plan, mesh);
    return mesh;
}

/// The data from which the middle nodes of a plan are placed.
struct Curved {
    std::shared_ptr<const LayerPlan> plan;
    mesh::LayeredNodes corners;
    mesh::HexMesh mesh;
    MiddlePlacer placer;

    Curved(std::shared_ptr<const LayerPlan> own, mesh::LayeredNodes nodes, const RunContext& context)
        : plan(std::move(own)),
          corners(std::move(nodes)),
          mesh(cells_of(*plan)),
          placer({mesh, &corners}, plan->middles->skin, context)
    {
    }
    Curved(const Curved&) = delete;
    Curved& operator=(const Curved&) = delete;

    [[nodiscard]] Vec3 on_skin(Index node) const
    {
        const std::size_t all = mesh::corner_count(mesh);
        return index(node) < all ? corners.on_skin(node) : placer.on_skin(index(node) - all);
    }
};

/// The layers of `nodes`, with the plan's middle nodes added.
mesh::LayeredNodes curved_nodes(mesh::LayeredNodes nodes, const std::shared_ptr<const LayerPlan>& plan,
                                const RunContext& context)
{
    if (!plan->middles) return nodes;
    const auto curved = std::make_shared<const Curved>(plan, nodes, context);
    nodes.on_skin = [curved](Index node) { return curved->on_skin(node); };
    nodes.place_middles = [curved](int first, int last, std::span<Vec3> out, const RunContext& own) {
        curved->placer.place(first, last, out, own);
    };
    return nodes;
}

/// Measure the share of the layers that this process of a team is responsible for.
LayersFound find_in_share(const PlacedLayers& layers, double least, const Team* team,
                          const RunContext& context)
{
    const mesh::HexMesh mesh = cells_of(*layers.plan);
    const mesh::LayeredMesh layered{mesh, layers.nodes};
    LayersFound found;
    quality::MeasuredLayers measured = quality::measure(layered, context, team);
    found.quality = std::move(measured.quality);
    found.good_enough = found.quality.inverted == 0 && found.quality.uncertified == 0 &&
                        found.quality.min_scaled_jacobian >= least;
    if (found.good_enough) found.misplaced = quality::find_misplaced(layered, measured.slabs, context, team);
    return found;
}

} // namespace

mesh::HexMesh cells_over(const mesh::QuadMesh& source, int layers)
{
    mesh::HexMesh mesh;
    mesh.nodes_per_layer = static_cast<Index>(source.nodes.size());
    mesh.layers = layers;
    mesh.quads = source.quads;
    for (const mesh::BoundarySide& side : mesh::boundary_sides(mesh.quads))
        mesh.rim.push_back({side.from, side.to});
    return mesh;
}

PlacedLayers placed_layers(std::shared_ptr<const LayerPlan> plan, const RunContext& context)
{
    const auto placed = std::make_shared<const Placed>(plan, context);
    PlacedLayers result;
    result.plan = std::move(plan);
    result.report = placed->placer.report();
    result.nodes.place = [placed](int first, int last, std::span<Vec3> out, const RunContext& own) {
        placed->placer.place(first, last, out, own);
    };
    result.nodes.on_skin = [placed](Index node) { return placed->on_skin(node); };
    result.nodes = curved_nodes(std::move(result.nodes), result.plan, context);
    return result;
}

PlacedLayers with_middles(PlacedLayers layers, MiddlePlan middles, const RunContext& context)
{
    auto plan = std::make_shared<LayerPlan>(*layers.plan);
    plan->middles = std::move(middles);
    layers.plan = std::move(plan);
    layers.nodes = curved_nodes(std::move(layers.nodes), layers.plan, context);
    return layers;
}

mesh::MiddleNodes middles_of(const LayerPlan& plan, const mesh::HexMesh& cells)
{
    return plan.middles ? mesh::number_sides(cells, plan.middles->full) : mesh::MiddleNodes{};
}

void put(Writer& writer, const LayerPlan& plan) { put_plan(writer, plan); }
void put(Reader& reader, LayerPlan& plan) { put_plan(reader, plan); }

LayersFound find_in_layers(const PlacedLayers& layers, double least, const Crew* crew,
                           const RunContext& context)
{
    if (crew == nullptr) return find_in_share(layers, least, nullptr, context);
    Writer writer;
    put(writer, *layers.plan), writer(least);
    const Team& team = crew->call(kLayersTask, std::move(writer).take());
    LayersFound found;
    do_together(&team, [&] { found = find_in_share(layers, least, &team, context); });
    return found;
}

void help_find_in_layers(const std::string& bytes, const Team& team, const RunContext& context)
{
    auto plan = std::make_shared<LayerPlan>();
    double least = 0;
    Reader reader(bytes);
    put(reader, *plan), reader(least);
    reader.finish();
    static_cast<void>(find_in_share(placed_layers(std::move(plan), context), least, &team, context));
}

} // namespace lacuna::sweep
