// SPDX-License-Identifier: MIT
//
// MSH files in parts as Gmsh has them: $Entities are those of the whole, and each has an entity in
// $PartitionedEntities for every part that has some of it. Nodes and elements are of these.
#include <lacuna/io/detail/msh_parts.h>

#include <lacuna/io/detail/msh_elements.h>

#include <algorithm>
#include <array>
#include <memory>
#include <numeric>

namespace lacuna::io {

std::string msh_partitioned(int parts, const std::vector<int>& ghosts,
                            const std::vector<MshPartEntity>& entities, const MshNumbers& numbers)
{
    const auto gap = [&](std::string& text) { // the line goes on
        if (!numbers.binary) text.back() = ' ';
    };
    std::string text = "$PartitionedEntities\n" + numbers.line(size_of(static_cast<std::size_t>(parts))) +
                       numbers.line(size_of(ghosts.size()));
    for (std::size_t p = 0; p < ghosts.size(); ++p) text += numbers.line(ghosts[p], static_cast<int>(p) + 1);
    std::array<std::size_t, 4> count{};
    for (const MshPartEntity& entity : entities) ++count[index(entity.dimension)];
    text += numbers.line(size_of(count[0]), size_of(count[1]), size_of(count[2]), size_of(count[3]));
    for (const int dimension : {0, 1, 2, 3})
        for (const MshPartEntity& entity : entities) {
            if (entity.dimension != dimension) continue;
            const Vec3 low = entity.box.min(), high = entity.box.max();
            text += numbers.line(entity.tag, dimension, entity.parent, size_of(1), entity.part + 1, low.x(),
                                 low.y(), low.z(), high.x(), high.y(), high.z(),
                                 size_of(entity.physical.size()));
            gap(text);
            for (const int tag : entity.physical) {
                text += numbers.line(tag);
                gap(text);
            }
            text += numbers.line(size_of(0)); // no bounding entities
        }
    return text + (numbers.binary ? "\n" : "") + "$EndPartitionedEntities\n";
}

void add_ghosts(std::vector<Section>& sections, const std::vector<MshGhosts>& ghosts,
                const MshNumbers& numbers)
{
    std::size_t all = 0;
    for (const MshGhosts& of : ghosts) all += of.count;
    if (all == 0) return;
    std::string head = "$GhostElements\n" + numbers.line(size_of(all));
    for (const MshGhosts& own : ghosts) {
        const std::size_t parts = own.of.size();
        sections.push_back({head, own.count, numbers.room(3 + parts, 20 + 4 * parts),
                            [own, numbers](std::size_t begin, std::size_t end, char* out) {
                                for (std::size_t i = begin; i < end; ++i) {
                                    out = numbers.add(out, own.number(i));
                                    out = numbers.add(out, own.part + 1);
                                    out = numbers.add(out, size_of(own.of.size()));
                                    for (const int part : own.of) out = numbers.add(out, part + 1);
                                    out = numbers.end(out);
                                }
                                return out;
                            }});
        head.clear();
    }
    sections.push_back({std::string(numbers.binary ? "\n" : "") + "$EndGhostElements\n", 0, 0, {}});
}

namespace {

/// A swept mesh's file in parts. Sections refer to what it is made of, and to it.
class PartedMesh : public std::enable_shared_from_this<PartedMesh> {
public:
    PartedMesh(const mesh::HexMesh& mesh, const NodeReader& nodes, const MshContent& content,
               const PartitionOptions& options, bool binary)
        : elements_{mesh, content},
          nodes_(nodes),
          parts_(layer_parts(mesh.layers, options)),
          ghosts_(options.ghosts),
          numbers_{binary}
    {
        for (std::size_t p = 0; p < parts_.size(); ++p)
            part_of_layer_.resize(index(parts_[p].last), static_cast<Index>(p));
    }

    std::vector<Section> sections()
    {
        part_skin();
        name_entities();
        std::vector<Section> all;
        const MshContent& content = elements_.content;
        text_ = msh_opening(content.names, "4.1", numbers_.binary) + msh_entities(content, numbers_.binary) +
                msh_partitioned(static_cast<int>(parts_.size()), ghost_tags_, entities_, numbers_);
        add_nodes(all);
        add_elements(all);
        add_ghosts(all, ghosts(), numbers_);
        return all;
    }

private:
    /// Quads or triangles of a patch that are of a part: a row of `order_`.
    struct Row {
        std::size_t surface, part;
        bool triangles;
        std::size_t begin, end;
    };

    [[nodiscard]] const mesh::HexMesh& mesh() const { return elements_.mesh; }
    [[nodiscard]] std::string gap() const { return numbers_.binary ? "\n" : ""; }
    std::string take_text() { return std::exchange(text_, {}); }

