// SPDX-License-Identifier: MIT
#include <lacuna/io/detail/mesh_deck.h>

#include <lacuna/core/error.h>
#include <lacuna/core/shared/constants.h>
#include <lacuna/io/detail/abaqus.h>
#include <lacuna/io/detail/cell_shapes.h>
#include <lacuna/io/detail/deck_builder.h>
#include <lacuna/io/detail/deck_writer.h>
#include <lacuna/io/detail/join_sets.h>
#include <lacuna/io/detail/texts.h>
#include <lacuna/io/shared/deck_materials.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <tuple>

namespace lacuna::io {
namespace {

/// The first of `count` consecutive free numbers.
/// @param highest  all numbers up to this one count as taken.
DeckTag free_from(DeckTag asked, std::size_t count, const std::set<DeckTag>& texts,
                  std::vector<DeckTag>& taken, DeckTag highest, const char* option, const char* what)
{
    taken.insert(taken.end(), texts.begin(), texts.end());
    for (const DeckTag tag : taken) highest = std::max(highest, tag);
    const DeckTag first = asked != 0 ? asked : highest + 1;
    if (first < 1)
        throw InvalidInput("io.number_taken", "{} = {}: numbers must be at least 1", option, found(first));
    const DeckTag last = first + static_cast<DeckTag>(count) - 1;
    if (last > std::numeric_limits<Index>::max())
        throw InvalidInput(Message("io.number_taken",
                                   "{} = {}: the last of {} would get the number {}, above the limit of {}",
                                   option, first, count, found(last),
                                   needed(std::numeric_limits<Index>::max()))
                               .remedy("give a smaller number"));
    for (const DeckTag tag : taken)
        if (tag >= first && tag <= last)
            throw InvalidInput(Message("io.number_taken", "{} = {}: the deck already has {}", option,
                                       found(first), numbered(what, tag))
                                   .remedy("the first free number is {}", needed(highest + 1)));
    return first;
}

template <class Parts>
class MeshAdder {
public:
    MeshAdder(Deck& deck, const Parts& parts, const AddedMesh& added, const MeshDeckOptions& options,
              const RunContext& context)
        : deck_(deck),
          parts_(parts),
          mesh_(parts.mesh),
          added_(added),
          options_(options),
          context_(context),
          texts_(numbers_in_text(deck)),
          sets_(deck, added, options.format, texts_.surfaces)
    {
    }

    void add()
    {
        parts_.check();
        const bool abaqus = options_.format == DeckFormat::abaqus;
        if (const DeckShape shape = parts_.cells()[0].shape;
            (shape == DeckShape::hex27 || shape == DeckShape::pyramid14) &&
            !format_of(options_.format).has_hex27)
            throw InvalidInput(
                Message("io.no_such_element", "{} has no hexahedron of 27 nodes{}",
                        format_of(options_.format).word,
                        shape == DeckShape::hex27 ? "" : " and no pyramid of 14")
                    .remedy("sweep with order = 2 and serendipity = true: hexahedra then have 20 nodes{}",
                            shape == DeckShape::hex27 ? "" : ", pyramids 13"));
        if (abaqus) check_element();
        find_place();
        choose_material();
        if (abaqus) tell_lost_elements();
        const std::vector<std::size_t> of_all = joins() ? sets_of_all(deck_) : std::vector<std::size_t>();
        add_points();
        add_cells();
        if (joins()) update_sets(of_all);
        if (abaqus) add_groups(); // surfaces get their names first; element sets are renamed if necessary
        if (options_.format != DeckFormat::nastran)
            for (const std::string& group : mesh_.volume_groups) add_volume_set(group);
        if (added_.skin_cells) add_skin_cells();
        if (!abaqus) add_groups();
        add_columns();
        add_region_card();
        sets_.tell_names(volume(), context_);
        tell_kept_sets();
        if (added_.before == nullptr) return;
        JoinedBefore& before = *added_.before;
        ++before.meshes;
        if (joins() || !name().empty()) before.regions.try_emplace(name(), region_);
        for (std::size_t n = 0; before.number && n < point_.size(); ++n) {
            const std::size_t number = index(before.number(static_cast<Index>(n)));
            if (number >= before.points.size()) before.points.resize(number + 1, -1);
            before.points[number] = point_[n];
        }
    }

private:
    /// Check that the requested element type has as many nodes as the cells of the mesh.
    void check_element()
    {
        const DeckShape shape = parts_.cells()[0].shape;
        if (shape_info(shape).corners < 8) return; // tetrahedra and pyramids have one type each
        const bool second = shape != DeckShape::hex8;
        element_ = options_.element.empty() ? (second ? "C3D20" : "C3D8") : options_.element;
        const bool wedges = parts_.cells()[1].begin < parts_.cells()[1].end;
        if (wedges && is_layer(element_) && layer_wedge(element_).empty())
            throw InvalidInput(
                Message("io.element",
                        "element = \"{}\": the mesh has wedges, but this type has no variant with six nodes",
                        element_)
                    .remedy("use SC8R, COH3D8 or GK3D8"));
        if (is_abaqus_element(element_, shape)) return;
        throw InvalidInput("io.element", "element = \"{}\": expected an Abaqus name of a hexahedron of {}",
                           element_,
                           second ? "twenty nodes, such as C3D20 or C3D20R; the mesh is of order 2"
                                  : "eight nodes, such as C3D8, C3D8I or C3D8R; the mesh has no "
                                    "middle nodes");
    }

