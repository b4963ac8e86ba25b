// SPDX-License-Identifier: MIT
#include <lacuna/fill/filled.h>

#include <lacuna/core/error.h>
#include <lacuna/core/shared/same_corners.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <tuple>
#include <utility>

namespace lacuna::fill {
namespace {

constexpr const char* kNoCells = "NONE"; ///< `InterfaceFaces::element` of a split without cells

/// A part of a mesh, swept or of tetrahedra.
struct PartSkin {
    std::string region;
    const std::vector<mesh::SkinPatch>* patches = nullptr;
    std::vector<Index>* number = nullptr; ///< for each node of the part, its number in the whole mesh
    std::vector<mesh::CellNodes> sides{}; ///< sides of the skin in the part's own numbers, seen from outside
    std::vector<Index> patch{};           ///< for each side, its patch
};

/// Number of corners of a side, of order 1 or 2.
std::size_t corners_of(const mesh::CellNodes& side) { return side.count == 3 || side.count == 6 ? 3 : 4; }

/// Corners of a side, sorted.
Quad key_of(const mesh::CellNodes& side)
{
    return face_key({side.node[0], side.node[1], side.node[2], side.node[corners_of(side) - 1]});
}

template <class Mesh>
PartSkin skin_of(const Mesh& mesh, std::string region, std::vector<Index>& number)
{
    PartSkin skin{std::move(region), &mesh.patches, &number};
    for (std::size_t i = 0; i < mesh.skin_count(); ++i) {
        skin.sides.push_back(mesh::skin_nodes(mesh, i));
        skin.patch.push_back(mesh::skin_quad(mesh, i).patch);
    }
    return skin;
}

/// A side that two parts share.
struct SharedSide {
    std::size_t a, b;                 ///< indices of the parts, `a` < `b`
    std::size_t side_a, side_b;       ///< indices of the side in the two skins
    mesh::CellNodes nodes_a, nodes_b; ///< its nodes in the whole mesh before the split, as each part sees
                                      ///< them from outside
    bool is_split = false;
};

class Splitter {
public:
    Splitter(FilledParts& mesh, const InterfaceFaces& faces) : mesh_(mesh), faces_(faces)
    {
        for (std::size_t p = 0; p < mesh.swept.parts.size(); ++p) {
            std::vector<Index>& number = numbers_.emplace_back();
            for (std::size_t n = 0; n < mesh.swept.parts[p].mesh.node_count(); ++n)
                number.push_back(mesh.swept.numbering[p].of(static_cast<Index>(n)));
        }
        for (std::size_t p = 0; p < numbers_.size(); ++p)
            parts_.push_back(skin_of(mesh.swept.parts[p].mesh, mesh.regions[p], numbers_[p]));
        for (FilledTets& tets : mesh.tets) parts_.push_back(skin_of(tets.mesh, tets.region, tets.number));
        for (const sweep::Swept& part : mesh.swept.parts) is_full_ = is_full_ || part.mesh.middles.full;
    }

    void split(const RunContext& context)
    {
        find_shared();
        choose();
        number_nodes();
        add_cells(context);
        pair_between();
        mesh_.owner.resize(mesh_.swept.nodes);
        for (std::size_t p = 0; p < parts_.size(); ++p)
            for (std::size_t n = 0; n < parts_[p].number->size(); ++n)
                mesh_.owner[index((*parts_[p].number)[n])] = {static_cast<Index>(p), static_cast<Index>(n)};
        for (const auto& [ends, node] : between_) mesh_.owner[index(node)] = mesh_.owner[index(ends.first)];
        // New nodes break the consecutive numbering, so the number of every node is listed.
        for (std::size_t p = 0; p < mesh_.swept.parts.size(); ++p) {
            const std::vector<Index>& number = numbers_[p];
            std::vector<std::pair<Index, Index>> known;
            for (std::size_t n = 0; n < number.size(); ++n)
                known.emplace_back(static_cast<Index>(n), number[n]);
            mesh_.swept.numbering[p] = {0, std::move(known), number.size()};
        }
    }

private:
    [[nodiscard]] mesh::CellNodes whole(std::size_t part, std::size_t side) const
    {
        mesh::CellNodes nodes = parts_[part].sides[side];
        for (std::size_t k = 0; k < nodes.count; ++k)
            nodes.node[k] = (*parts_[part].number)[index(nodes.node[k])];
        return nodes;
    }

