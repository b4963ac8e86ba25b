// SPDX-License-Identifier: MIT
//
// The format: https://gmsh.info/doc/texinfo/gmsh.html#MSH-file-format. All nodes form one block of one
// entity. Elements are written entity by entity. In partitioned files, $Entities lists the entities of the
// whole mesh. $PartitionedEntities lists, for each of these and each part, the entity's share in the part;
// nodes and elements refer to these shares.
#include <lacuna/io/detail/format_table.h>

#include <lacuna/core/error.h>
#include <lacuna/io/detail/cell_shapes.h>
#include <lacuna/io/detail/msh.h>

#include <algorithm>
#include <array>
#include <map>

namespace lacuna::io {

namespace {

using mesh::MeshView;
using mesh::Numbers;
using mesh::Ranges;
using mesh::ViewParts;

/// Elements of one entity, part and block.
struct Row {
    std::size_t entity;
    Index part;
    std::size_t block;
    Ranges cells;
    int tag = 0; ///< tag of the entity to which the elements are written
};

/// The share that one part has of an entity. It has the groups of that entity.
struct PartEntity {
    int dimension, tag;
    int parent; ///< tag of the whole entity, of the same dimension
    Index part;
};

/// The link between two surfaces. In version 2.2 it is text in binary files too.
std::string periodic_link(const MeshView& view, const MshNumbers& numbers, bool old,
                          const Eigen::Isometry3d& onto, std::size_t entity, std::size_t master,
                          const std::map<Index, Index>& nodes)
{
    const MshNumbers to{numbers.binary && !old};
    std::string text = to.line(2, view.entities[entity].tag, view.entities[master].tag) +
                       (old ? "Affine" : to.line(MshNumbers::size_of(16)));
    if (!to.binary && !old) text.back() = ' ';
    for (Eigen::Index i = 0; i < 4; ++i)
        for (Eigen::Index j = 0; j < 4; ++j) {
            if (!to.binary) text += ' ';
            text += to.line(onto.matrix()(i, j));
            if (!to.binary) text.pop_back();
        }
    if (!to.binary) text += '\n';
    text += to.line(MshNumbers::size_of(nodes.size()));
    for (const auto& [slave, node] : nodes)
        text += to.line(static_cast<std::uint64_t>(view.point_tags[index(slave)]),
                        static_cast<std::uint64_t>(view.point_tags[index(node)]));
    return text;
}

/// $Periodic of each pair of surfaces: nodes of the second one and their images on the first. Empty: there
/// are none. @param old  the version is 2.2
std::string msh_periodic(const MeshView& view, const MshNumbers& numbers, bool old)
{
    std::string all;
    std::size_t links = 0;
    for (const MeshView::Periodic& own : view.periodic) {
        std::map<Index, Index> from; // for each node of the second side, its partner on the first
        for (const auto& [a, b] : own.nodes.pairs) from.emplace(b, a);
        // The surface of each quad, by the quad's sorted nodes; and for each quad on the second side its
        // surface and nodes.
        std::map<std::vector<Index>, std::size_t> entity_of;
        std::vector<std::pair<std::size_t, std::vector<Index>>> sides;
        for (const MeshView::Block& block : view.blocks) {
            if (shape_info(block.shape).dimension != 2) continue;
            mesh::each_run(block.entities, 0, block.count, [&](std::size_t first, std::size_t last, Index e) {
                block.each_cell(first, last, [&](std::size_t, std::span<const Index> nodes) {
                    std::vector<Index> key(nodes.begin(), nodes.end());
                    if (std::ranges::all_of(key, [&](Index n) { return from.contains(n); }))
                        sides.emplace_back(index(e), key);
                    std::ranges::sort(key);
                    entity_of.emplace(std::move(key), index(e));
                });
            });
        }
        std::map<std::pair<std::size_t, std::size_t>, std::map<Index, Index>> pairs; // pairs of nodes, by
                                                                                     // both surfaces
        for (const auto& [entity, nodes] : sides) {
            std::vector<Index> key;
            for (const Index n : nodes) key.push_back(from.at(n));
            std::ranges::sort(key);
            const auto master = entity_of.find(key);
            if (master == entity_of.end()) continue;
            for (const Index n : nodes) pairs[{entity, master->second}][n] = from.at(n);
        }
        for (const auto& [entities, nodes] : pairs) {
            all += periodic_link(view, numbers, old, own.nodes.onto, entities.first, entities.second, nodes);
            ++links;
        }
    }
    if (links == 0) return {};
    return "$Periodic\n" + (old ? std::to_string(links) + "\n" : numbers.line(MshNumbers::size_of(links))) +
           all + (old ? "" : numbers.gap()) + "$EndPeriodic\n";
}

class MshFile {
public:
    MshFile(const View& view, const MeshFileOptions& options, const ViewParts* parts)
        : view_(view),
          numbers_{options.binary},
          old_(options.version == 2.2),
          parts_(parts),
          unit_(options.unit)
    {
        rows_ = rows_of(nullptr);
        if (parts != nullptr) part_rows_ = rows_of(parts);
        used_.assign(view->entities.size(), 0);
        for (const Row& row : rows_) used_[row.entity] = 1;
        number_cells();
        const bool can_overlap = options.version != 2.2;
        if (options.all_groups && !can_overlap)
            file_.notes.emplace_back("MSH 2.2 holds one group per element, so groups = \"all\" is ignored; "
                                     "version = 4.1 holds all");
        groups_ = msh_groups(*view, used_, options.all_groups && can_overlap);
        file_.changed = groups_.changed;
        if (view->point_tags.given() && view->points > 0)
            nodes_ = view->point_tags.bounds(view->points);
        else if (view->points > 0)
            nodes_ = {1, static_cast<std::int64_t>(view->points)};
        if (view->is_deck && std::min(nodes_.first, elements_.first) < 1)
            throw InvalidInput(
                Message("io.number_taken",
                        "{} has a node or an element of number 0, which an MSH file cannot hold",
                        view->source)
                    .remedy("write another format"));
    }

