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

/// A part of a mesh, swept or of tetrahedra.
struct PartSkin {
    std::string region;
    const std::vector<mesh::SkinPatch>* patches = nullptr;
    std::vector<Index>* number = nullptr; ///< of each of its nodes in the whole mesh
    std::vector<Quad> sides{};            ///< of its skin, in its own numbers, seen from outside
    std::vector<Index> patch{};           ///< of each side
};

template <class Mesh>
PartSkin skin_of(const Mesh& mesh, std::string region, std::vector<Index>& number)
{
    PartSkin skin{std::move(region), &mesh.patches, &number};
    for (std::size_t i = 0; i < mesh.skin_count(); ++i) {
        const mesh::SkinQuad side = mesh::skin_quad(mesh, i);
        skin.sides.push_back(side.nodes);
        skin.patch.push_back(side.patch);
    }
    return skin;
}

/// A side that two parts share.
struct SharedSide {
    std::size_t a, b;           ///< parts, in their order
    std::size_t side_a, side_b; ///< in their skins
    Quad nodes_a, nodes_b;      ///< in the whole mesh before it is split, seen from outside each
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
    }

    void split(const RunContext& context)
    {
        find_shared();
        choose();
        number_nodes();
        add_cells(context);
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
    [[nodiscard]] Quad whole(std::size_t part, std::size_t side) const
    {
        Quad nodes = parts_[part].sides[side];
        for (Index& n : nodes) n = (*parts_[part].number)[index(n)];
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
                all.push_back({face_key(whole(p, i)), p, i});
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

    /// Give each set of parts that are joined at a node of a split face a node of its own.
    void number_nodes()
    {
        std::map<Index, std::vector<const SharedSide*>> at; // sides round each node of a split face
        for (const SharedSide& side : shared_)
            if (side.is_split)
                for (const Index n : side.nodes_a) at[n];
        for (const SharedSide& side : shared_) {
            for (std::size_t k = 0; k < mesh::corner_count(side.nodes_a); ++k)
                if (const auto own = at.find(side.nodes_a[k]); own != at.end()) own->second.push_back(&side);
        }
        std::vector<std::map<Index, Index>> renumbered(parts_.size()); // of each part
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
            std::map<std::size_t, Index> number; // of each set of joined parts, by its first
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

    /// Rebuild the node pairs of periodic faces after duplication: the node of the part behind a side is
    /// paired with the node of the part behind the side's image.
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
            each_side([&](std::size_t p, const Quad& side) {
                if (std::ranges::all_of(side, [&](Index n) { return images.contains(n); }))
                    behind[face_key(side)] = p;
            });
            std::set<std::array<Index, 2>> pairs;
            const auto now = [&](std::size_t p, Index n) {
                const auto other = renumbered[p].find(n);
                return other == renumbered[p].end() ? n : other->second;
            };
            each_side([&](std::size_t p, const Quad& side) {
                if (!std::ranges::all_of(side, [&](Index n) { return image.contains(n); })) return;
                Quad there = side;
                for (Index& n : there) n = image.at(n);
                const auto other = behind.find(face_key(there));
                for (std::size_t k = 0; k < 4 && other != behind.end(); ++k)
                    pairs.insert({now(p, side[k]), now(other->second, there[k])});
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
        std::size_t closed = 0;
        for (const SharedSide& side : shared_) {
            if (!side.is_split) continue;
            const Quad own = whole(side.a, side.side_a), other = whole(side.b, side.side_b);
            Quad across = own; // the other part's node of each corner
            for (std::size_t k = 0; k < 4; ++k)
                across[k] = other[static_cast<std::size_t>(std::ranges::find(side.nodes_b, side.nodes_a[k]) -
                                                           side.nodes_b.begin())];
            if (across == own) {
                ++closed;
                continue;
            }
            made.cells.push_back(
                {own[0], own[1], own[2], own[3], across[0], across[1], across[2], across[3]});
        }
        if (made.cells.empty())
            throw InvalidInput(Message("fill.interface_none",
                                       "split_interface: the named faces have only nodes at the end of the "
                                       "interface, which are not duplicated")
                                   .remedy("name a larger face, or use a smaller 'size' on it"));
        if (closed > 0)
            log_line(context, formatted("note: split_interface: {} faces have no cell, because all their "
                                        "nodes are at the end of the interface",
                                        closed));
        mesh_.interfaces.push_back(std::move(made));
        mesh_.swept.report.push_back(formatted("split_interface: {} cells of {}",
                                               mesh_.interfaces.back().cells.size(), faces_.element));
    }

    std::vector<std::vector<Index>> numbers_{}; ///< of the nodes of the swept parts in the whole mesh
    FilledParts& mesh_;
    const InterfaceFaces& faces_;
    std::vector<PartSkin> parts_;
    std::vector<SharedSide> shared_;
};

} // namespace

FilledParts split_interface(FilledParts mesh, const InterfaceFaces& faces, const RunContext& context)
{
    hold_nodes(mesh, context);
    const std::string& element = faces.element;
    const bool is_thin = element.starts_with("COH3D8") || element.starts_with("GK3D8");
    if (!is_thin)
        throw InvalidInput(Message("fill.interface_element",
                                   "split_interface: cells of element = \"{}\" cannot have zero thickness",
                                   found(element))
                               .remedy("use COH3D8 or GK3D8"));
    if (!mesh.interfaces.empty())
        throw InvalidInput(Message("fill.interface_split", "split_interface: the mesh was split before")
                               .remedy("name all faces in one call"));
    if (std::ranges::any_of(mesh.swept.parts,
                            [](const sweep::Swept& part) { return part.layers || part.mesh.order() > 1; }))
        throw InvalidInput(
            Message("fill.interface_order",
                    "split_interface: {} has eight nodes, and the mesh is of "
                    "order 2",
                    element)
                .remedy("sweep with order = 1, or tie the regions: give one of them glued = false"));
    if (faces.groups.empty() && faces.pairs.empty() && !faces.all)
        throw InvalidInput(
            Message("fill.interface_none", "split_interface: no faces are named")
                .remedy("give faces = \"all\", a group, or pairs of regions: {{ {{ a, b }} }}"));
    Splitter(mesh, faces).split(context);
    return mesh;
}

} // namespace lacuna::fill
