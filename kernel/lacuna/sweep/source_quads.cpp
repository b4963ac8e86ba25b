// SPDX-License-Identifier: MIT
#include <lacuna/sweep/detail/source_quads.h>

#include <lacuna/core/error.h>
#include <lacuna/core/number_text.h>
#include <lacuna/quads/odd_region.h>
#include <lacuna/quads/pave.h>
#include <lacuna/quads/submap.h>
#include <lacuna/surface/quads_asked.h>
#include <lacuna/sweep/detail/volume_share.h>
#include <lacuna/sweep/detail/words.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace lacuna::sweep {

using namespace topology;

namespace {

/// Quads on the source that narrow places may ask for where nobody asked for quads across them. A ring of
/// three quads in a width of a 200th of its radius has some 8,000. A choice, not a measurement.
constexpr double kMostForWidth = 20000;

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

} // namespace

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

quads::PlanarQuadMesher mesher_for_all(const SweepOptions& options, bool narrow)
{
    quads::PlanarQuadMesher mesher = mesher_of(options, narrow);
    if (!options.wedges || !mesher) return mesher;
    return [mesher = std::move(mesher)](const quads::PlanarRegion& region, const RunContext& context) {
        return quads::fill_odd_region(region, mesher, context);
    };
}

SourceSize source_size(const OpenVolume& volume, const SweepOptions& options, KnownLinks& links,
                       const RunContext& context)
{
    SourceSize size;
    if (options.size) {
        size.asked = checked(options.size, "size");
    } else {
        size.by_default = surface::default_size(volume);
        size.asked = even_size(size.by_default->length);
        const double part = sizes_by_default(options)
                                ? planned_part_of_size(volume, links, options, size.asked, context)
                                : 1;
        if (part < 1) {
            size.by_default->why += ", of that " + in_short(part) + " for the bends of the ends";
            size.asked = even_size(size.by_default->length *= part);
        }
    }
    check_amount(volume, size.asked, options.layers);
    const bool maps = options.quads == Quads::automatic || options.quads == Quads::mapped;
    const bool gap_by_default = size.by_default && options.gap == 0;
    check_cancelled(context);
    size.sizing = gap_by_default ? surface::ShapeSizing{options.curvature, kDefaultGap, maps}
                                 : surface::ShapeSizing{options.curvature, options.gap};
    size.shape = surface::shape_size(volume, size.asked, size.sizing);
    if (gap_by_default && size.shape.width && surface::asks_for_more(volume, size.shape.at, kMostForWidth)) {
        size.too_narrow = size.shape.width;
        size.sizing = {options.curvature, 0};
        size.shape = surface::shape_size(volume, size.asked, size.sizing);
    }
    const bool narrow_by_default = size.shape.width && options.gap == 0 && size.sizing.gap > 0;
    size.narrow = narrow_by_default || options.gap > 0;
    size.along = size.shape.at;
    if (narrow_by_default) {
        size.along = surface::shape_size(volume, size.asked, {options.curvature, 0}).at;
        size.sizing.counts_across = false;
    }
    return size;
}

surface::SizeFields size_fields(const surface::SizeField& size, const SweepOptions& options)
{
    if (options.rows == 0) return {size};
    return {size, options.row_height ? checked(options.row_height, "row_height") : size};
}

} // namespace lacuna::sweep
