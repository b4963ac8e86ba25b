// SPDX-License-Identifier: MIT
#include <lacuna/io/detail/node_reader.h>

#include <lacuna/core/shared/bytes.h>
#include <lacuna/core/shared/team.h>

#include <algorithm>

namespace lacuna::io {

NodeReader::NodeReader(const mesh::LayeredMesh& layered, const RunContext& context)
    : mesh_(layered.mesh), layers_(&layered.nodes)
{
    const int levels = mesh::layers_at_once(mesh_);
    const std::size_t row = index(mesh_.nodes_per_layer);
    const auto at_once = static_cast<std::size_t>(levels), layers = index(mesh_.layers);
    corners_ = {0, at_once * row, layers / at_once + 1};
    corners_.made = std::make_shared<LayerCache<Vec3>>([this, levels, row, &context](std::size_t part) {
        const int first = static_cast<int>(part) * levels, last = std::min(first + levels, mesh_.layers + 1);
        std::vector<Vec3> nodes(static_cast<std::size_t>(last - first) * row);
        layers_->place(first, last, nodes, context);
        return nodes;
    });
    middles_.begin = mesh::corner_count(mesh_);
    if (mesh_.order() == 1) return;
    middles_.step = at_once * mesh::MiddlePlaces(mesh_).side(1, 0);
    middles_.parts = (layers + at_once - 1) / at_once;
    middles_.made = std::make_shared<LayerCache<Vec3>>([this, levels, &context](std::size_t part) {
        const int first = static_cast<int>(part) * levels, last = std::min(first + levels, mesh_.layers);
        const mesh::MiddlePlaces places(mesh_);
        const std::size_t begin = places.side(index(first), 0);
        std::vector<Vec3> nodes(places.upright(index(last), 0) - begin);
        layers_->place_middles(first, last, nodes, context);
        // the next part starts with the middle nodes of the last level
        if (last < mesh_.layers) nodes.resize(places.side(index(last), 0) - begin);
        return nodes;
    });
}

FieldReader::FieldReader(const CellField& field) : name_(field.name), make_(field.make)
{
    if (!make_)
        make_ = [values = &field.values](std::span<const std::uint32_t> cells, double* out) {
            for (const std::uint32_t cell : cells) *out++ = (*values)[cell];
        };
}

FieldReader::FieldReader(const mesh::HexMesh& mesh, const LayeredField& field, const RunContext& context,
                         const Team* team)
    : name_(field.name)
{
    const int layers = mesh::layers_at_once(mesh);
    const std::size_t columns = mesh.quads.size(), rim = mesh.rim.size();
    const std::size_t step = static_cast<std::size_t>(layers) * columns; // cells in a part
    const auto values_of = [values = field.values, layers, most = mesh.layers](std::size_t part) {
        const int first = static_cast<int>(part) * layers;
        return values(first, std::min(first + layers, most));
    };
    const auto cache = std::make_shared<LayerCache<double>>(values_of);
    make_ = [cache, step](std::span<const std::uint32_t> of, double* out) {
        LayerCache<double>::Values part; // consecutive cells often lie in the same part
        std::size_t number = 0;
        for (const std::uint32_t cell : of) {
            if (!part || cell / step != number) part = cache->part(number = cell / step);
            *out++ = (*part)[cell - number * step];
        }
    };

    // Compute the values of the cells behind the skin, one part of the cells after the other. A team shares
    // the parts.
    const std::vector<std::uint32_t> cells = cells_of_skin(mesh);
    skin_.resize(cells.size());
    const std::size_t all = columns * static_cast<std::size_t>(mesh.layers);
    const std::size_t parts = (all + step - 1) / step;
    const auto each_quad = [&](std::size_t part, const auto& visit) {
        const std::size_t begin = part * step, end = std::min(begin + step, all);
        const auto some = [&](std::size_t first, std::size_t last) {
            for (std::size_t i = first; i < last; ++i)
                if (cells[i] >= begin && cells[i] < end) visit(i, cells[i] - begin);
        };
        if (begin == 0) some(0, columns);
        if (end == all) some(columns, 2 * columns);
        some(2 * columns + begin / columns * rim, 2 * columns + end / columns * rim);
    };
    const auto [own_begin, own_end] = share_of(team, parts);
    Writer own;
    for (std::size_t part = own_begin; part < own_end; ++part) {
        check_cancelled(context);
        const auto values = cache->part(part);
        each_quad(part, [&](std::size_t i, std::size_t cell) { skin_[i] = (*values)[cell]; });
        if (team != nullptr) each_quad(part, [&](std::size_t i, std::size_t) { own(skin_[i]); });
    }
    if (team == nullptr) return;
    const std::vector<std::string> all_said = gather(team, std::move(own).take());
    for (std::size_t rank = 0; rank < all_said.size(); ++rank) {
        Reader reader(all_said[rank]);
        const auto [begin, end] = share_of(rank, all_said.size(), parts);
        for (std::size_t part = begin; part < end; ++part)
            each_quad(part, [&](std::size_t i, std::size_t) { reader(skin_[i]); });
    }
}

std::vector<FieldReader> readers_of(const mesh::HexMesh& mesh, const std::vector<CellField>& fields)
{
    check_fields(mesh, fields);
    return {fields.begin(), fields.end()};
}

std::vector<FieldReader> readers_of(const mesh::LayeredMesh& layered, const std::vector<LayeredField>& fields,
                                    const RunContext& context, const Team* team)
{
    std::set<std::string> names;
    for (const LayeredField& field : fields) check_field_name(field.name, names);
    std::vector<FieldReader> readers;
    for (const LayeredField& field : fields) readers.emplace_back(layered.mesh, field, context, team);
    return readers;
}

} // namespace lacuna::io
