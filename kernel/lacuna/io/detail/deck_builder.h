// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/io/deck.h>
#include <lacuna/io/detail/cursor.h>

#include <algorithm>
#include <map>
#include <span>

/// What the readers of meshes share. Internal to this folder.
namespace lacuna::io {

/// Places of nodes or elements by the tags the file gives them, which need not be dense.
class TagPlaces {
public:
    /// `twice(a, b)` is told of places with the same tag, of which the first counts.
    template <class Twice>
    TagPlaces(std::span<const DeckTag> tags, const Twice& twice);
    explicit TagPlaces(std::span<const DeckTag> tags) : TagPlaces(tags, [](Index, Index) {}) {}
    /// -1 where there is none.
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

/// Let values rise, each once.
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

/// The highest of the tags of regions or sets, and of one more.
template <class Entity>
int highest_tag(const std::vector<Entity>& entities, int tag = 0)
{
    for (const Entity& entity : entities) tag = std::max(tag, entity.tag);
    return tag;
}
/// Call `visit(block, e, i)` for all elements, counted by `i`.
template <class Visit>
void each_element(const Deck& deck, const Visit& visit)
{
    std::size_t i = 0;
    for (const DeckBlock& block : deck.blocks)
        for (std::size_t e = 0; e < block.count(); ++e) visit(block, e, i++);
}
/// Which regions have elements.
std::vector<char> used_regions(const Deck& deck);
/// The tags of all elements, block after block.
std::vector<DeckTag> element_tags(const Deck& deck);
/// The block of a shape and word, new where it is the first time.
std::size_t block_of(std::vector<DeckBlock>& blocks, DeckShape shape, std::string_view type);
/// Put an element behind those of another block; without what its card holds behind its nodes.
void copy_element(const DeckBlock& from, std::size_t e, DeckBlock& to);
/// Put the elements of a block behind those of another, likewise.
/// @param first_point   added to the places of points that they name; `first_region` to those of regions.
/// @param raise  added to their tags.
void append_block(const DeckBlock& from, Index first_point, Index first_region, DeckTag raise, DeckBlock& to);
/// Add to the numbers of nodes and elements that a set has.
void raise_numbers(DeckSet& set, DeckTag nodes, DeckTag elements);

/// Gathers what a reader finds.
class DeckBuilder {
public:
    explicit DeckBuilder(DeckFormat format) { deck_.format = format; }

    Deck& deck() { return deck_; }
    std::vector<Vec3>& points() { return deck_.points; }
    /// @throw InvalidInput  more points than can be numbered.
    void add_point(DeckTag tag, const Vec3& point, const Cursor& cursor);

    /// A new region.
    Index add_region(int tag, std::string_view name);
    /// The region of this tag, new where it is the first time. @param group  of several numberings in one
    /// file which.
    Index region_of(int tag, std::string_view name = {}, int group = 0);

    /// As `io::block_of()`.
    std::size_t block_of(DeckShape shape, std::string_view type);
    /// Add an element. @param nodes  places of points or, with `resolve()`, tags, in the order of DeckShape;
    /// -1: left out. @param tag  -1: counted. @param place  for messages, see `resolve()`.
    void add_element(std::size_t block, DeckTag tag, Index region, std::span<const Index> nodes,
                     std::uint64_t place = 0);
    /// Where elements that are added many at a time go, one after the other.
    struct Room {
        Index* nodes;  ///< places of points, in the order of DeckShape
        DeckTag* tags; ///< counted as they are
    };
    /// Add elements of one region, whose nodes and tags are to be filled in before the next are added.
    Room add_elements(std::size_t block, std::size_t count, Index region);
    /// Add a shell of three corners or more; more than four are split into triangles.
    /// @throw InvalidInput  fewer corners, a point that is not there, a polygon that crosses itself.
    void add_face(std::span<const Index> corners, Index region, const Cursor& cursor, DeckTag tag = -1);
    /// Tags of nodes as their places, in all elements so far. @param fail  is called with the element's place
    /// and what is wrong. Elements added with tags must all have been.
    template <class Fail>
    void resolve(const TagPlaces& nodes, const Fail& fail);

    /// Count what is not taken.
    void pass_over(const std::string& what, std::size_t count = 1);

    /// Leave out nodes that an element lists beyond those of its type.
    void pass_over_nodes(const std::string& type, std::size_t count)
    {
        further_nodes_[type] = std::max(further_nodes_[type], count);
    }
    /// Say what was read otherwise than it stands: a sentence without the file's name.
    void warn(const std::string& text) { deck_.warnings.push_back(text); }

    /// What was gathered. @throw InvalidInput "io.unreadable" (a point too far away)
    Deck take(const std::string& path);

private:
    void check_points(const std::string& path) const;
    std::string counted() const;

    Deck deck_;
    std::map<std::pair<int, int>, Index> regions_;
    std::vector<std::vector<std::uint64_t>> places_; ///< of the elements of each block
    std::map<std::string, std::size_t> passed_over_;
    std::map<std::string, std::size_t> further_nodes_; ///< by the elements' type, at most
    DeckTag elements_ = 0;                             ///< counted
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
/// Whether bytes are a binary STL file of one solid, to the byte.
bool is_binary_stl(std::string_view bytes);

template <class Twice>
TagPlaces::TagPlaces(std::span<const DeckTag> tags, const Twice& twice)
{
    DeckTag highest = 0;
    for (const DeckTag tag : tags) highest = std::max(highest, tag);
    // A table up to the highest tag, where it is not much longer than the tags themselves: 4 × is a choice.
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
                     Message(kUnreadable, "{} of type {} names {}, which is not there",
                             numbered("element", block.tags[i / per]), block.type, numbered("node", node)));
            node = place;
        }
    }
    for (std::vector<std::uint64_t>& places : places_) places = {};
}

} // namespace lacuna::io
