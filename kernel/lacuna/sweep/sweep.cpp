// SPDX-License-Identifier: MIT
#include <lacuna/sweep/sweep.h>

#include <lacuna/closure/close.h>
#include <lacuna/core/error.h>
#include <lacuna/core/number_text.h>
#include <lacuna/core/progress.h>
#include <lacuna/quads/odd_region.h>
#include <lacuna/quads/pave.h>
#include <lacuna/quads/submap.h>
#include <lacuna/quality/layered.h>
#include <lacuna/quality/quality.h>
#include <lacuna/surface/given_target.h>
#include <lacuna/surface/imprint.h>
#include <lacuna/surface/source_mesh.h>
#include <lacuna/surface/wall_breaks.h>
#include <lacuna/sweep/detail/both_ways.h>
#include <lacuna/sweep/detail/drawn_layers.h>
#include <lacuna/sweep/detail/given_meshes.h>
#include <lacuna/sweep/detail/keep_thickness.h>
#include <lacuna/sweep/detail/mean_outline.h>
#include <lacuna/sweep/detail/morph_ends.h>
#include <lacuna/sweep/detail/normals.h>
#include <lacuna/sweep/detail/plan_heights.h>
#include <lacuna/sweep/detail/prove_or_improve.h>
#include <lacuna/sweep/detail/size_words.h>
#include <lacuna/sweep/detail/volume_share.h>
#include <lacuna/sweep/detail/words.h>
#include <lacuna/sweep/layers.h>
#include <lacuna/sweep/morph.h>
#include <lacuna/topology/skin_groups.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <exception>
#include <limits>
#include <map>
#include <set>