    void poll(std::size_t done) const
    {
        if (done % kBetweenPolls == 0) check_cancelled(context_);
    }

    /// Whether the deck stores the nodes and cells of the mesh.
    [[nodiscard]] bool stores() const { return added_.bulk == nullptr; }
    /// Whether the deck was read from a file.
    [[nodiscard]] bool joins() const { return stores() && !added_.is_new; }

    /// The deck's point for a node of the mesh. If the deck stores no nodes: the number of the node in the
    /// whole mesh.
    [[nodiscard]] Index point(Index node) const
    {
        if (stores()) return point_[index(node)];
        return added_.numbers != nullptr ? added_.numbers->of(node) : node;
    }
    [[nodiscard]] DeckTag point_tag(Index node) const
    {
        return !stores() ? added_.bulk->first_node + point(node) : deck_.point_tags[index(point(node))];
    }

    void add_points()
    {
        if (!stores()) {
            std::vector<DeckTag> none;
            const auto* const of = added_.numbers;
            const std::size_t fresh = of != nullptr ? of->fresh() : parts_.nodes();
            DeckTag& first = added_.bulk->first_node;
            if (options_.first_node != 0) first = options_.first_node;
            free_from(first + (of != nullptr ? of->first() : 0), fresh, {}, none, 0, "first_node", "node");
            return;
        }
        const std::size_t fresh = static_cast<std::size_t>(std::ranges::count(added_.points, -1));
        std::vector<DeckTag> taken = deck_.point_tags;
        DeckTag next = free_from(options_.first_node, fresh, texts_.nodes, taken, deck_.gap.node,
                                 "first_node", "node");
        point_.assign(added_.points.begin(), added_.points.end());
        for (std::size_t n = 0; n < point_.size(); ++n) {
            poll(n);
            if (point_[n] >= 0) continue;
            point_[n] = static_cast<Index>(deck_.points.size());
            deck_.points.push_back(mesh_.node(n) / added_.scale);
            deck_.point_tags.push_back(next++);
        }
    }

    void add_cells()
    {
        std::vector<DeckTag> taken = element_tags(deck_);
        const std::size_t skin = added_.skin_cells ? mesh_.skin_count() : 0;
        first_cell_ = free_from(options_.first_cell, mesh_.cell_count() + skin, texts_.cells, taken,
                                added_.bulk ? added_.bulk->highest : deck_.gap.cell, "first_cell", "element");
        const int highest = highest_tag(
            deck_.regions,
            static_cast<int>(std::min<DeckTag>(texts_.property, std::numeric_limits<int>::max() - 2)));
        volume_ = volume();
        if (!takes_place()) deck_.regions.push_back({highest + 1, volume_, material_});
        const Index region = region_ = takes_place() ? place_ : static_cast<Index>(deck_.regions.size()) - 1;
        if (!stores()) {
            added_.bulk->first_cell = first_cell_;
            added_.bulk->region = region;
        }
        for (const auto& [shape, begin, end] : parts_.cells()) {
            if (begin == end) continue;
            DeckBlock& block = deck_.blocks[block_of(deck_.blocks, shape, type_of(shape))];
            for (std::size_t i = begin; i < end && stores(); ++i) {
                poll(i);
                const std::size_t c = parts_.cell(i);
                for (const Index node : cell_nodes(mesh_, c)) block.nodes.push_back(point(node));
                block.tags.push_back(first_cell_ + static_cast<DeckTag>(c));
                block.regions.push_back(region);
            }
        }
        if (has_sides() || !options_.contacts.empty()) std::tie(cells_, sides_) = parts_.behind_skin();
        for (std::size_t i = 0; joins() && added_.skin_cells && i < mesh_.skin_count(); ++i)
            if (const auto own = added_.skin_tags->find(key_of(i)); own != added_.skin_tags->end())
                skin_of_.emplace(i, own->second);
    }

