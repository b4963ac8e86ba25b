// SPDX-License-Identifier: MIT
#include <lacuna/io/msh.h>

#include <lacuna/core/error.h>
#include <lacuna/io/detail/msh_elements.h>

#include <algorithm>
#include <array>
#include <cstring>

// The format: https://gmsh.info/doc/texinfo/gmsh.html#MSH-file-format. All nodes form one block of the volume
// and are numbered from 1 as in the mesh. Elements are numbered from 1, the skin's quads and triangles patch
// after patch, then the hexahedra and the wedges.

namespace lacuna::io {
namespace {

std::uint64_t node_tag(Index node) { return static_cast<std::uint64_t>(node) + 1; }

// ---- Version 4.1, binary

void put_list(std::string& text, const std::vector<int>& tags)
{
    put(text, static_cast<std::uint64_t>(tags.size()));
    for (const int tag : tags) put(text, tag);
}

void put_box(std::string& text, const Eigen::AlignedBox3d& box)
{
    for (const double value : box.min()) put(text, value);
    for (const double value : box.max()) put(text, value);
}

std::vector<int> surface_tags(const MshContent& content)
{
    std::vector<int> tags;
    for (const MshSurface& surface : content.surfaces) tags.push_back(surface.tag);
    return tags;
}

std::string binary_entities(const MshContent& content)
{
    std::string text = "$Entities\n";
    for (const std::size_t count : {std::size_t(0), std::size_t(0), content.surfaces.size(), std::size_t(1)})
        put(text, static_cast<std::uint64_t>(count));
    for (const MshSurface& surface : content.surfaces) {
        put(text, surface.tag);
        put_box(text, surface.box);
        put_list(text, surface.physical);
        put_list(text, std::vector<int>{});
    }
    put(text, kVolumeTag);
    put_box(text, content.box);
    put_list(text, content.volume_physical);
    put_list(text, surface_tags(content));
    return text + "\n$EndEntities\n";
}

/// Number of a cell and its nodes, each eight bytes.
char* put_element(char* out, std::uint64_t number, const mesh::CellNodes& nodes)
{
    std::array<std::uint64_t, 28> record;
    record[0] = number;
    for (std::size_t i = 0; i < nodes.count; ++i) record[i + 1] = node_tag(nodes.node[i]);
    const std::size_t bytes = (nodes.count + 1) * sizeof(std::uint64_t);
    std::memcpy(out, record.data(), bytes);
    return out + bytes;
}

/// Cells of eight nodes alone, [begin, end) of those of a mesh, with the numbers from `number` on: as many
/// columns of them as the source has quads, which come before its triangles.
char* put_hexes(char* out, const mesh::HexMesh& mesh, std::size_t columns, std::size_t begin, std::size_t end,
                std::uint64_t number)
{
    while (begin < end) {
        const std::size_t layer = begin / columns, stop = std::min(end, (layer + 1) * columns);
        const std::uint64_t low = node_tag(static_cast<Index>(layer) * mesh.nodes_per_layer);
        const std::uint64_t high = low + static_cast<std::uint64_t>(mesh.nodes_per_layer);
        for (const Quad* quad = mesh.quads.data() + begin % columns; begin < stop; ++begin, ++quad) {
            std::array<std::uint64_t, 9> record{number++};
            for (std::size_t k = 0; k < 4; ++k) {
                const auto own = static_cast<std::uint64_t>((*quad)[k]);
                record[1 + k] = low + own;
                record[5 + k] = high + own;
            }
            out = put(out, record);
        }
    }
    return out;
}

std::string block_head(int dimension, int tag, int third, std::size_t count)
{
    std::string text;
    put(text, dimension);
    put(text, tag);
    put(text, third);
    put(text, static_cast<std::uint64_t>(count));
    return text;
}

std::string counts_of(std::size_t blocks, std::size_t count)
{
    std::string text;
    for (const std::size_t value : {blocks, count, std::size_t(1), count})
        put(text, static_cast<std::uint64_t>(value));
    return text;
}

void add_binary_elements(std::vector<Section>& sections, const MshElements& elements)
{
    const std::vector<MshBlock> blocks = elements.blocks();
    std::string head = "$Elements\n" + counts_of(blocks.size(), elements.count());
    for (const MshBlock& block : blocks) {
        const bool volume = block.surface == nullptr;
        head += block_head(volume ? 3 : 2, volume ? kVolumeTag : block.surface->tag, block.type(),
                           block.count);
        sections.push_back({head, block.count, (block.nodes() + 1) * sizeof(std::uint64_t),
                            [elements, block](std::size_t begin, std::size_t end, char* out) {
                                const mesh::HexMesh& mesh = elements.mesh;
                                if (block.shape == DeckShape::hex8)
                                    return put_hexes(out, mesh, block.count / index(mesh.layers), begin, end,
                                                     block.first + begin + 1);
                                for (std::size_t i = block.first + begin; i < block.first + end; ++i)
                                    out = put_element(out, i + 1, elements.nodes(i));
                                return out;
                            }});
        head.clear();
    }
    sections.push_back({"\n$EndElements\n", 0, 0, {}});
}

std::vector<Section> binary_41(const mesh::HexMesh& mesh, const NodeReader& reader, const MshContent& content)
{
    const std::size_t nodes = reader.count();
    std::vector<Section> sections;
    sections.push_back({msh_opening(content.names, "4.1", true) + binary_entities(content) + "$Nodes\n" +
                            counts_of(1, nodes) + block_head(3, kVolumeTag, 0, nodes),
                        nodes, sizeof(std::uint64_t), [](std::size_t begin, std::size_t end, char* out) {
                            for (std::size_t i = begin; i < end; ++i)
                                out = put(out, static_cast<std::uint64_t>(i + 1));
                            return out;
                        }});
    sections.push_back({{}, nodes, sizeof(Vec3), [&reader](std::size_t begin, std::size_t end, char* out) {
                            return reader.copy(begin, end, out);
                        }});
    sections.push_back({"\n$EndNodes\n", 0, 0, {}});
    add_binary_elements(sections, {mesh, content});
    return sections;
}

// ---- Version 4.1, text

/// Numbers, a blank before each.
std::string spaced(std::initializer_list<std::size_t> numbers)
{
    std::string text;
    for (const std::size_t number : numbers) text.append(1, ' ').append(std::to_string(number));
    return text;
}

std::string list_text(const std::vector<int>& tags)
{
    std::string text = spaced({tags.size()});
    for (const int tag : tags) text.append(1, ' ').append(std::to_string(tag));
    return text;
}

std::string box_text(const Eigen::AlignedBox3d& box)
{
    std::string text;
    for (const double value : box.min()) text.append(1, ' ').append(text_of(value));
    for (const double value : box.max()) text.append(1, ' ').append(text_of(value));
    return text;
}

std::string text_entities(const MshContent& content)
{
    std::string text = "$Entities\n0 0 " + std::to_string(content.surfaces.size()) + " 1\n";
    for (const MshSurface& surface : content.surfaces)
        text += std::to_string(surface.tag) + box_text(surface.box) + list_text(surface.physical) + " 0\n";
    text += std::to_string(kVolumeTag) + box_text(content.box) + list_text(content.volume_physical) +
            list_text(surface_tags(content)) + "\n";
    return text + "$EndEntities\n";
}

char* put_nodes(char* out, const mesh::CellNodes& nodes)
{
    for (const Index node : nodes.all()) {
        *out++ = ' ';
        out = put_text(out, static_cast<long long>(node) + 1);
    }
    *out++ = '\n';
    return out;
}

char* put_point(char* out, const Vec3& point)
{
    out = put_text(out, point.x());
    *out++ = ' ';
    out = put_text(out, point.y());
    *out++ = ' ';
    out = put_text(out, point.z());
    *out++ = '\n';
    return out;
}

std::string words(std::initializer_list<std::size_t> numbers) { return spaced(numbers).substr(1) + "\n"; }

/// Elements as lines: number, `middle(block)`, nodes.
template <class Head, class Middle>
void add_text_elements(std::vector<Section>& sections, const MshElements& elements, const std::string& start,
                       const Head& head, const Middle& middle)
{
    std::string text = start;
    for (const MshBlock& block : elements.blocks()) {
        const std::string between = middle(block);
        sections.push_back({text + head(block), block.count,
                            (block.nodes() + 1) * kNumberBytes + between.size() + 2,
                            [elements, block, between](std::size_t begin, std::size_t end, char* out) {
                                for (std::size_t i = block.first + begin; i < block.first + end; ++i) {
                                    out = put_text(out, static_cast<long long>(i) + 1);
                                    out = between.copy(out, between.size()) + out;
                                    out = put_nodes(out, elements.nodes(i));
                                }
                                return out;
                            }});
        text.clear();
    }
    sections.push_back({"$EndElements\n", 0, 0, {}});
}

std::vector<Section> text_41(const mesh::HexMesh& mesh, const NodeReader& reader, const MshContent& content)
{
    const std::size_t nodes = reader.count();
    std::vector<Section> sections;
    sections.push_back({msh_opening(content.names, "4.1", false) + text_entities(content) + "$Nodes\n" +
                            words({1, nodes, 1, nodes}) + words({3, kVolumeTag, 0, nodes}),
                        nodes, kNumberBytes, [](std::size_t begin, std::size_t end, char* out) {
                            for (std::size_t i = begin; i < end; ++i) {
                                out = put_text(out, static_cast<long long>(i) + 1);
                                *out++ = '\n';
                            }
                            return out;
                        }});
    sections.push_back(
        {{}, nodes, 3 * kNumberBytes, [&reader](std::size_t begin, std::size_t end, char* out) {
             reader.each(begin, end, [&](std::size_t, const Vec3& node) { out = put_point(out, node); });
             return out;
         }});
    const MshElements elements{mesh, content};
    const auto head = [](const MshBlock& block) {
        const bool volume = block.surface == nullptr;
        const int tag = volume ? kVolumeTag : block.surface->tag;
        return words({volume ? 3U : 2U, static_cast<std::size_t>(tag), static_cast<std::size_t>(block.type()),
                      block.count});
    };
    add_text_elements(sections, elements,
                      "$EndNodes\n$Elements\n" +
                          words({elements.blocks().size(), elements.count(), 1, elements.count()}),
                      head, [](const MshBlock&) { return std::string(); });
    return sections;
}

// ---- Version 2.2: an element carries one physical group and its entity

std::vector<Section> text_22(const mesh::HexMesh& mesh, const NodeReader& reader, const MshContent& content)
{
    std::vector<Section> sections;
    sections.push_back({msh_opening(content.names, "2.2", false) + "$Nodes\n" + words({reader.count()}),
                        reader.count(), 4 * kNumberBytes,
                        [&reader](std::size_t begin, std::size_t end, char* out) {
                            reader.each(begin, end, [&](std::size_t i, const Vec3& node) {
                                out = put_text(out, static_cast<long long>(i) + 1);
                                *out++ = ' ';
                                out = put_point(out, node);
                            });
                            return out;
                        }});
    const auto middle = [&](const MshBlock& block) {
        const MshSurface* surface = block.surface;
        const int physical = surface != nullptr ? surface->physical.front() : content.volume_physical.front();
        const int entity = surface != nullptr ? surface->tag : kVolumeTag;
        const auto unsign = [](int value) { return static_cast<std::size_t>(value); };
        return spaced({unsign(block.type()), 2, unsign(physical), unsign(entity)});
    };
    const MshElements elements{mesh, content};
    add_text_elements(
        sections, elements, "$EndNodes\n$Elements\n" + words({elements.count()}),
        [](const MshBlock&) { return std::string(); }, middle);
    return sections;
}

char* put_element_22(char* out, std::size_t number, int physical, int entity, const mesh::CellNodes& nodes)
{
    std::array<int, 30> record{static_cast<int>(number), physical, entity};
    for (std::size_t i = 0; i < nodes.count; ++i) record[i + 3] = nodes.node[i] + 1;
    const std::size_t bytes = (nodes.count + 3) * sizeof(int);
    std::memcpy(out, record.data(), bytes);
    return out + bytes;
}

/// Type, count and number of tags of the elements that follow.
std::string head_22(int type, std::size_t count)
{
    std::string text;
    for (const int value : {type, static_cast<int>(count), 2}) put(text, value);
    return text;
}

std::vector<Section> binary_22(const mesh::HexMesh& mesh, const NodeReader& reader, const MshContent& content)
{
    std::vector<Section> sections;
    sections.push_back({msh_opening(content.names, "2.2", true) + "$Nodes\n" + words({reader.count()}),
                        reader.count(), sizeof(int) + sizeof(Vec3),
                        [&reader](std::size_t begin, std::size_t end, char* out) {
                            reader.each(begin, end, [&](std::size_t i, const Vec3& node) {
                                out = put(out, static_cast<int>(i) + 1);
                                for (const double value : node) out = put(out, value);
                            });
                            return out;
                        }});
    const MshElements elements{mesh, content};
    std::string head = "\n$EndNodes\n$Elements\n" + words({elements.count()});
    for (const MshBlock& block : elements.blocks()) {
        const bool volume = block.surface == nullptr;
        const int physical = volume ? content.volume_physical.front() : block.surface->physical.front();
        const int entity = volume ? kVolumeTag : block.surface->tag;
        sections.push_back(
            {head + head_22(block.type(), block.count), block.count, (block.nodes() + 3) * sizeof(int),
             [elements, block, physical, entity](std::size_t begin, std::size_t end, char* out) {
                 for (std::size_t i = block.first + begin; i < block.first + end; ++i)
                     out = put_element_22(out, i + 1, physical, entity, elements.nodes(i));
                 return out;
             }});
        head.clear();
    }
    sections.push_back({"\n$EndElements\n", 0, 0, {}});
    return sections;
}

// ---- Fields of cells, alike in both versions

/// Section of one field: the skin with the values of its cells, then the cells. Gmsh and meshio
/// both read values by number of element; meshio takes a field only where every element has one.
void add_field(std::vector<Section>& sections, const MshContent& content, const mesh::CellKinds& kinds,
               const std::vector<std::uint32_t>& skin_cells, std::size_t cells, const FieldReader& field,
               bool binary)
{
    const auto head = [&](std::size_t elements) {
        return "$ElementData\n1\n\"" + field.name() + "\"\n1\n0\n3\n0\n1\n" + std::to_string(elements) + "\n";
    };
    const auto put_value = [binary](char* out, std::size_t number, double value) {
        if (binary) return put(put(out, static_cast<std::int32_t>(number)), value);
        out = put_text(out, static_cast<long long>(number));
        *out++ = ' ';
        out = put_text(out, value);
        *out++ = '\n';
        return out;
    };
    const std::size_t bytes = binary ? sizeof(std::int32_t) + sizeof(double) : 2 * kNumberBytes;
    const std::size_t skin = content.skin.size();
    sections.push_back(
        {head(skin + cells), skin, bytes,
         [&content, &skin_cells, &field, put_value](std::size_t begin, std::size_t end, char* out) {
             field.each_behind_skin(
                 begin, end, skin_cells, [&](std::size_t i) { return std::size_t(content.skin[i]); },
                 [&](std::size_t i, double value) { out = put_value(out, i + 1, value); });
             return out;
         }});
    sections.push_back(
        {{}, cells, bytes, [&field, kinds, skin, put_value](std::size_t begin, std::size_t end, char* out) {
             field.each_cell(
                 begin, end, [&](std::size_t i) { return kinds.cell(i); },
                 [&](std::size_t i, double value) { out = put_value(out, skin + 1 + i, value); });
             return out;
         }});
    sections.push_back({binary ? "\n$EndElementData\n" : "$EndElementData\n", 0, 0, {}});
}

void write(const mesh::HexMesh& mesh, const NodeReader& nodes, const std::vector<FieldReader>& fields,
           const OutputPath& path, const MshOptions& options, const RunContext& context,
           const Team* team = nullptr)
{
    const bool old = options.version == 2.2;
    const MshContent content = msh_content(
        mesh, nodes, holds_all_groups(options.all_groups, options.version, path, context));
    std::vector<Section> sections =
        options.partition.parts > 0 ? partitioned_msh(mesh, nodes, content, options.partition, options.binary)
        : options.binary ? (old ? binary_22(mesh, nodes, content) : binary_41(mesh, nodes, content))
                         : (old ? text_22(mesh, nodes, content) : text_41(mesh, nodes, content));
    std::vector<std::uint32_t> skin_cells;
    if (!fields.empty()) skin_cells = cells_of_skin(mesh);
    for (const FieldReader& field : fields)
        add_field(sections, content, mesh::CellKinds(mesh), skin_cells, mesh.cell_count(), field,
                  options.binary);
    write_file(path, sections, options.binary ? Sizes::exact : Sizes::varying, context, team);
}

void check_version(const MshOptions& options)
{
    if (options.version != 2.2 && options.version != 4.1)
        throw InvalidInput("io.unknown_version", "MSH version " + text_of(options.version) +
                                                     " cannot be written; known are 4.1 and 2.2");
    if (options.partition.parts > 0 && options.version != 4.1)
        throw InvalidInput("io.partition_version",
                           "parts are written in MSH version 4.1 alone; leave out the version");
}

} // namespace

std::string msh_entities(const MshContent& content, bool binary)
{
    return binary ? binary_entities(content) : text_entities(content);
}

void write_msh(const mesh::HexMesh& mesh, const OutputPath& path, const MshOptions& options,
               const RunContext& context)
{
    check_version(options);
    write(mesh, NodeReader(mesh), readers_of(mesh, options.fields), path, options, context);
}

void write_msh(const mesh::LayeredMesh& layered, const OutputPath& path, const MshOptions& options,
               const std::vector<LayeredField>& fields, const RunContext& context, const Team* team)
{
    check_version(options);
    const NodeReader nodes(layered, context);
    write(layered.mesh, nodes, readers_of(layered, fields, context, team), path, options, context, team);
}

} // namespace lacuna::io
