// SPDX-License-Identifier: MIT
#include <lacuna/io/detail/join_sets.h>

#include <lacuna/core/shared/criteria.h>
#include <lacuna/geometry/shared/facet_tree.h>
#include <lacuna/io/detail/deck_builder.h>
#include <lacuna/io/leave_out.h>
#include <lacuna/mesh/second_order.h>

#include <algorithm>
#include <iterator>
#include <numeric>
#include <span>

namespace lacuna::io {
namespace {

template <class Value>
void add(std::vector<Value>& to, const std::vector<Value>& values)
{
    to.insert(to.end(), values.begin(), values.end());
    tidy(to);
}

bool holds(const std::vector<DeckTag>& set, const std::vector<DeckTag>& all)
{
    return !all.empty() && std::ranges::includes(set, all);
}

std::vector<DeckTag> solids_of(const Deck& deck)
{
    std::vector<DeckTag> solids;
    for (const DeckBlock& block : deck.blocks)
        if (shape_info(block.shape).dimension == 3) add(solids, block.tags);
    return solids;
}

/// Element numbers of the solids in a part.
std::vector<DeckTag> solids_called(const Deck& deck, const std::string& name)
{
    std::vector<DeckTag> called;
    std::ranges::set_intersection(solids_of(deck), cells_of_part(deck, name), std::back_inserter(called));
    return called;
}

/// A face or quad: half the cross product of its diagonals, and its centre.
struct Facet {
    Vec3 area, centre;
};
template <class Place>
Facet facet_of(const Quad& quad, const Place& place)
{
    const Vec3 a = place(quad[0]), b = place(quad[1]), c = place(quad[2]), d = place(quad[3]);
    return {(c - a).cross(d - b) / 2, (a + b + c + d) / 4};
}

/// Finds which part of a mesh replaces the elements that were left out of a deck.
class Replacer {
public:
    /// @param named  a part with the volume's name was left out, and the mesh replaces it; otherwise the mesh
    ///               replaces everything that was left out.
    Replacer(const Deck& gone, const NewCells& added, bool named) : gone_(gone), added_(added)
    {
        cells_ = named ? solids_called(gone, added.volume) : solids_of(gone);
        std::vector<std::pair<const DeckBlock*, std::size_t>> elements;
        each_element(gone, [&](const DeckBlock& block, std::size_t e, std::size_t) {
            elements.emplace_back(&block, e);
            for (const Index node : block.element(e))
                if (node >= 0 && std::ranges::binary_search(cells_, block.tags[e]))
                    nodes_.push_back(gone.point_tags[index(node)]);
        });
        add(nodes_, {});
        each_with_same_nodes(gone, [&](std::span<const NumberedCell> alike) {
            Face found;
            for (const auto& [others, number] : alike) {
                const auto& [block, e] = elements[number / 8];
                const auto side = static_cast<int>(number % 8);
                if (side == 0) {
                    found.shell = block->tags[e];
                    continue;
                }
                if (found.side.side > 0) return; // the face is between two solids
                found.side = {block->tags[e], side};
                const Quad& face = face_corners(block->shape)[index(side - 1)];
                for (std::size_t k = 0; k < 4; ++k) // a triangle repeats its last corner
                    found.corners[k] = block->element(e)[index(face[k] < 0 ? face[2] : face[k])];
            }
            if (found.side.side > 0) skin_.push_back(found);
        });
        find_places();
    }

    /// Add the new nodes, cells or sides to a set that lost members.
    /// @param old   the set before its members were left out
    /// @param fits  whether the set may take the new cells
    /// @return  the replaced share of the members left out, measured by area of the skin [-]
    double fill(const DeckSet& old, DeckSet& set, const std::function<bool(const DeckSet&)>& fits)
    {
        using enum mesh::SetKind;
        if (old.kind != sides && holds(old.members, old.kind == nodes ? nodes_ : cells_)) {
            if (old.kind == elements && !fits(set)) return 0;
            add(set.members, old.kind == nodes ? added_.nodes : added_.cells);
            return 1;
        }
        const auto has_cell = [](const NewCells::Side& side) { return side.cell.has_value(); };
        if (old.kind == elements && std::ranges::none_of(added_.skin, has_cell)) return 0;
        std::vector<double> held; // for each face of the old skin: its area if the set contained it, else 0
        for (const Face& face : skin_) {
            std::vector<DeckTag> corners;
            for (const Index node : face.corners) corners.push_back(gone_.point_tags[index(node)]);
            add(corners, {});
            const bool has = old.kind == sides   ? std::ranges::binary_search(old.sides, face.side)
                             : old.kind == nodes ? holds(old.members, corners)
                                                 : std::ranges::binary_search(old.members, face.shell);
            held.push_back(has ? face.area.norm() : 0);
        }
        double share = 0;
        for (std::size_t i = 0; i < on_.size(); ++i) {
            if (on_[i] < 0 || held[index(on_[i])] == 0) continue;
            share += area_[i];
            const NewCells::Side& side = added_.skin[i];
            if (old.kind == sides && side.side) set.sides.push_back(*side.side);
            if (old.kind == elements) set.members.push_back(*side.cell);
            if (old.kind == nodes)
                set.members.insert(set.members.end(), side.nodes.begin(), side.nodes.end());
        }
        add(set.sides, {});
        add(set.members, {});
        return share > 0 ? share / std::accumulate(held.begin(), held.end(), 0.0) : 0;
    }

private:
    struct Face {
        Quad corners{};
        DeckSide side{};
        DeckTag shell = -1; ///< element on the face; -1: none
        Vec3 area = Vec3::Zero();
    };

