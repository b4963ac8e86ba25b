// SPDX-License-Identifier: MIT
#include <lacuna/fill/detail/edge_sets.h>

#include <lacuna/closure/shared/along.h>
#include <lacuna/geometry/shared/polyline.h>
#include <lacuna/io/shared/text_lines.h>
#include <lacuna/topology/shared/face_parts.h>
#include <lacuna/topology/shared/split_edge.h>
#include <lacuna/topology/shared/use_places.h>

#include <algorithm>
#include <array>
#include <map>
#include <ranges>
#include <set>
#include <unordered_map>

namespace lacuna::fill {

using namespace topology;

namespace {

/// For each side of an edge, given by two points of the model, the lower index first: the names of the sets
/// that hold it.
using NamedSides = std::map<std::array<Index, 2>, std::set<std::string>>;

/// Reads the sets of a deck on the points of a rim.
class SetReader {
public:
    SetReader(const io::Deck& deck, const Model& model, const std::vector<Index>& rim, double scale,
              NamedSides& found)
        : deck_(deck), found_(found)
    {
        const io::NodesAt nodes = io::nodes_at(deck, places_at(model, rim), model.tolerance, scale);
        for (std::size_t i = 0; i < rim.size(); ++i)
            for (const Index node : nodes.at(i)) point_[node] = rim[i];
        for (const io::DeckBlock& block : deck.blocks)
            for (std::size_t e = 0; e < block.count(); ++e) element_[block.tags[e]] = {&block, e};
        std::unordered_map<io::DeckTag, Index> node;
        for (const auto& [own, point] : point_) node[deck.point_tags[index(own)]] = own;
        for (const io::TextLine& line : io::lines_in_text(deck)) {
            const auto a = node.find(line.ends[0]), b = node.find(line.ends[1]);
            if (a == node.end() || b == node.end()) continue;
            lines_.nodes.insert(lines_.nodes.end(), {a->second, b->second});
            lines_.tags.push_back(line.tag);
            add(lines_, lines_.count() - 1, 0, line.region);
        }
        for (std::size_t e = 0; e < lines_.count(); ++e) element_[lines_.tags[e]] = {&lines_, e};
    }

    void run()
    {
        for (const io::DeckBlock& block : deck_.blocks) {
            if (mesh::shape_info(block.shape).dimension != 1) continue;
            for (std::size_t e = 0; e < block.count(); ++e)
                add(block, e, 0, deck_.regions[index(block.regions[e])].name);
        }
        for (const io::DeckSet& set : deck_.sets) {
            if (set.kind == io::DeckSet::Kind::elements)
                for (const io::DeckTag tag : set.members) add(tag, 1, 0, set.name);
            if (set.kind == io::DeckSet::Kind::sides)
                for (const io::DeckSide& side : set.sides)
                    if (side.side > 0) add(side.element, 2, side.side - 1, set.name);
        }
    }

private:
    /// Add a side of an element, if the element has the given dimension.
    void add(io::DeckTag tag, int dimension, int side, const std::string& name)
    {
        const auto known = element_.find(tag);
        if (known == element_.end()) return;
        const auto& [block, element] = known->second;
        if (mesh::shape_info(block->shape).dimension == dimension) add(*block, element, side, name);
    }
    void add(const io::DeckBlock& block, std::size_t element, int side, const std::string& name)
    {
        const int corners = mesh::shape_info(block.shape).corners;
        if (name.empty() || side >= corners) return;
        const std::span<const Index> nodes = block.element(element);
        const auto a = point_.find(nodes[index(side)]), b = point_.find(nodes[index((side + 1) % corners)]);
        if (a == point_.end() || b == point_.end()) return;
        found_[{std::min(a->second, b->second), std::max(a->second, b->second)}].insert(name);
    }

    const io::Deck& deck_;
    NamedSides& found_;
    io::DeckBlock lines_{.shape = io::DeckShape::line2, .type = {}}; ///< line elements kept as text
    std::unordered_map<Index, Index> point_; ///< for each node of the deck on the rim, the point of the model
    std::unordered_map<io::DeckTag, std::pair<const io::DeckBlock*, std::size_t>> element_;
};

} // namespace

std::map<EdgeId, std::vector<std::string>> edge_sets(Model& model,
                                                     std::span<const std::shared_ptr<const io::Deck>> decks,
                                                     double scale)
{
    std::map<EdgeId, std::vector<std::string>> sets;
    if (decks.empty()) return sets;
    const std::set<EdgeId> rim = rim_edges(model, all_faces(model));
    std::vector<Index> points;
    for (const EdgeId edge : rim)
        points.insert(points.end(), model[edge].points.begin(), model[edge].points.end());
    NamedSides named;
    for (const auto& deck : decks) SetReader(*deck, model, points, scale, named).run();
    if (named.empty()) return sets;
    const auto names = [&](const Edge& edge, std::size_t side) {
        const Index a = edge.points[side], b = edge.points[side + 1];
        const auto found = named.find({std::min(a, b), std::max(a, b)});
        return found == named.end() ? std::set<std::string>{} : found->second;
    };
    std::vector<EdgeId> parts;
    for (const EdgeId edge : rim) {
        parts.push_back(edge);
        for (std::size_t i = model[edge].points.size() - 2; i > 0; --i) { // from the end, because the part
                                                                          // behind is split off
            const Edge& whole = model[edge];
            if (names(whole, i) == names(whole, i - 1)) continue;
            const std::vector<double> at = geometry::arc_lengths(places_at(model, whole.points));
            parts.push_back(split_edge(model, edge, at[i] / at.back()).behind);
        }
    }
    for (const EdgeId part : parts) {
        const std::set<std::string> own = names(model[part], 0);
        if (!own.empty()) sets[part].assign(own.begin(), own.end());
    }
    return sets;
}

std::vector<io::ColumnSet> column_sets(const Volume& volume, const sweep::Swept& swept)
{
    std::vector<io::ColumnSet> sets;
    if (!volume.along) return sets;
    const Model& source = volume.along->source.model;
    const Index count = swept.mesh.nodes_per_layer;
    for (const auto& deck : volume.decks) {
        const auto is_of_nodes = [](const io::DeckSet& set) { return set.kind == io::DeckSet::Kind::nodes; };
        if (std::ranges::none_of(deck->sets, is_of_nodes)) continue;
        std::map<io::DeckTag, Index> node; // by node of the deck: the node of the first level in its column
        for (const Index first : {0, swept.mesh.layers * count}) { // a sweep may start at either end
            std::vector<Vec3> places;
            for (Index n = 0; n < count; ++n) places.push_back(swept.skin()[first + n]);
            const io::NodesAt at = io::nodes_at(*deck, places, source.tolerance, volume.scale);
            for (Index n = 0; n < count; ++n)
                for (const Index point : at.at(index(n))) node.emplace(deck->point_tags[index(point)], n);
        }
        for (const io::DeckSet& set : deck->sets | std::views::filter(is_of_nodes)) {
            io::ColumnSet columns{set.name};
            for (const io::DeckTag tag : set.members)
                if (const auto known = node.find(tag); known != node.end())
                    columns.nodes.push_back(known->second);
            std::ranges::sort(columns.nodes);
            if (!columns.nodes.empty()) sets.push_back(std::move(columns));
        }
    }
    return sets;
}

} // namespace lacuna::fill