    /// Whether the cells go into an existing region with the volume's name: one that lost its elements, or
    /// that of a mesh added before.
    [[nodiscard]] bool takes_place() const { return place_ >= 0; }

    void find_place()
    {
        if (added_.before != nullptr)
            if (const auto known = added_.before->regions.find(name()); known != added_.before->regions.end())
                place_ = extended_ = known->second;
        if (deck_.gap.names.empty()) return;
        const std::vector<char> used = used_regions(deck_);
        for (std::size_t r = 0; r < used.size(); ++r)
            if (used[r] == 0 && sets_.is_emptied(deck_.regions[r].name) &&
                same_word(deck_.regions[r].name, volume()))
                place_ = static_cast<Index>(r);
    }

    [[nodiscard]] bool unv() const { return options_.format == DeckFormat::unv; }

    /// The format's word for elements of a shape.
    [[nodiscard]] std::string type_of(DeckShape shape) const
    {
        if (options_.format == DeckFormat::abaqus) {
            if (shape == DeckShape::wedge6 && !layer_wedge(element_).empty()) return layer_wedge(element_);
            if (!element_.empty() && shape == parts_.cells()[0].shape) return element_;
        }
        return type_word(options_.format, shape);
    }

    void add_volume_set(const std::string& group)
    {
        std::string& region = deck_.regions[index(region_)].name;
        const bool own = group == volume_;
        DeckSet cells;
        cells.listed = extended_ >= 0; // lists the set, so that several pieces can extend it
        for (std::size_t c = 0; c < mesh_.cell_count() && stores(); ++c)
            cells.members.push_back(first_cell_ + static_cast<DeckTag>(c));
        const DeckSet& set = sets_.add(cells, group, own && takes_place() ? region : group);
        if (own && !takes_place()) region = set.name;
        if (!stores()) added_.bulk->sets.push_back(static_cast<std::size_t>(&set - deck_.sets.data()));
    }

    /// Update the sets of the deck that should contain the mesh.
    /// @param of_all  result of `sets_of_all()` before the mesh was added
    void update_sets(const std::vector<std::size_t>& of_all)
    {
        if (of_all.empty() && deck_.gap.gone.empty()) return;
        NewCells added{.volume = volume_};
        for (const Index place : point_) added.nodes.push_back(deck_.point_tags[index(place)]);
        for (std::size_t c = 0; c < mesh_.cell_count(); ++c)
            added.cells.push_back(first_cell_ + static_cast<DeckTag>(c));
        for (std::size_t i = 0; i < mesh_.skin_count(); ++i) {
            NewCells::Side& side = added.skin.emplace_back();
            const Quad corners = skin_quad(mesh_, i).nodes;
            for (std::size_t k = 0; k < 4; ++k)
                side.corners[k] = mesh_.node(index(corners[k])) / added_.scale;
            for (const Index node : skin_nodes(mesh_, i)) side.nodes.push_back(point_tag(node));
            if (has_sides()) side.side = {first_cell_ + cells_[i], sides_[i]};
            if (added_.skin_cells) side.cell = skin_tag(i);
        }
        join_sets(deck_, added, of_all, [&](const DeckSet& set) { return may_join(set); });
    }

    /// Whether the cells may join a set. They may not if the set has a section with another material than
    /// theirs. If decks were merged and each has a section for all its cells, the cells join the first of
    /// these sets only, so that they get one section.
    bool may_join(const DeckSet& set)
    {
        if (options_.format != deck_.format || takes_place()) return true;
        const std::optional<std::string> section = section_material(deck_, set.name);
        if (!section) return true;
        const bool chosen = !options_.material.empty() || (set.of_one_deck && !material_.empty());
        const bool has_other = set.of_one_deck && !section_set_.empty() && section_set_ != set.name;
        const bool other = has_other || (chosen && !same_word(*section, material_));
        if (other)
            log_line(context_, formatted("note: {} is not in the set {}, whose section has the material {}",
                                         volume_, set.name, *section));
        if (other || sets_.is_emptied(set.name)) return false;
        section_set_ = set.name;
        return true;
    }

