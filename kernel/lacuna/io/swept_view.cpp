// SPDX-License-Identifier: MIT
#include <lacuna/io/detail/swept_view.h>

#include <lacuna/core/error.h>
#include <lacuna/io/detail/cell_shapes.h>
#include <lacuna/io/detail/texts.h>

#include <algorithm>
#include <set>
#include <string>
#include <utility>

namespace lacuna::io {
namespace {

using mesh::MeshView;
using mesh::Ranges;

/// Add the entities and, for each group, the list of its entities.
void add_entities(const mesh::HexMesh& mesh, MeshView& view)
{
    const auto list = [&](const std::string& name, int number) {
        auto found = std::ranges::find(view.lists, name, &std::pair<std::string, std::vector<int>>::first);
        if (found == view.lists.end()) found = view.lists.insert(found, {name, {}});
        found->second.push_back(number);
    };
    for (const mesh::SkinPatch& patch : mesh.patches) {
        for (const std::string& name : patch.groups) list(name, patch.tag);
        MeshView::Entity entity{
            .dimension = 2, .tag = patch.tag, .number = patch.tag, .groups = patch.groups};
        if (entity.groups.empty()) entity.groups = {"surface:" + std::to_string(patch.tag)};
        view.entities.push_back(std::move(entity));
    }
    for (const std::string& name : mesh.volume_groups) list(name, 0);
    MeshView::Entity volume{.dimension = 3, .tag = 1, .groups = mesh.volume_groups};
    if (volume.groups.empty()) volume.groups = {"volume"};
    view.node_entity = view.entities.size();
    view.entities.push_back(std::move(volume));
}

void add_blocks(const std::shared_ptr<const SweptCells>& cells, MeshView& view)
{
    for (std::size_t k = 0; k < 4; ++k) {
        MeshView::Block& block = view.blocks.emplace_back();
        block.shape = cells->shapes()[k];
        block.count = cells->count[k];
        block.nodes = [cells, k](std::size_t begin, std::size_t end, Index* out) {
            cells->put_nodes(k, begin, end, out);
        };
        if (k < 2) mesh::add_run(block.entities, block.count, static_cast<Index>(cells->mesh.patches.size()));
        for (std::size_t i = 0; k >= 2 && i < block.count; ++i)
            mesh::add_run(block.entities, i + 1, skin_quad(cells->mesh, cells->skin(k, i)).patch);
    }
    std::vector<char> has_quads(cells->mesh.patches.size(), 0);
    for (const std::size_t k : {std::size_t(2), std::size_t(3)})
        for (const auto& [end, patch] : view.blocks[k].entities) has_quads[index(patch)] = 1;
    for (std::size_t p = 0; p < has_quads.size(); ++p)
        if (has_quads[p] != 0) view.entities.back().bounds.push_back(view.entities[p].tag);
}

void add_fields(const std::shared_ptr<const SweptCells>& cells, const std::vector<FieldReader>& fields,
                MeshView& view)
{
    if (fields.empty()) return;
    const auto behind = std::make_shared<const std::vector<std::uint32_t>>(cells_of_skin(cells->mesh));
    for (const FieldReader& field : fields)
        view.fields.push_back(
            {field.name(), [=, &field](std::size_t k, std::size_t begin, std::size_t end, double* out) {
                 const auto put = [&](std::size_t, double value) { *out++ = value; };
                 if (k < 2)
                     return field.each_cell(
                         begin, end, [&](std::size_t i) { return cells->cell(k, i); }, put);
                 field.each_behind_skin(
                     begin, end, *behind, [&](std::size_t i) { return cells->skin(k, i); }, put);
             }});
}

std::vector<Eigen::AlignedBox3d> boxes_of(const mesh::HexMesh& mesh, const NodeReader& nodes)
{
    std::vector<Eigen::AlignedBox3d> boxes(mesh.patches.size() + 1);
    for (std::size_t i = 0; i < mesh.skin_count(); ++i) {
        Eigen::AlignedBox3d& box = boxes[index(skin_quad(mesh, i).patch)];
        for (const Index node : skin_nodes(mesh, i)) box.extend(nodes.on_skin(node));
    }
    // The interior of a valid mesh lies within the bounding box of its skin.
    for (std::size_t p = 0; p < mesh.patches.size(); ++p) boxes.back().extend(boxes[p]);
    return boxes;
}

/// The nodes of the levels [first, last], mid-side nodes included. With `below`, level `last` is excluded.
Ranges nodes_of_levels(const mesh::HexMesh& mesh, int first, int last, bool below)
{
    const std::size_t row = index(mesh.nodes_per_layer), corners = mesh::corner_count(mesh);
    Ranges nodes(index(first) * row, index(last + (below ? 0 : 1)) * row);
    if (mesh.order() == 1) return nodes;
    const mesh::MiddlePlaces places(mesh);
    const std::size_t end = below ? places.side(index(last), 0)
                                  : places.side(index(last), 0) + (places.upright(0, 0) - places.side(0, 0));
    nodes.add(corners + places.side(index(first), 0), corners + std::min(end, places.count()));
    return nodes;
}

} // namespace

Index* SweptCells::put_nodes(std::size_t kind, std::size_t begin, std::size_t end, Index* out) const
{
    if (kind == 0 && mesh.order() == 1) return put_hexes(begin, end, out);
    for (std::size_t i = begin; i < end; ++i) {
        const mesh::CellNodes own = kind < 2 ? cell_nodes(mesh, cell(kind, i))
                                             : skin_nodes(mesh, skin(kind, i));
        out = std::ranges::copy(own.all(), out).out;
    }
    return out;
}

Index* SweptCells::put_hexes(std::size_t begin, std::size_t end, Index* out) const
{
    while (begin < end) {
        const std::size_t layer = begin / quads, stop = std::min(end, (layer + 1) * quads);
        const Index low = static_cast<Index>(layer) * mesh.nodes_per_layer;
        const Index high = low + mesh.nodes_per_layer;
        for (const Quad* quad = mesh.quads.data() + begin % quads; begin < stop; ++begin, ++quad, out += 8)
            for (std::size_t k = 0; k < 4; ++k) {
                out[k] = low + (*quad)[k];
                out[4 + k] = high + (*quad)[k];
            }
    }
    return out;
}

void check_skin(const mesh::HexMesh& mesh)
{
    const auto layers = static_cast<std::size_t>(std::max(mesh.layers, 0));
    const auto valid = [&](Index patch) {
        return patch >= 0 && static_cast<std::size_t>(patch) < mesh.patches.size();
    };
    const bool sizes = mesh.source_patch.size() == mesh.quads.size() &&
                       mesh.target_patch.size() == mesh.quads.size() &&
                       mesh.wall_patch.size() == layers * mesh.rim.size();
    if (!sizes || !std::all_of(mesh.source_patch.begin(), mesh.source_patch.end(), valid) ||
        !std::all_of(mesh.target_patch.begin(), mesh.target_patch.end(), valid) ||
        !std::all_of(mesh.wall_patch.begin(), mesh.wall_patch.end(), valid))
        throw InvalidInput("io.no_patch", "a quad of the skin belongs to no patch; assign each quad to one");
    std::set<int> tags;
    for (const mesh::SkinPatch& patch : mesh.patches)
        if (patch.tag <= 0 || !tags.insert(patch.tag).second)
            throw InvalidInput("io.patch_tag", "the skin {} must have its own positive tag",
                               numbered("patch", patch.tag));
}

std::shared_ptr<MeshView> view_of(const mesh::HexMesh& mesh, const NodeReader& nodes,
                                  const std::vector<FieldReader>& fields)
{
    check_skin(mesh);
    auto view = std::make_shared<MeshView>();
    view->points = nodes.count();
    view->each_point = [&nodes](std::size_t begin, std::size_t end, const MeshView::TakePoints& take) {
        nodes.each_span(begin, end, take);
    };
    const auto cells = std::make_shared<const SweptCells>(mesh);
    add_entities(mesh, *view);
    add_blocks(cells, *view);
    add_fields(cells, fields, *view);
    view->boxes = [&mesh, &nodes] { return boxes_of(mesh, nodes); };
    return view;
}

mesh::ViewParts parts_of(const mesh::HexMesh& mesh, const PartitionOptions& options)
{
    const std::vector<LayerPart> layers = layer_parts(mesh.layers, options);
    const SweptCells cells(mesh);
    mesh::ViewParts parts;
    parts.parts = static_cast<int>(layers.size());
    parts.has_ghosts = options.ghosts > 0;
    parts.of.resize(4);
    const Index last = static_cast<Index>(layers.size()) - 1;
    // Skin quads and triangles belong to the part of their cell. Those on the source belong to the first
    // part, those on the target to the last.
    for (const std::size_t k : {std::size_t(2), std::size_t(3)}) {
        const std::size_t each_end = k == 2 ? cells.quads : cells.triangles;
        mesh::add_run(parts.of[k], each_end, 0);
        mesh::add_run(parts.of[k], 2 * each_end, last);
    }
    for (Index p = 0; p <= last; ++p) {
        const LayerPart& part = layers[index(p)];
        for (const std::size_t k : {std::size_t(0), std::size_t(1)})
            mesh::add_run(parts.of[k], index(part.last) * cells.in_layer(k), p);
        mesh::add_run(parts.of[2], 2 * cells.quads + cells.rims(part.last), p);
        parts.points.emplace_back(p, nodes_of_levels(mesh, part.first, part.last, p != last));
        parts.used.push_back(nodes_of_levels(mesh, part.with_first, part.with_last, false));
    }
    // Collect consecutive layers of a part that are ghosts of the same other parts.
    const auto others = [&](Index own, int layer) {
        std::vector<int> of;
        for (Index p = 0; p <= last; ++p)
            if (p != own && layers[index(p)].with_first <= layer && layer < layers[index(p)].with_last)
                of.push_back(p);
        return of;
    };
    for (Index p = 0; parts.has_ghosts && p <= last; ++p)
        for (int first = layers[index(p)].first, next = first; first < layers[index(p)].last; first = next) {
            const std::vector<int> of = others(p, first);
            while (next < layers[index(p)].last && others(p, next) == of) ++next;
            for (const std::size_t k : {std::size_t(0), std::size_t(1)})
                if (!of.empty() && cells.in_layer(k) > 0)
                    parts.ghosts.push_back(
                        {p, of, k, {index(first) * cells.in_layer(k), index(next) * cells.in_layer(k)}});
        }
    return parts;
}

} // namespace lacuna::io