    /// The part of a quad of the skin: that of the cell behind it.
    [[nodiscard]] std::size_t part_of_skin(std::size_t i) const
    {
        const std::size_t columns = mesh().quads.size();
        if (i < columns) return 0;
        if (i < 2 * columns) return parts_.size() - 1;
        return index(part_of_layer_[(i - 2 * columns) / mesh().rim.size()]);
    }

    /// The skin's elements, patch after patch as without parts, in each of these part after part.
    void part_skin()
    {
        const MshContent& content = elements_.content;
        order_.resize(content.skin.size());
        std::iota(order_.begin(), order_.end(), std::uint32_t{0});
        for (std::size_t s = 0; s < content.surfaces.size(); ++s) {
            const MshSurface& surface = content.surfaces[s];
            const std::size_t quads = surface.end - surface.triangles;
            add_rows(s, false, surface.begin, quads);
            add_rows(s, true, quads, surface.end);
        }
    }

    void add_rows(std::size_t surface, bool triangles, std::size_t begin, std::size_t end)
    {
        const auto part = [&](std::uint32_t place) { return part_of_skin(elements_.content.skin[place]); };
        const auto at = [&](std::size_t place) {
            return order_.begin() + static_cast<std::ptrdiff_t>(place);
        };
        std::stable_sort(at(begin), at(end),
                         [&](std::uint32_t a, std::uint32_t b) { return part(a) < part(b); });
        for (std::size_t next = begin; begin < end; begin = next) {
            const std::size_t own = part(order_[begin]);
            while (next < end && part(order_[next]) == own) ++next;
            rows_.push_back({surface, own, triangles, begin, next});
        }
    }

    void name_entities()
    {
        const MshContent& content = elements_.content;
        int next = 0;
        for (const MshSurface& surface : content.surfaces) next = std::max(next, surface.tag);
        surface_tag_.assign(content.surfaces.size() * parts_.size(), 0);
        for (const Row& row : rows_) {
            int& tag = surface_tag_[row.surface * parts_.size() + row.part];
            if (tag != 0) continue; // its quads came before
            tag = ++next;
            const MshSurface& surface = content.surfaces[row.surface];
            entities_.push_back(
                {2, tag, surface.tag, static_cast<int>(row.part), surface.physical, surface.box});
        }
        const int parts = static_cast<int>(parts_.size());
        for (int p = 0; p < parts; ++p) {
            entities_.push_back({3, volume_tag(p), kVolumeTag, p, content.volume_physical, content.box});
            if (ghosts_ > 0) ghost_tags_.push_back(volume_tag(parts + p));
        }
    }

    static int volume_tag(int part) { return kVolumeTag + 1 + part; }

    /// A part has the levels below its layers, the last the highest too.
    [[nodiscard]] int levels_end(std::size_t part) const
    {
        return parts_[part].last + (part + 1 == parts_.size() ? 1 : 0);
    }

    void add_nodes(std::vector<Section>& all)
    {
        text_ += "$Nodes\n" + numbers_.line(size_of(parts_.size()), size_of(nodes_.count()), size_of(1),
                                            size_of(nodes_.count()));
        const auto row = index(mesh().nodes_per_layer);
        const std::size_t corners = mesh::corner_count(mesh());
        for (std::size_t p = 0; p < parts_.size(); ++p) {
            const auto first = index(parts_[p].first), last = index(levels_end(p));
            std::vector<std::pair<std::size_t, std::size_t>> ranges{{first * row, last * row}};
            if (mesh().order() == 2) {
                const mesh::MiddlePlaces places(mesh());
                const auto place = [&](std::size_t level) {
                    return corners + std::min(places.side(level, 0), places.count());
                };
                ranges.emplace_back(place(first), place(last));
            }
            std::size_t count = 0;
            for (const auto& [begin, end] : ranges) count += end - begin;
            text_ += numbers_.line(3, volume_tag(static_cast<int>(p)), 0, size_of(count));
            for (const auto& [from, to] : ranges)
                all.push_back(
                    {take_text(), to - from, numbers_.room(1, 8),
                     [self = shared_from_this(), from = from](std::size_t begin, std::size_t end, char* out) {
                         for (std::size_t n = from + begin; n < from + end; ++n)
                             out = self->numbers_.end(self->numbers_.add(out, size_of(n + 1)));
                         return out;
                     }});
            for (const auto& [from, to] : ranges)
                all.push_back(
                    {{},
                     to - from,
                     numbers_.room(3, sizeof(Vec3)),
                     [self = shared_from_this(), from = from](std::size_t begin, std::size_t end, char* out) {
                         return self->put_points(from + begin, from + end, out);
                     }});
        }
        text_ = gap() + "$EndNodes\n";
    }

    char* put_points(std::size_t begin, std::size_t end, char* out) const
    {
        if (numbers_.binary) return nodes_.copy(begin, end, out);
        nodes_.each(begin, end, [&](std::size_t, const Vec3& node) {
            for (const double x : node) out = numbers_.add(out, x);
            out = numbers_.end(out);
        });
        return out;
    }