    DeckFile write_41()
    {
        boxes_ = view_->boxes();
        open("4.1");
        add_entities();
        if (parts_ != nullptr) add_part_entities();
        add_nodes();
        text_ = numbers_.gap() + "$EndNodes\n$Elements\n";
        const std::vector<Row>& rows = parts_ != nullptr ? part_rows_ : rows_;
        text_ += numbers_.line(size_of(rows.size()), size_of(view_->cells()), size_of(elements_.first),
                               size_of(elements_.second));
        for (const Row& row : rows) {
            const DeckShape shape = view_->blocks[row.block].shape;
            text_ += numbers_.line(shape_info(shape).dimension, row.tag, words_of(shape).gmsh,
                                   size_of(row.cells.count()));
            add_elements<std::uint64_t>(row, {});
        }
        text_ += numbers_.gap() + "$EndElements\n";
        add_ghosts();
        return take();
    }

    /// Write version 2.2, in which an element has one physical group and its entity.
    DeckFile write_22()
    {
        open("2.2");
        text_ += "$Nodes\n" + std::to_string(view_->points) + "\n";
        add(view_->points, numbers_.room(4, 4 + sizeof(Vec3)),
            [view = view_, to = numbers_](std::size_t begin, std::size_t end, char* out) {
                view->each_point(begin, end, [&](std::span<const Vec3> points) {
                    for (const Vec3& point : points) {
                        out = to.add(out, static_cast<int>(view->point_tags[begin++]));
                        out = put_point(to, point, out);
                    }
                });
                return out;
            });
        text_ = numbers_.gap() + "$EndNodes\n$Elements\n" + std::to_string(view_->cells()) + "\n";
        for (const Row& row : rows_) {
            const int type = words_of(view_->blocks[row.block].shape).gmsh;
            const std::vector<int>& physical = groups_.tags[row.entity];
            const int group = physical.empty() ? 0 : physical.front();
            const int entity = view_->entities[row.entity].tag;
            if (numbers_.binary) text_ += numbers_.line(type, static_cast<int>(row.cells.count()), 2);
            add_elements<int>(row, numbers_.binary ? std::vector<int>{group, entity}
                                                   : std::vector<int>{type, 2, group, entity});
        }
        text_ += numbers_.gap() + "$EndElements\n";
        return take();
    }

private:
    static std::uint64_t size_of(std::size_t count) { return count; }
    static std::uint64_t size_of(std::int64_t number) { return static_cast<std::uint64_t>(number); }

