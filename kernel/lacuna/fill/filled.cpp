// SPDX-License-Identifier: MIT
#include <lacuna/fill/filled.h>

#include <lacuna/quality/shared/second_order.h>

#include <algorithm>
#include <utility>

namespace lacuna::fill {

namespace {

/// Add the fidelity of another region of the same full turn; distances are averaged by volume.
void add(const sweep::Fidelity& other, sweep::Fidelity& own)
{
    const double all = own.sealed_volume + other.sealed_volume;
    own.mean_distance = (own.mean_distance * own.sealed_volume + other.mean_distance * other.sealed_volume) /
                        all;
    own.max_distance = std::max(own.max_distance, other.max_distance);
    own.volume += other.volume;
    own.sealed_volume = all;
}

/// Count cells by group, in the order in which groups are first met.
void count(std::vector<Group>& groups, const std::string& name, int dim, std::size_t cells)
{
    auto known = std::ranges::find(groups, name, &Group::name);
    if (known == groups.end()) known = groups.insert(known, {name, dim, 0});
    known->cells += cells;
}

void count_skin(std::vector<Group>& groups, const mesh::HexMesh& mesh)
{
    std::vector<std::size_t> of_patch(mesh.patches.size(), 0);
    for (std::size_t i = 0; i < mesh.skin_count(); ++i) ++of_patch[index(mesh::skin_quad(mesh, i).patch)];
    for (std::size_t p = 0; p < mesh.patches.size(); ++p)
        for (const std::string& name : mesh.patches[p].groups) count(groups, name, 2, of_patch[p]);
}

} // namespace

std::span<const sweep::Swept> parts(const FilledVolume& mesh) { return {&mesh.swept, 1}; }

std::span<const sweep::Swept> parts(const FilledParts& mesh) { return mesh.swept.parts; }

std::span<const sweep::Swept> parts(const Filled& filled)
{
    return std::visit([](const auto& mesh) { return parts(mesh); }, filled.mesh);
}

std::vector<std::string> report(const FilledParts& mesh)
{
    std::vector<std::string> lines = mesh.swept.report;
    for (std::size_t p = 0; p < mesh.regions.size(); ++p)
        for (const std::string& line : mesh.swept.parts[p].report)
            lines.push_back(mesh.regions[p] + ": " + line);
    return lines;
}

std::vector<Region> regions(const FilledParts& mesh)
{
    std::vector<Region> all;
    for (std::size_t p = 0; p < mesh.regions.size(); ++p) {
        const sweep::Swept& part = mesh.swept.parts[p];
        const auto known = std::ranges::find(all, mesh.regions[p], &Region::name);
        if (known == all.end()) {
            all.push_back({mesh.regions[p], part.mesh.layers, part.fidelity});
            continue;
        }
        known->layers += part.mesh.layers;
        add(part.fidelity, known->fidelity);
    }
    return all;
}

sweep::Fidelity fidelity(const FilledParts& mesh)
{
    sweep::Fidelity whole;
    for (const sweep::Swept& part : mesh.swept.parts) {
        whole.volume += part.fidelity.volume;
        whole.sealed_volume += part.fidelity.sealed_volume;
        whole.max_distance = std::max(whole.max_distance, part.fidelity.max_distance);
        whole.mean_distance += part.fidelity.mean_distance / static_cast<double>(mesh.regions.size());
    }
    return whole;
}

std::vector<Group> groups(const FilledVolume& mesh)
{
    const mesh::HexMesh& cells = mesh.swept.mesh;
    std::vector<Group> all;
    count_skin(all, cells);
    for (const std::string& name : cells.volume_groups) all.push_back({name, 3, cells.cell_count()});
    return all;
}

std::vector<Group> groups(const FilledParts& mesh)
{
    std::vector<Group> all, regions;
    std::size_t sum = 0;
    for (const sweep::Swept& part : mesh.swept.parts) {
        const std::string& region = part.mesh.volume_groups.front();
        count_skin(all, part.mesh);
        if (region != "volume") count(regions, region, 3, part.mesh.cell_count()); // default: unnamed
        sum += part.mesh.cell_count();
    }
    std::ranges::sort(all, {}, &Group::name);
    all.insert(all.end(), regions.begin(), regions.end());
    all.push_back({"volume", 3, sum});
    return all;
}

WholeCells whole_cells(const sweep::SweptAssembly& swept)
{
    WholeCells whole;
    whole.nodes.resize(swept.nodes);
    std::size_t columns = 0;
    for (std::size_t p = 0; p < swept.parts.size(); ++p) {
        const mesh::HexMesh& mesh = swept.parts[p].mesh;
        const std::vector<Index>& number = swept.number[p];
        for (std::size_t n = 0; n < number.size(); ++n) whole.nodes[index(number[n])] = mesh.node(n);
        const mesh::CellKinds kinds(mesh);
        for (std::size_t c = 0; c < mesh.cell_count(); ++c) {
            Hex hex = mesh.hex(kinds.cell(c));
            for (Index& n : hex) n = number[index(n)];
            whole.hexes.push_back(hex);
            whole.column.push_back(static_cast<Index>(columns + kinds.cell(c) % mesh.quads.size()));
            if (mesh.order() == 1) continue;
            mesh::CellNodes cell = mesh::cell_nodes(mesh, kinds.cell(c));
            for (std::size_t n = 0; n < cell.count; ++n) cell.node[n] = number[index(cell.node[n])];
            whole.curved.push_back(cell);
        }
        columns += mesh.quads.size();
    }
    return whole;
}

quality::Quality measure(const WholeCells& cells, const RunContext& context)
{
    return cells.curved.empty() ? quality::measure_cells(cells.nodes, cells.hexes, context, cells.column)
                                : quality::measure_cells(cells.nodes, cells.curved, context, cells.column);
}

Vec3 node(const sweep::SweptAssembly& swept, std::size_t node)
{
    std::size_t p = 0;
    const auto in_part = [&] { return std::ranges::find(swept.number[p], static_cast<Index>(node)); };
    while (in_part() == swept.number[p].end()) ++p;
    return swept.parts[p].mesh.node(static_cast<std::size_t>(in_part() - swept.number[p].begin()));
}

Hex cell(const sweep::SweptAssembly& swept, bool wedge, std::size_t number)
{
    const auto count = wedge ? &mesh::HexMesh::wedge_count : &mesh::HexMesh::hex_count;
    std::size_t p = 0;
    while (number >= (swept.parts[p].mesh.*count)()) number -= (swept.parts[p++].mesh.*count)();
    const mesh::HexMesh& mesh = swept.parts[p].mesh;
    Hex hex = mesh.hex(mesh::CellKinds(mesh).cell(number + (wedge ? mesh.hex_count() : 0)));
    for (Index& corner : hex) corner = swept.number[p][index(corner)];
    return hex;
}

} // namespace lacuna::fill