    void find_shared()
    {
        struct Place {
            Quad key;
            std::size_t part, side;
        };
        std::vector<Place> all;
        for (std::size_t p = 0; p < parts_.size(); ++p)
            for (std::size_t i = 0; i < parts_[p].sides.size(); ++i)
                all.push_back({key_of(whole(p, i)), p, i});
        std::ranges::sort(all, {}, [](const Place& of) { return std::tuple(of.key, of.part, of.side); });
        for (std::size_t k = 1; k < all.size(); ++k)
            if (all[k].key == all[k - 1].key)
                shared_.push_back({all[k - 1].part, all[k].part, all[k - 1].side, all[k].side,
                                   whole(all[k - 1].part, all[k - 1].side), whole(all[k].part, all[k].side)});
        std::ranges::sort(shared_, {}, [](const SharedSide& of) { return std::tuple(of.a, of.side_a); });
    }

    void choose()
    {
        for (SharedSide& side : shared_) {
            const std::string &a = parts_[side.a].region, &b = parts_[side.b].region;
            side.is_split = (faces_.all && a != b) ||
                            std::ranges::any_of(faces_.pairs, [&](const auto& pair) {
                                return pair == std::pair(a, b) || pair == std::pair(b, a);
                            });
            for (const auto& [part, own] : {std::pair(side.a, side.side_a), {side.b, side.side_b}})
                for (const std::string& group :
                     (*parts_[part].patches)[index(parts_[part].patch[own])].groups)
                    if (std::ranges::find(faces_.groups, group) != faces_.groups.end()) side.is_split = true;
        }
        if (std::ranges::none_of(shared_, &SharedSide::is_split)) refuse();
    }

    [[noreturn]] void refuse() const
    {
        std::vector<std::string> pairs;
        for (const SharedSide& side : shared_)
            if (const std::string pair = formatted("{{ \"{}\", \"{}\" }}", parts_[side.a].region,
                                                   parts_[side.b].region);
                std::ranges::find(pairs, pair) == pairs.end())
                pairs.push_back(pair);
        Message message("fill.interface_none",
                        "split_interface: no cells of two regions share the named faces");
        if (pairs.empty())
            throw InvalidInput(std::move(message).remedy("sweep the regions as one lacuna.assembly"));
        throw InvalidInput(std::move(message).remedy(
            "name one of the pairs of regions that share faces: faces = {}{}{}", "{ ", pairs.front(), " }"));
    }

    /// At each node of a split face, give every set of parts that stay connected there its own node.
    void number_nodes()
    {
        // For each node of a split face, the shared sides at this node.
        std::map<Index, std::vector<const SharedSide*>> at;
        for (const SharedSide& side : shared_)
            if (side.is_split)
                for (const Index n : side.nodes_a) at[n];
        for (const SharedSide& side : shared_)
            for (const Index n : side.nodes_a)
                if (const auto own = at.find(n); own != at.end()) own->second.push_back(&side);
        std::vector<std::map<Index, Index>> renumbered(parts_.size()); // by part: new numbers of its nodes
        for (const auto& [node, sides] : at) {
            // `cut` unites parts that share a side that is not split; `joined` unites all parts that share a
            // side. Parts that only touch keep their common node.
            std::map<std::size_t, std::size_t> cut, joined;
            for (const SharedSide* side : sides)
                for (const std::size_t part : {side->a, side->b}) cut[part] = joined[part] = part;
            for (const SharedSide* side : sides) {
                unite(joined, side->a, side->b);
                if (!side->is_split) unite(cut, side->a, side->b);
            }
            std::map<std::size_t, Index> number; // new node of each connected set of parts, by the first part
                                                 // of the set
            for (const auto& [part, first] : cut) {
                const std::size_t own = root(cut, part);
                if (!number.contains(own))
                    number[own] = own == root(joined, part) ? node : static_cast<Index>(mesh_.swept.nodes++);
                if (number[own] != node) renumbered[part][node] = number[own];
            }
        }
        pair_doubles(renumbered);
        for (std::size_t p = 0; p < parts_.size(); ++p)
            if (!renumbered[p].empty())
                for (Index& n : *parts_[p].number)
                    if (const auto other = renumbered[p].find(n); other != renumbered[p].end())
                        n = other->second;
    }