    /// Rows sorted by entity, then by part; blocks keep their order.
    [[nodiscard]] std::vector<Row> rows_of(const ViewParts* parts) const
    {
        std::vector<Row> rows;
        for (std::size_t b = 0; b < view_->blocks.size(); ++b) {
            std::map<std::pair<Index, Index>, std::size_t> known;
            const auto add_run = [&](std::size_t first, std::size_t last, Index entity, Index part) {
                const auto [at, fresh] = known.try_emplace({entity, part}, rows.size());
                if (fresh) rows.push_back({index(entity), part, b, {}, view_->entities[index(entity)].tag});
                rows[at->second].cells.add(first, last);
            };
            const MeshView::Block& block = view_->blocks[b];
            mesh::each_run(block.entities, 0, block.count,
                           [&](std::size_t first, std::size_t last, Index entity) {
                               if (parts == nullptr) return add_run(first, last, entity, 0);
                               mesh::each_run(parts->of[b], first, last,
                                              [&](std::size_t from, std::size_t to, Index part) {
                                                  add_run(from, to, entity, part);
                                              });
                           });
        }
        std::ranges::stable_sort(rows, {}, [](const Row& row) { return std::pair(row.entity, row.part); });
        return rows;
    }

    /// Number the elements: as in the view or, in an unpartitioned file, in file order.
    void number_cells()
    {
        std::vector<std::map<std::size_t, std::size_t>> number(view_->blocks.size()); // next number, by
                                                                                      // entity
        std::size_t next = 1;
        for (const Row& row : rows_) {
            number[row.block][row.entity] = next;
            next += row.cells.count();
        }
        elements_ = {next > 1 ? 1 : 0, static_cast<std::int64_t>(next) - 1};
        bool any = false;
        for (std::size_t b = 0; b < number.size(); ++b) {
            const MeshView::Block& block = view_->blocks[b];
            if (!block.tags.given()) {
                Ranges numbers;
                mesh::each_run(block.entities, 0, block.count,
                               [&](std::size_t first, std::size_t last, Index entity) {
                                   std::size_t& own = number[b][index(entity)];
                                   numbers.add(own, own + (last - first));
                                   own += last - first;
                               });
                tags_.emplace_back(std::move(numbers));
                continue;
            }
            tags_.push_back(block.tags);
            if (block.count == 0) continue;
            const auto [low, high] = block.tags.bounds(block.count);
            elements_ = any ? std::pair(std::min(elements_.first, low), std::max(elements_.second, high))
                            : std::pair(low, high);
            any = true;
        }
    }

    void open(const char* version)
    {
        text_ = std::string("$MeshFormat\n") + version + (numbers_.binary ? " 1 8\n" : " 0 8\n");
        if (numbers_.binary) text_ += numbers_.line(int{1}) + "\n"; // shows readers the byte order
        text_ += "$EndMeshFormat\n";
        if (!unit_.empty()) text_ += "$Comments\nlengths are in " + unit_ + "\n$EndComments\n";
        text_ += "$PhysicalNames\n" + std::to_string(groups_.names.size()) + "\n";
        for (const PhysicalName& name : groups_.names)
            text_ += formatted("{} {} \"{}\"\n", name.dimension, name.tag, name.name);
        text_ += "$EndPhysicalNames\n";
    }

    template <class Visit>
    void each_entity(int dimension, const Visit& visit) const
    {
        for (std::size_t e = 0; e < used_.size(); ++e)
            if (used_[e] != 0 && view_->entities[e].dimension == dimension) visit(e, view_->entities[e]);
    }