    /// Report sets that were not extended because Nastran's cards or case control refer to them by number.
    void tell_kept_sets() const
    {
        if (!joins() || deck_.format != DeckFormat::nastran) return;
        std::vector<std::string> cards;
        for (const DeckText& text : deck_.texts) {
            each_line(text.text, [&](std::string_view line) {
                constexpr std::string_view kBetween = ",=* \t\r\v\f";
                const std::string word(next_word(line, kBetween)), number(next_word(line, kBetween));
                if (same_word(word, "SET") || same_word(word, "SET1") || same_word(word, "SET3"))
                    cards.push_back(word + " " + number);
            });
        }
        if (!cards.empty())
            log_line(
                context_,
                formatted("note: the members of {} are unchanged: no node and no cell of {} is added to them",
                          listed(cards), volume_));
    }

    void add_skin_cells()
    {
        // Region of a skin element. In UNV each skin element needs a property, in MSH exactly one group;
        // other formats have no region for skin elements.
        const auto region_of = [&](std::size_t i) {
            if (options_.format != DeckFormat::msh) return unv() ? region_ : -1;
            const auto& groups = mesh_.patches[index(skin_quad(mesh_, i).patch)].groups;
            if (groups.empty()) return Index(-1);
            const auto [found, fresh] = skin_regions_.try_emplace(groups.front(), -1);
            if (!fresh) return found->second;
            const auto same = std::ranges::find_if(deck_.regions, [&](const DeckRegion& of) {
                return of.tag == 0 && of.name == groups.front(); // a region that an earlier mesh has created
            });
            found->second = static_cast<Index>(same - deck_.regions.begin());
            if (same == deck_.regions.end()) deck_.regions.push_back({0, groups.front(), {}});
            return found->second;
        };
        for (const auto& [shape, begin, end] : parts_.skin()) {
            if (begin == end) continue;
            DeckBlock& block = deck_.blocks[block_of(deck_.blocks, shape, type_of(shape))];
            for (std::size_t k = begin; k < end; ++k) {
                const std::size_t i = parts_.side(k);
                if (is_inner(i) || is_there(i)) continue;
                for (const Index node : skin_nodes(mesh_, i)) block.nodes.push_back(point(node));
                block.tags.push_back(skin_tag(i));
                block.regions.push_back(region_of(i));
            }
        }
    }

    /// A quad of the skin by the deck's points.
    [[nodiscard]] Quad key_of(std::size_t i) const
    {
        Quad quad = skin_quad(mesh_, i).nodes;
        for (Index& node : quad) node = point(node);
        return face_key(quad);
    }

    /// Whether the deck, or a mesh that was added before, already has a quad of the skin. If not, the quad is
    /// recorded.
    bool is_there(std::size_t i)
    {
        if (added_.skin_tags == nullptr) return false;
        if (joins()) return skin_of_.contains(i);
        const auto [found, fresh] = added_.skin_tags->try_emplace(key_of(i), skin_tag(i));
        if (!fresh) skin_of_.emplace(i, found->second);
        return !fresh;
    }

    /// Whether a quad is an interface that is not written: between pieces of a volume (it has no group), or
    /// between meshes if `interfaces` is off.
    [[nodiscard]] bool is_inner(std::size_t i) const
    {
        const bool several = added_.before != nullptr;
        if (several && mesh_.patches[index(skin_quad(mesh_, i).patch)].groups.empty()) return true;
        return !added_.inner.empty() && added_.inner[i] != 0;
    }

    [[nodiscard]] DeckTag skin_tag(std::size_t i) const
    {
        const auto known = skin_of_.find(i);
        return known != skin_of_.end() ? known->second
                                       : first_cell_ + static_cast<DeckTag>(mesh_.cell_count() + i);
    }

