// SPDX-License-Identifier: MIT
#include <lacuna/sweep/detail/sweep_between.h>

#include <lacuna/core/error.h>
#include <lacuna/core/shared/background.h>
#include <lacuna/core/shared/criteria.h>
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
#include <iterator>
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
        if (!volume.model[face].keeps_nodes || !has_cells_to_keep(volume.model[face], options.wedges) ||
            options.beside.handed.contains(face))
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

/// Refuse a target with quads that are far smaller than those of the source, compared with the whole ends:
/// its cells are nearly flat. Example: the floor of a long tube inside the source.
void check_shrinking(const mesh::HexMesh& mesh)
{
    const std::size_t top = index(mesh.nodes_per_layer * mesh.layers);
    const auto area = [&](const Quad& q, std::size_t first) {
        const auto at = [&](std::size_t k) -> const Vec3& { return mesh.nodes[first + index(q[k])]; };
        return (at(2) - at(0)).cross(at(3) - at(1)).norm();
    };
    double source = 0, target = 0, most = 0;
    for (const Quad& q : mesh.quads) {
        source += area(q, 0);
        target += area(q, top);
        most = std::max(most, area(q, 0) / area(q, top));
    }
    if (const double shrunk = std::sqrt(most * target / source); shrunk > surface::kMostShrunk)
        throw NotSweepable(Message("surface.not_imprinted",
                                   "the image of the source on the target is {:.2g} times smaller in some "
                                   "places than on the whole",
                                   found(shrunk))
                               .remedy("choose other faces as source and target"));
}

/// One sweep, stage by stage.
class SweepBetween {
public:
    SweepBetween(const OpenVolume& volume, std::vector<surface::LinkingSurface> links,
                 const SourceSize& sizes, const SweepOptions& options, const RunContext& context)
        : volume_(volume),
          sizes_(sizes),
          options_(options),
          context_(context),
          motion_(moving_faces(volume)),
          given_links_(std::move(links))
    {
    }

    ProvedSweep run(const std::vector<double>& asked, Outline outline)
    {
        plan(asked);
        mesh_source_and_walls(outline);
        mesh_target();
        make_cells();
        return prove();
    }

private:
    /// Imprint the target, divide the rims, and choose the layers.
    void plan(const std::vector<double>& asked)
    {
        if (!motion_) imprint_ = imprint_of(volume_, given_links_, size_, options_.wedges);
        if (imprint_) {
            split_ = imprint_->volume.get();
            links_ = &imprint_->links;
        }
        std::vector<surface::LinkingSurface>& links = *links_;
        check_cancelled(context_);
        given_ = given_meshes(*split_, links, asked, size_, options_);
        if (options_.curvature > SweepOptions{}.curvature && may_divide_rims(volume_, options_)) {
            for (surface::LinkingSurface& link : links)
                for (surface::RimSegment& segment : link.segments) segment.given = false;
        }
        surface::WallBreaks wall_breaks = surface::set_wall_breaks(*split_, size_, std::move(links));
        links = std::move(wall_breaks.links);
        if (sizes_by_default(options_))
            links = surface::follow_facets(
                surface::RimFacets(*split_, links).breaks(options_.curvature, size_), links);
        tables_ = surface::layer_tables(volume_, options_.boundary_layers);
        planned_ = plan_heights(
            *split_, links, tables_, given_.heights, sizes_, options_,
            options_.size ? wall_breaks.layers : std::max(wall_breaks.layers, kDefaultGap), context_);
    }

