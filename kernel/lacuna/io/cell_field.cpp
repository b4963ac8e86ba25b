// SPDX-License-Identifier: MIT
#include <lacuna/io/cell_field.h>

#include <lacuna/core/error.h>
#include <lacuna/core/shared/marks.h>
#include <lacuna/io/detail/node_reader.h>
#include <lacuna/io/detail/texts.h>

#include <algorithm>
#include <map>
#include <set>

namespace lacuna::io {
namespace {

/// The source quad at each rim side.
std::vector<std::uint32_t> quads_of_rim(const mesh::HexMesh& mesh)
{
    Marks on_rim(index(mesh.nodes_per_layer));
    for (const Segment& segment : mesh.rim)
        for (const Index n : segment)
            if (n >= 0 && n < mesh.nodes_per_layer) on_rim.add(n);
    std::map<Segment, std::uint32_t> quad_of; // for each side between two rim nodes; a few are not of the rim
    for (std::size_t q = 0; q < mesh.quads.size(); ++q) {
        const Quad& quad = mesh.quads[q];
        for (std::size_t k = 0; k < 4; ++k) {
            const Index from = quad[k], to = quad[(k + 1) % 4];
            if (on_rim.has(from) && on_rim.has(to))
                quad_of.emplace(Segment{from, to}, static_cast<std::uint32_t>(q));
        }
    }
    std::vector<std::uint32_t> quads;
    quads.reserve(mesh.rim.size());
    for (const Segment& segment : mesh.rim) {
        const auto at = quad_of.find(segment);
        if (at == quad_of.end())
            throw InvalidInput(
                Message("io.rim", "the edge from {} to {} of the boundary belongs to no quad of the source",
                        numbered("node", segment[0] + 1), numbered("node", segment[1] + 1))
                    .remedy("give boundary edges of the source's quads"));
        quads.push_back(at->second);
    }
    return quads;
}

} // namespace

void check_field_name(const std::string& name, std::set<std::string>& names)
{
    const bool plain = std::all_of(name.begin(), name.end(), [](unsigned char c) {
        return c > 32 && c != 127 && c != '"' && c != '<' && c != '&';
    });
    if (name.empty() || !plain)
        throw InvalidInput("io.field_name",
                           "the cell field '{}' must have a name without blanks, quotes, < and &", name);
    if (name == "entity")
        throw InvalidInput(Message("io.field_name", "the cell field name 'entity' is reserved")
                               .remedy("give the field another name"));
    if (!names.insert(name).second)
        throw InvalidInput(Message("io.field_name", "two cell fields are named '{}'", name)
                               .remedy("give one of them another name"));
}

void check_fields(const mesh::HexMesh& mesh, const std::vector<CellField>& fields)
{
    std::set<std::string> names;
    for (const CellField& field : fields) {
        if (!field.make && field.values.size() != mesh.cell_count())
            throw InvalidInput(Message("io.field_size", "the cell field '{}' has {} values for {} cells",
                                       field.name, found(field.values.size()), needed(mesh.cell_count()))
                                   .remedy("give one value for each cell"));
        check_field_name(field.name, names);
    }
}

std::vector<std::uint32_t> cells_of_skin(const mesh::HexMesh& mesh)
{
    const std::size_t quads = mesh.quads.size();
    const auto layers = static_cast<std::size_t>(std::max(mesh.layers, 0));
    std::vector<std::uint32_t> cells;
    cells.reserve(mesh.skin_count());
    if (layers == 0) return cells;
    for (std::size_t q = 0; q < quads; ++q) cells.push_back(static_cast<std::uint32_t>(q));
    for (std::size_t q = 0; q < quads; ++q)
        cells.push_back(static_cast<std::uint32_t>((layers - 1) * quads + q));
    const std::vector<std::uint32_t> rim = quads_of_rim(mesh);
    for (std::size_t layer = 0; layer < layers; ++layer)
        for (const std::uint32_t quad : rim)
            cells.push_back(static_cast<std::uint32_t>(layer * quads) + quad);
    return cells;
}

} // namespace lacuna::io