    void add_entities()
    {
        std::array<std::size_t, 4> count{};
        std::string all;
        for (const int dimension : {0, 1, 2, 3})
            each_entity(dimension, [&](std::size_t e, const MeshView::Entity& entity) {
                ++count[index(dimension)];
                all += numbers_.line(entity.tag);
                numbers_.add_lists(all, boxes_[e], {groups_.tags[e], entity.bounds});
            });
        text_ += "$Entities\n" +
                 numbers_.line(size_of(count[0]), size_of(count[1]), size_of(count[2]), size_of(count[3])) +
                 all + numbers_.gap() + "$EndEntities\n";
    }

    /// For each entity and each part that shares it, add an entity for that share.
    void add_part_entities()
    {
        // If entities are numbered over all dimensions together, so are the entities of parts.
        std::array<int, 4> next{};
        for (const MeshView::Entity& entity : view_->entities)
            for (const int dimension : {0, 1, 2, 3})
                if (view_->is_deck || entity.dimension == dimension)
                    next[index(dimension)] = std::max(next[index(dimension)], entity.tag);
        int& first = next.front();
        const auto next_tag = [&](int dimension) {
            return ++(view_->is_deck ? first : next[index(dimension)]);
        };
        std::map<std::pair<std::size_t, Index>, int> tags;
        std::array<std::size_t, 4> count{};
        std::array<std::string, 4> all;
        for (Row& row : part_rows_) {
            const MeshView::Entity& of = view_->entities[row.entity];
            int& tag = tags[{row.entity, row.part}];
            if (tag == 0) {
                tag = next_tag(of.dimension);
                entities_.push_back({of.dimension, tag, of.tag, row.part});
                std::string& text = all[index(of.dimension)];
                ++count[index(of.dimension)];
                text += numbers_.line(tag, of.dimension, of.tag, size_of(std::size_t(1)), row.part + 1);
                numbers_.add_lists(text, boxes_[row.entity], {groups_.tags[row.entity], {}});
            }
            row.tag = tag;
        }
        text_ += "$PartitionedEntities\n" + numbers_.line(size_of(std::size_t(parts_->parts))) +
                 numbers_.line(size_of(std::size_t(parts_->has_ghosts ? parts_->parts : 0)));
        for (int p = 0; parts_->has_ghosts && p < parts_->parts; ++p)
            text_ += numbers_.line(next_tag(3), p + 1);
        text_ += numbers_.line(size_of(count[0]), size_of(count[1]), size_of(count[2]), size_of(count[3])) +
                 all[0] + all[1] + all[2] + all[3] + numbers_.gap() + "$EndPartitionedEntities\n";
    }

    /// Write all nodes as one block. In partitioned files, write one block for each part that has nodes,
    /// under the first volume of the part.
    void add_nodes()
    {
        struct Block {
            int dimension, tag;
            Ranges points;
        };
        std::vector<Block> blocks;
        if (parts_ == nullptr) {
            const bool none = view_->entities.empty();
            const MeshView::Entity of = none ? MeshView::Entity{.tag = 1}
                                             : view_->entities[view_->node_entity];
            blocks.push_back({of.dimension, of.tag, {0, view_->points}});
        }
        for (std::size_t p = 0; parts_ != nullptr && p < parts_->points.size(); ++p) {
            const auto& [part, points] = parts_->points[p];
            const auto volume = std::ranges::find_if(entities_, [part = part](const PartEntity& entity) {
                return entity.dimension == 3 && entity.part == part;
            });
            blocks.push_back({3, volume == entities_.end() ? 1 : volume->tag, points});
        }
        text_ += "$Nodes\n" + numbers_.line(size_of(blocks.size()), size_of(view_->points),
                                            size_of(nodes_.first), size_of(nodes_.second));
        for (const Block& block : blocks) {
            const std::size_t count = block.points.count();
            text_ += numbers_.line(block.dimension, block.tag, 0, size_of(count));
            add(count, numbers_.room(1, 8),
                [view = view_, to = numbers_, points = block.points](std::size_t begin, std::size_t end,
                                                                     char* out) {
                    const auto put = [&](std::size_t, std::int64_t tag) {
                        out = to.end(to.add(out, size_of(tag)));
                    };
                    points.each(begin, end, [&](std::size_t first, std::size_t last) {
                        view->point_tags.each(first, last, put);
                    });
                    return out;
                });
            add(count, numbers_.room(3, sizeof(Vec3)),
                [view = view_, to = numbers_, points = block.points](std::size_t begin, std::size_t end,
                                                                     char* out) {
                    const auto take = [&](std::span<const Vec3> own) { out = put_points(to, own, out); };
                    points.each(begin, end, [&](std::size_t first, std::size_t last) {
                        view->each_point(first, last, take);
                    });
                    return out;
                });
        }
    }

