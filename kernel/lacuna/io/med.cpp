// SPDX-License-Identifier: MIT
#include <lacuna/io/detail/med.h>

#include <lacuna/io/detail/cell_shapes.h>
#include <lacuna/io/detail/deck_builder.h>
#include <lacuna/io/detail/deck_view.h>
#include <lacuna/io/detail/format_table.h>
#include <lacuna/io/shared/units.h>

#include <algorithm>
#include <limits>
#include <map>
#include <optional>
#include <set>

namespace lacuna::io {

void read_med(Cursor& cursor, DeckBuilder& into);

namespace {

using mesh::MeshView;

class MedReader {
public:
    MedReader(Cursor& cursor, DeckBuilder& into, MedContent content)
        : cursor_(cursor), into_(into), content_(std::move(content))
    {
    }

    void read()
    {
        Deck& deck = into_.deck();
        if (is_unit(content_.unit)) deck.unit = content_.unit;
        for (const std::string& note : content_.notes) into_.warn(note);
        if (std::ranges::any_of(content_.points, [](const Vec3& p) { return !p.allFinite(); }))
            cursor_.fail("expected finite coordinates");
        deck.points = std::move(content_.points);
        deck.point_tags = numbers({&content_.point_numbers, 1}, deck.points.size(), "nodes");
        std::vector<std::vector<std::int32_t>> given;
        std::size_t count = 0;
        for (const MedCells& cells : content_.cells) {
            given.push_back(cells.numbers);
            count += cells.families.size();
        }
        const std::vector<DeckTag> tags = numbers(given, count, "cells");
        std::size_t first = 0;
        for (const MedCells& cells : content_.cells)
            first += add_cells(cells, {tags.data() + first, count - first});
        add_sets();
    }

private:
    /// Numbers of nodes or cells: those of the file or, if it gives none or repeats one, numbers in order.
    std::vector<DeckTag> numbers(std::span<const std::vector<std::int32_t>> given, std::size_t count,
                                 const char* what)
    {
        std::vector<DeckTag> all;
        for (const auto& some : given) all.insert(all.end(), some.begin(), some.end());
        std::vector<DeckTag> sorted = all;
        std::ranges::sort(sorted);
        const bool twice = std::ranges::adjacent_find(sorted) != sorted.end();
        if (all.size() == count && !twice && (all.empty() || sorted.front() >= 0)) return all;
        if (!all.empty())
            into_.warn(formatted("{} are numbered in order, because their numbers repeat", what));
        all.resize(count);
        for (std::size_t i = 0; i < count; ++i) all[i] = static_cast<DeckTag>(i) + 1;
        return all;
    }

    std::size_t add_cells(const MedCells& cells, std::span<const DeckTag> tags)
    {
        const std::optional<DeckShape> shape = shape_numbered(&ShapeWords::med, cells.type);
        if (!shape) cursor_.fail("the cell type {} is unknown", cells.type);
        const auto size = static_cast<std::size_t>(shape_info(*shape).nodes);
        const auto places = node_places(NodeOrder::med, *shape);
        const std::size_t count = cells.families.size();
        if (cells.nodes.size() != count * size) cursor_.fail("the number of nodes does not match the cells");
        const std::size_t block = into_.block_of(*shape, "");
        std::vector<Index> nodes(size);
        for (std::size_t e = 0; e < count; ++e) {
            for (std::size_t k = 0; k < size; ++k) {
                const std::int32_t node = cells.nodes[e * size + places[k]];
                if (node < 1 || index(node) > into_.points().size())
                    cursor_.fail("expected a node of {}, found number {}", into_.points().size(),
                                 found(node));
                nodes[k] = node - 1;
            }
            if (is_inverted(*shape, nodes)) // some programs write nodes in the order of VTK
                for (std::size_t k = 0; k < size; ++k) nodes[k] = cells.nodes[e * size + k] - 1;
            const std::int32_t family = cells.families[e];
            const Index region = into_.region_of(
                family == std::numeric_limits<std::int32_t>::min() ? 0 : std::abs(family));
            into_.add_element(block, tags[e], region, nodes);
            cells_of_[family].push_back(tags[e]);
            region_of_[family] = region;
        }
        return count;
    }

    [[nodiscard]] bool is_inverted(DeckShape shape, std::span<const Index> nodes) const
    {
        const auto [dimension, corners, count] = shape_info(shape);
        if (dimension < 3) return false;
        const auto at = [&](int k) -> const Vec3& { return into_.deck().points[index(nodes[index(k)])]; };
        double volume = 0; // six times the volume of the cell: sum over its faces, seen from the first corner
        for (const Quad& face : face_corners(shape)) {
            const auto add = [&](int a, int b, int c) {
                volume += (at(a) - at(0)).dot((at(b) - at(0)).cross(at(c) - at(0)));
            };
            add(face[0], face[1], face[2]);
            if (face[3] >= 0) add(face[0], face[2], face[3]);
        }
        return volume < 0;
    }

