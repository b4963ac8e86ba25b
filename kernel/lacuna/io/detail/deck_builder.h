// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/shared/same_corners.h>
#include <lacuna/io/deck.h>
#include <lacuna/io/detail/cursor.h>

#include <algorithm>
#include <map>
#include <span>

/// Common parts of the mesh readers. Internal to this folder.
namespace lacuna::io {

/// Indices of nodes or elements by their tags in the file, which need not be dense.
class TagPlaces {
public:
    /// @param twice  called as twice(a, b) for two indices with the same tag; the first of them is used.
    template <class Twice>
    TagPlaces(std::span<const DeckTag> tags, const Twice& twice);
    explicit TagPlaces(std::span<const DeckTag> tags) : TagPlaces(tags, [](Index, Index) {}) {}
    /// @return  -1: none.
    [[nodiscard]] Index find(DeckTag tag) const
    {
        return tag >= 0 && static_cast<std::uint64_t>(tag) < dense_.size()
                   ? dense_[static_cast<std::size_t>(tag)]
                   : find_sparse(tag);
    }

private:
    [[nodiscard]] Index find_sparse(DeckTag tag) const;

    std::vector<Index> dense_;
    std::vector<std::pair<DeckTag, Index>> sparse_;
};

/// Sort the values and remove duplicates.
template <class Value>
void tidy(std::vector<Value>& values)
{
    if (!std::ranges::is_sorted(values)) std::ranges::sort(values);
    values.erase(std::unique(values.begin(), values.end()), values.end());
}
inline void tidy(DeckSet& set)
{
    tidy(set.members);
    tidy(set.sides);
}

/// The highest of the tags of all regions or sets and a given tag.
template <class Entity>
int highest_tag(const std::vector<Entity>& entities, int tag = 0)
{
    for (const Entity& entity : entities) tag = std::max(tag, entity.tag);
    return tag;
}
/// Call `visit(block, e, i)` for all elements; `i` counts them.
template <class Visit>
void each_element(const Deck& deck, const Visit& visit)
{
    std::size_t i = 0;
    for (const DeckBlock& block : deck.blocks)
        for (std::size_t e = 0; e < block.count(); ++e) visit(block, e, i++);
}
/// The corners of a shell as those of a face; the fourth is -1 for a triangle.
inline Quad shell_corners(DeckShape shape) { return {0, 1, 2, shape_info(shape).corners == 4 ? 3 : -1}; }
/// Group the faces of solids and the shells of a deck by their corners: call `take(faces)` for each group.
/// The number of a face is 8 × the number of its element, as each_element() counts, plus its side (from 1),
/// or plus 0 for a shell.
template <class Take>
void each_with_same_nodes(const Deck& deck, const Take& take)
{
    const auto each = [&](const auto& visit) {
        each_element(deck, [&](const DeckBlock& block, std::size_t e, std::size_t i) {
            const auto visit_side = [&](Quad corners, std::uint64_t side) {
                for (Index& k : corners) k = k < 0 ? -1 : block.element(e)[index(k)];
                visit(corners, 8 * std::uint64_t(i) + side);
            };
            if (shape_info(block.shape).dimension == 2) visit_side(shell_corners(block.shape), 0);
            std::uint64_t side = 0;
            for (const Quad& face : face_corners(block.shape)) visit_side(face, ++side);
        });
    };
    each_with_same_corners(deck.points.size(), each, take);
}
/// Whether each region has elements.
std::vector<char> used_regions(const Deck& deck);
/// The tags of all elements, block after block.
std::vector<DeckTag> element_tags(const Deck& deck);
/// The block of a shape and type word, created on first use.
std::size_t block_of(std::vector<DeckBlock>& blocks, DeckShape shape, std::string_view type);
/// A copy of a block without the elements for which `gone(e)` holds.
template <class Gone>
DeckBlock without_elements(const DeckBlock& block, const Gone& gone)
{
    DeckBlock kept{.shape = block.shape, .type = block.type};
    auto more = block.more.begin();
    for (std::size_t e = 0; e < block.count(); ++e) {
        const bool has_more = more != block.more.end() && more->first == e;
        const auto card = has_more ? more++ : more;
        if (gone(e)) continue;
        if (has_more) kept.more.emplace_back(kept.count(), card->second);
        kept.nodes.insert(kept.nodes.end(), block.element(e).begin(), block.element(e).end());
        kept.tags.push_back(block.tags[e]);
        kept.regions.push_back(block.regions[e]);
    }
    return kept;
}
/// Append the elements of a block to another, without the card fields after their nodes (`DeckBlock::more`).
/// @param first_point   added to the point indices; `first_region` is added to the region indices.
/// @param raise  added to the tags.
void append_block(const DeckBlock& from, Index first_point, Index first_region, DeckTag raise, DeckBlock& to);
/// Add an offset to the node and element numbers in a set.
void raise_numbers(DeckSet& set, DeckTag nodes, DeckTag elements);

/// Collects the data found by a reader.
class DeckBuilder {
public:
    explicit DeckBuilder(DeckFormat format) { deck_.format = format; }

    Deck& deck() { return deck_; }
    std::vector<Vec3>& points() { return deck_.points; }
    /// @throw InvalidInput  more points than can be numbered.
    void add_point(DeckTag tag, const Vec3& point, const Cursor& cursor);

