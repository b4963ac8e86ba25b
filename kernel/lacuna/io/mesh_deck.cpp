// SPDX-License-Identifier: MIT
#include <lacuna/io/detail/mesh_deck.h>

#include <lacuna/core/error.h>
#include <lacuna/core/shared/constants.h>
#include <lacuna/io/cell_field.h>
#include <lacuna/io/detail/abaqus.h>
#include <lacuna/io/detail/cell_shapes.h>
#include <lacuna/io/detail/deck_builder.h>
#include <lacuna/io/detail/deck_view.h>
#include <lacuna/io/detail/deck_writer.h>
#include <lacuna/io/detail/join_sets.h>
#include <lacuna/io/detail/texts.h>
#include <lacuna/io/shared/mixed_deck.h>
#include <lacuna/mesh/layered_nodes.h>
#include <lacuna/mesh/mesh_part.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <tuple>
#include <type_traits>
#include <unordered_map>

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

/// For each quad of the skin, the Abaqus number of this face in its cell: S1 at the bottom, S2 at the top,
/// and S3 to S6 (for a wedge to S5) at the sides.
std::vector<int> sides_of_skin(const mesh::HexMesh& mesh, const std::vector<std::uint32_t>& cells)
{
    std::vector<int> sides(mesh.skin_count(), 1);
    const std::size_t quads = mesh.quads.size();
    std::fill_n(sides.begin() + static_cast<std::ptrdiff_t>(quads), quads, 2);
    for (std::size_t i = 2 * quads; i < sides.size(); ++i) {
        const Segment& side = mesh.rim[(i - 2 * quads) % mesh.rim.size()];
        const Quad& quad = mesh.quads[cells[i] % quads];
        const std::size_t corners = mesh::corner_count(quad);
        for (std::size_t k = 0; k < corners; ++k)
            if (quad[k] == side[0] && quad[(k + 1) % corners] == side[1]) sides[i] = 3 + static_cast<int>(k);
    }
    return sides;
}

// Common interface of swept meshes and tetrahedra: cells and skin by shape, and their nodes.

/// Positions [begin, end) of the cells, or of the sides of the skin, of one shape.
struct OfShape {
    DeckShape shape;
    std::size_t begin, end;
};
using ByShape = std::array<OfShape, 2>;

/// A swept mesh. Its cells and skin are not stored by shape, so positions are converted to indices.
struct SweptParts {
    const mesh::HexMesh& mesh;
    mesh::CellKinds kinds{mesh};

    [[nodiscard]] ByShape cells() const
    {
        return {
            {{cell_shape(mesh), 0, kinds.hexes()}, {DeckShape::wedge6, kinds.hexes(), mesh.cell_count()}}};
    }
    [[nodiscard]] ByShape skin() const
    {
        return {{{skin_shape(mesh), 0, kinds.skin_quads()},
                 {DeckShape::tri3, kinds.skin_quads(), mesh.skin_count()}}};
    }
    [[nodiscard]] std::size_t cell(std::size_t i) const { return kinds.cell(i); }
    [[nodiscard]] std::size_t side(std::size_t i) const { return kinds.skin(i); }
    [[nodiscard]] mesh::CellNodes cell_nodes(std::size_t c) const { return mesh::cell_nodes(mesh, c); }
    [[nodiscard]] mesh::CellNodes skin_nodes(std::size_t i) const { return mesh::skin_nodes(mesh, i); }
    [[nodiscard]] Quad skin_quad(std::size_t i) const { return mesh::skin_quad(mesh, i).nodes; }
    [[nodiscard]] Index patch(std::size_t i) const { return mesh::skin_quad(mesh, i).patch; }
    /// For each side of the skin: its cell, and the number of that face in the cell.
    [[nodiscard]] std::pair<std::vector<std::uint32_t>, std::vector<int>> behind_skin() const
    {
        std::vector<std::uint32_t> cells = cells_of_skin(mesh);
        std::vector<int> sides = sides_of_skin(mesh, cells);
        return {std::move(cells), std::move(sides)};
    }
    [[nodiscard]] std::size_t nodes() const { return mesh::corner_count(mesh) + mesh::middle_count(mesh); }
    /// All nodes of the columns over nodes of the first level.
    [[nodiscard]] std::vector<Index> nodes_over(std::span<const Index> first) const
    {
        std::vector<Index> all;
        const mesh::MiddlePlaces middle(mesh);
        for (const Index node : first) {
            for (Index level = 0; level <= mesh.layers; ++level) {
                all.push_back(level * mesh.nodes_per_layer + node);
                if (level < mesh.layers && mesh.order() > 1)
                    all.push_back(static_cast<Index>(mesh::corner_count(mesh) +
                                                     middle.upright(static_cast<std::size_t>(level), node)));
            }
        }
        return all;
    }
    void check() const { check_skin(mesh); }
};