    /// Add groups as sets, and name each region after its group with the fewest cells.
    void add_sets()
    {
        std::map<std::string, std::vector<std::int32_t>> of_cells, of_nodes;
        for (const MedFamily& family : content_.families)
            for (const std::string& group : family.groups)
                (family.number < 0 ? of_cells : of_nodes)[group].push_back(family.number);
        std::map<Index, std::size_t> fewest;
        for (const auto& [name, families] : of_cells) {
            DeckSet set{.name = name};
            for (const std::int32_t family : families)
                if (const auto cells = cells_of_.find(family); cells != cells_of_.end())
                    set.members.insert(set.members.end(), cells->second.begin(), cells->second.end());
            if (set.members.empty()) continue;
            tidy(set);
            for (const std::int32_t family : families) {
                const auto region = region_of_.find(family);
                if (region == region_of_.end()) continue;
                const auto [best, fresh] = fewest.try_emplace(region->second, set.members.size());
                if (!fresh && best->second <= set.members.size()) continue;
                best->second = set.members.size();
                into_.deck().regions[index(region->second)].name = name;
            }
            into_.deck().sets.push_back(std::move(set));
        }
        for (const auto& [name, families] : of_nodes) {
            DeckSet set{.kind = DeckSet::Kind::nodes, .name = name};
            const std::set<std::int32_t> wanted(families.begin(), families.end());
            for (std::size_t p = 0; p < content_.point_families.size(); ++p)
                if (wanted.contains(content_.point_families[p]))
                    set.members.push_back(into_.deck().point_tags[p]);
            tidy(set);
            if (!set.members.empty()) into_.deck().sets.push_back(std::move(set));
        }
    }

    Cursor& cursor_;
    DeckBuilder& into_;
    MedContent content_;
    std::map<std::int32_t, std::vector<DeckTag>> cells_of_; ///< numbers of the cells of each family
    std::map<std::int32_t, Index> region_of_;
};

/// The content of a MED file. Each entity of the view becomes a family of cells. Nodes that are in the same
/// sets of nodes become a family of nodes.
MedContent content_of_view(const MeshView& view, const std::string& unit)
{
    MedContent content{.unit = unit};
    view.each_point(0, view.points, [&](std::span<const Vec3> points) {
        content.points.insert(content.points.end(), points.begin(), points.end());
    });
    std::vector<DeckTag> tags;
    view.point_tags.each(0, view.points, [&](std::size_t, DeckTag tag) { tags.push_back(tag); });
    content.point_numbers.assign(tags.begin(), tags.end());
    std::map<DeckShape, MedCells> cells;
    for (const MeshView::Block& block : view.blocks) {
        MedCells& own = cells[block.shape];
        own.type = words_of(block.shape).med;
        if (own.type == 0) refuse_element(block, "MED", "there is no such element");
        const auto places = node_places(NodeOrder::med, block.shape);
        const auto size = static_cast<std::size_t>(shape_info(block.shape).nodes);
        each_cell(block, 0, block.count, [&](std::size_t, DeckTag tag, std::span<const Index> nodes) {
            own.nodes.resize(own.nodes.size() + size);
            for (std::size_t k = 0; k < size; ++k)
                own.nodes[own.nodes.size() - size + places[k]] = nodes[k] + 1;
            if (block.tags.given() || view.is_deck) own.numbers.push_back(static_cast<std::int32_t>(tag));
        });
        mesh::each_run(block.entities, 0, block.count,
                       [&](std::size_t first, std::size_t last, Index entity) {
                           own.families.insert(own.families.end(), last - first, -entity - 1);
                       });
    }
    for (auto& [shape, own] : cells) content.cells.push_back(std::move(own));
    for (std::size_t e = 0; e < view.entities.size(); ++e)
        content.families.push_back({-static_cast<std::int32_t>(e) - 1, view.entities[e].groups});
    // A family of nodes for each list of sets to which nodes belong.
    SetLists lists;
    content.point_families.assign(view.points, 0);
    const TagPlaces places(tags);
    for (std::size_t s = 0; s < view.sets.size(); ++s)
        if (view.sets[s].kind == mesh::SetKind::nodes)
            view.sets[s].members.each(0, view.sets[s].count, [&](std::size_t, DeckTag tag) {
                if (const Index at = places.find(tag); at >= 0)
                    content.point_families[index(at)] = lists.extended(content.point_families[index(at)],
                                                                       static_cast<int>(s));
            });
    for (const std::int32_t list :
         std::set<std::int32_t>(content.point_families.begin(), content.point_families.end())) {
        if (list == 0) continue;
        MedFamily& family = content.families.emplace_back(MedFamily{.number = list});
        for (const int set : lists[list]) add_once(family.groups, view.sets[index(set)].name);
    }
    return content;
}

} // namespace

void read_med(Cursor& cursor, DeckBuilder& into)
{
    cursor.has_bytes = true;
    if (!cursor.rest().starts_with("\x89HDF")) cursor.fail("expected a MED file, which begins like HDF5");
    MedContent content = med_content(cursor.rest());
    if (!content.error.empty()) cursor.fail("{}", content.error);
    MedReader(cursor, into, std::move(content)).read();
}

DeckFile med_file(const View& view, const MeshFileOptions& options, const mesh::ViewParts* /*parts*/)
{
    check_numbers(*view, std::numeric_limits<std::int32_t>::max(), "a MED file",
                  "give first_node and first_cell");
    MedContent content = content_of_view(*view, options.unit);
    DeckFile file;
    file.add(med_bytes(content));
    file.notes = std::move(content.notes);
    return file;
}

} // namespace lacuna::io