    /// Pair the nodes of periodic faces again after the duplication. A node of the part behind a side is
    /// paired with the node of the part behind the image of that side.
    void pair_doubles(const std::vector<std::map<Index, Index>>& renumbered)
    {
        for (mesh::PeriodicNodes& periodic : mesh_.swept.periodic) {
            std::map<Index, Index> image;
            std::set<Index> images;
            for (const auto& [a, b] : periodic.pairs) image[a] = b, images.insert(b);
            std::map<Quad, std::size_t> behind;
            const auto each_side = [&](const auto& visit) {
                for (std::size_t p = 0; p < parts_.size(); ++p)
                    for (std::size_t i = 0; i < parts_[p].sides.size(); ++i) visit(p, whole(p, i));
            };
            each_side([&](std::size_t p, const mesh::CellNodes& side) {
                if (std::ranges::all_of(side, [&](Index n) { return images.contains(n); }))
                    behind[key_of(side)] = p;
            });
            std::set<std::array<Index, 2>> pairs;
            const auto now = [&](std::size_t p, Index n) {
                const auto other = renumbered[p].find(n);
                return other == renumbered[p].end() ? n : other->second;
            };
            each_side([&](std::size_t p, const mesh::CellNodes& side) {
                if (!std::ranges::all_of(side, [&](Index n) { return image.contains(n); })) return;
                mesh::CellNodes there = side;
                for (std::size_t k = 0; k < there.count; ++k) there.node[k] = image.at(there.node[k]);
                const auto other = behind.find(key_of(there));
                for (std::size_t k = 0; k < side.count && other != behind.end(); ++k)
                    pairs.insert({now(p, side.node[k]), now(other->second, there.node[k])});
            });
            periodic.pairs.assign(pairs.begin(), pairs.end());
        }
    }

    static std::size_t root(const std::map<std::size_t, std::size_t>& sets, std::size_t part)
    {
        while (sets.at(part) != part) part = sets.at(part);
        return part;
    }
    /// Join two sets of parts; the lowest number is the root.
    static void unite(std::map<std::size_t, std::size_t>& sets, std::size_t a, std::size_t b)
    {
        a = root(sets, a), b = root(sets, b);
        sets[std::max(a, b)] = std::min(a, b);
    }

    void add_cells(const RunContext& context)
    {
        SplitInterface made{faces_.region, faces_.element, {}};
        std::size_t split = 0, closed = 0;
        for (const SharedSide& side : shared_) {
            if (!side.is_split) continue;
            const mesh::CellNodes own = whole(side.a, side.side_a), other = whole(side.b, side.side_b);
            mesh::CellNodes across = own; // for each corner of the side, the other part's node there
            for (std::size_t k = 0; k < own.count; ++k)
                across.node[k] = other.node[static_cast<std::size_t>(
                    std::ranges::find(side.nodes_b, side.nodes_a.node[k]) - side.nodes_b.begin())];
            ++(std::ranges::equal(across, own) ? closed : split);
            if (!std::ranges::equal(across, own) && faces_.element != kNoCells)
                made.cells.push_back(cell_of(own, across));
        }
        if (split == 0)
            throw InvalidInput(Message("fill.interface_none",
                                       "split_interface: the named faces have only nodes at the end of the "
                                       "interface, which are not duplicated")
                                   .remedy("name a larger face, or use a smaller 'size' on it"));
        if (closed > 0)
            log_line(context, formatted("note: split_interface: {} faces have no cell, because all their "
                                        "nodes are at the end of the interface",
                                        closed));
        mesh_.interfaces.push_back(std::move(made));
        mesh_.swept.report.push_back(
            faces_.element == kNoCells ? formatted("split_interface: {} faces without cells", split)
                                       : formatted("split_interface: {} cells of {}", split, faces_.element));
    }

