// SPDX-License-Identifier: MIT
#include <lacuna/io/shared/mixed_deck.h>

#include <lacuna/core/shared/same_corners.h>
#include <lacuna/io/detail/abaqus.h>
#include <lacuna/io/detail/deck_builder.h>
#include <lacuna/io/detail/deck_view.h>
#include <lacuna/io/detail/deck_writer.h>
#include <lacuna/io/detail/mesh_deck.h>

#include <algorithm>
#include <map>
#include <numeric>

namespace lacuna::io {
namespace {

/// For each side of each skin: whether another skin has the same side.
std::vector<std::vector<char>> inner_sides(const std::vector<std::vector<Quad>>& skins)
{
    struct Place {
        Quad nodes;
        std::size_t part, side;
    };
    std::vector<Place> all;
    std::vector<std::vector<char>> inner;
    for (std::size_t p = 0; p < skins.size(); ++p) {
        inner.emplace_back(skins[p].size(), 0);
        for (std::size_t i = 0; i < skins[p].size(); ++i) {
            all.push_back({face_key(skins[p][i]), p, i});
        }
    }
    std::ranges::sort(all, {}, &Place::nodes);
    for (std::size_t k = 1; k < all.size(); ++k) {
        if (all[k].nodes != all[k - 1].nodes) continue;
        for (const Place& place : {all[k - 1], all[k]}) inner[place.part][place.side] = 1;
    }
    return inner;
}

/// The skin of a mesh, with the node numbers of the whole mesh. @param number  returns the number of a node
template <class Number>
std::vector<Quad> numbered_skin(const mesh::HexMesh& mesh, const Number& number)
{
    std::vector<Quad> skin;
    for (std::size_t i = 0; i < mesh.skin_count(); ++i) {
        Quad& quad = skin.emplace_back(skin_quad(mesh, i).nodes);
        for (Index& n : quad) n = number(n);
    }
    return skin;
}

/// An empty deck of a format.
Deck new_deck(DeckFormat format)
{
    Deck deck;
    deck.format = format;
    if (format == DeckFormat::nastran)
        deck.texts = {{DeckText::Place::head, "", "BEGIN BULK\n"}, {DeckText::Place::tail, "", "ENDDATA\n"}};
    return deck;
}

} // namespace

void add_contacts(Deck& deck, std::span<const mesh::ContactPair> pairs, const JoinedBefore& before)
{
    deck.contacts.assign(pairs.begin(), pairs.end());
    for (mesh::ContactPair& pair : deck.contacts)
        for (const std::size_t s : {0, 1})
            if (const auto set = before.sets.find({DeckSet::Kind::sides, pair.groups[s]});
                set != before.sets.end())
                pair.sets[s] = set->second;
}

Deck deck_without_bulk(std::span<BulkPart> parts, MeshDeckOptions options, bool interfaces,
                       const RunContext& context)
{
    Deck deck = new_deck(options.format);
    const bool cells = format_of(options.format).skin == Format::Skin::quads;
    const bool several = parts.front().numbers != nullptr;
    JoinedBefore before; // parts of the same name form one region
    std::vector<std::vector<char>> inner(parts.size());
    if (cells && several && !interfaces) {
        std::vector<std::vector<Quad>> skins;
        for (const BulkPart& part : parts)
            skins.push_back(numbered_skin(part.mesh, [&](Index n) { return part.numbers->of(n); }));
        inner = inner_sides(skins);
    }
    std::map<Quad, DeckTag> skin_tags;
    for (std::size_t p = 0; p < parts.size(); ++p) {
        const mesh::HexMesh& mesh = parts[p].mesh;
        BulkPlace& place = parts[p].place;
        AddedMesh added{.points = {}, .skin_cells = cells, .bulk = &place, .numbers = parts[p].numbers};
        if (several) added.before = &before;
        if (interfaces) added.skin_tags = &skin_tags;
        added.inner = std::move(inner[p]);
        if (p > 0) {
            const BulkPart& last = parts[p - 1];
            place.first_node = last.place.first_node;
            place.highest = last.place.first_cell + static_cast<DeckTag>(last.mesh.cell_count()) - 1;
        }
        add_mesh(deck, mesh, added, options, context);
        tidy(place.sets);
        options.first_node = options.first_cell = 0;
    }
    add_contacts(deck, options.contacts, before);
    return deck;
}

Deck deck_of(std::span<const mesh::LayeredPart> swept, std::span<const NumberedTets> tets, std::size_t nodes,
             MeshDeckOptions options, bool interfaces, const RunContext& context)
{
    Deck deck = new_deck(options.format);
    deck.points.resize(nodes);
    deck.point_tags.resize(nodes);
    std::iota(deck.point_tags.begin(), deck.point_tags.end(),
              options.first_node != 0 ? options.first_node : 1);
    std::vector<std::vector<Index>> numbers;
    std::vector<std::vector<Quad>> skins;
    const auto add_numbers = [&](std::size_t count, const auto& node, const auto& number) {
        std::vector<Index>& own = numbers.emplace_back(count);
        for (std::size_t n = 0; n < count; ++n) {
            own[n] = number(static_cast<Index>(n));
            deck.points[index(own[n])] = node(n);
        }
    };
    for (const mesh::LayeredPart& part : swept) {
        const auto number = [&](Index n) { return part.numbers.of(n); };
        add_numbers(
            part.mesh.node_count(), [&](std::size_t n) { return part.mesh.node(n); }, number);
        skins.push_back(numbered_skin(part.mesh, number));
    }
    for (const auto& [mesh, number] : tets) {
        add_numbers(
            mesh.node_count(), [&](std::size_t n) { return mesh.node(n); },
            [&](Index n) { return number[index(n)]; });
        std::vector<Quad>& skin = skins.emplace_back(mesh.skin);
        for (Quad& side : skin)
            for (Index& n : side) n = number[index(n)];
    }
    std::vector<std::vector<char>> inner(skins.size());
    const bool cells = format_of(options.format).skin == Format::Skin::quads;
    if (cells && !interfaces) inner = inner_sides(skins);
    JoinedBefore before; // parts of the same name form one region
    std::map<Quad, DeckTag> skin_tags;
    options.first_node = 0;
    const auto add = [&](const auto& mesh, std::size_t p) {
        AddedMesh added{.points = numbers[p], .skin_cells = cells, .before = &before, .is_new = true};
        if (interfaces) added.skin_tags = &skin_tags;
        added.inner = std::move(inner[p]);
        add_mesh(deck, mesh, added, options, context);
        options.first_cell = 0;
    };
    for (std::size_t p = 0; p < swept.size(); ++p) add(swept[p].mesh, p);
    for (std::size_t t = 0; t < tets.size(); ++t) add(tets[t].mesh, swept.size() + t);
    add_contacts(deck, options.contacts, before);
    return deck;
}

void add_layer(Deck& deck, std::span<const mesh::CellNodes> cells, const std::string& region,
               const std::string& element)
{
    const auto is_taken = [&](const std::string& name) {
        return std::ranges::any_of(deck.sets, [&](const DeckSet& set) { return same_word(set.name, name); });
    };
    if (cells.empty()) return;
    const std::string name = free_name(region, deck.format, is_taken);
    deck.regions.push_back({highest_tag(deck.regions) + 1, name, {}});
    DeckTag tag = 0;
    for (const DeckTag used : element_tags(deck)) tag = std::max(tag, used);
    DeckSet set{.tag = highest_tag(deck.sets) + 1, .name = name};
    for (const mesh::CellNodes& cell : cells) {
        const bool wedge = cell.count % 3 == 0 && cell.count < 27;
        const DeckShape shape = *find_shape(3, wedge ? 6 : 8, static_cast<int>(cell.count));
        const bool own = deck.format != DeckFormat::unv && deck.format != DeckFormat::nastran;
        const std::string type = !own    ? type_word(deck.format, shape)
                                 : wedge ? layer_wedge(element)
                                         : element;
        DeckBlock& block = deck.blocks[block_of(deck.blocks, shape, type)];
        block.nodes.insert(block.nodes.end(), cell.begin(), cell.end());
        block.tags.push_back(++tag);
        block.regions.push_back(static_cast<Index>(deck.regions.size()) - 1);
        set.members.push_back(tag);
    }
    if (deck.format != DeckFormat::nastran) deck.sets.push_back(std::move(set));
}

} // namespace lacuna::io
