// SPDX-License-Identifier: MIT
#include <lacuna/io/detail/mesh_deck.h>

#include <lacuna/core/error.h>
#include <lacuna/io/cell_field.h>
#include <lacuna/io/detail/cell_shapes.h>
#include <lacuna/io/detail/cursor.h>
#include <lacuna/io/detail/deck_writer.h>
#include <lacuna/io/detail/msh_content.h>

#include <algorithm>
#include <map>

namespace lacuna::io {
namespace {

/// The first of `count` numbers that none has.
DeckTag free_from(DeckTag asked, std::size_t count, const std::set<DeckTag>& texts,
                  std::vector<DeckTag>& taken, const char* option, const char* what)
{
    taken.insert(taken.end(), texts.begin(), texts.end());
    DeckTag highest = 0;
    for (const DeckTag tag : taken) highest = std::max(highest, tag);
    const DeckTag first = asked != 0 ? asked : highest + 1;
    const auto refuse = [&](const std::string& why) {
        throw InvalidInput("io.number_taken",
                           std::string(option) + " = " + std::to_string(first) + ": " + why);
    };
    if (first < 1) refuse("numbers are 1 or more");
    const DeckTag last = first + static_cast<DeckTag>(count) - 1;
    if (last > std::numeric_limits<Index>::max())
        refuse("the last of " + std::to_string(count) + " would be " + std::to_string(last) + ", more than " +
               std::to_string(std::numeric_limits<Index>::max()));
    for (const DeckTag tag : taken)
        if (tag >= first && tag <= last)
            refuse(std::string("the deck has a ") + what + " " + std::to_string(tag) +
                   "; the first free one is " + std::to_string(highest + 1));
    return first;
}

/// Abaqus's side of its cell that a quad of the skin is: S1 below, S2 above, S3 to S6 round it.
std::vector<int> sides_of_skin(const mesh::HexMesh& mesh, const std::vector<std::uint32_t>& cells)
{
    std::vector<int> sides(mesh.skin_count(), 1);
    const std::size_t quads = mesh.quads.size();
    std::fill_n(sides.begin() + static_cast<std::ptrdiff_t>(quads), quads, 2);
    for (std::size_t i = 2 * quads; i < sides.size(); ++i) {
        const Segment& side = mesh.rim[(i - 2 * quads) % mesh.rim.size()];
        const Quad& quad = mesh.quads[cells[i] % quads];
        for (std::size_t k = 0; k < 4; ++k)
            if (quad[k] == side[0] && quad[(k + 1) % 4] == side[1]) sides[i] = 3 + static_cast<int>(k);
    }
    return sides;
}

class MeshAdder {
public:
    MeshAdder(Deck& deck, const mesh::HexMesh& mesh, const AddedMesh& added, const MeshDeckOptions& options)
        : deck_(deck), mesh_(mesh), added_(added), options_(options)
    {
    }

    void add()
    {
        check_skin(mesh_);
        const bool abaqus = options_.format == DeckFormat::abaqus;
        if (cell_shape(mesh_) == DeckShape::hex27)
            throw InvalidInput("io.no_such_element",
                               "hexahedra of 27 nodes are no elements of Abaqus, CalculiX, Nastran or UNV; "
                               "sweep with order = 2, serendipity = true for those of 20");
        if (abaqus) check_element();
        texts_ = numbers_in_text(deck_);
        add_points();
        add_cells();
        add_groups();
        add_region_card();
    }

private:
    /// The word of an element of as many nodes as the mesh's.
    void check_element()
    {
        const bool second = mesh_.order() == 2;
        element_ = options_.element.empty() ? (second ? "C3D20" : "C3D8") : options_.element;
        if (is_abaqus_element(element_, cell_shape(mesh_))) return;
        throw InvalidInput("io.element",
                           "element = \"" + element_ + "\": expected Abaqus's word for a hexahedron of " +
                               (second ? "twenty nodes, such as C3D20 or C3D20R; the mesh is of order 2"
                                       : "eight nodes, such as C3D8, C3D8I or C3D8R; the mesh has no "
                                         "middle nodes"));
    }

