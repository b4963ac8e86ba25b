// SPDX-License-Identifier: MIT
#include <lacuna/fill/filled.h>

#include <lacuna/core/error.h>
#include <lacuna/io/leave_out.h>
#include <lacuna/io/shared/mixed_deck.h>
#include <lacuna/quality/shared/second_order.h>

#include <algorithm>
#include <optional>
#include <utility>

namespace lacuna::fill {

namespace {

/// Add the fidelity of another part; distances are averaged by volume.
void add(const sweep::Fidelity& other, sweep::Fidelity& own)
{
    const double all = own.sealed_volume + other.sealed_volume;
    own.mean_distance = (own.mean_distance * own.sealed_volume + other.mean_distance * other.sealed_volume) /
                        all;
    own.max_distance = std::max(own.max_distance, other.max_distance);
    own.volume += other.volume;
    own.sealed_volume = all;
}

/// Add cells to the count of a group; a new group is appended.
void count(std::vector<Group>& groups, const std::string& name, int dim, std::size_t cells)
{
    auto known = std::ranges::find(groups, name, &Group::name);
    if (known == groups.end()) known = groups.insert(known, {name, dim, 0});
    known->cells += cells;
}

template <class Mesh>
void count_skin(std::vector<Group>& groups, const Mesh& mesh)
{
    std::vector<std::size_t> of_patch(mesh.patches.size(), 0);
    for (std::size_t i = 0; i < mesh.skin_count(); ++i) ++of_patch[index(mesh::skin_quad(mesh, i).patch)];
    for (std::size_t p = 0; p < of_patch.size(); ++p)
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
    for (const FilledTets& tets : mesh.tets)
        for (const std::string& line : tets.report) lines.push_back(tets.region + ": " + line);
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
    for (const FilledTets& tets : mesh.tets) all.push_back({tets.region, 0, tets.fidelity});
    return all;
}

sweep::Fidelity fidelity(const FilledParts& mesh)
{
    sweep::Fidelity whole;
    for (const sweep::Swept& part : mesh.swept.parts) add(part.fidelity, whole);
    for (const FilledTets& tets : mesh.tets) add(tets.fidelity, whole);
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
    const auto add = [&](const auto& part) {
        count_skin(all, part);
        const std::string& name = part.volume_groups.front();
        // "volume" is the default and names no region
        if (name != "volume") count(regions, name, 3, part.cell_count());
        sum += part.cell_count();
    };
    for (const sweep::Swept& part : mesh.swept.parts) add(part.mesh);
    for (const FilledTets& tets : mesh.tets) add(tets.mesh);
    for (const SplitInterface& split : mesh.interfaces)
        if (!split.cells.empty()) count(regions, split.region, 3, split.cells.size());
    std::ranges::sort(all, {}, &Group::name);
    all.insert(all.end(), regions.begin(), regions.end());
    all.push_back({"volume", 3, sum});
    return all;
}

void hold_nodes(FilledParts& mesh, const RunContext& context)
{
    for (sweep::Swept& part : mesh.swept.parts) {
        if (!part.layers) continue;
        part.mesh.nodes.resize(mesh::corner_count(part.mesh));
        part.layers->place(0, part.mesh.layers + 1, part.mesh.nodes, context);
        part.layers.reset();
    }
}

namespace {

/// Set the places of all nodes of a mesh that was split, also of those that no part has.
void place_owned(const FilledParts& mesh, std::span<Vec3> nodes)
{
    for (std::size_t n = 0; n < mesh.owner.size(); ++n) nodes[n] = node(mesh, n);
}

} // namespace

WholeCells whole_cells(const FilledParts& mesh_of_all)
{
    const sweep::SweptAssembly& swept = mesh_of_all.swept;
    WholeCells whole;
    whole.nodes.resize(swept.nodes);
    std::size_t columns = 0;
    for (std::size_t p = 0; p < swept.parts.size(); ++p) {
        const mesh::HexMesh& mesh = swept.parts[p].mesh;
        const mesh::NodeNumbers& number = swept.numbering[p];
        const mesh::SkinNodes node = swept.parts[p].skin();
        const auto count = static_cast<Index>(mesh::corner_count(mesh) + mesh::middle_count(mesh));
        for (Index n = 0; n < count; ++n) whole.nodes[index(number.of(n))] = node[n];
        const mesh::CellKinds kinds(mesh);
        for (std::size_t c = 0; c < mesh.cell_count(); ++c) {
            Hex hex = mesh.hex(kinds.cell(c));
            for (Index& n : hex) n = number.of(n);
            whole.hexes.push_back(hex);
            whole.column.push_back(static_cast<Index>(columns + kinds.cell(c) % mesh.quads.size()));
            if (mesh.order() == 1) continue;
            mesh::CellNodes cell = mesh::cell_nodes(mesh, kinds.cell(c));
            for (std::size_t n = 0; n < cell.count; ++n) cell.node[n] = number.of(cell.node[n]);
            whole.curved.push_back(cell);
        }
        columns += mesh.quads.size();
    }
    for (const FilledTets& tets : mesh_of_all.tets) {
        for (std::size_t n = 0; n < tets.number.size(); ++n)
            whole.nodes[index(tets.number[n])] = tets.mesh.node(n);
        for (std::size_t c = 0; c < tets.mesh.cells.size(); ++c) {
            Hex hex = tets.mesh.cells[c];
            for (Index& n : hex) n = tets.number[index(n)];
            whole.hexes.push_back(hex);
            whole.column.push_back(static_cast<Index>(columns++));
            if (tets.mesh.order() == 1) continue;
            mesh::CellNodes cell = merged_nodes(tets.mesh, c);
            for (std::size_t n = 0; n < cell.count; ++n) cell.node[n] = tets.number[index(cell.node[n])];
            whole.curved.push_back(cell);
        }
    }
    place_owned(mesh_of_all, whole.nodes);
    return whole;
}

io::Deck whole_deck(const FilledParts& mesh, const io::MeshDeckOptions& options, bool interfaces,
                    const RunContext& context)
{
    const io::Format& format = io::format_of(options.format);
    for (const SplitInterface& split : mesh.interfaces)
        if (!format.has_thin_order2 && !split.cells.empty() && split.cells.front().count > 8)
            throw InvalidInput(
                Message("fill.interface_order", "{} has no element of {} nodes without thickness",
                        format.word, split.cells.front().count)
                    .remedy("split with element = \"none\", sweep with order = 1, or write {}",
                            io::endings_of([](const io::Format& of) {
                                return of.has_hex27 && of.has_thin_order2 && of.has_option("with");
                            })));
    std::vector<mesh::LayeredPart> swept;
    for (std::size_t p = 0; p < mesh.swept.parts.size(); ++p)
        swept.push_back({mesh.swept.parts[p].mesh, nullptr, mesh.swept.numbering[p]});
    std::vector<io::NumberedTets> tets;
    for (const FilledTets& part : mesh.tets) tets.push_back({part.mesh, part.number});
    io::Deck deck = io::deck_of(swept, tets, mesh.swept.nodes, options, interfaces, context);
    deck.unit = mesh.unit;
    place_owned(mesh, deck.points);
    for (const SplitInterface& split : mesh.interfaces)
        io::add_layer(deck, split.cells, split.region, split.element);
    return deck;
}

JoinedDeck joined_deck(const io::Deck& deck, const topology::Model& model, double scale,
                       const FilledParts& mesh, io::MeshDeckOptions options, const io::Deck* gone,
                       const RunContext& context)
{
    for (const Contact& contact : mesh.contacts) {
        options.contacts.push_back(contact.pair);
        options.contacts.back().tolerance /= scale;
    }
    options.columns = mesh.columns;
    JoinedDeck joined{deck, mesh.swept.periodic};
    io::JoinedBefore before;
    const auto join = [&](const auto& part, std::size_t number) {
        options.material = mesh.materials[number];
        joined.deck = io::join_deck(joined.deck, model, scale, part, options, context, gone, &before);
        options.first_node = options.first_cell = 0;
    };
    for (std::size_t p = 0; p < mesh.swept.parts.size(); ++p) {
        before.number = [&](Index node) { return mesh.swept.numbering[p].of(node); };
        join(mesh.swept.parts[p].mesh, p);
    }
    for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
        before.number = [&](Index node) { return mesh.tets[t].number[index(node)]; };
        join(mesh.tets[t].mesh, mesh.swept.parts.size() + t);
    }
    io::add_contacts(joined.deck, options.contacts, before);
    joined.deck = io::close_gap(std::move(joined.deck), context);
    for (mesh::PeriodicNodes& periodic : joined.periodic) {
        periodic.onto.translation() /= scale;
        for (auto& pair : periodic.pairs)
            for (Index& node : pair) node = before.points[index(node)];
    }
    return joined;
}

quality::Quality measure(const WholeCells& cells, const RunContext& context)
{
    return cells.curved.empty() ? quality::measure_cells(cells.nodes, cells.hexes, context, cells.column)
                                : quality::measure_cells(cells.nodes, cells.curved, context, cells.column);
}

} // namespace lacuna::fill