/// Pyramids and tetrahedra.
struct TetParts {
    const mesh::TetPart& mesh;

    [[nodiscard]] ByShape cells() const
    {
        return {{{mesh::cell_shape(mesh, true), 0, mesh.pyramids},
                 {mesh::cell_shape(mesh, false), mesh.pyramids, mesh.cells.size()}}};
    }
    [[nodiscard]] ByShape skin() const
    {
        return {{{mesh::skin_shape(mesh, true), 0, mesh.skin_quads},
                 {mesh::skin_shape(mesh, false), mesh.skin_quads, mesh.skin.size()}}};
    }
    [[nodiscard]] static std::size_t cell(std::size_t i) { return i; }
    [[nodiscard]] static std::size_t side(std::size_t i) { return i; }
    [[nodiscard]] mesh::CellNodes cell_nodes(std::size_t c) const { return mesh::cell_nodes(mesh, c); }
    [[nodiscard]] mesh::CellNodes skin_nodes(std::size_t i) const { return mesh::skin_nodes(mesh, i); }
    [[nodiscard]] Quad skin_quad(std::size_t i) const { return mesh.skin[i]; }
    [[nodiscard]] Index patch(std::size_t i) const { return mesh.skin_patch[i]; }
    [[nodiscard]] std::pair<std::vector<std::uint32_t>, std::vector<int>> behind_skin() const
    {
        std::unordered_map<Quad, std::size_t, CornerHash<4>> sides;
        for (std::size_t i = 0; i < mesh.skin.size(); ++i) sides.emplace(face_key(mesh.skin[i]), i);
        std::pair<std::vector<std::uint32_t>, std::vector<int>> behind{
            std::vector<std::uint32_t>(mesh.skin.size()), std::vector<int>(mesh.skin.size())};
        for (const OfShape& of : cells())
            for (std::size_t c = of.begin; c < of.end; ++c) {
                const mesh::CellNodes nodes = cell_nodes(c);
                int number = 0;
                for (Quad face : face_corners(of.shape)) {
                    for (Index& corner : face) corner = corner < 0 ? -1 : nodes.node[index(corner)];
                    ++number;
                    const auto side = sides.find(rising(face));
                    if (side == sides.end()) continue;
                    behind.first[side->second] = static_cast<std::uint32_t>(c);
                    behind.second[side->second] = number;
                }
            }
        return behind;
    }
    [[nodiscard]] std::size_t nodes() const { return mesh.node_count(); }
    [[nodiscard]] static std::vector<Index> nodes_over(std::span<const Index>) { return {}; }
    static void check() {}
};

/// The format's word for elements of a shape; empty: the format needs none.
std::string type_word(DeckFormat format, DeckShape shape)
{
    const ShapeWords& words = words_of(shape);
    return format == DeckFormat::unv       ? std::to_string(words.unv)
           : format == DeckFormat::nastran ? words.nastran
           : format == DeckFormat::abaqus  ? words.abaqus
                                           : "";
}

template <class Parts>
class MeshAdder {
public:
    MeshAdder(Deck& deck, const Parts& parts, const AddedMesh& added, const MeshDeckOptions& options,
              const RunContext& context)
        : deck_(deck), parts_(parts), mesh_(parts.mesh), added_(added), options_(options), context_(context)
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
        texts_ = numbers_in_text(deck_);
        first_set_ = deck_.sets.size();
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
        tell_names();
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