namespace lacuna::sweep {

using namespace topology;

namespace {

surface::QuadStyle style_of(const SweepOptions& options, bool rows_along_walls)
{
    switch (options.quads) {
    case Quads::automatic:
        return options.rows > 0 || rows_along_walls ? surface::QuadStyle::free
                                                    : surface::QuadStyle::automatic;
    case Quads::mapped:
        return surface::QuadStyle::mapped;
    case Quads::gmsh:
    case Quads::paved:
        return surface::QuadStyle::free;
    case Quads::keep:
        return surface::QuadStyle::kept;
    }
    return surface::QuadStyle::automatic;
}

/// What fills the source faces that are not mapped: the kernel's paver, or the mesher handed in.
/// @param narrow  quads are asked for across places that may be narrow.
quads::PlanarQuadMesher mesher_of(const SweepOptions& options, bool narrow)
{
    if (options.quads == Quads::gmsh) return options.quad_mesher;
    if (options.quads == Quads::mapped) {
        return [](const quads::PlanarRegion& region, const RunContext& context) {
            if (auto grid = quads::submap(region, context)) return std::move(*grid);
            const std::string why = "a source face of right angles is to be mapped, and the grid its " +
                                    std::to_string(region.points.size()) +
                                    " boundary nodes enclose folds or overlaps";
            try {
                quads::pave(region, {}, context);
            } catch (const NotSweepable&) {
                throw NotSweepable("surface.not_submapped", why);
            }
            throw NotSweepable("surface.not_submapped", why + "; quads = \"auto\" paves it");
        };
    }
    // A grid has as many quads across a neck as its rim leaves over.
    const bool grids = options.quads != Quads::paved && !narrow;
    return [rows = options.rows, grids](const quads::PlanarRegion& region, const RunContext& context) {
        return quads::pave(region, {.exact_rows = rows, .grids = grids}, context).mesh;
    };
}

/// The same for regions that may have an odd number of sides.
quads::PlanarQuadMesher mesher_for_all(const SweepOptions& options, bool narrow)
{
    quads::PlanarQuadMesher mesher = mesher_of(options, narrow);
    if (!options.wedges || !mesher) return mesher;
    return [mesher = std::move(mesher)](const quads::PlanarRegion& region, const RunContext& context) {
        return quads::fill_odd_region(region, mesher, context);
    };
}

/// A field that refuses what is no length before anything is divided by it.
surface::SizeField checked(const surface::SizeField& field, const std::string& option)
{
    return [field, option](const Vec3& p) {
        const double h = field(p);
        if (!(h > 0) || !std::isfinite(h)) {
            throw InvalidInput("sweep.size", "sweep: option '" + option +
                                                 "' must be a positive number everywhere; at " +
                                                 place_in_short(p) + " it is " + in_full(h));
        }
        return h;
    };
}

/// Refuse at once what could never be numbered, instead of filling the memory first.
void check_amount(const OpenVolume& volume, const surface::SizeField& size, const LayerSpec& layers)
{
    constexpr std::size_t kSamples = 64; ///< facets a face; a rough count will do
    double quads = 0;
    for (const FaceId face : volume.faces(Role::source)) {
        const std::vector<Triangle>& triangles = volume.model[face].triangles;
        const std::size_t step = std::max<std::size_t>(1, triangles.size() / kSamples);
        double sum = 0, samples = 0;
        for (std::size_t t = 0; t < triangles.size(); t += step) {
            const double h = size(volume.model.at(triangles[t][0]));
            sum += 1 / (h * h);
            ++samples;
        }
        quads += face_area(volume.model, face) * sum / std::max(samples, 1.0);
    }
    const double levels = static_cast<double>(
        std::max<std::size_t>(layers.heights.size(), static_cast<std::size_t>(std::max(layers.count, 1))));
    if (quads < 1 || quads * levels < std::numeric_limits<Index>::max()) {
        if (levels < std::numeric_limits<Index>::max() / 16.0) return;
    }
    throw InvalidInput(
        "sweep.too_many",
        "about " + in_short(quads) + " quads on the source and " + with_decimals(levels, 0) +
            " layers make " + in_short(std::max(quads, 1.0) * levels) +
            " hexahedra, more than can be numbered; ask for a larger 'size' or fewer 'layers'");
}

/// The size asked for, or the default; smaller where the shape needs it.
SourceSize source_size(const OpenVolume& volume, const SweepOptions& options, const RunContext& context)
{
    SourceSize size;
    if (options.size) {
        size.asked = checked(options.size, "size");
    } else {
        size.by_default = surface::default_size(volume);
        size.asked = [length = size.by_default->length](const Vec3&) { return length; };
    }
    check_amount(volume, size.asked, options.layers);
    const bool maps = options.quads == Quads::automatic || options.quads == Quads::mapped;
    size.sizing = {options.curvature, options.gap};
    check_cancelled(context);
    if (size.by_default && options.gap == 0) size.sizing = {options.curvature, kDefaultGap, maps};
    size.shape = surface::shape_size(volume, size.asked, size.sizing);
    const bool narrow_by_default = size.shape.width && options.gap == 0 && size.sizing.gap > 0;
    size.narrow = narrow_by_default || options.gap > 0;
    size.along = size.shape.at;
    if (narrow_by_default) {
        size.along = surface::shape_size(volume, size.asked, {options.curvature, 0}).at;
        size.sizing.counts_across = false;
    }
    return size;
}

/// The size, and the height of rows where they are asked for.
surface::SizeFields size_fields(const surface::SizeField& size, const SweepOptions& options)
{
    if (options.rows == 0) return {size};
    return {size, options.row_height ? checked(options.row_height, "row_height") : size};
}

RimColumns columns_of(const OpenVolume& volume, const std::vector<surface::LinkingSurface>& links,
                      const std::vector<surface::GivenColumns>& given, const surface::SourceMesh& source,
                      const std::vector<double>& heights, std::vector<surface::WallMesh>& walls,
                      const RunContext& context)
{
    RimColumns columns;
    columns.layers = static_cast<int>(heights.size()) - 1;
    walls = surface::mesh_walls(volume, links, source.links, heights, given, context);
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

/// Void walls alone, ruled between the ends: the paper's class I, whose node lines are straight. Not where
/// void edges are bent.
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

/// SkinPatches of the skin, one a face, with the groups a person reads.
class SkinPatches {
public:
    SkinPatches(const OpenVolume& volume, mesh::HexMesh& mesh)
        : volume_(volume), mesh_(mesh), groups_(topology::skin_groups(volume))
    {
    }

    /// Face of each patch.
    [[nodiscard]] std::vector<FaceId> faces() const
    {
        std::vector<FaceId> faces(patch_.size());
        for (const auto& [face, patch] : patch_) faces[static_cast<std::size_t>(patch)] = face;
        return faces;
    }

    Index of(FaceId face)
    {
        const auto [found, fresh] = patch_.try_emplace(face, static_cast<Index>(mesh_.patches.size()));
        if (fresh) {
            const Face& f = volume_.model[face];
            mesh::SkinPatch patch;
            patch.tag = static_cast<int>(mesh_.patches.size()) + 1;
            if (f.origin != Origin::made_void) patch.face = f.tag;
            patch.groups = groups_[face.index()];
            mesh_.patches.push_back(std::move(patch));
        }
        return found->second;
    }

private:
    const OpenVolume& volume_;
    mesh::HexMesh& mesh_;
    std::vector<std::vector<std::string>> groups_; ///< of each face
    std::map<FaceId, Index> patch_;
};

/// @param ends  faces of each quad on the source and on the target.
/// @return  face of each patch.
std::vector<FaceId> set_patches(const OpenVolume& volume, const surface::SourceMesh& source,
                                const EndFaces& ends, const std::vector<surface::WallMesh>& walls,
                                mesh::HexMesh& mesh)
{
    SkinPatches patches(volume, mesh);
    for (const FaceId face : ends.source) mesh.source_patch.push_back(patches.of(face));
    for (const FaceId face : ends.target) mesh.target_patch.push_back(patches.of(face));

    // A linking surface's sides run with the linking surface or against it; each side of the rim finds its
    // place by the nodes it joins.
    struct RimPosition {
        std::size_t link, side;
    };
    std::map<std::pair<Index, Index>, RimPosition> places;
    for (std::size_t b = 0; b < walls.size(); ++b) {
        const std::size_t n = source.links[b].source_at.size();
        for (std::size_t i = 0; i < n; ++i) {
            const Index a = source.first[b] + static_cast<Index>(i);
            const Index c = source.first[b] + static_cast<Index>((i + 1) % n);
            places[{std::min(a, c), std::max(a, c)}] = {b, i};
        }
    }
    for (int layer = 0; layer < mesh.layers; ++layer) {
        for (const Segment& side : mesh.rim) {
            const RimPosition place = places.at({std::min(side[0], side[1]), std::max(side[0], side[1])});
            const std::size_t n = source.links[place.link].source_at.size();
            mesh.wall_patch.push_back(
                patches.of(walls[place.link].face[static_cast<std::size_t>(layer) * n + place.side]));
        }
    }
    return patches.faces();
}

/// Layers and, where it had to be found out, how good their cells are.
struct BestLayers {
    LayerNodes layers;
    std::optional<quality::Quality> quality;
};

/// The layers, by the way whose worst cell is best: with the rim's residual spread over each layer, and,
/// where that leaves poor cells, without.
BestLayers best_layers(const surface::SourceMesh& source, const Morphed& morphed, const RimColumns& columns,
                       PlacementOptions placement, const SweepOptions& options, const RunContext& context)
{
    if (options.interior == Interior::normals)
        return {place_along_normals(source.quads, morphed.nodes, columns, context), {}};
    placement.spread_residual = options.interior != Interior::affine;
    LayerNodes spread = place_layers(source.quads, morphed.nodes, columns, placement, context);
    if (options.interior != Interior::automatic || spread.placement != Placement::fitted)
        return {std::move(spread), {}};
    const auto measured = [&](LayerNodes& layers) {
        mesh::HexMesh mesh;
        mesh.nodes_per_layer = static_cast<Index>(source.quads.nodes.size());
        mesh.layers = columns.layers;
        mesh.quads = source.quads.quads;
        mesh.nodes = std::move(layers.nodes);
        quality::Quality found = quality::measure(mesh, context);
        layers.nodes = std::move(mesh.nodes);
        return found;
    };
    quality::Quality with = measured(spread);
    if (with.min_scaled_jacobian >= options.improving.good_enough)
        return {std::move(spread), std::move(with)};
    placement.spread_residual = false;
    LayerNodes plain = place_layers(source.quads, morphed.nodes, columns, placement, context);
    quality::Quality without = measured(plain);
    if (without.min_scaled_jacobian > with.min_scaled_jacobian) return {std::move(plain), std::move(without)};
    return {std::move(spread), std::move(with)};
}

/// The same, left to be made, and how good the cells are; nothing where they are not good enough to stay as
/// they are placed.
struct GoodLayers {
    PlacedLayers layers;
    LayersFound found;

    void judge(const SweepOptions& options, const RunContext& context)
    {
        const double least = std::max(options.improving.good_enough, options.min_scaled_jacobian);
        found = find_in_layers(layers, least, options.crew, context);
    }
};
std::optional<GoodLayers> good_layers(const surface::SourceMesh& source, const Morphed& morphed,
                                      const RimColumns& columns, PlacementOptions placement,
                                      const SweepOptions& options, const RunContext& context)
{
    placement.spread_residual = options.interior != Interior::affine;
    GoodLayers good{placed_layers(std::make_shared<const LayerPlan>(
                                      LayerPlan{source.quads, morphed.nodes, columns, placement}),
                                  context),
                    {}};
    good.judge(options, context);
    if (!good.found.good_enough) return std::nullopt;
    return good;
}

/// Rising, each node once, the last place said.
std::vector<std::pair<Index, Vec3>> in_order(std::vector<std::pair<Index, Vec3>> nodes)
{
    std::ranges::stable_sort(nodes, {}, &std::pair<Index, Vec3>::first);
    std::vector<std::pair<Index, Vec3>> once;
    for (const auto& node : nodes) {
        if (!once.empty() && once.back().first == node.first) once.pop_back();
        once.push_back(node);
    }
    return once;
}

/// Lay nodes of the skin onto neighbours'. Layers that are not good enough then are held from there on.
void lay_onto_neighbours(std::vector<std::pair<Index, Vec3>> nodes, Swept& swept,
                         std::optional<GoodLayers>& good, const SweepOptions& options,
                         const RunContext& context)
{
    mesh::HexMesh& mesh = swept.mesh;
    if (!good) {
        for (const auto& [node, place] : nodes) mesh.nodes[index(node)] = place;
        return;
    }
    if (nodes.empty()) return;
    good->layers.plan = swept.plan;
    good->layers.nodes = *swept.layers;
    good->layers = with_laid(std::move(good->layers), in_order(std::move(nodes)));
    good->judge(options, context);
    swept.plan = good->layers.plan;
    swept.layers = good->layers.nodes;
    if (good->found.good_enough) return;
    mesh.nodes.resize(mesh::corner_count(mesh));
    swept.layers->place(0, mesh.layers + 1, mesh.nodes, context);
    swept.layers.reset();
    swept.plan.reset();
    good.reset();
}

/// Whether nothing but the placing of layers has a say in where nodes inside are.
bool may_be_layered(const SweepOptions& options)
{
    return options.layered && options.order == 1 && options.boundary_layers.empty() &&
           options.interior != Interior::normals;
}

/// Whether all faces of an end came with a mesh that can stay.
bool came_with_mesh(const OpenVolume& volume, Role end, bool wedges)
{
    const std::vector<FaceId> faces = volume.faces(end);
    return std::all_of(faces.begin(), faces.end(), [&](FaceId id) {
        const Face& face = volume.model[id];
        return face.keeps_nodes && has_cells_to_keep(face, wedges);
    });
}

/// Given quads do not move, and leave no place for rows of other heights.
void refuse_kept_source(const OpenVolume& volume, const surface::RimRows& rows, const SweepOptions& options)
{
    if (rows.empty() || options.quads != Quads::automatic) return;
    for (const FaceId face : volume.faces(Role::source)) {
        if (!volume.model[face].keeps_nodes || !has_cells_to_keep(volume.model[face], options.wedges))
            continue;
        throw NotSweepable("sweep.layers_given",
                           name_of(volume.model, face) +
                               " came with quads, which stay, and walls at its rim are to have boundary "
                               "layers; quads = \"paved\" meshes it anew, as does loading with keep_mesh = "
                               "false");
    }
}

/// The inner edges of the target on the source; nothing where it has none, or where both ends came with
/// meshes that may be the same graph.
std::optional<surface::Imprint> imprint_of(const OpenVolume& volume,
                                           const std::vector<surface::LinkingSurface>& links,
                                           const surface::SizeField& size, bool wedges)
{
    if (surface::inner_edges(volume, Role::target).empty()) return std::nullopt;
    if (came_with_mesh(volume, Role::source, wedges) && came_with_mesh(volume, Role::target, wedges))
        return std::nullopt;
    return surface::imprint_target(volume, links, size);
}

/// What the mesh's shape is to be: in an assembly, without the nodes and meshes of neighbours.
const OpenVolume& shape_of(const OpenVolume& volume, const SweepOptions& options)
{
    return options.beside.shape != nullptr ? *options.beside.shape : volume;
}

/// Seeds, quads, walls, target, layers and proof between the rims of linking surfaces that say what goes with
/// what.
ProvedSweep sweep_between(const OpenVolume& volume, std::vector<surface::LinkingSurface> given_links,
                          const std::vector<double>& asked, const SourceSize& sizes,
                          const SweepOptions& options, Outline outline, const RunContext& context)
{
    const surface::SizeField& size = sizes.shape.at;
    Swept result;
    std::optional<surface::Imprint> imprint = imprint_of(volume, given_links, size, options.wedges);
    const OpenVolume& split = imprint ? *imprint->volume : volume;
    std::vector<surface::LinkingSurface>& links = imprint ? imprint->links : given_links;
    check_cancelled(context);
    GivenMeshes given = given_meshes(split, links, asked, size, options);
    const int least_layers = surface::set_wall_breaks(split, size, links);
    const surface::LayerTables tables = surface::layer_tables(volume, options.boundary_layers);
    const bool by_rows = !given.heights.empty();
    const auto [heights,
                by_bends] = plan_heights(split, links, tables, given.heights, sizes.along, options,
                                         options.size ? least_layers : std::max(least_layers, kDefaultGap));
    surface::EdgeDemands demands{surface::rim_rows(split, links, tables),
                                 surface::find_intervals(split, links, options.intervals).sides};
    refuse_kept_source(split, demands.rows, options);
    for (std::string& note : given.notes) result.report.push_back("given: " + note);
    report_progress(context, "quads of the source");
    check_cancelled(context);
    const surface::Seeds seeds = surface::seed_source(
        split, links, size, style_of(options, !demands.rows.empty()), sizes.sizing,
        imprint ? surface::image_lengths(*imprint) : std::map<EdgeId, double>{}, options.wedges, demands);
    for (const std::string& note : seeds.notes) result.report.push_back("given: " + note);
    result.defaults = sizes_in_words(volume, split, sizes, seeds, options,
                                     {static_cast<int>(heights.size()) - 1, by_rows, by_bends});
    result.report.insert(result.report.end(), result.defaults.begin(), result.defaults.end());
    surface::SourceMesh source = surface::mesh_source(split, links, seeds, size_fields(size, options),
                                                      mesher_for_all(options, sizes.narrow), context);
    report_progress(context, "walls");
    std::vector<surface::WallMesh> walls;
    RimColumns columns = columns_of(split, links, given.columns, source, heights, walls, context);
    if (outline == Outline::mean && !options.wedges)
        source = laid_between(split, std::move(source), columns, size, mesher_of(options, sizes.narrow),
                              context);
    for (std::string& note : source.notes) result.report.push_back("source " + note);
    for (const surface::WallMesh& wall : walls) {
        for (const std::string& note : wall.notes) result.report.push_back("walls: " + note);
    }
    check_cancelled(context);

    report_progress(context, "target");
    std::string why;
    std::optional<surface::GivenTarget> given_target;
    if (!imprint) given_target = surface::given_target(volume, links, source, why, options.wedges);
    if (!given_target && !imprint && !surface::inner_edges(volume, Role::target).empty())
        imprint = surface::imprint_target(volume, links, size); // refuses what keeps its quads, by name
    EndFaces ends = end_faces(volume, source, imprint);
    if (given_target) ends.target = given_target->face;
    if (!why.empty()) result.report.push_back("target: the quads it came with are not kept: " + why);
    Morphed morphed;
    if (given_target) {
        morphed.nodes = given_target->nodes;
        morphed.report = "its own quads are laid out as the source's and stay";
    } else {
        const OpenVolume& shape = shape_of(volume, options);
        const std::optional<OpenVolume> turned = shape.turned_round != volume.turned_round
                                                     ? std::optional(turned_round(shape))
                                                     : std::nullopt;
        morphed = imprint ? morph_onto_faces(source, columns, seeds, *imprint, ends.target, context)
                          : morph_onto(turned ? *turned : shape, source, columns, context);
    }
    result.report.push_back("target: " + morphed.report);
    report_progress(context, "layers");
    PlacementOptions placement;
    placement.straight_lines = options.interior == Interior::automatic && ruled(volume, links);
    placement.heights = heights;
    std::optional<GoodLayers> good;
    if (may_be_layered(options)) good = good_layers(source, morphed, columns, placement, options, context);
    LayerNodes layers;
    std::optional<quality::Quality> measured;
    if (good) {
        layers = {source.quads.nodes, good->layers.placement, good->layers.report};
        result.layers = std::move(good->layers.nodes);
        result.plan = std::move(good->layers.plan);
    } else {
        BestLayers best = best_layers(source, morphed, columns, placement, options, context);
        layers = std::move(best.layers);
        measured = std::move(best.quality);
    }
    result.report.push_back(layers.report);
    SweptParts parts{
        split, links, source, walls, ends, columns.layers, {}, !seeds.kept.empty(), given_target.has_value()};
    if (imprint) {
        for (const auto& [edge, image] : imprint->images) parts.target_edges[edge] = image.target;
    }
    KeptThickness kept;
    if (!good) kept = keep_thickness(parts, tables, layers.nodes, context);
    if (!tables.heights.empty()) measured.reset(); // nodes were moved
    for (std::string& note : kept.report) result.report.push_back(std::move(note));

    mesh::HexMesh& mesh = result.mesh;
    mesh.nodes_per_layer = static_cast<Index>(source.quads.nodes.size());
    mesh.layers = columns.layers;
    mesh.nodes = std::move(layers.nodes);
    mesh.quads = source.quads.quads;
    for (const mesh::BoundarySide& side : mesh::boundary_sides(mesh.quads))
        mesh.rim.push_back({side.from, side.to});
    const std::vector<FaceId> faces = set_patches(volume, source, ends, walls, mesh);
    // The proof needs room: what the nodes were made of goes.
    walls = {};
    columns = {};
    for (const FaceId wall : volume.faces(Role::wall)) {
        if (volume.model[wall].origin != Origin::given ||
            std::find(faces.begin(), faces.end(), wall) != faces.end())
            continue;
        result.report.push_back("walls: " + name_of(volume.model, wall) +
                                " is smaller than the quads there and has none, nor a group");
    }
    report_progress(context, "proof of every cell");
    check_cancelled(context);
    std::set<FaceId> still = given_faces(volume, seeds.kept, options.wedges);
    if (options.beside.settle) {
        SettledNodes settled = options.beside.settle(result.skin(), faces);
        still.merge(settled.faces);
        lay_onto_neighbours(std::move(settled.nodes), result, good, options, context);
        measured.reset();
    }
    quality::Proof proof = good
                               ? quality::prove(mesh::LayeredMesh{mesh, *result.layers},
                                                std::move(good->found.quality),
                                                std::move(good->found.misplaced), options.min_scaled_jacobian)
                               : prove_or_improve(result, volume.model, faces, still, std::move(kept.held),
                                                  std::move(measured), options, context);
    const quality::Quality& quality = proof.quality;
    result.min_scaled_jacobian = quality.min_scaled_jacobian;
    const std::string wedges = quality.wedges > 0
                                   ? " hexahedra and " + std::to_string(quality.wedges) + " wedges"
                                   : "";
    result.report.push_back("cells: " + std::to_string(quality.hexes) + wedges +
                            ", all certified, scaled Jacobian " +
                            std::to_string(quality.min_scaled_jacobian) + " at least, " +
                            std::to_string(quality.mean_scaled_jacobian) + " on average");
    report_given(volume, result, options.wedges);
    result.quality = quality;
    return {std::move(result), std::move(proof), faces, seeds.kept};
}

/// Round walls do not say how far they turn; several loops together may.
bool can_turn_together(const std::vector<surface::LinkingSurface>& links)
{
    return links.size() > 1 &&
           std::any_of(links.begin(), links.end(),
                       [](const surface::LinkingSurface& link) { return link.lines.empty(); });
}

/// Each loop turned by its own walls; where that makes poor cells, all turned as one body if that makes
/// better ones.
ProvedSweep better_turning(const OpenVolume& volume, const std::vector<surface::LinkingSurface>& links,
                           const std::vector<double>& heights, const SourceSize& size,
                           const SweepOptions& options, Outline outline, const RunContext& context)
{
    const auto start = std::chrono::steady_clock::now();
    ProvedSweep alone = sweep_between(volume, links, heights, size, options, outline, context);
    const bool poor = alone.proof.finding ? quality::can_be_improved(alone.proof.finding->fault)
                                          : alone.swept.min_scaled_jacobian < options.improving.good_enough;
    if (!poor) return alone;
    const std::vector<surface::LinkingSurface> as_one = surface::linking_surfaces(
        volume, surface::Turning::together, {}, context);
    const bool same = std::none_of(as_one.begin(), as_one.end(), [](const surface::LinkingSurface& link) {
        return link.branch.has_value();
    });
    if (same) return alone;
    try { // What went wrong first says more than what goes wrong second.
        ProvedSweep together = sweep_between(volume, as_one, heights, size, remaining(options, start),
                                             outline, context);
        if (together.proof.finding) {
            log_line(context, "loops turned as one body: " + together.proof.finding->message);
        } else if (alone.proof.finding ||
                   together.swept.min_scaled_jacobian > alone.swept.min_scaled_jacobian) {
            together.swept.report.insert(
                together.swept.report.begin(),
                "loops: turned as one body; each by its own walls the cells are worse");
            return together;
        }
    } catch (const Cancelled&) {
        throw;
    } catch (const Error& error) {
        log_line(context, std::string("loops turned as one body: ") + error.what());
    }
    return alone;
}

/// From source to target, by the linking surfaces that the walls are.
ProvedSweep sweep_one_way(const OpenVolume& volume, const SourceSize& size, const SweepOptions& options,
                          Outline outline, const RunContext& context)
{
    const bool counted = options.layers.count > 0 || !options.layers.heights.empty();
    std::vector<double> heights = counted ? layer_heights(options.layers) : std::vector<double>{};
    if (volume.turned_round) {
        std::reverse(heights.begin(), heights.end());
        for (double& h : heights) h = 1 - h;
    }
    report_progress(context, "linking surfaces");
    const std::vector<surface::LinkingSurface> links = surface::linking_surfaces(
        volume, surface::Turning::each, {}, context);
    return can_turn_together(links) ? better_turning(volume, links, heights, size, options, outline, context)
                                    : sweep_between(volume, links, heights, size, options, outline, context);
}

/// Middle nodes, proved, and the curved skin compared with the sealed one: as four straight quads each, which
/// are off by a quarter of what the quad's own straight sides would be, at most.
void elevate_and_compare(const OpenVolume& shape, const std::set<FaceId>& kept, ProvedSweep& result,
                         const SweepOptions& options, const RunContext& context)
{
    Swept& swept = result.swept;
    Elevated elevated = elevate(shape, swept.mesh, result.faces, options.second_order, context);
    swept.report.push_back(std::move(elevated.report));
    const quality::Quality& quality = elevated.quality;
    swept.min_scaled_jacobian = quality.min_scaled_jacobian;
    swept.report.push_back("cells of order 2: all certified, scaled Jacobian " +
                           std::to_string(quality.min_scaled_jacobian) + " at least, " +
                           std::to_string(quality.mean_scaled_jacobian) + " on average");
    swept.quality = quality;
    if (quality.min_scaled_jacobian < options.min_scaled_jacobian) {
        throw NotSweepable("quality.below_limit", "at order 2 the smallest scaled Jacobian is " +
                                                      in_full(quality.min_scaled_jacobian) +
                                                      ", below the limit of " +
                                                      in_full(options.min_scaled_jacobian));
    }
    swept.fidelity = compare(shape, finer_skin(swept.mesh), result.faces, kept, quality.volume,
                             {options.max_deviation, options.beside.between}, context);
    for (FaceFidelity& face : swept.fidelity.faces) {
        face.quads /= 4;
        face.side *= 2;
        face.source_side *= 2;
    }
}

/// A mesh that was proved, and compared with the sealed skin.
Swept sweep_compared(const OpenVolume& volume, const SweepOptions& options, const RunContext& context)
{
    const OneWay one_way = [&](const OpenVolume& way, const SweepOptions& rest, Outline outline) {
        return sweep_one_way(way, source_size(way, rest, context), rest, outline, context);
    };
    ProvedSweep result = sweep_both_ways(volume, options, one_way, context);
    quality::require(result.proof);
    report_progress(context, "shape of the skin");
    Swept& swept = result.swept;
    // Quads handed on by a neighbour are compared too: they are no part of that shape.
    const OpenVolume& shape = shape_of(volume, options);
    const std::set<FaceId> kept = options.beside.shape != nullptr ? std::set<FaceId>{} : result.kept;
    if (options.order == 2) {
        elevate_and_compare(shape, kept, result, options, context);
    } else {
        swept.fidelity = compare(shape, swept.mesh, result.faces, kept, result.proof.quality.volume,
                                 {options.max_deviation, options.beside.between}, context,
                                 swept.layers ? &*swept.layers : nullptr);
    }
    swept.report.push_back(in_words(swept.fidelity));
    swept.faces = std::move(result.faces);
    return std::move(swept);
}

/// Of order 2, a cell whose least scaled Jacobian is below this is worth a sweep with more sides for a turn.
/// A quad with two sides on a round rim opens by nearly half a turn between them: it came out at 0.002, and
/// with a few sides more the rim had none. All else in the cases tried was above 0.5. A choice.
constexpr double kPoorCurved = 0.1;
/// Sides for a full turn tried at most for that. A choice, not a measurement.
constexpr int kMostForCurved = 32;

/// The sweep asked for. Of order 2, with more sides for a turn as long as cells are poor or not valid.
Swept sweep_as_asked(const OpenVolume& volume, const SweepOptions& options, const RunContext& context)
{
    if (options.order == 1 || options.volume_share == 0 || options.curvature == 0)
        return sweep_compared(volume, options, context);
    std::optional<Swept> best;
    std::optional<NotSweepable> refused;
    for (SweepOptions rest = options; rest.curvature <= kMostForCurved;
         rest.curvature += rest.curvature / 4 + 1) {
        try {
            Swept next = sweep_compared(volume, rest, context);
            if (rest.curvature != options.curvature)
                next.report.push_back(
                    "order 2: " + std::to_string(rest.curvature) + " sides for a full turn instead of " +
                    std::to_string(options.curvature) + ", by which cells were poor or not valid");
            if (!best || next.min_scaled_jacobian > best->min_scaled_jacobian) best = std::move(next);
            if (best->min_scaled_jacobian >= kPoorCurved) break;
        } catch (const NotSweepable& error) {
            if (!refused) refused = error;
            if (!best && refused->code() != "sweep.second_order") throw;
        }
    }
    if (!best) throw NotSweepable(*refused);
    return std::move(*best);
}

/// The options, with the layers that intervals ask for.
SweepOptions with_layer_intervals(const OpenVolume& volume, SweepOptions options)
{
    if (options.intervals.empty()) return options;
    const auto links = surface::linking_surfaces(volume);
    const auto layers = surface::find_intervals(volume, links, options.intervals).layers;
    if (!layers) return options;
    LayerSpec& spec = options.layers;
    if (spec.count > 0 || !spec.heights.empty()) {
        throw NotSweepable("surface.sides_asked",
                           "intervals: " + layers->name + " asks for " + std::to_string(layers->count) +
                               " layers, and option 'layers' for " +
                               std::to_string(std::max<std::size_t>(spec.heights.size(),
                                                                    static_cast<std::size_t>(spec.count))) +
                               "; leave out one of them");
    }
    spec.count = layers->count;
    // An edge runs from the end that is swept from, the sweep itself from the source the person named.
    const bool turn = volume.turned_round && !layers->from_named_source;
    spec.bias = turn ? 1 / layers->bias : layers->bias;
    return options;
}

/// With more sides for a full turn as long as too much volume is lost.
Swept sweep_for_volume(const OpenVolume& volume, const SweepOptions& options, const RunContext& context)
{
    Swept best = sweep_as_asked(volume, options, context);
    SweepOptions rest = options;
    while (const std::optional<int> sides = sides_for_lost_volume(best.fidelity, rest)) {
        rest.curvature = *sides;
        try {
            Swept next = sweep_compared(volume, rest, context);
            const double enough = std::min(best.min_scaled_jacobian, options.improving.good_enough);
            if (!is_closer(volume_lost(next.fidelity), volume_lost(best.fidelity)) ||
                next.min_scaled_jacobian < enough)
                break;
            next.report.push_back("shape: " + std::to_string(rest.curvature) +
                                  " sides for a full turn instead of " + std::to_string(options.curvature) +
                                  ", by which the volume was " + in_short(100 * volume_lost(best.fidelity)) +
                                  " % less than what was sealed");
            best = std::move(next);
        } catch (const NotSweepable& error) {
            log_line(context, std::string("more sides for a full turn: ") + error.what());
            break;
        }
    }
    require(best.fidelity, best.mesh.layers, {options.max_deviation, options.beside.between, options.size});
    // Of order 2, given middle nodes may bulge from straight facets.
    if (options.max_deviation <= 0 && options.order == 1) require_volume(best.fidelity, best.mesh.layers);
    return best;
}

Swept sweep_once(const OpenVolume& volume, const SweepOptions& asked, const RunContext& context)
{
    check_cancelled(context);
    report_progress(context, "size");
    check(asked, context);
    if (!closure::is_watertight(volume)) {
        throw NotSweepable("sweep.not_closed",
                           "the volume is not sealed; close it first with volume:close()");
    }
    const SweepOptions options = with_layer_intervals(volume, asked);
    const std::optional<DrawnLayers> drawn = drawn_layers(volume, options, context);
    if (!drawn) return sweep_for_volume(volume, options, context);
    std::string why;
    try {
        SweepOptions moved = options;
        moved.layers = {};
        moved.layers.heights = drawn->heights;
        Swept swept = sweep_for_volume(volume, moved, context);
        swept.report.push_back(drawn->report);
        return swept;
    } catch (const NotSweepable& error) {
        why = error.what();
    }
    log_line(context, "layers nearer to each other in the bends: " + why);
    Swept swept = sweep_for_volume(volume, options, context);
    swept.report.push_back("layers: even ones; nearer to each other in the bends they fail: " + why);
    return swept;
}

Swept sweep_or_with_wedges(const OpenVolume& volume, const SweepOptions& asked, const RunContext& context)
{
    if (asked.fallback != Fallback::wedges || asked.wedges) return sweep_once(volume, asked, context);
    std::exception_ptr why;
    std::string words;
    try {
        return sweep_once(volume, asked, context);
    } catch (const NotSweepable& error) {
        why = std::current_exception();
        words = error.what();
    }
    try {
        SweepOptions with_wedges = asked;
        with_wedges.wedges = true;
        Swept swept = sweep_once(volume, with_wedges, context);
        swept.report.push_back("fallback: meshed with wedges, because " + words);
        return swept;
    } catch (const Cancelled&) {
        throw;
    } catch (const Error& error) { // what went wrong with hexahedra alone says more
        log_line(context, std::string("with wedges: ") + error.what());
    }
    std::rethrow_exception(why);
}

} // namespace

Swept sweep(const OpenVolume& volume, const SweepOptions& asked, const RunContext& context)
{
    Swept swept = sweep_or_with_wedges(volume, asked, context);
    if (!asked.beside.settle)
        for (const std::string& line : swept.defaults) log_line(context, line);
    return swept;
}

} // namespace lacuna::sweep
