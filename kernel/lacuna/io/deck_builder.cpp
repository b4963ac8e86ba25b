// SPDX-License-Identifier: MIT
#include <lacuna/io/detail/deck_builder.h>

#include <lacuna/core/error.h>
#include <lacuna/core/shared/attempt.h>
#include <lacuna/core/shared/large_pages.h>
#include <lacuna/geometry/newell.h>
#include <lacuna/geometry/shared/triangulate.h>
#include <lacuna/io/detail/cell_shapes.h>
#include <lacuna/mesh/tet_mesh.h>

#include <algorithm>
#include <numeric>

namespace lacuna::io {
namespace {

/// Whether all triangles of the fan from the first corner have the polygon's orientation, so that the fan
/// fills the polygon.
bool fan_fills(const std::vector<Vec3>& at, const Vec3& normal)
{
    for (std::size_t k = 1; k + 1 < at.size(); ++k)
        if ((at[k] - at[0]).cross(at[k + 1] - at[0]).dot(normal) < 0) return false;
    return true;
}

/// Turn bricks of the form that `merged_brick()` describes into pyramids, and the numbers of their sides into
/// those of pyramids.
void take_out_pyramids(Deck& deck)
{
    std::vector<DeckTag> found;
    std::vector<DeckBlock> pyramids;
    for (DeckBlock& block : deck.blocks) {
        if (block.shape != DeckShape::hex8 && block.shape != DeckShape::hex20) continue;
        const auto is_pyramid = [&](std::size_t e) {
            const std::span<const Index> nodes = block.element(e);
            Hex hex;
            std::copy_n(nodes.begin(), hex.size(), hex.begin());
            for (std::size_t n = 12; n < 16 && nodes.size() == 20; ++n)
                if (nodes[n] != hex[4]) return false;
            return mesh::is_pyramid(hex);
        };
        const bool second = block.shape == DeckShape::hex20;
        DeckBlock own{.shape = second ? DeckShape::pyramid13 : DeckShape::pyramid5, .type = block.type};
        for (std::size_t e = 0; e < block.count(); ++e) {
            if (!is_pyramid(e)) continue;
            for (std::size_t n = 0; n < block.element(e).size(); ++n) // take each node of the pyramid once
                if (n < 5 || kMergedBrick[n] > 4) own.nodes.push_back(block.element(e)[n]);
            own.tags.push_back(block.tags[e]);
            own.regions.push_back(block.regions[e]);
        }
        if (own.count() == 0) continue;
        block = without_elements(block, is_pyramid);
        found.insert(found.end(), own.tags.begin(), own.tags.end());
        pyramids.push_back(std::move(own));
    }
    if (found.empty()) return;
    std::erase_if(deck.blocks, [](const DeckBlock& block) { return block.count() == 0; });
    for (DeckBlock& block : pyramids) deck.blocks.push_back(std::move(block));
    std::ranges::sort(found);
    const auto is_found = [&](const DeckSide& side) {
        return std::ranges::binary_search(found, side.element);
    };
    for (DeckSet& set : deck.sets) {
        std::erase_if(set.sides, [&](const DeckSide& side) { return side.side == 2 && is_found(side); });
        for (DeckSide& side : set.sides)
            if (side.side > 2 && is_found(side)) --side.side;
    }
}

} // namespace

std::vector<char> used_regions(const Deck& deck)
{
    std::vector<char> used(deck.regions.size(), 0);
    for (const DeckBlock& block : deck.blocks)
        for (const Index region : block.regions)
            if (region >= 0) used[index(region)] = 1;
    return used;
}

std::vector<DeckTag> element_tags(const Deck& deck)
{
    std::vector<DeckTag> tags;
    for (const DeckBlock& block : deck.blocks) tags.insert(tags.end(), block.tags.begin(), block.tags.end());
    return tags;
}

std::size_t block_of(std::vector<DeckBlock>& blocks, DeckShape shape, std::string_view type)
{
    // A linear search is fast enough: formats have at most a few dozen type words.
    for (std::size_t b = 0; b < blocks.size(); ++b)
        if (blocks[b].shape == shape && blocks[b].type == type) return b;
    blocks.push_back({.shape = shape, .type = std::string(type)});
    return blocks.size() - 1;
}

void append_block(const DeckBlock& from, Index first_point, Index first_region, DeckTag raise, DeckBlock& to)
{
    for (const Index node : from.nodes) to.nodes.push_back(node < 0 ? -1 : first_point + node);
    for (const DeckTag tag : from.tags) to.tags.push_back(tag + raise);
    for (const Index region : from.regions) to.regions.push_back(region < 0 ? -1 : first_region + region);
}

void raise_numbers(DeckSet& set, DeckTag nodes, DeckTag elements)
{
    for (DeckTag& member : set.members) member += set.kind == DeckSet::Kind::nodes ? nodes : elements;
    for (DeckSide& side : set.sides) side.element += elements;
}

void DeckBuilder::add_point(DeckTag tag, const Vec3& point, const Cursor& cursor)
{
    if (!is_index(deck_.points.size() + 1)) cursor.fail("too many nodes");
    deck_.point_tags.push_back(tag);
    deck_.points.push_back(point);
}

Index DeckBuilder::add_region(int tag, std::string_view name)
{
    deck_.regions.push_back({tag, std::string(trimmed(name)), ""});
    return static_cast<Index>(deck_.regions.size()) - 1;
}

Index DeckBuilder::region_of(int tag, std::string_view name, int group)
{
    const auto [found, fresh] = regions_.try_emplace({tag, group}, static_cast<Index>(deck_.regions.size()));
    if (fresh) add_region(tag, name);
    return found->second;
}

std::size_t DeckBuilder::block_of(DeckShape shape, std::string_view type)
{
    const std::size_t block = io::block_of(deck_.blocks, shape, type);
    places_.resize(deck_.blocks.size());
    return block;
}

void DeckBuilder::add_element(std::size_t block, DeckTag tag, Index region, std::span<const Index> nodes,
                              std::uint64_t place)
{
    DeckBlock& to = deck_.blocks[block];
    to.nodes.insert(to.nodes.end(), nodes.begin(), nodes.end());
    ++elements_;
    to.tags.push_back(tag < 0 ? elements_ : tag);
    to.regions.push_back(region);
    if (place > 0) places_[block].push_back(place);
}

DeckBuilder::Room DeckBuilder::add_elements(std::size_t block, std::size_t count, Index region)
{
    DeckBlock& to = deck_.blocks[block];
    const std::size_t first = to.count(), nodes = to.nodes.size();
    const auto grow = [](auto& values, std::size_t more, Index value) {
        make_room(values, more);
        values.resize(values.size() + more, value);
    };
    grow(to.nodes, count * static_cast<std::size_t>(shape_info(to.shape).nodes), 0);
    grow(to.tags, count, 0);
    grow(to.regions, count, region);
    for (std::size_t i = 0; i < count; ++i) to.tags[first + i] = ++elements_;
    return {to.nodes.data() + nodes, to.tags.data() + first};
}

void DeckBuilder::add_face(std::span<const Index> corners, Index region, const Cursor& cursor, DeckTag tag)
{
    const std::vector<Vec3>& points = deck_.points;
    if (corners.size() < 3)
        cursor.fail("expected a face of three corners or more, found {}", found(corners.size()));
    for (const Index p : corners)
        if (p < 0 || index(p) >= points.size())
            cursor.fail("expected a point number up to {}, found {}", points.size(),
                        found(std::int64_t(p) + 1));
    if (corners.size() == 4) return add_element(block_of(DeckShape::quad4, ""), tag, region, corners);
    const std::size_t triangles = block_of(DeckShape::tri3, "");
    const auto add_triangle = [&](Index a, Index b, Index c) {
        add_element(triangles, tag, region, Triangle{a, b, c});
    };
    if (corners.size() == 3) return add_element(triangles, tag, region, corners);
    std::vector<Vec3> at;
    for (const Index p : corners) at.push_back(points[index(p)]);
    if (fan_fills(at, geometry::newell_vector(at))) {
        for (std::size_t k = 1; k + 1 < corners.size(); ++k)
            add_triangle(corners[0], corners[k], corners[k + 1]);
        return;
    }
    const geometry::Plane plane = geometry::newell_plane(std::vector<std::vector<Vec3>>{at});
    std::vector<Vec2> flat;
    for (const Vec3& p : at) flat.push_back(geometry::to_plane(plane, p));
    std::vector<Index> loop(corners.size());
    std::iota(loop.begin(), loop.end(), 0);
    auto cut = attempt<InvalidInput>([&] {
        return geometry::triangulate(flat, std::vector<std::vector<Index>>{loop}, {.interior_points = false});
    });
    if (!cut) cursor.fail("the polygon of {} corners crosses itself", corners.size());
    for (const Triangle& t : cut->triangles)
        add_triangle(corners[index(t[0])], corners[index(t[1])], corners[index(t[2])]);
}

void DeckBuilder::pass_over(const std::string& what, std::size_t count)
{
    constexpr std::size_t kMostKinds = 1000; // keeps nonsense files from filling the memory with their words
    const bool known = passed_over_.size() < kMostKinds || passed_over_.contains(what);
    if (count > 0) passed_over_[known ? what : "others"] += count;
}

void DeckBuilder::check_points(const std::string& path) const
{
    constexpr double kFarthest = 1e100; // largest coordinate: its cube is still a finite number
    for (std::size_t p = 0; p < deck_.points.size(); ++p) {
        if (deck_.points[p].cwiseAbs().maxCoeff() <= kFarthest) continue;
        throw InvalidInput(Message("io.unreadable", "cannot read {}: {} has a coordinate beyond 1e100", path,
                                   numbered("point", p + 1))
                               .remedy("check the file, or export it again"));
    }
}

Deck DeckBuilder::take(const std::string& path)
{
    check_points(path);
    deck_.path = path;
    if (deck_.format == DeckFormat::abaqus || deck_.format == DeckFormat::unv) take_out_pyramids(deck_);
    std::vector<std::string> passed;
    for (const auto& [what, count] : passed_over_) passed.push_back(formatted("{} {}", count, what));
    if (!passed.empty()) deck_.notes.push_back(formatted("{}: passed over {}", path, listed(passed)));
    for (const auto& [type, count] : further_nodes_)
        warn(formatted("elements {} list too many nodes; up to {} nodes per element are ignored", type,
                       count));
    for (std::string& warning : deck_.warnings) warning.insert(0, path + ": ");
    for (std::size_t p = deck_.point_tags.size(); p < deck_.points.size(); ++p)
        deck_.point_tags.push_back(static_cast<DeckTag>(p) + 1);
    return std::move(deck_);
}

Index TagPlaces::find_sparse(DeckTag tag) const
{
    const auto found = std::lower_bound(sparse_.begin(), sparse_.end(), std::pair<DeckTag, Index>{tag, 0});
    return found == sparse_.end() || found->first != tag ? -1 : found->second;
}

} // namespace lacuna::io
