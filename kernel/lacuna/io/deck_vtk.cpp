// SPDX-License-Identifier: MIT
//
// A deck as VTK has it: cells in the deck's order, with arrays of their entities, regions and numbers.
#include <lacuna/io/detail/deck_entities.h>
#include <lacuna/io/detail/deck_writer.h>
#include <lacuna/io/detail/vtk_cells.h>
#include <lacuna/io/detail/vtk_file.h>

#include <cstring>
#include <memory>

namespace lacuna::io {
namespace {

/// The cells, block after block; what the sections of the file refer to.
struct Cells {
    const Deck& deck;
    BulkReader bulk;
    DeckEntities entities;
    std::vector<std::size_t> blocks;     ///< those that are written
    std::size_t count = 0, lists = 0;    ///< of cells, and of their nodes
    std::vector<std::size_t> first_node; ///< of each block that is written, in the list of nodes
    std::shared_ptr<const Deck> own;     ///< of a piece, the deck
};

/// @param own  the deck where it is to live as long as its cells; null: it does so by itself.
std::shared_ptr<const Cells> cells_of(const Deck& deck, const BulkReader& bulk, DeckEntities entities,
                                      std::shared_ptr<const Deck> own = nullptr)
{
    auto cells = std::make_shared<Cells>(
        Cells{deck, bulk, std::move(entities), {}, 0, 0, {}, std::move(own)});
    for (std::size_t b = 0; b < deck.blocks.size(); ++b) {
        const DeckBlock& block = deck.blocks[b];
        if (std::ranges::find(block.nodes, -1) != block.nodes.end())
            refuse_element(block, "VTK", "some have not all their middle nodes");
        if (vtk_type_of(block.shape) == 0) refuse_element(block, "VTK", "there is no such cell");
        cells->blocks.push_back(b);
        cells->first_node.push_back(cells->lists);
        cells->count += bulk.count(block);
        cells->lists += bulk.count(block) * static_cast<std::size_t>(shape_info(block.shape).nodes);
    }
    return cells;
}

/// Names with the entities that are in them; sets of nodes with the places of these, from 0.
VtkTable table_of(const Deck& deck, const DeckEntities& entities, DeckFile& file)
{
    VtkTable table = entities.groups;
    std::size_t surfaces = 0;
    std::unique_ptr<TagPlaces> places;
    for (const DeckSet& set : deck.sets) {
        if (set.kind == DeckSet::Kind::sides) ++surfaces;
        if (set.kind != DeckSet::Kind::nodes) continue;
        if (!places) places = std::make_unique<TagPlaces>(deck.point_tags, [](Index, Index) {});
        std::vector<int> points;
        for (const DeckTag tag : set.members)
            if (const Index point = places->find(tag); point >= 0) points.push_back(point);
        table.push_back({"nodes:" + set.name, std::move(points)});
    }
    std::erase_if(table, [](const auto& of) { return of.second.empty(); });
    if (surfaces > 0)
        file.notes.push_back(std::to_string(surfaces) + " sets of sides are not written: VTK has none");
    return table;
}

/// A section of each block, with a record an element by `put_one(block, element, out)`.
template <class PutOne>
std::vector<Section> by_blocks(const std::shared_ptr<const Cells>& cells,
                               const std::function<std::size_t(const DeckBlock&)>& bytes,
                               const PutOne& put_one)
{
    std::vector<Section> sections;
    for (std::size_t at = 0; at < cells->blocks.size(); ++at) {
        const DeckBlock& block = cells->deck.blocks[cells->blocks[at]];
        sections.push_back(
            {{}, cells->bulk.count(block), bytes(block), each([cells, at, put_one](std::size_t e, char* out) {
                 return put_one(*cells, at, e, out);
             })});
    }
    if (sections.empty()) sections.emplace_back();
    return sections;
}

const DeckBlock& block_at(const Cells& cells, std::size_t at) { return cells.deck.blocks[cells.blocks[at]]; }

/// The place in an element of node `k` in VTK's order, where a wedge's triangle 0-1-2 looks away from 3-4-5.
std::size_t place_of_node(DeckShape shape, std::size_t k)
{
    constexpr std::array<std::size_t, 6> kWedge{0, 2, 1, 3, 5, 4};
    return shape == DeckShape::wedge6 ? kWedge[k] : k;
}

std::int32_t entity_at(const Cells& cells, std::size_t at, std::size_t e)
{
    return cells.entities.at(cells.blocks[at], e) + 1;
}

std::int32_t region_at(const Cells& cells, std::size_t at, std::size_t e)
{
    const Index region = cells.bulk.region(block_at(cells, at), e);
    return region < 0 ? 0 : cells.deck.regions[index(region)].tag;
}

std::int32_t type_at(const Cells& cells, std::size_t at) { return vtk_type_of(block_at(cells, at).shape); }

} // namespace

namespace {

std::vector<VtuArray> vtu_arrays(const std::shared_ptr<const Cells>& cells)
{
    const std::size_t points = cells->bulk.points();
    const auto fixed = [](std::size_t bytes) { return [bytes](const DeckBlock&) { return bytes; }; };
    using Place = VtuArray::Place;
    std::vector<VtuArray> arrays;
    arrays.push_back({Place::points,
                      "type=\"Float64\" NumberOfComponents=\"3\"",
                      points * sizeof(Vec3),
                      {{{}, points, sizeof(Vec3), [cells](std::size_t begin, std::size_t end, char* out) {
                            cells->bulk.each_point(begin, end, [&](std::size_t, DeckTag, const Vec3& point) {
                                std::memcpy(out, point.data(), sizeof(Vec3));
                                out += sizeof(Vec3);
                            });
                            return out;
                        }}}});
    arrays.push_back({Place::point_data,
                      "type=\"Int64\" Name=\"node_number\"",
                      points * 8,
                      {{{}, points, 8, each([cells](std::size_t i, char* out) {
                            return put(
                                out, static_cast<std::int64_t>(cells->bulk.point_tag(static_cast<Index>(i))));
                        })}}});
    const auto add = [&](Place place, const char* attributes, std::size_t bytes, auto put_one) {
        arrays.push_back({place, attributes, cells->count * bytes, by_blocks(cells, fixed(bytes), put_one)});
    };
    arrays.push_back(
        {Place::cells, "type=\"Int32\" Name=\"connectivity\"", cells->lists * 4,
         by_blocks(
             cells,
             [](const DeckBlock& block) {
                 return static_cast<std::size_t>(shape_info(block.shape).nodes) * 4;
             },
             [](const Cells& of, std::size_t at, std::size_t e, char* out) {
                 const DeckBlock& block = block_at(of, at);
                 of.bulk.element(block, e, [&](DeckTag, Index, std::span<const Index> nodes) {
                     for (std::size_t k = 0; k < nodes.size(); ++k)
                         out = put(out, static_cast<std::int32_t>(nodes[place_of_node(block.shape, k)]));
                 });
                 return out;
             })});
    add(Place::cells, "type=\"Int64\" Name=\"offsets\"", 8,
        [](const Cells& of, std::size_t at, std::size_t e, char* out) {
            const auto nodes = static_cast<std::size_t>(shape_info(block_at(of, at).shape).nodes);
            return put(out, static_cast<std::int64_t>(of.first_node[at] + nodes * (e + 1)));
        });
    add(Place::cells, "type=\"UInt8\" Name=\"types\"", 1,
        [](const Cells& of, std::size_t at, std::size_t, char* out) {
            return put(out, static_cast<std::uint8_t>(type_at(of, at)));
        });
    add(Place::cell_data, "type=\"Int32\" Name=\"entity\"", 4,
        [](const Cells& of, std::size_t at, std::size_t e, char* out) {
            return put(out, entity_at(of, at, e));
        });
    add(Place::cell_data, "type=\"Int32\" Name=\"region\"", 4,
        [](const Cells& of, std::size_t at, std::size_t e, char* out) {
            return put(out, region_at(of, at, e));
        });
    add(Place::cell_data, "type=\"Int64\" Name=\"cell_number\"", 8,
        [](const Cells& of, std::size_t at, std::size_t e, char* out) {
            return put(out, static_cast<std::int64_t>(of.bulk.tag(block_at(of, at), e)));
        });
    return arrays;
}

/// A part of a deck as a deck, with its ghosts behind what is its own in each block.
struct Piece {
    std::shared_ptr<Deck> deck = std::make_shared<Deck>();
    std::shared_ptr<const Cells> cells;
    std::vector<std::vector<char>> ghost; ///< of each element of each block
    std::vector<char> ghost_point;
};

/// @param lowest  of each point the lowest part that has it
Piece piece_of(const Deck& deck, const DeckEntities& entities, const DeckPartition& partition,
               const std::vector<Index>& lowest, Index part)
{
    Piece piece;
    Deck& own = *piece.deck;
    own.regions = deck.regions;
    DeckEntities own_entities;
    own_entities.all = entities.all;
    own_entities.made.resize(deck.blocks.size());
    std::vector<Index> point(deck.points.size(), -1);
    std::vector<char> used(deck.points.size(), 0);
    const auto of_piece = [&](std::size_t b, std::size_t e) {
        return partition.part[b][e] == part ||
               std::ranges::binary_search(partition.lists[index(partition.ghost_of[b][e])], part);
    };
    for (std::size_t b = 0; b < deck.blocks.size(); ++b) {
        const DeckBlock& block = deck.blocks[b];
        DeckBlock& mine = own.blocks.emplace_back();
        mine.shape = block.shape;
        mine.type = block.type;
        std::vector<Index>& entity = own_entities.of.emplace_back();
        std::vector<char>& ghost = piece.ghost.emplace_back();
        for (std::size_t e = 0; e < block.count(); ++e) {
            if (!of_piece(b, e)) continue;
            mine.nodes.insert(mine.nodes.end(), block.element(e).begin(), block.element(e).end());
            mine.tags.push_back(block.tags[e]);
            mine.regions.push_back(block.regions[e]);
            entity.push_back(entities.of[b][e]);
            ghost.push_back(partition.part[b][e] == part ? 0 : 1);
            for (const Index node : block.element(e))
                if (node >= 0) used[index(node)] = 1;
        }
    }
    for (std::size_t p = 0; p < used.size(); ++p) {
        if (used[p] == 0) continue;
        point[p] = static_cast<Index>(own.points.size());
        own.points.push_back(deck.points[p]);
        own.point_tags.push_back(deck.point_tags[p]);
        piece.ghost_point.push_back(lowest[p] == part ? 0 : 1);
    }
    for (DeckBlock& block : own.blocks)
        for (Index& node : block.nodes)
            if (node >= 0) node = point[index(node)];
    piece.cells = cells_of(own, {own, nullptr}, std::move(own_entities), piece.deck);
    return piece;
}

std::vector<VtuArray> piece_arrays(const std::shared_ptr<const Piece>& piece, bool ghosts)
{
    std::vector<VtuArray> arrays = vtu_arrays(piece->cells);
    if (!ghosts) return arrays;
    const std::string attributes = "type=\"UInt8\" Name=\"vtkGhostType\"";
    const std::size_t points = piece->ghost_point.size();
    arrays.push_back({VtuArray::Place::point_data,
                      attributes,
                      points,
                      {{{}, points, 1, each([piece](std::size_t i, char* out) {
                            return put(out, static_cast<std::uint8_t>(piece->ghost_point[i]));
                        })}}});
    arrays.push_back({VtuArray::Place::cell_data, attributes, piece->cells->count,
                      by_blocks(
                          piece->cells, [](const DeckBlock&) { return std::size_t(1); },
                          [piece](const Cells& of, std::size_t at, std::size_t e, char* out) {
                              return put(out, static_cast<std::uint8_t>(piece->ghost[of.blocks[at]][e]));
                          })});
    return arrays;
}

} // namespace

DeckFile vtu_of_deck(const Deck& deck, const LayeredBulk* layered)
{
    const BulkReader bulk(deck, layered);
    DeckFile file;
    file.sizes = Sizes::exact;
    const auto cells = cells_of(deck, bulk, entities_of(deck, bulk));
    const VtkTable table = table_of(deck, cells->entities, file);
    file.sections = vtu_file(bulk.points(), cells->count, vtu_arrays(cells), table);
    return file;
}

void write_pvtu(const Deck& deck, const DeckPartition& partition, int ghosts, const OutputPath& path,
                const RunContext& context)
{
    const DeckEntities entities = entities_of(deck, {deck, nullptr});
    DeckFile file;
    const VtkTable table = table_of(deck, entities, file);
    std::vector<Index> lowest(deck.points.size(), partition.parts);
    for (std::size_t b = 0; b < deck.blocks.size(); ++b)
        for (std::size_t e = 0; e < deck.blocks[b].count(); ++e)
            for (const Index node : deck.blocks[b].element(e))
                if (node >= 0) lowest[index(node)] = std::min(lowest[index(node)], partition.part[b][e]);
    const auto piece = [&](Index part) {
        return std::make_shared<const Piece>(piece_of(deck, entities, partition, lowest, part));
    };
    std::vector<FileOfSet> files;
    std::vector<std::string> names;
    for (Index part = 0; part < partition.parts; ++part) {
        names.push_back(piece_name(path.text(), index(part)));
        files.push_back({path.beside(names.back()), [&, part] {
                             const auto own = piece(part);
                             return vtu_file(own->deck->points.size(), own->cells->count,
                                             piece_arrays(own, ghosts > 0), table);
                         }});
    }
    write_files(files, path, pvtu_head(piece_arrays(piece(0), ghosts > 0), ghosts) + pvtu_end(names),
                context);
}

DeckFile vtk_of_deck(const Deck& deck, bool binary, const LayeredBulk* layered)
{
    const BulkReader bulk(deck, layered);
    DeckFile file;
    file.sizes = binary ? Sizes::exact : Sizes::varying;
    const auto cells = cells_of(deck, bulk, entities_of(deck, bulk));
    const auto room = [binary](std::size_t numbers, std::size_t bytes) {
        return binary ? numbers * bytes : numbers * kNumberBytes + 1;
    };
    const std::string count = std::to_string(cells->count);
    const VtkTable table = table_of(deck, cells->entities, file);
    std::string head = vtk_head(table, binary);
    head.append("POINTS ").append(std::to_string(bulk.points())).append(" double\n");
    file.sections.push_back(
        {head, bulk.points(), room(3, 8), [bulk, binary](std::size_t begin, std::size_t end, char* out) {
             bulk.each_point(begin, end, [&](std::size_t, DeckTag, const Vec3& point) {
                 for (const double x : point) out = put_number(out, x, binary);
                 out = end_line(out, binary);
             });
             return out;
         }});
    const auto add = [&](const std::string& before, std::vector<Section> sections) {
        sections.front().text = before;
        for (Section& section : sections) file.sections.push_back(std::move(section));
    };
    const auto one = [&](const std::string& before, std::size_t bytes, auto value) {
        add(before, by_blocks(
                        cells, [bytes, room](const DeckBlock&) { return room(1, bytes); },
                        [value, binary](const Cells& of, std::size_t at, std::size_t e, char* out) {
                            return end_line(put_number(out, value(of, at, e), binary), binary);
                        }));
    };
    add("\nCELLS " + count + " " + std::to_string(cells->count + cells->lists) + "\n",
        by_blocks(
            cells,
            [room](const DeckBlock& block) {
                return room(static_cast<std::size_t>(shape_info(block.shape).nodes) + 1, 4);
            },
            [binary](const Cells& of, std::size_t at, std::size_t e, char* out) {
                const DeckBlock& block = block_at(of, at);
                of.bulk.element(block, e, [&](DeckTag, Index, std::span<const Index> nodes) {
                    out = put_number(out, static_cast<std::int32_t>(nodes.size()), binary);
                    for (std::size_t k = 0; k < nodes.size(); ++k)
                        out = put_number(out, static_cast<std::int32_t>(nodes[place_of_node(block.shape, k)]),
                                         binary);
                });
                return end_line(out, binary);
            }));
    one("\nCELL_TYPES " + count + "\n", 4,
        [](const Cells& of, std::size_t at, std::size_t) { return type_at(of, at); });
    one("\nCELL_DATA " + count + "\nSCALARS entity int 1\nLOOKUP_TABLE default\n", 4, entity_at);
    one("\nSCALARS region int 1\nLOOKUP_TABLE default\n", 4, region_at);
    one("\nSCALARS cell_number long 1\nLOOKUP_TABLE default\n", 8,
        [](const Cells& of, std::size_t at, std::size_t e) {
            return static_cast<std::int64_t>(of.bulk.tag(block_at(of, at), e));
        });
    file.sections.push_back({"\nPOINT_DATA " + std::to_string(bulk.points()) +
                                 "\nSCALARS node_number long 1\nLOOKUP_TABLE default\n",
                             bulk.points(), room(1, 8), each([bulk, binary](std::size_t i, char* out) {
                                 const auto tag = static_cast<std::int64_t>(
                                     bulk.point_tag(static_cast<Index>(i)));
                                 return end_line(put_number(out, tag, binary), binary);
                             })});
    file.sections.push_back({"\n", 0, 0, {}});
    return file;
}

} // namespace lacuna::io