    /// Find the face of the old skin on which each quad of the new skin lies.
    void find_places()
    {
        std::vector<Triangle> triangles;
        for (Face& face : skin_) {
            const auto& [a, b, c, d] = face.corners;
            triangles.insert(triangles.end(), {{a, b, c}, {a, c, d}});
            face.area = facet_of(face.corners, [&](Index node) { return gone_.points[index(node)]; }).area;
        }
        const geometry::FacetTree tree(gone_.points, triangles);
        for (const NewCells::Side& side : added_.skin) {
            const Facet quad = facet_of({0, 1, 2, 3},
                                        [&](Index corner) { return side.corners[index(corner)]; });
            area_.push_back(quad.area.norm());
            const Index hit = tree.closest(quad.centre, kFollowsFace * kFollowsFace * area_.back()).triangle;
            on_.push_back(hit < 0 || quad.area.dot(skin_[index(hit / 2)].area) <= 0 ? -1 : hit / 2);
        }
    }

    const Deck& gone_;
    const NewCells& added_;
    /// Numbers of the solids and nodes that the mesh replaces, increasing: those of the part with the
    /// volume's name or, if there is none, of everything left out.
    std::vector<DeckTag> cells_, nodes_;
    std::vector<Face> skin_;   ///< skin of the elements that were left out
    std::vector<Index> on_;    ///< for each quad of the new skin, its face in `skin_`; -1: none
    std::vector<double> area_; ///< area of each of these quads
};

/// Whether a set that contains all solids is meant to contain all of them. It is not
/// - if it is the set of a region;
/// - if it contains the cells behind a surface, as in a mesh with one layer.
bool is_of_all(const Deck& deck, const DeckSet& set)
{
    if (same_word(set.name, "all") || same_word(set.name, "eall")) return true;
    bool others = false;
    for (const DeckRegion& region : deck.regions) {
        if (same_word(region.name, set.name)) return false;
        others = others || !region.name.empty();
    }
    return others && std::ranges::none_of(deck.sets, [&](const DeckSet& surface) {
               return surface.sides.size() == set.members.size() && set.name.starts_with(surface.name);
           });
}

} // namespace

std::vector<std::size_t> sets_of_all(const Deck& deck)
{
    std::vector<std::size_t> found;
    std::vector<DeckTag> nodes;
    add(nodes, deck.point_tags);
    const std::vector<DeckTag> solids = solids_of(deck);
    for (std::size_t s = 0; s < deck.sets.size(); ++s) {
        const DeckSet& set = deck.sets[s];
        const bool of_nodes = set.kind == DeckSet::Kind::nodes;
        if (set.of_one_deck || (deck.gap.gone.empty() && holds(set.members, of_nodes ? nodes : solids) &&
                                (of_nodes || is_of_all(deck, set))))
            found.push_back(s);
    }
    return found;
}

void join_sets(Deck& deck, const NewCells& added, const std::vector<std::size_t>& of_all,
               const std::function<bool(const DeckSet&)>& fits)
{
    for (const std::size_t s : of_all)
        if (DeckSet& set = deck.sets[s]; set.kind == DeckSet::Kind::nodes || fits(set))
            add(set.members, set.kind == DeckSet::Kind::nodes ? added.nodes : added.cells);
    const bool named = find_word(deck.gap.names, added.volume) != deck.gap.names.end() &&
                       std::ranges::any_of(deck.gap.gone, [&](const auto& gone) {
                           return !solids_called(*gone, added.volume).empty();
                       });
    for (const auto& gone : deck.gap.gone) {
        Replacer replacer(*gone, added, named);
        for (const DeckSet& old : gone->sets)
            for (DeckSet& set : deck.sets)
                if (set.kind == old.kind && same_word(set.name, old.name))
                    deck.gap.replaced[{old.kind, old.name}] += replacer.fill(old, set, fits);
    }
}

} // namespace lacuna::io