    static char* put_point(const MshNumbers& to, const Vec3& point, char* out)
    {
        for (const double x : point) out = to.add(out, x);
        return to.end(out);
    }
    static char* put_points(const MshNumbers& to, std::span<const Vec3> points, char* out)
    {
        static_assert(sizeof(Vec3) == 3 * sizeof(double));
        if (to.binary) {
            std::memcpy(out, points.data(), points.size_bytes());
            return out + points.size_bytes();
        }
        for (const Vec3& point : points) out = put_point(to, point, out);
        return out;
    }

    /// Write the elements of a row. The record of an element consists of its number, the numbers in `middle`,
    /// and its nodes. Element and node numbers have the type `Tag`.
    template <class Tag>
    void add_elements(const Row& row, const std::vector<int>& middle)
    {
        const MeshView::Block& block = view_->blocks[row.block];
        const auto size = static_cast<std::size_t>(shape_info(block.shape).nodes);
        add(row.cells.count(),
            numbers_.room(1 + middle.size() + size, sizeof(Tag) * (1 + size) + sizeof(int) * middle.size()),
            [view = view_, &block, tags = tags_[row.block], cells = row.cells, middle,
             to = numbers_](std::size_t begin, std::size_t end, char* out) {
                each_chunk<Tag>(cells, begin, end, tags,
                                [&](std::size_t first, std::size_t last, const Tag* own) {
                                    out = put_elements(*view, block, own, first, last, middle, to, out);
                                });
                return out;
            });
    }

    /// Call `visit(first, last, tags)` for chunks of the cells at the list positions [begin, end), with the
    /// numbers of the cells in the chunk. A chunk has at most `kAtOnce` cells.
    template <class Tag, class Visit>
    static void each_chunk(const Ranges& cells, std::size_t begin, std::size_t end, const Numbers& tags,
                           const Visit& visit)
    {
        std::array<Tag, MeshView::Block::kAtOnce> own;
        cells.each(begin, end, [&](std::size_t first, std::size_t last) {
            while (first < last) {
                const std::size_t stop = std::min(first + own.size(), last);
                tags.each(first, stop, [&](std::size_t i, std::int64_t number) {
                    own[i - first] = static_cast<Tag>(number);
                });
                visit(first, stop, own.data());
                first = stop;
            }
        });
    }

    /// Write the most frequent records faster: a number and eight nodes that are numbered from 1.
    template <class Tag>
    static char* put_hexes(const MeshView::Block& block, const Tag* tags, std::size_t begin, std::size_t end,
                           char* out)
    {
        block.each_cell(begin, end, [&](std::size_t i, std::span<const Index> nodes) {
            std::array<Tag, 9> record{tags[i - begin]};
            for (std::size_t k = 0; k < 8; ++k) record[k + 1] = static_cast<Tag>(nodes[k]) + 1;
            out = put(out, record);
        });
        return out;
    }

    /// @param tags  numbers of the cells [begin, end)
    template <class Tag>
    static char* put_elements(const MeshView& view, const MeshView::Block& block, const Tag* tags,
                              std::size_t begin, std::size_t end, const std::vector<int>& middle,
                              const MshNumbers& to, char* out)
    {
        const bool counted = !view.point_tags.given();
        if (to.binary && counted && middle.empty() && block.shape == DeckShape::hex8)
            return put_hexes(block, tags, begin, end, out);
        const std::span<const std::uint8_t> places = node_places(NodeOrder::gmsh, block.shape);
        block.each_cell(begin, end, [&](std::size_t i, std::span<const Index> nodes) {
            std::array<Tag, 27> own;
            for (std::size_t k = 0; k < nodes.size(); ++k)
                own[places[k]] = static_cast<Tag>(counted ? nodes[k] + 1 : view.point_tags[index(nodes[k])]);
            out = to.add(out, tags[i - begin]);
            for (const int number : middle) out = to.add(out, number);
            for (std::size_t k = 0; k < nodes.size(); ++k) out = to.add(out, own[k]);
            out = to.end(out);
        });
        return out;
    }

