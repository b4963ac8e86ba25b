// SPDX-License-Identifier: MIT
#include <lacuna/view/detail/scene.h>

#include <lacuna/core/error.h>
#include <lacuna/core/shared/list_text.h>
#include <lacuna/core/shared/same_corners.h>
#include <lacuna/quality/shared/metrics.h>
#include <lacuna/view/detail/cell_set.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <optional>

namespace lacuna::view {

double quality_low(double least) { return std::min(0.5, std::floor(least * 10) / 10); }

namespace {

constexpr std::size_t kFaceOfQuadSide[] = {2, 1, 3, 0}; // face of the cell over side k of its source quad
constexpr std::size_t kBottom = 4, kTop = 5;
constexpr Colour kFreeEdge{214, 39, 40}, kEdge{40, 50, 60}, kVoidEdge{190, 110, 10};
constexpr Colour kPlain{240, 240, 240}; // colour of the legend's key for hatching

/// The visible cells of a swept region.
class ShownRegion {
public:
    ShownRegion(const Region& region, const PictureOptions& options)
        : mesh_(*region.mesh), quads_(mesh_.quads.size()), mask_(mesh_.cell_count(), 1)
    {
        across_ = mesh::opposite_sides(mesh_.quads, mesh_.nodes_per_layer);
        for (std::size_t r = 0; r < mesh_.rim.size(); ++r) rim_[mesh_.rim[r]] = r;
        for (std::size_t c = 0; c < mask_.size(); ++c) mask_[c] = shown(c, options) ? 1 : 0;
    }

    /// Call visit(cell, face, patch) for each face of a visible cell that no other visible cell shares. The
    /// patch is -1 for faces inside the mesh.
    template <class Visit>
    void sides(Visit&& visit) const
    {
        for (std::size_t c = 0; c < mask_.size(); ++c) {
            if (mask_[c] == 0) continue;
            const std::size_t q = c % quads_, layer = c / quads_;
            const bool last = layer + 1 == static_cast<std::size_t>(mesh_.layers);
            if (layer == 0)
                visit(c, kBottom, mesh_.source_patch[q]);
            else if (mask_[c - quads_] == 0)
                visit(c, kBottom, Index{-1});
            if (last)
                visit(c, kTop, mesh_.target_patch[q]);
            else if (mask_[c + quads_] == 0)
                visit(c, kTop, Index{-1});
            for (std::size_t k = 0; k < 4; ++k) {
                const Index other = across_[4 * q + k];
                if (other == mesh::kRimSide) {
                    const Segment side{mesh_.quads[q][k], mesh_.quads[q][(k + 1) % 4]};
                    visit(c, kFaceOfQuadSide[k], mesh_.wall_patch[layer * mesh_.rim.size() + rim_.at(side)]);
                } else if (other >= 0 && mask_[layer * quads_ + index(other) / 4] == 0) {
                    visit(c, kFaceOfQuadSide[k], Index{-1});
                }
            }
        }
    }

private:
    [[nodiscard]] bool shown(std::size_t cell, const PictureOptions& options) const
    {
        const auto layer = static_cast<int>(cell / quads_) + 1;
        if (options.layers && (layer < (*options.layers)[0] || layer > (*options.layers)[1])) return false;
        if (!options.cut) return true;
        Vec3 centre = Vec3::Zero();
        for (const Index n : mesh_.hex(cell)) centre += mesh_.nodes[index(n)] / 8;
        return (centre - options.cut->point).dot(options.cut->normal) <= 0;
    }

