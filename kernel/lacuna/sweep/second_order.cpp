// SPDX-License-Identifier: MIT
#include <lacuna/sweep/detail/second_order.h>

#include <lacuna/core/error.h>
#include <lacuna/core/shared/constants.h>
#include <lacuna/sweep/detail/middle_placer.h>

#include <limits>

namespace lacuna::sweep {

namespace {

/// Check that there are enough node numbers. Cells of 20 nodes use up numbers for 27, because `finer_skin()`
/// compares the skin with all of them.
void check_amount(const mesh::HexMesh& mesh)
{
    const std::size_t row = index(mesh.nodes_per_layer) + mesh.middles.sides.size() + mesh.quads.size();
    const std::size_t all = (2 * index(mesh.layers) + 1) * row;
    if (all <= static_cast<std::size_t>(std::numeric_limits<Index>::max())) return;
    throw InvalidInput(Message("sweep.too_many",
                               "a mesh of order 2 would need {} node numbers, more than there are",
                               found(all))
                           .remedy("use a larger 'size' or fewer 'layers'"));
}

/// Generate nodes on demand: the quality of such a mesh, and its nodes; empty if some cell is not valid.
Elevated leave_to_be_made(const PlacedLayers& layers, const mesh::HexMesh& mesh, const PlacedSkin& skin,
                          const Crew* crew, const RunContext& context)
{
    Elevated result;
    result.layers = with_middles(layers, {mesh.middles.full, skin.middles.nodes()}, context);
    result.quality = find_in_layers(*result.layers, kInfinity, crew, context).quality;
    if (result.quality.uncertified > 0) result.layers.reset();
    return result;
}

/// Store the middle nodes, and move those of invalid cells. @return  number of cells that were invalid
std::size_t hold_middles(const topology::OpenVolume& volume, mesh::HexMesh& mesh,
                         const std::vector<FaceId>& faces, const SkinMiddles& skin, Elevated& result,
                         const RunContext& context)
{
    mesh.middles.nodes.resize(mesh::middle_count(mesh));
    MiddlePlacer({mesh}, skin.nodes(), context).place(0, mesh.layers, mesh.middles.nodes, context);
    check_cancelled(context);
    result.quality = quality::measure(mesh, context);
    if (result.quality.uncertified == 0) return 0;
    const std::size_t repaired = repair_middles(volume, mesh, faces, skin, context);
    result.quality = quality::measure(mesh, context);
    return repaired;
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
    std::size_t repaired = 0;
    if (layers != nullptr) {
        result = leave_to_be_made(*layers, mesh, skin, crew, context);
        if (!result.layers) {
            mesh.nodes.resize(mesh::corner_count(mesh));
            layers->nodes.place(0, mesh.layers + 1, mesh.nodes, context);
        }
    }
    if (!result.layers) repaired = hold_middles(volume, mesh, faces, skin.middles, result, context);
    result.report = formatted("order 2: {}, {} middle nodes; of those on the skin {} on exact curves and "
                              "surfaces, {} on facets, {} given",
                              mesh.middles.full ? "hex27" : "hex20", mesh::middle_count(mesh),
                              skin.counts.exact, skin.counts.facets, skin.counts.given);
    if (repaired > 0)
        result.report += formatted("; the inner ones of {} cells moved to make them valid", repaired);
    return result;
}

namespace {

/// The middle of quad `i` of a skin.
Vec3 middle_of_skin_quad(const mesh::SkinNodes& skin, std::size_t i)
{
    const mesh::CellNodes nodes = mesh::skin_nodes(skin.mesh, i);
    if (nodes.count == 9) return skin[nodes.node[8]];
    Vec3 middle = Vec3::Zero();
    for (std::size_t k = 0; k < 4; ++k) middle += skin[nodes.node[4 + k]] / 2 - skin[nodes.node[k]] / 4;
    return middle;
}

/// Finds the position of a node of the finer skin. On a level, its nodes are numbered corners first, then
/// side midpoints, then quad centres; between two levels come midpoints of upright sides, then centres of
/// faces, then of cells.
class FinerNodes {
public:
    explicit FinerNodes(const mesh::SkinNodes& skin)
        : skin_(skin), places_(skin.mesh), rim_of_(skin.mesh.middles.sides.size(), 0)
    {
        for (std::size_t r = 0; r < skin.mesh.rim.size(); ++r)
            rim_of_[index(skin.mesh.middles.rim_side[r])] = r;
    }