    /// The cell between a side and its duplicate.
    mesh::CellNodes cell_of(const mesh::CellNodes& low, const mesh::CellNodes& high)
    {
        mesh::CellNodes cell;
        const std::size_t corners = corners_of(low);
        const auto add = [&](Index node) { cell.node[cell.count++] = node; };
        const auto add_between = [&](std::size_t k) { add(between(low.node[k], high.node[k])); };
        const auto add_sides = [&](std::size_t begin, std::size_t end) {
            for (const mesh::CellNodes* side : {&low, &high})
                for (std::size_t k = begin; k < end; ++k) add(side->node[k]);
        };
        add_sides(0, corners);
        if (low.count == corners) return cell;
        add_sides(corners, 2 * corners);
        for (std::size_t k = 0; k < corners; ++k) add_between(k);
        if (!is_full_) return cell;
        // For each upright face of a hexahedron, the index of the side below it. In a wedge, faces and sides
        // have the same order.
        constexpr std::array<std::size_t, 4> kSideBelow{3, 1, 0, 2};
        for (std::size_t f = 0; f < corners; ++f) add_between(corners + (corners == 4 ? kSideBelow[f] : f));
        if (corners == 3) return cell;
        add_sides(8, 9);
        add_between(8);
        return cell;
    }

    /// The node of a cell between two opposite nodes.
    Index between(Index a, Index b)
    {
        const auto [at, is_new] = between_.try_emplace(std::minmax(a, b),
                                                       static_cast<Index>(mesh_.swept.nodes));
        if (is_new) ++mesh_.swept.nodes;
        return at->second;
    }

    /// Pair the nodes between two nodes of a periodic face with those between their images.
    void pair_between()
    {
        for (mesh::PeriodicNodes& periodic : mesh_.swept.periodic) {
            std::map<Index, Index> image;
            for (const auto& [a, b] : periodic.pairs) image[a] = b;
            const auto image_of = [&](Index node) {
                const auto at = image.find(node);
                return at == image.end() ? Index(-1) : at->second;
            };
            for (const auto& [ends, node] : between_)
                if (const auto other = between_.find(
                        std::minmax(image_of(ends.first), image_of(ends.second)));
                    other != between_.end())
                    periodic.pairs.push_back({node, other->second});
        }
    }