    const mesh::HexMesh& mesh_;
    std::size_t quads_;
    std::vector<std::uint8_t> mask_;
    std::vector<Index> across_;
    std::map<Segment, std::size_t> rim_;
};

/// Draw a face of a cell. A face of order 2 is divided at its middle nodes: one quad between them, and a
/// triangle at each corner.
/// @param curved  all nodes of a cell of order 2, as `mesh::merged_nodes()`; a count of 0: of order 1
/// @param place   returns the place of a node
template <class Place>
void add_side(std::vector<DrawnSide>& sides, const Hex& hex, const mesh::CellNodes& curved, std::size_t face,
              const Place& place, const DrawnSide& like)
{
    const Quad& corners = mesh::kHexFaces[face];
    std::vector<std::size_t> kept; // merged corners are repeated
    for (std::size_t k = 0; k < 4; ++k)
        if (hex[index(corners[k])] != hex[index(corners[(k + 1) % 4])]) kept.push_back(k);
    if (kept.size() < 3) return;
    const auto corner = [&](std::size_t k) { return place(hex[index(corners[kept[k]])]); };
    const std::size_t n = kept.size();
    DrawnSide side = like;
    side.count = n;
    if (curved.count == 0) {
        for (std::size_t k = 0; k < n; ++k) side.corner[k] = corner(k);
        sides.push_back(side);
        return;
    }
    const auto middle = [&](std::size_t k) {
        return place(curved.node[index(8 + mesh::kHexFaceEdges[face][kept[k % n]])]);
    };
    for (std::size_t k = 0; k < n; ++k) side.corner[k] = middle(k);
    side.hidden = 15;
    sides.push_back(side);
    side.count = 3;
    side.hidden = 4;
    for (std::size_t k = 0; k < n; ++k) {
        side.corner = {middle(k + n - 1), corner(k), middle(k), middle(k)};
        sides.push_back(side);
    }
}

Colour kind_colour(std::size_t i) { return kind_colours()[i % kind_colours().size()]; }

/// The data that determines the colours of a region.
struct Colours {
    ColourBy by;
    std::vector<double> quality;
    double low = 0;
    int layers = 1;
    std::size_t region = 0, first_patch = 0;
    std::vector<ShownPatch> patches;