    void add_points()
    {
        const std::size_t fresh = static_cast<std::size_t>(std::ranges::count(added_.points, -1));
        std::vector<DeckTag> taken = deck_.point_tags;
        DeckTag next = free_from(options_.first_node, fresh, texts_.nodes, taken, "first_node", "node");
        point_.assign(added_.points.begin(), added_.points.end());
        for (std::size_t n = 0; n < point_.size(); ++n) {
            if (point_[n] >= 0) continue;
            point_[n] = static_cast<Index>(deck_.points.size());
            deck_.points.push_back(mesh_.node(n) / added_.scale);
            deck_.point_tags.push_back(next++);
        }
    }

    void add_cells()
    {
        std::vector<DeckTag> taken;
        for (const DeckBlock& block : deck_.blocks)
            taken.insert(taken.end(), block.tags.begin(), block.tags.end());
        const std::size_t skin = added_.skin_cells ? mesh_.skin_count() : 0;
        first_cell_ = free_from(options_.first_cell, mesh_.hex_count() + skin, texts_.cells, taken,
                                "first_cell", "element");
        int highest = static_cast<int>(
            std::min<DeckTag>(texts_.property, std::numeric_limits<int>::max() - 2));
        for (const DeckRegion& region : deck_.regions) highest = std::max(highest, region.tag);
        volume_ = mesh_.volume_groups.empty() ? "volume" : mesh_.volume_groups.front();
        const auto region = static_cast<Index>(deck_.regions.size());
        deck_.regions.push_back({highest + 1, set_name(DeckSet::Kind::elements, volume_), ""});
        const bool abaqus = options_.format == DeckFormat::abaqus;
        const bool nastran = options_.format == DeckFormat::nastran;
        DeckBlock& block = block_of(cell_shape(mesh_), abaqus               ? element_
                                                       : nastran            ? "CHEXA"
                                                       : mesh_.order() == 2 ? "116"
                                                                            : "115");
        for (std::size_t c = 0; c < mesh_.hex_count(); ++c) {
            for (const Index node : cell_nodes(mesh_, c).all()) block.nodes.push_back(point_[index(node)]);
            block.tags.push_back(first_cell_ + static_cast<DeckTag>(c));
            block.regions.push_back(region);
        }
        if (!nastran)
            for (const std::string& group : mesh_.volume_groups) add_volume_set(group);
        if (added_.skin_cells) add_skin_cells();
    }

    void add_volume_set(const std::string& group)
    {
        DeckSet set{.kind = DeckSet::Kind::elements, .tag = next_set(), .name = {}};
        set.name = group == volume_ ? deck_.regions.back().name : set_name(set.kind, group);
        for (std::size_t c = 0; c < mesh_.hex_count(); ++c)
            set.members.push_back(first_cell_ + static_cast<DeckTag>(c));
        deck_.sets.push_back(std::move(set));
    }

    void add_skin_cells()
    {
        DeckBlock& block = block_of(skin_shape(mesh_), mesh_.order() == 2 ? "95" : "94");
        const auto region = static_cast<Index>(deck_.regions.size() - 1);
        for (std::size_t i = 0; i < mesh_.skin_count(); ++i) {
            for (const Index node : skin_nodes(mesh_, i).all()) block.nodes.push_back(point_[index(node)]);
            block.tags.push_back(skin_tag(i));
            block.regions.push_back(region);
        }
    }

    [[nodiscard]] DeckTag skin_tag(std::size_t i) const
    {
        return first_cell_ + static_cast<DeckTag>(mesh_.hex_count() + i);
    }

    DeckBlock& block_of(DeckShape shape, const std::string& type)
    {
        for (DeckBlock& block : deck_.blocks)
            if (block.shape == shape && block.type == type) return block;
        DeckBlock& block = deck_.blocks.emplace_back();
        block.shape = shape;
        block.type = type;
        return block;
    }

    int next_set() const
    {
        int tag = 0;
        for (const DeckSet& set : deck_.sets) tag = std::max(tag, set.tag);
        return tag + 1;
    }

