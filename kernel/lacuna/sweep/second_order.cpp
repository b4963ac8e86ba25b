// SPDX-License-Identifier: MIT
#include <lacuna/sweep/detail/second_order.h>

#include <lacuna/core/error.h>
#include <lacuna/core/shared/constants.h>
#include <lacuna/quality/shared/second_order.h>
#include <lacuna/sweep/detail/middle_placer.h>

#include <limits>

namespace lacuna::sweep {

namespace {

/// Check that there are enough node numbers.
void check_amount(const mesh::HexMesh& mesh)
{
    const std::size_t all = mesh::corner_count(mesh) + mesh::middle_count(mesh);
    if (all <= static_cast<std::size_t>(std::numeric_limits<Index>::max())) return;
    throw InvalidInput(Message("sweep.too_many",
                               "a mesh of order 2 would need {} node numbers, more than there are",
                               found(all))
                           .remedy("use a larger 'size' or fewer 'layers'"));
}

/// Try to generate middle nodes on demand. @return  the generator and the quality; no generator if some cell
/// is not valid
Elevated leave_to_be_made(const PlacedLayers& layers, const mesh::HexMesh& mesh, const PlacedSkin& skin,
                          const Crew* crew, const RunContext& context)
{
    Elevated result;
    result.layers = with_middles(layers, {mesh.middles.full, skin.middles.nodes()}, context);
    result.quality = find_in_layers(*result.layers, kInfinity, crew, context).quality;
    if (result.quality.uncertified > 0) result.layers.reset();
    return result;
}

/// Store the middle nodes. @throw NotSweepable "sweep.second_order"  a cell is invalid
void hold_middles(const topology::OpenVolume& volume, mesh::HexMesh& mesh, const std::vector<FaceId>& faces,
                  const SkinMiddles& skin, Elevated& result, const RunContext& context)
{
    mesh.middles.nodes.resize(mesh::middle_count(mesh));
    MiddlePlacer({mesh}, skin.nodes(), context).place(0, mesh.layers, mesh.middles.nodes, context);
    check_cancelled(context);
    result.quality = quality::measure(mesh, context);
    if (result.quality.uncertified == 0) return;
    const std::vector<std::size_t> invalid = quality::invalid_cells(mesh, context);
    if (!invalid.empty()) refuse_middles(volume, mesh, faces, skin, invalid.front(), invalid.size());
}

} // namespace

Elevated elevate(const topology::OpenVolume& volume, mesh::HexMesh& mesh, const std::vector<FaceId>& faces,
                 const SecondOrderOptions& options, const RunContext& context, const PlacedLayers* layers,
                 const Crew* crew)
{
    mesh.middles = mesh::number_sides(mesh, !options.serendipity);
    check_amount(mesh);
    const PlacedSkin skin = place_skin(volume, {mesh, layers != nullptr ? &layers->nodes : nullptr}, faces,
                                       options, context);
    check_cancelled(context);
    Elevated result;
    if (layers != nullptr) {
        result = leave_to_be_made(*layers, mesh, skin, crew, context);
        if (!result.layers) {
            mesh.nodes.resize(mesh::corner_count(mesh));
            layers->nodes.place(0, mesh.layers + 1, mesh.nodes, context);
        }
    }
    if (!result.layers) hold_middles(volume, mesh, faces, skin.middles, result, context);
    result.report = formatted("order 2: {}, {} middle nodes; of those on the skin {} on exact curves and "
                              "surfaces, {} on facets, {} given",
                              mesh.middles.full ? "hex27" : "hex20", mesh::middle_count(mesh),
                              skin.counts.exact, skin.counts.facets, skin.counts.given);
    return result;
}

} // namespace lacuna::sweep