    void mesh_source_and_walls(Outline outline)
    {
        const std::vector<surface::LinkingSurface>& links = *links_;
        surface::EdgeDemands demands{surface::rim_rows(*split_, links, tables_),
                                     surface::find_intervals(*split_, links, options_.intervals).sides,
                                     options_.beside.handed};
        refuse_kept_source(*split_, demands.rows, options_);
        for (const std::string& note : given_.notes) result_.not_kept.push_back("given: " + note);
        result_.report = result_.not_kept;
        report_progress(context_, "quads of the source", share::source);
        check_cancelled(context_);
        seeds_.emplace(surface::seed_source(
            *split_, links, size_, style_of(options_, !demands.rows.empty()), sizes_.sizing,
            imprint_ ? surface::image_lengths(*imprint_) : std::map<EdgeId, double>{}, options_.wedges,
            demands, context_));
        std::ranges::copy(seeds_->notes, std::back_inserter(result_.notes));
        result_.defaults = sizes_in_words(
            volume_, *split_, sizes_, *seeds_, options_,
            {static_cast<int>(planned_.heights.size()) - 1, !given_.heights.empty(), planned_.by_bends});
        result_.report.insert(result_.report.end(), result_.defaults.begin(), result_.defaults.end());
        std::vector<surface::LinkingNodes> rim;
        for (const surface::LinkingSurface& link : links) rim.push_back(seeds_->nodes(link));
        const auto mesh_walls = [&](const RunContext& own) {
            return surface::mesh_walls(*split_, links, rim, planned_.heights, given_.columns, own);
        };
        std::optional<Background<std::vector<surface::WallMesh>>> walls_to_be;
        if (walls_beside(*split_, *seeds_, rim, planned_.heights)) walls_to_be.emplace(context_, mesh_walls);
        source_ = surface::mesh_source(*split_, links, *seeds_, size_fields(size_, options_),
                                       mesher_for_all(options_, sizes_), context_);
        report_progress(context_, "walls", share::walls);
        walls_ = walls_to_be ? walls_to_be->take() : mesh_walls(context_);
        columns_ = columns_of(links, source_, planned_.heights, walls_);
        if (outline == Outline::mean && !options_.wedges)
            source_ = laid_between(*split_, std::move(source_), columns_, size_, mesher_of(options_, sizes_),
                                   context_);
        for (std::string& note : source_.notes) result_.report.push_back("source " + note);
        for (const surface::WallMesh& wall : walls_) {
            for (const std::string& note : wall.notes) result_.report.push_back("walls: " + note);
        }
        check_cancelled(context_);
    }

    void mesh_target()
    {
        report_progress(context_, "target", share::target);
        surface::GivenTarget given_target;
        if (!imprint_) given_target = surface::given_target(volume_, *links_, source_, options_.wedges);
        keeps_target_ = !given_target.face.empty();
        const bool moved = motion_ && !keeps_target_;
        if (!keeps_target_ && !imprint_ && !moved && !surface::inner_edges(volume_, Role::target).empty())
            // If faces of the target keep their quads, this raises an error that names them.
            imprint_ = surface::imprint_target(volume_, *links_, size_);
        ends_ = end_faces(volume_, source_, imprint_, motion_ != nullptr);
        if (keeps_target_) ends_.target = std::move(given_target.face);
        if (!given_target.why.empty()) {
            result_.not_kept.push_back("target: its given quads are not kept: " + given_target.why);
            result_.report.push_back(result_.not_kept.back());
            result_.notes.push_back(result_.not_kept.back());
        }
        if (keeps_target_) {
            target_.nodes = std::move(given_target.nodes);
            target_.report = "its given quads are connected like the source's and are kept";
        } else if (moved) {
            target_ = moved_by(*motion_, source_, columns_);
        } else {
            const OpenVolume& shape = shape_of(volume_, options_);
            const std::optional<OpenVolume> turned = shape.turned_round != volume_.turned_round
                                                         ? std::optional(turned_round(shape))
                                                         : std::nullopt;
            target_ = imprint_
                          ? morph_onto_faces(source_, columns_, *seeds_, *imprint_, ends_.target, context_)
                          : morph_onto(turned ? *turned : shape, source_, columns_, context_);
        }
        result_.report.push_back("target: " + target_.report);
    }

    /// Place the nodes of the layers, and name the patches of the skin.
    void make_cells()
    {
        report_progress(context_, "layers", share::layers);
        PlacementOptions placement;
        placement.straight_lines = ruled(volume_, *links_);
        placement.heights = planned_.heights;
        if (may_be_layered(options_))
            good_ = good_layers(source_, target_, columns_, placement, options_, context_);
        LayerNodes layers;
        if (good_) {
            layers = {.nodes = source_.quads.nodes, .report = good_->layers.report};
            result_.layers = std::move(good_->layers.nodes);
            result_.plan = std::move(good_->layers.plan);
        } else {
            layers = place_layers(source_.quads, target_.nodes, columns_, placement, context_);
        }
        result_.report.push_back(layers.report);
        SweptParts parts{*split_,
                         *links_,
                         source_,
                         walls_,
                         ends_,
                         columns_.layers,
                         {},
                         seeds_->kept,
                         keeps_target_,
                         options_.beside.settle && !options_.beside.own_mesh};
        if (imprint_) {
            for (const auto& [edge, image] : imprint_->images) parts.target_edges[edge] = image.target;
        }
        KeptThickness kept;
        if (!good_) kept = keep_thickness(parts, tables_, layers.nodes, context_);
        hold_creases(*links_, source_, planned_.heights.size(), kept.held);
        for (std::string& note : kept.report) result_.report.push_back(std::move(note));
        held_ = std::move(kept.held);
        result_.held = held_;

        result_.mesh = cells_over(source_.quads, columns_.layers);
        result_.mesh.nodes = std::move(layers.nodes);
        faces_ = set_patches(volume_, source_, ends_, walls_, result_.mesh);
        // Free memory for the proof.
        walls_ = {};
        columns_ = {};
        for (const FaceId wall : volume_.faces(Role::wall)) {
            if (volume_.model[wall].origin != Origin::given ||
                std::ranges::find(faces_, wall) != faces_.end())
                continue;
            result_.report.push_back(
                formatted("walls: {} is smaller than the quads there, so it gets no quads and no group",
                          entity_of(volume_.model, wall)));
        }
    }