    /// A name that no set of the kind has.
    std::string set_name(DeckSet::Kind kind, const std::string& group) const
    {
        const std::string name = options_.format == DeckFormat::abaqus ? abaqus_name(group) : group;
        std::string unique = name;
        const auto taken = [&](const DeckSet& set) {
            return set.kind == kind && same_word(set.name, unique);
        };
        for (int i = 2; std::ranges::any_of(deck_.sets, taken); ++i) unique = name + "_" + std::to_string(i);
        return unique;
    }

    void add_groups()
    {
        std::vector<std::string> names;
        std::map<std::string, std::vector<std::uint32_t>> quads;
        for (std::size_t i = 0; i < mesh_.skin_count(); ++i)
            for (const std::string& name : mesh_.patches[index(skin_quad(mesh_, i).patch)].groups) {
                std::vector<std::uint32_t>& of = quads[name];
                if (of.empty()) names.push_back(name);
                of.push_back(static_cast<std::uint32_t>(i));
            }
        if (options_.format == DeckFormat::abaqus) {
            cells_ = cells_of_skin(mesh_);
            sides_ = sides_of_skin(mesh_, cells_);
        }
        for (const std::string& name : names) add_group(name, quads[name]);
    }

    void add_group(const std::string& name, const std::vector<std::uint32_t>& quads)
    {
        const auto add = [&](DeckSet::Kind kind) -> DeckSet& {
            return deck_.sets.emplace_back(
                DeckSet{.kind = kind, .tag = next_set(), .name = set_name(kind, name)});
        };
        if (added_.skin_cells) {
            DeckSet& set = add(DeckSet::Kind::elements);
            for (const std::uint32_t i : quads) set.members.push_back(skin_tag(i));
            return;
        }
        DeckSet& nodes = add(DeckSet::Kind::nodes);
        for (const std::uint32_t i : quads)
            for (const Index node : skin_nodes(mesh_, i).all())
                nodes.members.push_back(deck_.point_tags[index(point_[index(node)])]);
        tidy(nodes.members);
        if (options_.format != DeckFormat::abaqus) return;
        DeckSet& cells = add(DeckSet::Kind::elements);
        for (const std::uint32_t i : quads) cells.members.push_back(first_cell_ + cells_[i]);
        tidy(cells.members);
        DeckSet& sides = add(DeckSet::Kind::sides);
        for (const std::uint32_t i : quads) sides.sides.push_back({first_cell_ + cells_[i], sides_[i]});
        tidy(sides.sides);
    }

    template <class Value>
    static void tidy(std::vector<Value>& values)
    {
        std::sort(values.begin(), values.end());
        values.erase(std::unique(values.begin(), values.end()), values.end());
    }

    void add_region_card()
    {
        if (deck_.format != DeckFormat::nastran) return;
        const int property = deck_.regions.back().tag;
        const std::string text = "$ property of " + volume_ + "\nPSOLID," + std::to_string(property) + ",1\n";
        deck_.texts.push_back({DeckText::Place::cards, "", text});
    }

    Deck& deck_;
    const mesh::HexMesh& mesh_;
    const AddedMesh& added_;
    const MeshDeckOptions& options_;
    TextNumbers texts_;
    std::vector<Index> point_; ///< of each node of the mesh
    std::string volume_, element_;
    DeckTag first_cell_ = 1;
    std::vector<std::uint32_t> cells_; ///< behind each quad of the skin
    std::vector<int> sides_;           ///< of these cells
};

} // namespace

void add_mesh(Deck& deck, const mesh::HexMesh& mesh, const AddedMesh& added, const MeshDeckOptions& options)
{
    MeshAdder(deck, mesh, added, options).add();
}

Deck deck_of(const mesh::HexMesh& mesh, const MeshDeckOptions& options)
{
    Deck deck;
    deck.format = options.format;
    if (options.format == DeckFormat::nastran) {
        deck.texts.push_back({DeckText::Place::head, "", "BEGIN BULK\n"});
        deck.texts.push_back({DeckText::Place::tail, "", "ENDDATA\n"});
    }
    const std::vector<Index> points(mesh.node_count(), -1);
    add_mesh(deck, mesh, {.points = points, .skin_cells = options.format == DeckFormat::unv}, options);
    return deck;
}

} // namespace lacuna::io