    [[nodiscard]] Index row() const
    {
        return skin_.mesh.nodes_per_layer + sides() + static_cast<Index>(skin_.mesh.quads.size());
    }
    [[nodiscard]] Vec3 operator()(Index node) const
    {
        const mesh::HexMesh& mesh = skin_.mesh;
        const Index at = node % row(), side = at - mesh.nodes_per_layer;
        const bool between = node / row() % 2 == 1;
        const std::size_t level = index(node / row() / 2);
        if (side < 0)
            return between ? middle(places_.upright(level, at))
                           : skin_[static_cast<Index>(level) * mesh.nodes_per_layer + at];
        const std::size_t quads = mesh.quads.size();
        if (side < sides())
            return between ? middle_of_skin_quad(skin_,
                                                 2 * quads + level * mesh.rim.size() + rim_of_[index(side)])
                           : middle(places_.side(level, side));
        return middle_of_skin_quad(skin_, index(side - sides()) + (level > 0 ? quads : 0));
    }

private:
    [[nodiscard]] Index sides() const { return static_cast<Index>(rim_of_.size()); }
    [[nodiscard]] Vec3 middle(std::size_t place) const
    {
        return skin_[static_cast<Index>(mesh::corner_count(skin_.mesh) + place)];
    }

    mesh::SkinNodes skin_;
    mesh::MiddlePlaces places_;
    std::vector<std::size_t> rim_of_; ///< for each side of the source, its index on the rim
};

} // namespace

FinerSkin finer_skin(const mesh::SkinNodes& skin)
{
    const mesh::HexMesh& mesh = skin.mesh;
    const FinerNodes nodes(skin);
    FinerSkin result;
    mesh::HexMesh& fine = result.mesh;
    fine.nodes_per_layer = nodes.row();
    fine.layers = 2 * mesh.layers;
    fine.patches = mesh.patches;
    const auto middle = [&](Index side) { return mesh.nodes_per_layer + side; };
    const Index first_centre = middle(static_cast<Index>(mesh.middles.sides.size()));
    for (std::size_t q = 0; q < mesh.quads.size(); ++q) {
        for (std::size_t k = 0; k < 4; ++k) {
            const Quad& side = mesh.middles.side_of[q];
            fine.quads.push_back({mesh.quads[q][k], middle(side[k]), first_centre + static_cast<Index>(q),
                                  middle(side[(k + 3) % 4])});
            fine.source_patch.push_back(mesh.source_patch[q]);
            fine.target_patch.push_back(mesh.target_patch[q]);
        }
    }
    for (std::size_t r = 0; r < mesh.rim.size(); ++r) {
        fine.rim.push_back({mesh.rim[r][0], middle(mesh.middles.rim_side[r])});
        fine.rim.push_back({middle(mesh.middles.rim_side[r]), mesh.rim[r][1]});
    }
    for (int l = 0; l < fine.layers; ++l)
        for (std::size_t r = 0; r < mesh.rim.size(); ++r)
            fine.wall_patch.insert(fine.wall_patch.end(), 2,
                                   mesh.wall_patch[index(l / 2) * mesh.rim.size() + r]);
    for (Index n = 0; n < fine.nodes_per_layer; ++n) fine.nodes.push_back(nodes(n));
    result.nodes.on_skin = nodes;
    return result;
}

} // namespace lacuna::sweep