    [[nodiscard]] Colour of(std::size_t cell, std::size_t layer, Index patch) const
    {
        switch (by) {
        case ColourBy::quality:
            return on_ramp(kQualityRamp, (quality[cell] - low) / (1 - low));
        case ColourBy::layer:
            return on_ramp(kOrderRamp, layers > 1 ? static_cast<double>(layer) / (layers - 1) : 0);
        case ColourBy::region:
            return kind_colour(region);
        case ColourBy::origin:
            return patch < 0 ? kInside : patches[index(patch)].made_void ? kVoid : kGiven;
        case ColourBy::group:
            break;
        }
        return patch < 0 ? kInside : kind_colour(first_patch + index(patch));
    }
    [[nodiscard]] bool hatched(Index patch) const
    {
        return (by == ColourBy::origin || by == ColourBy::group) && patch >= 0 &&
               patches[index(patch)].made_void;
    }
};

void check_layers(std::span<const Region> regions, const PictureOptions& options)
{
    if (!options.layers) return;
    int most = 0;
    for (const Region& region : regions) most = std::max(most, region.mesh->layers);
    const auto [from, to] = *options.layers;
    if (from < 1 || to < from || from > most)
        throw InvalidInput(Message("view.layers",
                                   "picture: option 'layers' is {} to {}, but the mesh has layers 1 to {}",
                                   found(from), found(to), needed(most))
                               .remedy("give first and last layer, in this order"));
}

/// For each part, the number of its region. Parts with the same name, such as copies, form one region.
template <class Regions>
std::vector<std::size_t> numbers_by_name(const Regions& regions)
{
    std::map<std::string, std::size_t> known;
    std::vector<std::size_t> numbers;
    for (const auto& region : regions)
        numbers.push_back(known.try_emplace(region.name, known.size()).first->second);
    return numbers;
}

std::string title_of(std::size_t regions, std::size_t cells)
{
    return formatted("{}, {}", counted(regions, "region"), counted(cells, "cell"));
}

std::string title_of(std::span<const Region> regions)
{
    std::size_t cells = 0;
    for (const Region& region : regions) cells += region.mesh->cell_count();
    if (regions.size() > 1) return title_of(std::ranges::max(numbers_by_name(regions)) + 1, cells);
    const auto layers = static_cast<std::size_t>(regions.front().mesh->layers);
    return formatted("{}: {}, {}", regions.front().name, counted(cells, "cell"), counted(layers, "layer"));
}

/// Whether sides inside the volume may be visible.
bool laid_open(const PictureOptions& options) { return options.cut || options.layers; }

template <class Regions>
Legend legend_of(const Regions& regions, const std::string& title, const std::vector<Colours>& colours,
                 const PictureOptions& options)
{
    Legend legend;
    legend.title = options.title.empty() ? title : options.title;
    bool made_void = false;
    switch (options.colour) {
    case ColourBy::quality:
        legend.ramp = kQualityRamp;
        legend.quantity = "scaled Jacobian, 1 is best";
        return legend;
    case ColourBy::layer:
        legend.ramp = kOrderRamp;
        legend.low = 1;
        legend.quantity = "layer, from the source";
        return legend;
    case ColourBy::region:
        for (std::size_t r = 0; const std::size_t number : numbers_by_name(regions)) {
            if (number == legend.keys.size()) legend.keys.push_back({kind_colour(number), regions[r].name});
            ++r;
        }
        return legend;
    case ColourBy::origin:
        for (const Colours& own : colours)
            for (const ShownPatch& patch : own.patches) made_void = made_void || patch.made_void;
        legend.keys.push_back({kGiven, "given"});
        if (made_void) legend.keys.push_back({kVoid, "void, closed", true});
        break;
    case ColourBy::group:
        for (const Colours& own : colours)
            for (std::size_t p = 0; p < own.patches.size(); ++p) {
                const ShownPatch& patch = own.patches[p];
                if (patch.quads == 0) continue;
                const std::string name = patch.groups.empty() ? formatted("patch {}", patch.tag)
                                                              : full_list(patch.groups, std::identity());
                legend.keys.push_back({kind_colour(own.first_patch + p), name, patch.made_void});
            }
        break;
    }
    if (laid_open(options)) legend.keys.push_back({kInside, "inside"});
    return legend;
}

/// Hide the edges of all sides, unless they are drawn.
/// @throw InvalidInput  there are no sides
void finish_sides(Scene& scene, const PictureOptions& options)
{
    if (!options.edges)
        for (DrawnSide& side : scene.sides) side.hidden = 15;
    if (scene.sides.empty())
        throw InvalidInput(Message("view.empty", "picture: option 'cut' hides all cells")
                               .remedy("reverse its normal or move its point"));
}

} // namespace

Scene scene_of(std::span<const Region> regions, const PictureOptions& options, const RunContext& context)
{
    check_layers(regions, options);
    Scene scene;
    std::vector<Colours> colours;
    double least = 1;
    int layers = 1;
    const std::vector<std::size_t> numbers = numbers_by_name(regions);
    for (const Region& region : regions) {
        Colours& own = colours.emplace_back();
        own.by = options.colour;
        own.region = numbers[colours.size() - 1];
        own.patches = shown_patches(*region.mesh);
        if (const std::size_t last = colours.size() - 1; last > 0)
            own.first_patch = colours[last - 1].first_patch + colours[last - 1].patches.size();
        layers = std::max(layers, region.mesh->layers);
        if (options.colour != ColourBy::quality) continue;
        own.quality = quality::metric_values(*region.mesh, quality::Metric::scaled_jacobian, context);
        for (const double value : own.quality) least = std::min(least, value);
    }
    for (std::size_t r = 0; r < regions.size(); ++r) {
        check_cancelled(context);
        const mesh::HexMesh& mesh = *regions[r].mesh;
        Colours& own = colours[r];
        own.low = quality_low(least);
        own.layers = layers;
        ShownRegion(regions[r], options).sides([&](std::size_t cell, std::size_t face, Index patch) {
            DrawnSide like;
            like.colour = own.of(cell, cell / mesh.quads.size(), patch);
            like.hatched = own.hatched(patch);
            const mesh::CellNodes curved = mesh.order() > 1 ? mesh::cell_nodes(mesh, cell)
                                                            : mesh::CellNodes();
            add_side(
                scene.sides, mesh.hex(cell), curved, face, [&](Index n) { return mesh.node(index(n)); },
                like);
        });
    }
    finish_sides(scene, options);
    scene.legend = legend_of(regions, title_of(regions), colours, options);
    if (options.colour == ColourBy::quality) scene.legend.low = quality_low(least);
    if (options.colour == ColourBy::layer) scene.legend.high = layers;
    return scene;
}

namespace {

/// The corners of a cell's face; a triangle as {a, b, c, c}. A cell may be stored with merged corners: empty
/// if the face has collapsed to an edge or a point.
std::optional<Quad> face_nodes(const Hex& hex, const Quad& face)
{
    Quad nodes{};
    std::size_t count = 0;
    for (std::size_t k = 0; k < 4; ++k) {
        const Index node = hex[index(face[k])];
        if (node != hex[index(face[(k + 1) % 4])]) nodes[count++] = node;
    }
    if (count < 3) return std::nullopt;
    if (count == 3) nodes[3] = nodes[2];
    return nodes;
}

/// Add the sides of the visible cells of a region that no other visible cell shares.
void add_sides(Scene& scene, const ListedCells& region, const Colours& colours, const PictureOptions& options)
{
    std::map<Quad, Index> patch; // of the sides of the skin
    for (std::size_t i = 0; i < region.sides.size(); ++i)
        patch[face_key(region.sides[i])] = region.side_patch[i];
    std::map<Quad, std::pair<std::size_t, std::size_t>> open; // cell and face of sides used once
    for (std::size_t c = 0; c < region.cells.size(); ++c) {
        Vec3 centre = Vec3::Zero();
        for (const Index n : region.cells[c]) centre += region.nodes[index(n)] / 8;
        if (options.cut && (centre - options.cut->point).dot(options.cut->normal) > 0) continue;
        for (std::size_t face = 0; face < mesh::kHexFaces.size(); ++face) {
            const std::optional<Quad> nodes = face_nodes(region.cells[c], mesh::kHexFaces[face]);
            if (!nodes) continue;
            const auto [known, fresh] = open.try_emplace(face_key(*nodes), c, face);
            if (!fresh) open.erase(known);
        }
    }
    for (const auto& [key, side] : open) {
        const auto& [cell, face] = side;
        const auto found = patch.find(key);
        const Index own = found != patch.end() ? found->second : -1;
        DrawnSide drawn;
        drawn.colour = colours.of(cell, 0, own);
        drawn.hatched = colours.hatched(own);
        add_side(
            scene.sides, region.cells[cell], region.curved.empty() ? mesh::CellNodes() : region.curved[cell],
            face, [&](Index n) { return region.nodes[index(n)]; }, drawn);
    }
}

} // namespace

Scene scene_of(const DeckCells& deck, const PictureOptions& options, const RunContext& context)
{
    if (options.layers || options.colour == ColourBy::layer)
        throw InvalidInput(
            Message("view.layers",
                    "picture: only swept meshes have layers; meshes read from a file and meshes with "
                    "tetrahedra have none")
                .remedy("leave out 'layers', and colour by quality, groups or region"));
    Scene scene;
    Colours colours;
    colours.by = options.colour;
    colours.patches = deck.patches;
    double least = 1;
    std::size_t cells = 0;
    for (const ListedCells& region : deck.regions) {
        cells += region.cells.size();
        for (const double value : region.quality) least = std::min(least, value);
    }
    colours.low = quality_low(least);
    for (const ListedCells& region : deck.regions) {
        check_cancelled(context);
        colours.quality = region.quality;
        add_sides(scene, region, colours, options);
        ++colours.region;
    }
    finish_sides(scene, options);
    scene.legend = legend_of(deck.regions, title_of(deck.regions.size(), cells), {colours}, options);
    if (options.colour == ColourBy::quality) scene.legend.low = colours.low;
    return scene;
}

namespace {

Colour role_colour(topology::Role role)
{
    return role == topology::Role::source ? kSource : role == topology::Role::target ? kTarget : kWall;
}

Legend legend_of(const topology::Model& model, const std::vector<topology::Role>* roles,
                 const PictureOptions& options)
{
    std::size_t given = 0, closed = 0, free = 0;
    for (const topology::Face& face : model.faces)
        (face.origin == topology::Origin::made_void ? closed : given) += 1;
    for (std::size_t e = 0; e < model.edges.size(); ++e)
        free += model.uses_of_edge(EdgeId(e)).size() == 1 ? 1 : 0;
    Legend legend;
    legend.title = options.title;
    if (legend.title.empty())
        legend.title = formatted("{}{}, {}", counted(given, "given face"),
                                 closed > 0 ? formatted(", {} void", closed) : "",
                                 counted(free, "free edge"));
    if (roles == nullptr) {
        legend.keys.push_back({kGiven, "given"});
    } else {
        const std::pair<topology::Role, const char*> names[] = {{topology::Role::source, "source"},
                                                                {topology::Role::target, "target"},
                                                                {topology::Role::wall, "wall"}};
        for (const auto& [role, name] : names)
            if (std::find(roles->begin(), roles->end(), role) != roles->end())
                legend.keys.push_back({role_colour(role), name});
    }
    if (closed > 0) legend.keys.push_back({roles == nullptr ? kVoid : kPlain, "void, closed", true});
    if (free > 0) legend.keys.push_back({kFreeEdge, "free edge", false, true});
    return legend;
}

} // namespace

Scene scene_of(const topology::Model& model, const std::vector<topology::Role>* roles,
               const PictureOptions& options)
{
    Scene scene;
    const auto colour_of = [&](std::size_t f) {
        if (roles == nullptr) return model.faces[f].origin == topology::Origin::made_void ? kVoid : kGiven;
        return role_colour((*roles)[f]);
    };
    for (std::size_t f = 0; f < model.faces.size(); ++f) {
        const topology::Face& face = model.faces[f];
        DrawnSide side;
        side.colour = colour_of(f);
        side.hatched = face.origin == topology::Origin::made_void;
        side.closed = false;
        for (const Quad& quad : face.given_quads) {
            for (std::size_t k = 0; k < 4; ++k) side.corner[k] = model.at(quad[k]);
            scene.sides.push_back(side);
        }
        side.count = 3;
        side.hidden = options.facets ? 0 : 15;
        for (const Triangle& triangle : topology::loose_triangles(face)) {
            for (std::size_t k = 0; k < 3; ++k) side.corner[k] = model.at(triangle[k]);
            scene.sides.push_back(side);
        }
    }
    for (std::size_t e = 0; e < model.edges.size(); ++e) {
        const topology::Edge& edge = model.edges[e];
        const bool free = model.uses_of_edge(EdgeId(e)).size() == 1;
        DrawnLine line;
        line.colour = free ? kFreeEdge : edge.origin == topology::Origin::made_void ? kVoidEdge : kEdge;
        line.width = free ? 4 : 2;
        for (std::size_t i = 0; i + 1 < edge.points.size(); ++i) {
            line.from = model.at(edge.points[i]);
            line.to = model.at(edge.points[i + 1]);
            scene.lines.push_back(line);
        }
    }
    scene.legend = legend_of(model, roles, options);
    return scene;
}

} // namespace lacuna::view