    void add_groups()
    {
        std::vector<std::string> names;
        std::map<std::string, std::vector<std::uint32_t>> quads;
        for (std::size_t i = 0; i < mesh_.skin_count(); ++i) {
            poll(i);
            if (added_.skin_cells && is_inner(i)) continue;
            for (const std::string& name : mesh_.patches[index(skin_quad(mesh_, i).patch)].groups) {
                std::vector<std::uint32_t>& of = quads[name];
                if (of.empty()) names.push_back(name);
                of.push_back(static_cast<std::uint32_t>(i));
            }
        }
        // Groups with names that are valid in Abaqus come first and keep their names: of "wall:3" and
        // "wall_3", "wall:3" is renamed. Names with a colon are generated and come last.
        const auto rank = [&](const std::string& name) {
            if (options_.format != DeckFormat::abaqus || abaqus_name(name) == name) return 0;
            return name.find(':') == std::string::npos ? 1 : 2;
        };
        std::ranges::stable_sort(names, {}, rank);
        for (const std::string& name : names) add_group(name, quads[name]);
    }

    [[nodiscard]] bool has_sides() const
    {
        return format_of(options_.format).skin == Format::Skin::nodes_and_sides;
    }

    /// Add the sets of the nodes of columns. They extend sets of nodes of the same name.
    void add_columns()
    {
        const std::size_t part = added_.before != nullptr ? added_.before->meshes : 0;
        for (const ColumnSet& column : options_.columns) {
            if (column.part != part) continue;
            DeckSet set{.kind = DeckSet::Kind::nodes, .name = column.name};
            for (const Index node : parts_.nodes_over(column.nodes)) set.members.push_back(point_tag(node));
            const auto same = std::ranges::find_if(deck_.sets, [&](const DeckSet& other) {
                return other.kind == set.kind && same_word(other.name, set.name);
            });
            if (same == deck_.sets.end()) {
                sets_.add(set, column.name, column.name);
                continue;
            }
            same->members.insert(same->members.end(), set.members.begin(), set.members.end());
            tidy(*same);
        }
    }

    void add_group(const std::string& name, const std::vector<std::uint32_t>& quads)
    {
        DeckSet set;
        if (added_.skin_cells) {
            // If all quads are elements of the deck already, its group of that name is unchanged.
            if (joins() && sets_.is_taken(set.kind, name) &&
                std::ranges::all_of(quads, [&](std::uint32_t i) { return skin_of_.contains(i); }))
                return;
            for (const std::uint32_t i : quads) set.members.push_back(skin_tag(i));
            const std::string& own = sets_.add(set, unv() ? name + SetAdder::kSkin : name, name).name;
            // Give the skin's region the name of the set, so that the group is written under one name.
            if (const auto of = skin_regions_.find(name); of != skin_regions_.end())
                deck_.regions[index(of->second)].name = own;
            return;
        }
        set.kind = DeckSet::Kind::nodes;
        for (const std::uint32_t i : quads)
            for (const Index node : skin_nodes(mesh_, i)) set.members.push_back(point_tag(node));
        sets_.add(set, name, name);
        const bool in_contact = std::ranges::any_of(options_.contacts, [&](const mesh::ContactPair& pair) {
            return std::ranges::find(pair.groups, name) != pair.groups.end();
        });
        if (!has_sides() && !in_contact) return;
        DeckSet cells, sides;
        sides.kind = DeckSet::Kind::sides;
        for (const std::uint32_t i : quads) {
            cells.members.push_back(first_cell_ + cells_[i]);
            sides.sides.push_back({first_cell_ + cells_[i], sides_[i]});
        }
        if (options_.format == DeckFormat::abaqus) sets_.add(cells, name + SetAdder::kSkin, name + "_cells");
        sets_.add(sides, name, name);
    }