    void add_ghosts()
    {
        if (parts_ == nullptr) return;
        std::size_t all = 0;
        for (const ViewParts::Ghosts& own : parts_->ghosts) all += own.cells.count();
        if (all == 0) return;
        text_ += "$GhostElements\n" + numbers_.line(size_of(all));
        for (const ViewParts::Ghosts& own : parts_->ghosts) {
            const std::size_t of = own.of.size();
            add(own.cells.count(), numbers_.room(3 + of, 20 + 4 * of),
                [own, tags = tags_[own.block], to = numbers_](std::size_t begin, std::size_t end, char* out) {
                    const auto put = [&](std::size_t, std::int64_t number) {
                        out = to.add(to.add(out, size_of(number)), own.part + 1);
                        out = to.add(out, size_of(own.of.size()));
                        for (const int part : own.of) out = to.add(out, part + 1);
                        out = to.end(out);
                    };
                    own.cells.each(begin, end,
                                   [&](std::size_t first, std::size_t last) { tags.each(first, last, put); });
                    return out;
                });
        }
        text_ += numbers_.gap() + "$EndGhostElements\n";
    }

    /// $ElementData of each field. Values cover all elements, since meshio rejects a field that lacks some.
    void add_fields()
    {
        for (std::size_t f = 0; f < view_->fields.size(); ++f) {
            text_ += "$ElementData\n1\n\"" + view_->fields[f].name + "\"\n1\n0\n3\n0\n1\n" +
                     std::to_string(view_->cells()) + "\n";
            for (const Row& row : rows_)
                add(row.cells.count(), numbers_.room(2, sizeof(std::int32_t) + sizeof(double)),
                    [view = view_, f, b = row.block, tags = tags_[row.block], cells = row.cells,
                     to = numbers_](std::size_t begin, std::size_t end, char* out) {
                        const auto put = [&](std::size_t first, std::size_t last, const std::int32_t* own) {
                            view->fields[f].each(b, first, last, [&](std::size_t i, double value) {
                                out = to.end(to.add(to.add(out, own[i - first]), value));
                            });
                        };
                        each_chunk<std::int32_t>(cells, begin, end, tags, put);
                        return out;
                    });
            text_ += numbers_.gap() + "$EndElementData\n";
        }
    }

    /// Append records after the pending text.
    void add(std::size_t records, std::size_t bytes, decltype(Section::fill) fill)
    {
        file_.sections.push_back({std::exchange(text_, {}), records, bytes, std::move(fill)});
    }
    DeckFile take()
    {
        text_ += msh_periodic(*view_, numbers_, old_);
        add_fields();
        add(0, 0, {});
        file_.sizes = numbers_.binary ? Sizes::exact : Sizes::varying;
        return std::move(file_);
    }

    View view_;
    MshNumbers numbers_;
    bool old_; ///< the version is 2.2
    const ViewParts* parts_;
    std::string unit_; ///< declared unit of the lengths; empty: none
    std::vector<Row> rows_, part_rows_;
    std::vector<char> used_;    ///< whether an entity has elements
    std::vector<Numbers> tags_; ///< element numbers, for each block
    std::pair<std::int64_t, std::int64_t> elements_,
        nodes_; ///< lowest and highest number
    MshGroups groups_;
    std::vector<Eigen::AlignedBox3d> boxes_; ///< one for each entity
    std::vector<PartEntity> entities_;
    std::string text_; ///< text that precedes the next section
    DeckFile file_;
};

} // namespace

DeckFile msh_file(const View& view, const MeshFileOptions& options, const ViewParts* parts)
{
    MshFile file(view, options, parts);
    return options.version == 2.2 ? file.write_22() : file.write_41();
}

} // namespace lacuna::io
