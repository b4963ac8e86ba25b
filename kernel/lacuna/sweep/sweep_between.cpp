// SPDX-License-Identifier: MIT
#include <lacuna/sweep/detail/sweep_between.h>

#include <lacuna/core/error.h>
#include <lacuna/core/shared/background.h>
#include <lacuna/core/shared/progress.h>
#include <lacuna/quality/quality.h>
#include <lacuna/quality/shared/layered.h>
#include <lacuna/surface/shared/given_target.h>
#include <lacuna/surface/shared/imprint.h>
#include <lacuna/surface/shared/intervals.h>
#include <lacuna/surface/shared/rim_breaks.h>
#include <lacuna/surface/shared/source_mesh.h>
#include <lacuna/surface/shared/swept_motion.h>
#include <lacuna/surface/shared/wall_breaks.h>
#include <lacuna/sweep/detail/given_meshes.h>
#include <lacuna/sweep/detail/keep_thickness.h>
#include <lacuna/sweep/detail/morph.h>
#include <lacuna/sweep/detail/morph_ends.h>
#include <lacuna/sweep/detail/plan_heights.h>
#include <lacuna/sweep/detail/prove_or_improve.h>
#include <lacuna/sweep/detail/shares.h>
#include <lacuna/sweep/detail/skin_patches.h>
#include <lacuna/sweep/detail/source_quads.h>
#include <lacuna/sweep/detail/volume_share.h>
#include <lacuna/sweep/shared/layer_plan.h>
#include <lacuna/sweep/shared/layers.h>

#include <algorithm>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>