    /// Choose the material: the requested one or, by default, that of the elements next to the mesh.
    void choose_material()
    {
        material_ = options_.material;
        if (!joins()) return;
        const std::vector<std::string> known = materials_in_text(deck_);
        if (takes_place() && options_.format == deck_.format) {
            material_ = deck_.regions[index(place_)].material;
            if (extended_ >= 0) return; // the mesh is another piece of one that was added before
            log_line(context_, formatted("{} replaces the region of that name and keeps its cards{}",
                                         volume(), options_.material.empty() ? "" : "; material is ignored"));
            return;
        }
        if (material_.empty()) {
            if (find_word(known, added_.neighbour_material) == known.end()) return;
            material_ = added_.neighbour_material;
            std::vector<std::string> lost; // materials of elements that were left out
            for (const auto& gone : deck_.gap.gone) {
                const std::vector<char> used = used_regions(*gone);
                for (std::size_t r = 0; r < used.size(); ++r)
                    if (const std::string& own = gone->regions[r].material;
                        used[r] != 0 && !own.empty() && !same_word(own, material_) &&
                        find_word(lost, own) == lost.end())
                        lost.push_back(own);
            }
            log_line(
                context_,
                formatted(
                    "note: {}: its material is {}, that of {} beside it{}; to use another, set the option "
                    "material of open_volume",
                    volume(), material_, added_.neighbour,
                    lost.empty() ? ""
                                 : formatted(", while elements that were left out have {}",
                                             full_list(lost, std::identity()))));
            return;
        }
        if (const auto found = find_word(known, material_); found != known.end()) {
            material_ = *found;
            return;
        }
        throw InvalidInput("io.no_material", "material = {}: {} has {}", material_, deck_.path,
                           materials_in_words(deck_));
    }
    /// Report the types of hexahedra that were left out, if the new ones are of another type.
    void tell_lost_elements() const
    {
        if (!options_.element.empty() || element_.empty() || extended_ >= 0) return;
        std::set<std::string> types;
        for (const auto& gone : deck_.gap.gone)
            for (const DeckBlock& block : gone->blocks)
                if (!same_word(block.type, element_) &&
                    is_abaqus_element(block.type, parts_.cells()[0].shape))
                    types.insert(block.type);
        for (const std::string& type : types)
            log_line(context_, formatted("note: {} has elements {}, while some that were left out are {}; "
                                         "element = \"{}\" writes these",
                                         volume(), element_, type, type));
    }
    [[nodiscard]] std::string name() const
    {
        return mesh_.volume_groups.empty() ? "" : mesh_.volume_groups.front();
    }
    [[nodiscard]] std::string volume() const { return name().empty() ? "volume" : name(); }

    void add_region_card()
    {
        if (options_.format != deck_.format || takes_place()) return;
        const DeckRegion& region = deck_.regions[index(region_)];
        if (deck_.format == DeckFormat::nastran) {
            // Nastran needs a number. If the material is a name, from another format, write 1; the user sets
            // the number.
            const std::string number = parse_integer<int>(material_) ? material_ : "1";
            const bool named = number != material_ && !material_.empty();
            deck_.texts.push_back(
                {DeckText::Place::cards, "",
                 formatted("$ property of {}{}{}\nPSOLID,{},{}\n", volume_, named ? ", material " : "",
                           named ? material_ : "", region.tag, number)});
        } else if (deck_.format == DeckFormat::abaqus && !material_.empty() && section_set_.empty() &&
                   !section_material(deck_, region.name)) {
            add_model_cards(deck_,
                            formatted("*SOLID SECTION, ELSET={}, MATERIAL={}\n", region.name, material_));
        }
    }

    Deck& deck_;
    const Parts& parts_;
    decltype(Parts::mesh) mesh_;
    const AddedMesh& added_;
    const MeshDeckOptions& options_;
    const RunContext& context_;
    TextNumbers texts_;
    SetAdder sets_;
    std::string material_;
    std::vector<Index> point_; ///< the deck's point for each node of the mesh
    std::string volume_, element_;
    std::string section_set_;                   ///< set of the deck whose section applies to the cells
    std::map<std::string, Index> skin_regions_; ///< for MSH: regions of the skin, by the groups' names
    Index place_ = -1, region_ = -1;            ///< region that the volume replaces, and region of the cells
    Index extended_ = -1;                       ///< region of an earlier mesh that the cells extend
    DeckTag first_cell_ = 1;
    std::vector<std::uint32_t> cells_;       ///< cell of each quad of the skin
    std::vector<int> sides_;                 ///< for each of these quads, the number of the face in the cell
    std::map<std::size_t, DeckTag> skin_of_; ///< quads of the skin that are elements already
};

} // namespace

void add_mesh(Deck& deck, const mesh::HexMesh& mesh, const AddedMesh& added, const MeshDeckOptions& options,
              const RunContext& context)
{
    MeshAdder(deck, SweptParts{mesh}, added, options, context).add();
}

void add_mesh(Deck& deck, const mesh::TetPart& mesh, const AddedMesh& added, const MeshDeckOptions& options,
              const RunContext& context)
{
    MeshAdder(deck, TetParts{mesh}, added, options, context).add();
}

bool has_material(const Deck& deck, const std::string& material)
{
    const std::vector<std::string> known = materials_in_text(deck);
    return find_word(known, material) != known.end();
}

std::string materials_in_words(const Deck& deck)
{
    const std::vector<std::string> known = materials_in_text(deck);
    return known.empty() ? "no materials" : formatted("the materials {}", short_list(known, std::identity()));
}

} // namespace lacuna::io