    /// Check for cancellation about once a millisecond.
    void poll(std::size_t done) const
    {
        constexpr std::size_t kPolled = 65536;
        if (done % kPolled == 0) check_cancelled(context_);
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
                for (const Index node : parts_.cell_nodes(c)) block.nodes.push_back(point(node));
                block.tags.push_back(first_cell_ + static_cast<DeckTag>(c));
                block.regions.push_back(region);
            }
        }
        if (has_sides() || !options_.contacts.empty()) std::tie(cells_, sides_) = parts_.behind_skin();
        for (std::size_t i = 0; joins() && added_.skin_cells && i < mesh_.skin_count(); ++i)
            if (const auto own = added_.skin_tags->find(key_of(i)); own != added_.skin_tags->end())
                skin_of_.emplace(i, own->second);
    }

    [[nodiscard]] bool is_emptied(const std::string& name) const
    {
        return find_word(deck_.gap.names, name) != deck_.gap.names.end();
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
            if (used[r] == 0 && is_emptied(deck_.regions[r].name) &&
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
        const DeckSet& set = add_set(cells, group, own && takes_place() ? region : group);
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
            const Quad corners = parts_.skin_quad(i);
            for (std::size_t k = 0; k < 4; ++k)
                side.corners[k] = mesh_.node(index(corners[k])) / added_.scale;
            for (const Index node : parts_.skin_nodes(i)) side.nodes.push_back(point_tag(node));
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
        if (other || is_emptied(set.name)) return false;
        section_set_ = set.name;
        return true;
    }

    /// Add a group as a set, named `wanted` if that name is free. The group extends the set of a mesh that
    /// was added before, or a set that lost all members; otherwise a new set is made.
    const DeckSet& add_set(DeckSet& set, const std::string& group, const std::string& wanted)
    {
        tidy(set);
        const auto put = [&](DeckSet& into) -> const DeckSet& {
            const bool rises = into.sides.empty() && set.sides.empty() &&
                               (into.members.empty() || set.members.empty() ||
                                into.members.back() < set.members.front());
            into.members.insert(into.members.end(), set.members.begin(), set.members.end());
            into.sides.insert(into.sides.end(), set.sides.begin(), set.sides.end());
            if (!rises) tidy(into);
            into.listed |= set.listed;
            return into;
        };
        GroupSets own;
        const auto [known, fresh] =
            (added_.before ? added_.before->sets : own).try_emplace({set.kind, group}, deck_.sets.size());
        if (!fresh) return put(deck_.sets[known->second]);
        const auto find = [&](const std::string& name) {
            const std::vector<std::size_t>& named = sets_named(name);
            const auto at = std::ranges::find_if(named, [&](std::size_t s) {
                const DeckSet& other = deck_.sets[s];
                if (other.kind != set.kind) return false;
                const bool none = other.members.empty() && other.sides.empty();
                // If the deck does not store cells, the set of all cells of a mesh is empty. It is recognised
                // by being empty and created by this mesh.
                if (none && !stores()) return set.members.empty() && s >= first_set_;
                return none ? is_emptied(name) : other.members == set.members && other.sides == set.sides;
            });
            return at == named.end() ? kNoIndex : *at;
        };
        set.name = free_name(wanted, options_.format, [&](const std::string& name) {
            return find(name) == kNoIndex && is_taken(set.kind, name);
        });
        constexpr const char* kKinds[] = {"nodes", "elements", "sides"}; // in the order of DeckSet::Kind
        const bool behind = options_.format == DeckFormat::abaqus && group.ends_with(kSkin);
        if (!behind && set.name != free_name(wanted, options_.format, [](const auto&) { return false; }))
            renamed_.emplace(formatted("its set of {} {}", kKinds[static_cast<int>(set.kind)], wanted),
                             set.name);
        if (const std::size_t same = find(set.name); same != kNoIndex) {
            known->second = same;
            deck_.gap.replaced[{deck_.sets[same].kind, deck_.sets[same].name}] = 1;
            return put(deck_.sets[same]);
        }
        set.tag = names().highest_tag + 1;
        return deck_.sets.emplace_back(std::move(set));
    }

    /// The names of the deck's sets, with those that were added since the last call.
    SetNames& names()
    {
        SetNames& names = added_.before ? added_.before->names : names_;
        for (; names.counted < deck_.sets.size(); ++names.counted) {
            const DeckSet& set = deck_.sets[names.counted];
            names.sets[upper(set.name)].push_back(names.counted);
            names.highest_tag = std::max(names.highest_tag, set.tag);
        }
        return names;
    }
    const std::vector<std::size_t>& sets_named(const std::string& name) { return names().sets[upper(name)]; }

    [[nodiscard]] bool is_taken(DeckSet::Kind kind, const std::string& name)
    {
        if (kind != DeckSet::Kind::nodes && find_word(texts_.surfaces, name) != texts_.surfaces.end())
            return true;
        return std::ranges::any_of(sets_named(name), [&](std::size_t s) {
            return share_names(options_.format, kind, deck_.sets[s].kind);
        });
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

    void tell_names() const
    {
        std::vector<std::string> names;
        for (const auto& [own, name] : renamed_) names.push_back(formatted("{} is called {}", own, name));
        if (!names.empty())
            log_line(context_, formatted("note: {}: renamed, because other sets have these names: {}",
                                         volume(), listed(names)));
    }

    void add_skin_cells()
    {
        // Region of a skin element. In UNV each skin element needs a property, in MSH exactly one group;
        // other formats have no region for skin elements.
        const auto region_of = [&](std::size_t i) {
            if (options_.format != DeckFormat::msh) return unv() ? region_ : -1;
            const auto& groups = mesh_.patches[index(parts_.patch(i))].groups;
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
                for (const Index node : parts_.skin_nodes(i)) block.nodes.push_back(point(node));
                block.tags.push_back(skin_tag(i));
                block.regions.push_back(region_of(i));
            }
        }
    }

    /// A quad of the skin by the deck's points.
    [[nodiscard]] Quad key_of(std::size_t i) const
    {
        Quad quad = parts_.skin_quad(i);
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
        if (several && mesh_.patches[index(parts_.patch(i))].groups.empty()) return true;
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
            for (const std::string& name : mesh_.patches[index(parts_.patch(i))].groups) {
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
                add_set(set, column.name, column.name);
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
            if (joins() && is_taken(set.kind, name) &&
                std::ranges::all_of(quads, [&](std::uint32_t i) { return skin_of_.contains(i); }))
                return;
            for (const std::uint32_t i : quads) set.members.push_back(skin_tag(i));
            const std::string& own = add_set(set, unv() ? name + kSkin : name, name).name;
            // Give the skin's region the name of the set, so that the group is written under one name.
            if (const auto of = skin_regions_.find(name); of != skin_regions_.end())
                deck_.regions[index(of->second)].name = own;
            return;
        }
        set.kind = DeckSet::Kind::nodes;
        for (const std::uint32_t i : quads)
            for (const Index node : parts_.skin_nodes(i)) set.members.push_back(point_tag(node));
        add_set(set, name, name);
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
        if (options_.format == DeckFormat::abaqus) add_set(cells, name + kSkin, name + "_cells");
        add_set(sides, name, name);
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
                formatted("{}{}: its material is {}, that of {} beside it{}; to use another, set the option "
                          "material of open_volume",
                          lost.empty() ? "" : "note: ", volume(), material_, added_.neighbour,
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
                           known.empty() ? "no materials"
                                         : formatted("the materials {}", short_list(known, std::identity())));
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
    // Suffix of the keys of skin groups, to distinguish them from cell groups; it occurs in no name.
    static constexpr const char* kSkin = "\n";

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
    std::string material_;
    std::vector<Index> point_; ///< the deck's point for each node of the mesh
    std::string volume_, element_;
    std::string section_set_;                    ///< set of the deck whose section applies to the cells
    std::map<std::string, std::string> renamed_; ///< sets whose names were in use, with their new names
    std::map<std::string, Index> skin_regions_;  ///< for MSH: regions of the skin, by the groups' names
    Index place_ = -1, region_ = -1;             ///< region that the volume replaces, and region of the cells
    Index extended_ = -1;                        ///< region of an earlier mesh that the cells extend
    DeckTag first_cell_ = 1;
    SetNames names_;                         ///< names of the deck's sets, if no mesh was added before
    std::size_t first_set_ = 0;              ///< number of sets before the mesh was added
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
    const auto add = [&](const auto& parts, std::size_t p) {
        AddedMesh added{.points = numbers[p], .skin_cells = cells, .before = &before, .is_new = true};
        if (interfaces) added.skin_tags = &skin_tags;
        added.inner = std::move(inner[p]);
        MeshAdder(deck, parts, added, options, context).add();
        options.first_cell = 0;
    };
    for (std::size_t p = 0; p < swept.size(); ++p) add(SweptParts{swept[p].mesh}, p);
    for (std::size_t t = 0; t < tets.size(); ++t) add(TetParts{tets[t].mesh}, swept.size() + t);
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