    char* put_element(std::size_t i, char* out) const
    {
        out = numbers_.add(out, size_of(i + 1));
        for (const Index node : elements_.nodes(i).all()) out = numbers_.add(out, size_of(index(node) + 1));
        return numbers_.end(out);
    }

    void add_elements(std::vector<Section>& all)
    {
        const std::size_t skin = elements_.content.skin.size(), hexes = elements_.kinds.hexes();
        const std::size_t wedges = mesh().triangle_count(), columns = mesh().quads.size() - wedges;
        const std::size_t volumes = parts_.size() * (std::size_t(columns > 0) + std::size_t(wedges > 0));
        text_ += "$Elements\n" + numbers_.line(size_of(rows_.size() + volumes), size_of(elements_.count()),
                                               size_of(1), size_of(elements_.count()));
        const auto add = [&](int dimension, int tag, DeckShape shape, std::size_t count, const auto& place) {
            const auto nodes = static_cast<std::size_t>(shape_info(shape).nodes);
            text_ += numbers_.line(dimension, tag, gmsh_type(shape), size_of(count));
            all.push_back({take_text(), count, numbers_.room(nodes + 1, 8 * (nodes + 1)),
                           [self = shared_from_this(), place](std::size_t begin, std::size_t end, char* out) {
                               for (std::size_t i = begin; i < end; ++i)
                                   out = self->put_element(place(*self, i), out);
                               return out;
                           }});
        };
        for (const Row& row : rows_)
            add(2, surface_tag_[row.surface * parts_.size() + row.part],
                row.triangles ? DeckShape::tri3 : skin_shape(mesh()), row.end - row.begin,
                [from = row.begin](const PartedMesh& of, std::size_t i) {
                    return std::size_t(of.order_[from + i]);
                });
        for (std::size_t p = 0; p < parts_.size(); ++p) {
            const auto first = index(parts_[p].first), count = index(parts_[p].last) - first;
            const auto cells = [&](DeckShape shape, std::size_t before, std::size_t each_layer) {
                if (each_layer == 0) return;
                add(3, volume_tag(static_cast<int>(p)), shape, count * each_layer,
                    [from = before + first * each_layer](const PartedMesh&, std::size_t i) {
                        return from + i;
                    });
            };
            cells(cell_shape(mesh()), skin, columns);
            cells(DeckShape::wedge6, skin + hexes, wedges);
        }
        text_ = gap() + "$EndElements\n";
        all.push_back({take_text(), 0, 0, {}});
    }

    /// Runs of layers of one part that are ghosts of the same others.
    [[nodiscard]] std::vector<MshGhosts> ghosts() const
    {
        const std::size_t skin = elements_.content.skin.size(), hexes = elements_.kinds.hexes();
        const std::size_t wedges = mesh().triangle_count(), columns = mesh().quads.size() - wedges;
        const auto of = [&](int layer) {
            std::vector<int> parts;
            for (std::size_t p = 0; p < parts_.size(); ++p)
                if (part_of_layer_[index(layer)] != static_cast<Index>(p) && parts_[p].with_first <= layer &&
                    layer < parts_[p].with_last)
                    parts.push_back(static_cast<int>(p));
            return parts;
        };
        std::vector<MshGhosts> all;
        for (int first = 0, next = 0; ghosts_ > 0 && first < mesh().layers; first = next) {
            const std::vector<int> parts = of(first);
            const Index part = part_of_layer_[index(first)];
            while (next < mesh().layers && part_of_layer_[index(next)] == part && of(next) == parts) ++next;
            if (parts.empty()) continue;
            const auto add = [&](std::size_t before, std::size_t each_layer) {
                if (each_layer == 0) return;
                all.push_back({index(next - first) * each_layer, part, parts,
                               [from = before + index(first) * each_layer + 1](std::size_t i) {
                                   return size_of(from + i);
                               }});
            };
            add(skin, columns);
            add(skin + hexes, wedges);
        }
        return all;
    }

    MshElements elements_;
    const NodeReader& nodes_;
    std::vector<LayerPart> parts_;
    int ghosts_;
    MshNumbers numbers_;
    std::vector<Index> part_of_layer_;
    std::vector<std::uint32_t> order_; ///< of the skin's elements, as the file has them without parts
    std::vector<Row> rows_;
    std::vector<int> surface_tag_; ///< of each surface and part; 0: nothing of it
    std::vector<MshPartEntity> entities_;
    std::vector<int> ghost_tags_;
    std::string text_; ///< before the next section
};

} // namespace

std::vector<Section> partitioned_msh(const mesh::HexMesh& mesh, const NodeReader& nodes,
                                     const MshContent& content, const PartitionOptions& options, bool binary)
{
    return std::make_shared<PartedMesh>(mesh, nodes, content, options, binary)->sections();
}

} // namespace lacuna::io