    Index add_region(int tag, std::string_view name);
    /// The region with this tag, created on first use. @param group  number of the numbering that the tag
    /// belongs to, if a file has several numberings.
    Index region_of(int tag, std::string_view name = {}, int group = 0);

    /// As `io::block_of()`.
    std::size_t block_of(DeckShape shape, std::string_view type);
    /// Add an element.
    /// @param tag    -1: its number in the order of addition.
    /// @param nodes  in the order of DeckShape: indices of points or, with `resolve()`, tags; -1: omitted.
    /// @param place  position in the file for messages of `resolve()`.
    void add_element(std::size_t block, DeckTag tag, Index region, std::span<const Index> nodes,
                     std::uint64_t place = 0);
    /// Memory for elements that are added in bulk.
    struct Room {
        Index* nodes;  ///< indices of points, in the order of DeckShape
        DeckTag* tags; ///< filled with consecutive numbers at first
    };
    /// Add elements of one region. The caller must fill in their nodes and tags before it adds others.
    Room add_elements(std::size_t block, std::size_t count, Index region);
    /// Add a shell with three or more corners; more than four are split into triangles.
    /// @throw InvalidInput  fewer corners, an unknown point, a polygon that intersects itself.
    void add_face(std::span<const Index> corners, Index region, const Cursor& cursor, DeckTag tag = -1);
    /// Replace node tags by point indices in all elements. All of them must have been added with tags.
    /// @param fail  called with the element's place and the error.
    template <class Fail>
    void resolve(const TagPlaces& nodes, const Fail& fail);

    /// Count content that is ignored.
    void pass_over(const std::string& what, std::size_t count = 1);

    /// Ignore the nodes that elements list beyond those of their type, and count them.
    void pass_over_nodes(const std::string& type, std::size_t count)
    {
        further_nodes_[type] = std::max(further_nodes_[type], count);
    }
    /// Add a warning about content that was read differently from the file: a sentence that does not name the
    /// file.
    void warn(const std::string& text) { deck_.warnings.push_back(text); }

    /// The collected deck. @throw InvalidInput "io.unreadable" (a point too far away)
    Deck take(const std::string& path);

private:
    void check_points(const std::string& path) const;

    Deck deck_;
    std::map<std::pair<int, int>, Index> regions_;
    std::vector<std::vector<std::uint64_t>> places_; ///< place in the file of each element of each block
    std::map<std::string, std::size_t> passed_over_;
    std::map<std::string, std::size_t> further_nodes_; ///< for each element type, the largest number of
                                                       ///< surplus nodes
    DeckTag elements_ = 0;                             ///< number of elements
};

void read_stl(Cursor& cursor, DeckBuilder& into);
void read_obj(Cursor& cursor, DeckBuilder& into);
void read_msh(Cursor& cursor, DeckBuilder& into);
void read_unv(Cursor& cursor, DeckBuilder& into);
void read_nastran(Cursor& cursor, DeckBuilder& into);
void read_abaqus(Cursor& cursor, DeckBuilder& into);
void read_vtk(Cursor& cursor, DeckBuilder& into);
void read_vtu(Cursor& cursor, DeckBuilder& into);
void read_medit(Cursor& cursor, DeckBuilder& into);
void read_exodus(Cursor& cursor, DeckBuilder& into);
/// Whether bytes are a binary STL file of one solid, with exactly the right size.
bool is_binary_stl(std::string_view bytes);

template <class Twice>
TagPlaces::TagPlaces(std::span<const DeckTag> tags, const Twice& twice)
{
    DeckTag highest = 0;
    for (const DeckTag tag : tags) highest = std::max(highest, tag);
    // Use a table up to the highest tag if that is at most 4 × the number of tags. A higher factor makes more
    // lookups direct, but wastes memory for sparse tags. Not measured.
    if (static_cast<std::uint64_t>(highest) / 4 <= tags.size()) {
        dense_.assign(static_cast<std::size_t>(highest) + 1, -1);
        for (std::size_t i = 0; i < tags.size(); ++i) {
            Index& place = dense_[static_cast<std::size_t>(tags[i])];
            if (place >= 0)
                twice(place, static_cast<Index>(i));
            else
                place = static_cast<Index>(i);
        }
        return;
    }
    sparse_.reserve(tags.size());
    for (std::size_t i = 0; i < tags.size(); ++i) sparse_.emplace_back(tags[i], static_cast<Index>(i));
    std::sort(sparse_.begin(), sparse_.end());
    for (std::size_t i = 1; i < sparse_.size(); ++i)
        if (sparse_[i].first == sparse_[i - 1].first) twice(sparse_[i - 1].second, sparse_[i].second);
}

template <class Fail>
void DeckBuilder::resolve(const TagPlaces& nodes, const Fail& fail)
{
    for (std::size_t b = 0; b < deck_.blocks.size(); ++b) {
        DeckBlock& block = deck_.blocks[b];
        const auto per = static_cast<std::size_t>(shape_info(block.shape).nodes);
        for (std::size_t i = 0; i < block.nodes.size(); ++i) {
            Index& node = block.nodes[i];
            if (node == -1) continue;
            const Index place = nodes.find(node);
            if (place < 0)
                fail(places_[b][i / per],
                     Message(kUnreadable, "{} of type {} names {}, which does not exist",
                             numbered("element", block.tags[i / per]), block.type, numbered("node", node)));
            node = place;
        }
    }
    for (std::vector<std::uint64_t>& places : places_) places = {};
}

} // namespace lacuna::io