    ProvedSweep prove()
    {
        report_progress(context_, "proof of every cell", share::proof);
        check_cancelled(context_);
        std::set<FaceId> still = given_faces(volume_, seeds_->kept, options_.wedges);
        if (options_.beside.settle) {
            SettledNodes settled = options_.beside.settle(result_.skin(), faces_);
            still.merge(settled.faces);
            for (const auto& [node, place] : settled.nodes) result_.mesh.nodes[index(node)] = place;
        }
        quality::Proof proof = good_ ? quality::prove(mesh::LayeredMesh{result_.mesh, *result_.layers},
                                                      std::move(good_->found.quality),
                                                      std::move(good_->found.misplaced),
                                                      options_.min_scaled_jacobian)
                                     : prove_or_improve(result_, volume_.model, faces_, still,
                                                        std::move(held_), options_, context_);
        const quality::Quality& quality = proof.quality;
        const bool nearly_flat = quality.min_scaled_jacobian < kFoldedQuad;
        if (nearly_flat && !good_ && !motion_ && !keeps_target_) check_shrinking(result_.mesh);
        if (nearly_flat && imprint_ && imprint_->follows_quads)
            throw NotSweepable(
                Message("surface.not_imprinted",
                        "lines inside one end follow quads of the other that do not fit them: the "
                        "least scaled Jacobian is {:.2g}",
                        found(quality.min_scaled_jacobian))
                    .remedy("give another 'size', or cut the volume otherwise"));
        result_.min_scaled_jacobian = quality.min_scaled_jacobian;
        const std::string wedges = quality.wedges > 0 ? formatted(" hexahedra and {} wedges", quality.wedges)
                                                      : "";
        result_.report.push_back(
            formatted("cells: {}{}, all certified, scaled Jacobian {:.6f} at least, {:.6f} on "
                      "average",
                      quality.hexes, wedges, quality.min_scaled_jacobian, quality.mean_scaled_jacobian));
        report_given(options_.beside.given != nullptr ? *options_.beside.given : volume_, result_, options_);
        result_.quality = quality;
        return {std::move(result_), std::move(proof), faces_, seeds_->kept};
    }

    const OpenVolume& volume_;
    const SourceSize& sizes_;
    const surface::SizeField& size_ = sizes_.shape.at;
    const SweepOptions& options_;
    const RunContext& context_;
    const geometry::MotionPointer motion_;
    std::vector<surface::LinkingSurface> given_links_;
    std::optional<surface::Imprint> imprint_;
    /// The volume and its links, with the target's inner edges imprinted on the source.
    const OpenVolume* split_ = &volume_;
    std::vector<surface::LinkingSurface>* links_ = &given_links_;
    GivenMeshes given_;
    surface::LayerTables tables_;
    PlannedHeights planned_;
    std::optional<surface::Seeds> seeds_;
    surface::SourceMesh source_;
    std::vector<surface::WallMesh> walls_;
    RimColumns columns_;
    EndFaces ends_;
    Morphed target_;
    bool keeps_target_ = false;
    std::optional<GoodLayers> good_;
    std::vector<char> held_; ///< nodes that an improvement may not move
    std::vector<FaceId> faces_;
    Swept result_;
};

} // namespace

const OpenVolume& shape_of(const OpenVolume& volume, const SweepOptions& options)
{
    return options.beside.shape != nullptr ? *options.beside.shape : volume;
}

ProvedSweep sweep_between(const OpenVolume& volume, std::vector<surface::LinkingSurface> given_links,
                          const std::vector<double>& asked, const SourceSize& sizes,
                          const SweepOptions& options, Outline outline, const RunContext& context)
{
    return SweepBetween(volume, std::move(given_links), sizes, options, context).run(asked, outline);
}

} // namespace lacuna::sweep
