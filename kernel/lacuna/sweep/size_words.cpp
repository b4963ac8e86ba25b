// SPDX-License-Identifier: MIT
#include <lacuna/sweep/detail/size_words.h>

#include <lacuna/core/message.h>
#include <lacuna/core/shared/constants.h>

#include <cmath>

namespace lacuna::sweep {

using namespace topology;

namespace {

/// The face on the other side of an edge.
NamedEntity beyond(const Model& model, EdgeId edge, FaceId face)
{
    for (const FaceUse& use : model.uses_of_edge(edge))
        if (use.face != face) return entity_of(model, use.face);
    return entity_of(model, edge);
}

/// Describe the narrow place that requires a size.
std::string width_in_words(const Model& model, const surface::SizeCause& cause)
{
    const NamedEntity a = beyond(model, *cause.edge, cause.face), b = beyond(model, *cause.other, cause.face);
    const std::string sides = a == b ? formatted("within {}", a) : formatted("between {} and {}", a, b);
    return formatted("{:.2g} where {} is {:.2g} wide {}", cause.size, entity_of(model, cause.face),
                     cause.width, sides);
}

/// Describe the edge of the rim whose curvature requires the shortest sides.
std::string bends_in_words(const Model& model, const surface::Seeds& seeds)
{
    double least = kInfinity;
    EdgeId shortest;
    for (const auto& [edge, pieces] : seeds.pieces) {
        for (const surface::SeedPiece& piece : pieces) {
            const double side = piece.length / piece.count;
            if (piece.fixed || !piece.bends || side >= least) continue;
            least = side;
            shortest = edge;
        }
    }
    if (!std::isfinite(least)) return {};
    return formatted("{:.2g} on {}, by its curvature", least, entity_of(model, shortest));
}

} // namespace

std::vector<std::string> sizes_in_words(const OpenVolume& volume, const OpenVolume& split,
                                        const SourceSize& sizes, const surface::Seeds& seeds,
                                        const SweepOptions& options, const LayersTaken& layers)
{
    std::vector<std::string> finer;
    const surface::ShapeSize& shape = sizes.shape;
    if (shape.width) finer.push_back(width_in_words(volume.model, *shape.width));
    if (shape.curvature)
        finer.push_back(formatted("{:.2g} by the curvature of {}", shape.curvature->size,
                                  entity_of(volume.model, shape.curvature->face)));
    if (const std::string bends = bends_in_words(split.model, seeds); !bends.empty()) finer.push_back(bends);

    std::vector<std::string> lines;
    const bool kept = seeds.kept.size() == split.faces(Role::source).size();
    if (!kept && (sizes.by_default || !finer.empty())) {
        std::string line = sizes.by_default ? formatted("size: {:.2g} [model length] by default, {}",
                                                        sizes.by_default->length, sizes.by_default->why)
                                            : "size: as requested";
        for (std::size_t i = 0; i < finer.size(); ++i)
            line += (i == 0 ? "; less where the shape needs it: " : "; ") + finer[i];
        if (sizes.too_narrow)
            line += formatted(
                "; a size for {} quads across, as with 'gap', would give too many quads in total: it "
                "would be {}",
                kDefaultGap, width_in_words(volume.model, *sizes.too_narrow));
        lines.push_back(line);
    }
    if (options.layers.count == 0 && options.layers.heights.empty()) {
        lines.push_back(formatted("layer count: {} by default, {}", layers.count,
                                  layers.by_rows    ? "the rows of quads that walls came with"
                                  : layers.by_bends ? "for the bends of the walls, by 'curvature'"
                                  : !options.size && layers.count == kDefaultGap
                                      ? "about as high as the size, and three at least"
                                      : "about as high as the size"));
    }
    return lines;
}

} // namespace lacuna::sweep
