// SPDX-License-Identifier: MIT
#include <lacuna/sweep/detail/source_quads.h>

#include <lacuna/core/error.h>
#include <lacuna/core/shared/criteria.h>
#include <lacuna/core/shared/limits.h>
#include <lacuna/quads/shared/odd_region.h>
#include <lacuna/quads/shared/pattern_counts.h>
#include <lacuna/quads/shared/pave.h>
#include <lacuna/quads/shared/submap.h>
#include <lacuna/surface/shared/default_size.h>
#include <lacuna/surface/shared/quads_asked.h>
#include <lacuna/surface/shared/wall_columns.h>
#include <lacuna/sweep/detail/volume_share.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

namespace lacuna::sweep {

using namespace topology;

namespace {

/// Maximum number of cells if the size or the number of layers is not given. With more cells, a solver would
/// exceed the memory of a large workstation; often a length has the wrong unit. Not measured.
constexpr double kMostUnasked = 50e6;

/// Expected number of quads on the faces of a role (`power` 2), or of sides across these faces (`power` 1).
/// If some of the faces keep given quads, the other faces are assumed to have the same density; otherwise the
/// size is used.
double sides_over(const OpenVolume& volume, Role role, const surface::SizeField& size, int power,
                  const SweepOptions& options)
{
    const bool kept = role == Role::wall || options.quads == Quads::automatic || options.quads == Quads::keep;
    double by_size = 0, given = 0, given_area = 0, all_area = 0;
    for (const FaceId id : volume.faces(role)) {
        const Face& face = volume.model[id];
        const double area = face_area(volume.model, id);
        all_area += area;
        if (kept && face.keeps_nodes && has_cells_to_keep(face, false)) {
            given += area * std::pow(static_cast<double>(face.given_quads.size()) / area, power / 2.);
            given_area += area;
        }
        double sum = 0, sampled = 0;
        const std::size_t step = std::max<std::size_t>(1, face.triangles.size() / kFineChords);
        for (std::size_t t = 0; t < face.triangles.size(); t += step) {
            const Vec3 &a = volume.model.at(face.triangles[t][0]), &b = volume.model.at(face.triangles[t][1]),
                       &c = volume.model.at(face.triangles[t][2]);
            const double own = (b - a).cross(c - a).norm();
            sum += own * std::pow(size((a + b + c) / 3), -power);
            sampled += own;
        }
        by_size += area * sum / std::max(sampled, std::numeric_limits<double>::min());
    }
    return given_area > 0 ? given * all_area / given_area : by_size;
}

/// Additional quads due to the curvature of the rims. Away from the rim, the length of sides grows by 0.3 per
/// unit of distance, as in the paver. The number of quads is the integral of the inverse square of the side
/// length.
double quads_by_turns(std::span<const surface::LinkingSurface> links, const Model& model,
                      const surface::SizeField& size, int per_turn)
{
    double more = 0;
    for (const surface::LinkingSurface& link : links) {
        const std::vector<double> turning = surface::turning_of_segments(model, link);
        for (std::size_t i = 0; i < turning.size(); ++i) {
            const surface::RimSegment& segment = link.segments[i];
            const double middle[] = {(segment.source_from + segment.source_to) / 2};
            const double by_size = (segment.source_to - segment.source_from) /
                                   size(link.source.points(middle).front());
            more += std::max(0., turning[i] * per_turn / kFullTurn - by_size);
        }
    }
    return more / kGrading;
}

/// Estimate the number of cells from areas, lengths and given meshes. If the mesh would have more nodes than
/// can be numbered, it is refused here, before any memory is used.
ExpectedCells expected_cells(const OpenVolume& volume, const SourceSize& size, const SweepOptions& options,
                             KnownLinks& links, const RunContext& context)
{
    const double most = std::numeric_limits<Index>::max();
    double quads = std::max(1., sides_over(volume, Role::source, size.shape.at, 2, options));
    if (options.curvature > SweepOptions{}.curvature && !volume.faces(Role::wall).empty())
        quads += quads_by_turns(links.of(volume, context), volume.model, size.shape.at, options.curvature);
    double layers = std::max(options.layers.count, static_cast<int>(options.layers.heights.size()));
    const double asked = std::max(1., layers);
    if (!(quads * asked < most && asked < most / 16))
        throw InvalidInput(
            Message(
                "sweep.too_many",
                "about {:.2g} quads on the source and {:.0f} layers give more hexahedra than can be numbered",
                found(quads), found(asked))
                .remedy("use a larger 'size' or fewer 'layers'"));
    if (layers > 0 && options.size) return {quads * layers, 0};
    if (layers == 0) { // the mean width of the walls is the mean length of the rims
        double width = 0;
        for (const Role end : {Role::source, Role::target})
            for (const Rim& rim : rims(volume.model, volume.faces(end)))
                for (const EdgeUse& use : rim.uses) width += edge_length(volume.model, use.edge) / 2;
        layers = std::max(1., sides_over(volume, Role::wall, size.along, 1, options) / width);
    }
    return {quads * layers, quads * layers};
}

} // namespace

surface::QuadStyle style_of(const SweepOptions& options, bool rows_along_walls)
{
    if (options.quads == Quads::mapped) return surface::QuadStyle::mapped;
    if (options.quads == Quads::keep) return surface::QuadStyle::kept;
    if (options.quads != Quads::automatic) return surface::QuadStyle::free;
    return options.rows == 0 && !rows_along_walls ? surface::QuadStyle::automatic : surface::QuadStyle::rows;
}

quads::PlanarQuadMesher mesher_of(const SweepOptions& options, const SourceSize& size)
{
    if (options.quads == Quads::gmsh) return options.quad_mesher;
    if (options.quads == Quads::mapped) {
        return [](const quads::PlanarRegion& region, const RunContext& context) {
            if (auto grid = quads::submap(region, context)) return std::move(*grid);
            throw NotSweepable(
                Message("surface.not_submapped",
                        "a source face of right angles cannot be mapped: the grid within its {} boundary "
                        "nodes folds or overlaps",
                        found(region.points.size()))
                    .remedy("quads = \"auto\" paves it"));
        };
    }
    // A grid cannot add quads across a neck: their number follows from the rim.
    const bool grids = options.quads != Quads::paved && !size.narrow;
    return [pave = quads::PaveOptions{options.rows, grids, size.across}](const quads::PlanarRegion& region,
                                                                         const RunContext& context) {
        return quads::pave(region, pave, context).mesh;
    };
}

quads::PlanarQuadMesher mesher_for_all(const SweepOptions& options, const SourceSize& size)
{
    quads::PlanarQuadMesher mesher = mesher_of(options, size);
    if (!options.wedges || !mesher) return mesher;
    return [mesher = std::move(mesher)](const quads::PlanarRegion& region, const RunContext& context) {
        return quads::fill_odd_region(region, mesher, context);
    };
}

void reduce_by_shape(const OpenVolume& volume, const SweepOptions& options, SourceSize& size)
{
    const bool maps = options.quads == Quads::automatic || options.quads == Quads::mapped;
    const bool gap_by_default = size.by_default && options.gap == 0;
    size.sizing = gap_by_default ? surface::ShapeSizing{options.curvature, kDefaultGap, maps}
                                 : surface::ShapeSizing{options.curvature, options.gap};
    size.across = size.sizing.counts_across ? size.sizing.gap : 0;
    size.shape = surface::shape_size(volume, size.asked, size.sizing);
    // If narrow places would cause very many source quads by default, they stay coarse.
    if (gap_by_default && size.shape.width &&
        surface::asks_for_more(volume, size.shape.at, quads::kManyQuads)) {
        size.too_narrow = size.shape.width;
        size.sizing = {options.curvature, 0};
        size.shape = surface::shape_size(volume, size.asked, size.sizing);
    }
}

SourceSize source_size(const OpenVolume& volume, const SweepOptions& options, KnownLinks& links,
                       const RunContext& context)
{
    std::optional<SourceSize>& known = links.sizes(volume, options.curvature);
    if (known) return *known;
    SourceSize size;
    size.layers = links.plan.layers;
    if (options.size) {
        size.asked = surface::checked_size(options.size, "size");
    } else {
        size.by_default = surface::default_size(volume);
        const double part = links.plan.part;
        if (part < 1) size.by_default->why += formatted(", times {:.2g} because the ends bend", part);
        size.asked = surface::even_size(size.by_default->length *= part);
    }
    check_cancelled(context);
    reduce_by_shape(volume, options, size);
    const bool narrow_by_default = size.shape.width && options.gap == 0 && size.sizing.gap > 0;
    size.narrow = narrow_by_default || options.gap > 0;
    size.along = size.shape.at;
    if (narrow_by_default) {
        size.along = surface::shape_size(volume, size.asked, {options.curvature, 0}).at;
        size.sizing.counts_across = false;
    }
    size.expected = expected_cells(volume, size, options, links, context);
    known = size;
    return size;
}

void check_cells(const ExpectedCells& expected, const RunContext& context)
{
    const double all = expected.all;
    const std::string cells = all < 1e7    ? formatted("{:.0f}", all)
                              : all < 1e12 ? formatted("{:.0f} million", all / 1e6)
                                           : formatted("{:.2g}", all);
    log_line(context, formatted("estimate: about {} cells", cells));
    if (expected.unasked > kMostUnasked)
        throw InvalidInput(
            Message("sweep.many_cells",
                    "about {} cells are expected, and above {:.0f} million both 'size' and 'layers' must be "
                    "given",
                    found(cells), needed(kMostUnasked / 1e6))
                .remedy("use a larger 'size', or give both"));
}

surface::SizeFields size_fields(const surface::SizeField& size, const SweepOptions& options)
{
    if (options.rows == 0) return {size};
    return {size, options.row_height ? surface::checked_size(options.row_height, "row_height") : size};
}

} // namespace lacuna::sweep