    /// At order 2: for each pair of opposite nodes of a cell, the node between them.
    std::map<std::pair<Index, Index>, Index> between_{};
    bool is_full_ = false; ///< cells of order 2 have centres
    /// For each swept part and each of its nodes, the number of the node in the whole mesh.
    std::vector<std::vector<Index>> numbers_{};
    FilledParts& mesh_;
    const InterfaceFaces& faces_;
    std::vector<PartSkin> parts_;
    std::vector<SharedSide> shared_;
};

/// The name of the faces below (`target`) or above a level.
std::string at_level(int level, const char* side) { return formatted("level_{}:{}", level, side); }

/// The layers [from, to) of a sweep, as a sweep of its own. Its first and last quads get new patches, unless
/// they lie on an end of the whole sweep.
sweep::Swept layers_of(const sweep::Swept& whole, int from, int to)
{
    sweep::Swept part = whole;
    mesh::HexMesh& mesh = part.mesh;
    const auto cut = [](auto& list, std::size_t first, std::size_t count) {
        list.erase(list.begin(), list.begin() + static_cast<std::ptrdiff_t>(first));
        list.resize(count);
    };
    mesh.layers = to - from;
    const auto low = static_cast<std::size_t>(from), count = static_cast<std::size_t>(mesh.layers);
    const mesh::MiddlePlaces middle(whole.mesh);
    cut(mesh.nodes, low * index(mesh.nodes_per_layer), (count + 1) * index(mesh.nodes_per_layer));
    if (mesh.order() > 1) cut(mesh.middles.nodes, middle.side(low, 0), mesh::MiddlePlaces(mesh).count());
    cut(mesh.wall_patch, low * mesh.rim.size(), count * mesh.rim.size());
    const auto end = [&](std::vector<Index>& patches, int level, const char* name) {
        int tag = 0;
        for (const mesh::SkinPatch& patch : mesh.patches) tag = std::max(tag, patch.tag);
        patches.assign(patches.size(), static_cast<Index>(mesh.patches.size()));
        mesh.patches.push_back({tag + 1, {at_level(level, name)}, 0});
        part.faces.emplace_back();
    };
    if (from > 0) {
        end(mesh.source_patch, from, "source");
        part.fidelity = {}; // only the first part keeps the fidelity and the report of the whole mesh
        part.report.clear();
    }
    if (to < whole.mesh.layers) end(mesh.target_patch, to, "target");
    return part;
}

/// Divide the mesh of one sweep into one part between each two levels. The nodes keep their numbers.
FilledParts divided_at(FilledParts mesh, InterfaceFaces& faces)
{
    std::ranges::sort(faces.levels);
    const sweep::Swept whole = std::move(mesh.swept.parts.front());
    if (mesh.swept.parts.size() > 1 || !mesh.tets.empty())
        throw InvalidInput(Message("fill.interface_levels",
                                   "split_interface: a mesh of {} parts has no common levels",
                                   found(mesh.swept.parts.size() + mesh.tets.size()))
                               .remedy("split the mesh of one sweep, or cut the volumes there"));
    for (const int level : faces.levels)
        if (level < 1 || level >= whole.mesh.layers)
            throw InvalidInput(
                Message("fill.interface_levels",
                        "split_interface: a split above layer {} is requested, but the last layer is {}",
                        found(level), whole.mesh.layers)
                    .remedy("name a layer from 1 to {}", needed(whole.mesh.layers - 1)));
    std::vector<int> levels{0};
    levels.insert(levels.end(), faces.levels.begin(), faces.levels.end());
    levels.push_back(whole.mesh.layers);
    const auto ends = std::ranges::unique(levels);
    levels.erase(ends.begin(), ends.end());
    const std::string region = mesh.regions.front(), material = mesh.materials.front();
    const std::size_t member = mesh.swept.member.empty() ? 0 : mesh.swept.member.front();
    const std::vector<io::ColumnSet> columns = std::exchange(mesh.columns, {});
    mesh.swept.parts.clear();
    mesh.swept.numbering.clear();
    mesh.swept.member.clear();
    mesh.regions.clear();
    mesh.materials.clear();
    for (std::size_t i = 0; i + 1 < levels.size(); ++i) {
        const int from = levels[i];
        const sweep::Swept& part = mesh.swept.parts.emplace_back(layers_of(whole, from, levels[i + 1]));
        const auto corners = static_cast<Index>(part.mesh.nodes.size());
        const auto low = static_cast<Index>(
            whole.mesh.nodes.size() + mesh::MiddlePlaces(whole.mesh).side(static_cast<std::size_t>(from), 0));
        std::vector<std::pair<Index, Index>> number;
        for (Index n = 0; n < static_cast<Index>(part.mesh.node_count()); ++n)
            number.emplace_back(n, n < corners ? from * part.mesh.nodes_per_layer + n : low + n - corners);
        mesh.swept.numbering.emplace_back(0, std::move(number), part.mesh.node_count());
        mesh.swept.member.push_back(member);
        mesh.regions.push_back(region);
        mesh.materials.push_back(material);
        for (io::ColumnSet column : columns) {
            column.part = i;
            mesh.columns.push_back(std::move(column));
        }
        if (from > 0) faces.groups.push_back(at_level(from, "source"));
    }
    return mesh;
}

} // namespace

FilledParts split_interface(FilledParts mesh, InterfaceFaces faces, const RunContext& context)
{
    hold_nodes(mesh, context);
    const std::string& element = faces.element;
    if (!element.starts_with("COH3D8") && !element.starts_with("GK3D8") && element != kNoCells)
        throw InvalidInput(Message("fill.interface_element",
                                   "split_interface: cells of element = \"{}\" cannot have zero thickness",
                                   found(element))
                               .remedy("use COH3D8 or GK3D8, or element = \"none\" for a split without "
                                       "cells"));
    if (!mesh.interfaces.empty())
        throw InvalidInput(Message("fill.interface_split", "split_interface: the mesh was split before")
                               .remedy("name all faces in one call"));
    if (!faces.levels.empty()) mesh = divided_at(std::move(mesh), faces);
    if (faces.groups.empty() && faces.pairs.empty() && !faces.all)
        throw InvalidInput(Message("fill.interface_none", "split_interface: no faces are named")
                               .remedy("give faces = \"all\", a group, pairs of regions: {{ {{ a, b }} }}, "
                                       "or numbers of layers"));
    Splitter(mesh, faces).split(context);
    return mesh;
}

} // namespace lacuna::fill