namespace lacuna::sweep {

using namespace topology;

namespace {

/// Whether to mesh the walls while another thread paves the source. This saves time if paving, which uses one
/// thread, takes long. It is possible only without exact geometry, for which both tasks would need the same
/// CAD process.
bool walls_beside(const OpenVolume& volume, const surface::Seeds& seeds,
                  const std::vector<surface::LinkingNodes>& rim, const std::vector<double>& heights)
{
    const bool free = std::ranges::any_of(volume.faces(Role::source), [&](FaceId face) {
        return !seeds.kept.contains(face) && !seeds.corners.contains(face) && !seeds.submapped.contains(face);
    });
    const auto exact = [](const Face& face) { return face.surface != nullptr; };
    const auto on_curve = [](const Edge& edge) { return edge.curve != nullptr; };
    if (!free || std::ranges::any_of(volume.model.faces, exact) ||
        std::ranges::any_of(volume.model.edges, on_curve))
        return false;
    // The time for paving grows with the square of the number of rim sides. The time for walls grows with rim
    // sides times layers, and the walls get one thread here. With many layers they would therefore take
    // longer than paving. Measured: 4 µs per quad, 0.6 µs per wall node.
    std::size_t round = 0;
    for (const surface::LinkingNodes& nodes : rim) round += nodes.source_at.size();
    return 2 * heights.size() <= round;
}

RimColumns columns_of(const std::vector<surface::LinkingSurface>& links, const surface::SourceMesh& source,
                      const std::vector<double>& heights, const std::vector<surface::WallMesh>& walls)
{
    RimColumns columns;
    columns.layers = static_cast<int>(heights.size()) - 1;
    for (std::size_t b = 0; b < links.size(); ++b) {
        for (std::size_t i = 0; i < source.links[b].source_at.size(); ++i)
            columns.rim.push_back(source.first[b] + static_cast<Index>(i));
    }
    for (std::size_t layer = 0; layer < heights.size(); ++layer) {
        for (std::size_t b = 0; b < links.size(); ++b) {
            const std::size_t n = source.links[b].source_at.size();
            const auto row = walls[b].points.begin() + static_cast<std::ptrdiff_t>(layer * n);
            columns.points.insert(columns.points.end(), row, row + static_cast<std::ptrdiff_t>(n));
        }
    }
    return columns;
}

/// Fix the nodes of columns along creases of the walls, as if they were on edges.
void hold_creases(const std::vector<surface::LinkingSurface>& links, const surface::SourceMesh& source,
                  std::size_t rows, std::vector<char>& held)
{
    const std::size_t nodes = source.quads.nodes.size();
    for (std::size_t b = 0; b < links.size(); ++b) {
        for (const surface::RimSegment& segment : links[b].segments) {
            const std::vector<double>& at = source.links[b].source_at;
            const auto found = std::ranges::find(at, segment.source_from);
            const bool follows = segment.on_crease || segment.follows || segment.target_follows;
            if (!follows || found == at.end()) continue;
            held.resize(rows * nodes);
            const auto first = index(source.first[b] + static_cast<Index>(found - at.begin()));
            for (std::size_t n = first; n < held.size(); n += nodes) held[n] = 1;
        }
    }
}

/// Whether all walls are void and ruled between the ends, with straight void edges. Node lines are then
/// straight: class I of Roca and Sarrate (2010).
bool ruled(const OpenVolume& volume, const std::vector<surface::LinkingSurface>& links)
{
    for (const FaceId wall : volume.faces(Role::wall)) {
        if (volume.model[wall].origin == Origin::given) return false;
    }
    for (const surface::LinkingSurface& link : links) {
        if (link.lines.empty()) return false;
        for (const surface::LinkingLine& line : link.lines) {
            const surface::Chain chain(volume.model, line.line.uses);
            const double chord = (volume.model.at(volume.model[line.line.target].point) -
                                  volume.model.at(volume.model[line.line.source].point))
                                     .norm();
            if (chain.length() - chord > volume.model.tolerance) return false;
        }
    }
    return true;
}

/// Layers generated on demand, and the quality of their cells. Empty if the cells need improvement.
struct GoodLayers {
    PlacedLayers layers;
    LayersFound found;
};
std::optional<GoodLayers> good_layers(const surface::SourceMesh& source, const Morphed& morphed,
                                      const RimColumns& columns, PlacementOptions placement,
                                      const SweepOptions& options, const RunContext& context)
{
    GoodLayers good{placed_layers(std::make_shared<const LayerPlan>(
                                      LayerPlan{source.quads, morphed.nodes, columns, placement}),
                                  context),
                    {}};
    const double least = std::max(options.improving.good_enough, options.min_scaled_jacobian);
    good.found = find_in_layers(good.layers, least, options.crew, context);
    if (!good.found.good_enough) return std::nullopt;
    return good;
}

/// Whether the positions of inner nodes follow from the placement of layers alone. At order 2, members of an
/// assembly are excluded, because neighbours look up each other's middle nodes in stored meshes.
bool may_be_layered(const SweepOptions& options)
{
    return options.layered && (options.order == 1 || !options.beside.settle) &&
           options.boundary_layers.empty();
}

/// Whether all faces of an end have given meshes that can be kept.
bool came_with_mesh(const OpenVolume& volume, Role end, bool wedges)
{
    return std::ranges::all_of(volume.faces(end), [&](FaceId id) {
        const Face& face = volume.model[id];
        return face.keeps_nodes && has_cells_to_keep(face, wedges);
    });
}

/// Refuse boundary layers along the rim of a source with kept quads. Given quads do not move, so their rows
/// cannot get other heights.
void refuse_kept_source(const OpenVolume& volume, const surface::RimRows& rows, const SweepOptions& options)
{
    if (rows.empty() || options.quads != Quads::automatic) return;
    for (const FaceId face : volume.faces(Role::source)) {
        if (!volume.model[face].keeps_nodes || !has_cells_to_keep(volume.model[face], options.wedges))
            continue;
        Message refusal("sweep.layers_given",
                        "{} keeps its given quads, so boundary layers cannot be placed along its rim",
                        entity_of(volume.model, face));
        if (!options.beside.own_mesh) throw NotSweepable(std::move(refusal));
        throw NotSweepable(
            std::move(refusal).remedy("remesh it with quads = \"paved\", or load with keep_mesh = false"));
    }
}

/// The motion that made the walls, if both ends have the same number of faces; else null.
geometry::MotionPointer moving_faces(const OpenVolume& volume)
{
    const bool alike = volume.faces(Role::source).size() == volume.faces(Role::target).size();
    return alike ? surface::swept_motion(volume) : nullptr;
}

/// Imprint of the target's inner edges on the source. Empty if the target has no inner edges. Also empty if
/// both ends have given meshes, which may have the same connectivity.
std::optional<surface::Imprint> imprint_of(const OpenVolume& volume,
                                           const std::vector<surface::LinkingSurface>& links,
                                           const surface::SizeField& size, bool wedges)
{
    if (surface::inner_edges(volume, Role::target).empty()) return std::nullopt;
    if (came_with_mesh(volume, Role::source, wedges) && came_with_mesh(volume, Role::target, wedges))
        return std::nullopt;
    return surface::imprint_target(volume, links, size);
}

} // namespace

const OpenVolume& shape_of(const OpenVolume& volume, const SweepOptions& options)
{
    return options.beside.shape != nullptr ? *options.beside.shape : volume;
}

ProvedSweep sweep_between(const OpenVolume& volume, std::vector<surface::LinkingSurface> given_links,
                          const std::vector<double>& asked, const SourceSize& sizes,
                          const SweepOptions& options, Outline outline, const RunContext& context)
{
    const surface::SizeField& size = sizes.shape.at;
    Swept result;
    const geometry::MotionPointer motion = moving_faces(volume);
    std::optional<surface::Imprint> imprint;
    if (!motion) imprint = imprint_of(volume, given_links, size, options.wedges);
    const OpenVolume& split = imprint ? *imprint->volume : volume;
    std::vector<surface::LinkingSurface>& links = imprint ? imprint->links : given_links;
    check_cancelled(context);
    GivenMeshes given = given_meshes(split, links, asked, size, options);
    if (options.curvature > SweepOptions{}.curvature && may_divide_rims(volume, options)) {
        for (surface::LinkingSurface& link : links)
            for (surface::RimSegment& segment : link.segments) segment.given = false;
    }
    surface::WallBreaks wall_breaks = surface::set_wall_breaks(split, size, std::move(links));
    links = std::move(wall_breaks.links);
    const int least_layers = wall_breaks.layers;
    if (sizes_by_default(options))
        links = surface::follow_facets(surface::RimFacets(split, links).breaks(options.curvature, size),
                                       links);
    const surface::LayerTables tables = surface::layer_tables(volume, options.boundary_layers);
    const bool by_rows = !given.heights.empty();
    const auto [heights, by_bends] = plan_heights(
        split, links, tables, given.heights, sizes, options,
        options.size ? least_layers : std::max(least_layers, kDefaultGap), context);
    surface::EdgeDemands demands{surface::rim_rows(split, links, tables),
                                 surface::find_intervals(split, links, options.intervals).sides,
                                 options.beside.handed};
    refuse_kept_source(split, demands.rows, options);
    for (const std::string& note : given.notes) result.not_kept.push_back("given: " + note);
    result.report = result.not_kept;
    report_progress(context, "quads of the source", share::source);
    check_cancelled(context);
    const surface::Seeds seeds = surface::seed_source(
        split, links, size, style_of(options, !demands.rows.empty()), sizes.sizing,
        imprint ? surface::image_lengths(*imprint) : std::map<EdgeId, double>{}, options.wedges, demands,
        context);
    for (const std::string& note : seeds.notes) result.report.push_back("given: " + note);
    result.defaults = sizes_in_words(volume, split, sizes, seeds, options,
                                     {static_cast<int>(heights.size()) - 1, by_rows, by_bends});
    result.report.insert(result.report.end(), result.defaults.begin(), result.defaults.end());
    std::vector<surface::LinkingNodes> rim;
    for (const surface::LinkingSurface& link : links) rim.push_back(seeds.nodes(link));
    const auto mesh_walls = [&](const RunContext& own) {
        return surface::mesh_walls(split, links, rim, heights, given.columns, own);
    };
    std::optional<Background<std::vector<surface::WallMesh>>> walls_to_be;
    if (walls_beside(split, seeds, rim, heights)) walls_to_be.emplace(context, mesh_walls);
    surface::SourceMesh source = surface::mesh_source(split, links, seeds, size_fields(size, options),
                                                      mesher_for_all(options, sizes.narrow), context);
    report_progress(context, "walls", share::walls);
    std::vector<surface::WallMesh> walls = walls_to_be ? walls_to_be->take() : mesh_walls(context);
    RimColumns columns = columns_of(links, source, heights, walls);
    if (outline == Outline::mean && !options.wedges)
        source = laid_between(split, std::move(source), columns, size, mesher_of(options, sizes.narrow),
                              context);
    for (std::string& note : source.notes) result.report.push_back("source " + note);
    for (const surface::WallMesh& wall : walls) {
        for (const std::string& note : wall.notes) result.report.push_back("walls: " + note);
    }
    check_cancelled(context);

    report_progress(context, "target", share::target);
    surface::GivenTarget given_target;
    if (!imprint) given_target = surface::given_target(volume, links, source, options.wedges);
    const bool keeps_target = !given_target.face.empty();
    const bool moved = motion && !keeps_target;
    if (!keeps_target && !imprint && !moved && !surface::inner_edges(volume, Role::target).empty())
        // If faces of the target keep their quads, this raises an error that names them.
        imprint = surface::imprint_target(volume, links, size);
    EndFaces ends = end_faces(volume, source, imprint, motion != nullptr);
    if (keeps_target) ends.target = std::move(given_target.face);
    if (!given_target.why.empty()) {
        result.not_kept.push_back("target: its given quads are not kept: " + given_target.why);
        result.report.push_back(result.not_kept.back());
        result.notes.push_back(result.not_kept.back());
    }
    Morphed morphed;
    if (keeps_target) {
        morphed.nodes = std::move(given_target.nodes);
        morphed.report = "its given quads are connected like the source's and are kept";
    } else if (moved) {
        morphed = moved_by(*motion, source, columns);
    } else {
        const OpenVolume& shape = shape_of(volume, options);
        const std::optional<OpenVolume> turned = shape.turned_round != volume.turned_round
                                                     ? std::optional(turned_round(shape))
                                                     : std::nullopt;
        morphed = imprint ? morph_onto_faces(source, columns, seeds, *imprint, ends.target, context)
                          : morph_onto(turned ? *turned : shape, source, columns, context);
    }
    result.report.push_back("target: " + morphed.report);
    report_progress(context, "layers", share::layers);
    PlacementOptions placement;
    placement.straight_lines = ruled(volume, links);
    placement.heights = heights;
    std::optional<GoodLayers> good;
    if (may_be_layered(options)) good = good_layers(source, morphed, columns, placement, options, context);
    LayerNodes layers;
    if (good) {
        layers = {.nodes = source.quads.nodes, .report = good->layers.report};
        result.layers = std::move(good->layers.nodes);
        result.plan = std::move(good->layers.plan);
    } else {
        layers = place_layers(source.quads, morphed.nodes, columns, placement, context);
    }
    result.report.push_back(layers.report);
    SweptParts parts{split,       links, source, walls, ends, columns.layers, {}, !seeds.kept.empty(),
                     keeps_target};
    if (imprint) {
        for (const auto& [edge, image] : imprint->images) parts.target_edges[edge] = image.target;
    }
    KeptThickness kept;
    if (!good) kept = keep_thickness(parts, tables, layers.nodes, context);
    hold_creases(links, source, heights.size(), kept.held);
    for (std::string& note : kept.report) result.report.push_back(std::move(note));

    mesh::HexMesh& mesh = result.mesh;
    mesh = cells_over(source.quads, columns.layers);
    mesh.nodes = std::move(layers.nodes);
    const std::vector<FaceId> faces = set_patches(volume, source, ends, walls, mesh);
    // Free memory for the proof.
    walls = {};
    columns = {};
    for (const FaceId wall : volume.faces(Role::wall)) {
        if (volume.model[wall].origin != Origin::given || std::ranges::find(faces, wall) != faces.end())
            continue;
        result.report.push_back(
            formatted("walls: {} is smaller than the quads there, so it gets no quads and no group",
                      entity_of(volume.model, wall)));
    }
    report_progress(context, "proof of every cell", share::proof);
    check_cancelled(context);
    std::set<FaceId> still = given_faces(volume, seeds.kept, options.wedges);
    if (options.beside.settle) {
        SettledNodes settled = options.beside.settle(result.skin(), faces);
        still.merge(settled.faces);
        for (const auto& [node, place] : settled.nodes) mesh.nodes[index(node)] = place;
    }
    quality::Proof proof =
        good ? quality::prove(mesh::LayeredMesh{mesh, *result.layers}, std::move(good->found.quality),
                              std::move(good->found.misplaced), options.min_scaled_jacobian)
             : prove_or_improve(result, volume.model, faces, still, std::move(kept.held), options, context);
    const quality::Quality& quality = proof.quality;
    result.min_scaled_jacobian = quality.min_scaled_jacobian;
    const std::string wedges = quality.wedges > 0 ? formatted(" hexahedra and {} wedges", quality.wedges)
                                                  : "";
    result.report.push_back(
        formatted("cells: {}{}, all certified, scaled Jacobian {:.6f} at least, {:.6f} on "
                  "average",
                  quality.hexes, wedges, quality.min_scaled_jacobian, quality.mean_scaled_jacobian));
    report_given(volume, result, options.wedges);
    result.quality = quality;
    return {std::move(result), std::move(proof), faces, seeds.kept};
}

} // namespace lacuna::sweep
