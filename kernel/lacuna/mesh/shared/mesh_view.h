// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/types.h>
#include <lacuna/mesh/cell_shape.h>
#include <lacuna/mesh/mesh_part.h>
#include <lacuna/mesh/shared/orientation.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace lacuna::mesh {

/// A list of indices or numbers, stored as ranges.
class Ranges {
public:
    Ranges() = default;
    Ranges(std::size_t begin, std::size_t end) { add(begin, end); }

    void add(std::size_t begin, std::size_t end);
    [[nodiscard]] std::size_t count() const { return count_; }
    [[nodiscard]] std::size_t operator[](std::size_t i) const
    {
        const Range& range = ranges_[range_at(i)];
        return range.first + (i - range.before);
    }
    /// Call `visit(first, last)` for each range of values at the list positions [begin, end), in order.
    template <class Visit>
    void each(std::size_t begin, std::size_t end, const Visit& visit) const
    {
        for (std::size_t r = begin < end ? range_at(begin) : 0; begin < end; ++r) {
            const std::size_t first = ranges_[r].first + (begin - ranges_[r].before);
            const std::size_t next = r + 1 < ranges_.size() ? ranges_[r + 1].before : count_;
            const std::size_t count = std::min(next, end) - begin;
            visit(first, first + count);
            begin += count;
        }
    }

    /// The list position of a value. @pre the values ascend and include it
    [[nodiscard]] std::size_t position(std::size_t value) const
    {
        const Range& range = ranges_[range_with(value)];
        return range.before + (value - range.first);
    }
    /// @pre the values ascend
    [[nodiscard]] bool contains(std::size_t value) const;

private:
    struct Range {
        std::size_t first;  ///< first value of the range
        std::size_t before; ///< number of list entries before the range
    };
    [[nodiscard]] std::size_t range_at(std::size_t i) const;
    /// The last range that begins at a value or below it; -1: none does.
    [[nodiscard]] std::size_t range_with(std::size_t value) const;

    std::vector<Range> ranges_;
    std::size_t count_ = 0;
};

/// The numbers (tags) of nodes or cells by index: from an array, from ranges, or counted from a first one.
class Numbers {
public:
    Numbers() = default; ///< counted from 1
    explicit Numbers(std::size_t first) : first_(first) {}
    /// @param held  referenced, not copied
    explicit Numbers(std::span<const std::int64_t> held) : held_(held) {}
    explicit Numbers(Ranges ranges)
    {
        if (ranges.count() > 0) ranges_ = std::make_shared<const Ranges>(std::move(ranges));
    }

    [[nodiscard]] bool given() const { return !held_.empty() || ranges_ != nullptr || first_ != 1; }
    [[nodiscard]] std::int64_t operator[](std::size_t i) const
    {
        if (!held_.empty()) return held_[i];
        return static_cast<std::int64_t>(ranges_ != nullptr ? (*ranges_)[i] : i + first_);
    }
    /// Call `visit(i, number)` for the indices [begin, end).
    template <class Visit>
    void each(std::size_t begin, std::size_t end, const Visit& visit) const
    {
        if (!held_.empty()) {
            for (std::size_t i = begin; i < end; ++i) visit(i, held_[i]);
            return;
        }
        const auto count_up = [&](std::size_t first, std::size_t last) {
            for (; first < last; ++first) visit(begin++, static_cast<std::int64_t>(first));
        };
        if (ranges_ != nullptr) return ranges_->each(begin, end, count_up);
        count_up(begin + first_, end + first_);
    }
    /// The lowest and the highest of the first `count` numbers. @pre count > 0
    [[nodiscard]] std::pair<std::int64_t, std::int64_t> bounds(std::size_t count) const;
    /// Call `visit(first, last)` for each maximal range of consecutive numbers at the indices [begin, end).
    template <class Visit>
    void each_range(std::size_t begin, std::size_t end, const Visit& visit) const
    {
        if (ranges_ != nullptr) return ranges_->each(begin, end, visit);
        if (held_.empty() && begin < end) return visit(begin + first_, end + first_);
        while (begin < end) {
            const auto first = static_cast<std::size_t>(held_[begin++]);
            std::size_t last = first + 1;
            for (; begin < end && static_cast<std::size_t>(held_[begin]) == last; ++begin) ++last;
            visit(first, last);
        }
    }

private:
    std::span<const std::int64_t> held_;
    std::shared_ptr<const Ranges> ranges_; ///< copies of the numbers share them
    std::size_t first_ = 1;
};

/// A value for each index, stored as runs. Run: consecutive indices with the same value. An entry has the end
/// of a run (the first index after it) and the value of the run; the ends ascend.
using Runs = std::vector<std::pair<std::size_t, Index>>;

/// Append a run that ends at `end`; the last run is extended if it has the same value.
void add_run(Runs& runs, std::size_t end, Index of);
/// Call `visit(first, last, of)` for the runs within the indices [begin, end), where `of` is the value of the
/// run.
template <class Visit>
void each_run(const Runs& runs, std::size_t begin, std::size_t end, const Visit& visit)
{
    auto run = std::ranges::upper_bound(runs, begin, {}, &Runs::value_type::first);
    for (; begin < end; ++run) {
        const std::size_t last = std::min(run->first, end);
        visit(begin, last, run->second);
        begin = last;
    }
}

/// A mesh as the writers see it, independent of its storage: a swept mesh, layers created on writing, a deck,
/// or several meshes merged into one. Callbacks deliver nodes and cells in blocks, because a call for each
/// cell would be slow. Several threads may call the callbacks at once, for any range and in any order.
/// Repeated calls must return the same results.
struct MeshView {
    /// Receives consecutive points.
    using TakePoints = std::function<void(std::span<const Vec3>)>;

    /// Cells of one dimension and one region that belong to the same groups.
    struct Entity {
        int dimension = 3;
        int tag = 0;                       ///< number among the entities of its dimension, > 0
        int number = 0;                    ///< number among the entities of all dimensions, >= 0
        int region = 0;                    ///< number of the region; 0: none
        std::vector<std::string> groups{}; ///< names
        std::size_t main = 0;              ///< index in `groups` of the group for formats with one group per
                                           ///< cell
        std::vector<int> bounds{};         ///< tags of the entities that bound this entity, if known
    };
    /// Cells of one shape.
    struct Block {
        /// Cells delivered at once: 27 kB for cells of 27 nodes, which fits into the first-level cache.
        static constexpr std::size_t kAtOnce = 256;

        CellShape shape = CellShape::hex8;
        std::string type{}; ///< element type as named in the source file; may be empty
        std::size_t count = 0;
        /// Writes the nodes of the cells [begin, end), cell by cell in the order of `CellShape`, as indices
        /// from 0.
        std::function<void(std::size_t begin, std::size_t end, Index* out)> nodes;
        Numbers tags;  ///< if not given, cells are numbered from 1 in file order
        Runs entities; ///< index of the entity that each cell belongs to
        Runs regions;  ///< index of the region that each cell belongs to; -1: none

        /// Call `visit(i, nodes)` for the cells [begin, end).
        template <class Visit>
        void each_cell(std::size_t begin, std::size_t end, const Visit& visit) const
        {
            std::array<Index, kAtOnce * 27> room;
            const auto size = static_cast<std::size_t>(shape_info(shape).nodes);
            while (begin < end) {
                const std::size_t now = std::min(kAtOnce, end - begin);
                nodes(begin, begin + now, room.data());
                for (std::size_t k = 0; k < now; ++k)
                    visit(begin + k, std::span<const Index>(room.data() + k * size, size));
                begin += now;
            }
        }
    };
    /// A field with one or several values for each cell.
    struct Field {
        std::string name;
        /// Writes the values of the cells [begin, end) of the block with index `block`.
        std::function<void(std::size_t block, std::size_t begin, std::size_t end, double* out)> values;
        std::size_t components = 1;

        /// Call `visit(i, value)` for the cells [begin, end) of a block, for each component in turn.
        template <class Visit>
        void each(std::size_t block, std::size_t begin, std::size_t end, const Visit& visit) const
        {
            std::array<double, 1024> room; // 8 kB, which fits into the first-level cache
            while (begin < end) {
                const std::size_t count = std::min(room.size() / components, end - begin);
                values(block, begin, begin + count, room.data());
                for (std::size_t k = 0; k < count * components; ++k) visit(begin + k / components, room[k]);
                begin += count;
            }
        }
    };
    struct GroupTag {
        int dimension = 0;
        std::string group;
        int tag = 0;
    };
    /// Cells of one property, section or material.
    struct Region {
        int tag = 0;
        std::string name; ///< may be empty
    };
    struct Set {
        SetKind kind = SetKind::elements;
        int tag = 0; ///< number of the group; 0: none
        std::string name;
        std::size_t count = 0; ///< number of members
        /// Members of a set of nodes or cells, ascending; may include entities in `KeptText`.
        Numbers members{};
        std::span<const CellSide> sides{}; ///< members of a set of sides, ascending
        bool listed = false;               ///< whether the set has its own card, even if it equals a region
    };
    /// Text by the index of a node or cell, ascending.
    using TextByIndex = std::span<const std::pair<std::size_t, std::string>>;
    /// Content of a source file besides the mesh, which is copied verbatim.
    struct KeptText {
        std::string head, cards, tail;  ///< text before the mesh, with the mesh, and after it
        std::string instance;           ///< name of the only instance; names in `cards` start with it
        int highest_set = 0;            ///< highest number of a set in `cards`
        TextByIndex points;             ///< fields of a node's card after its coordinates
        std::vector<TextByIndex> cells; ///< by block: fields of a cell's card after its nodes
    };

    /// Pairs of periodic nodes, and the tags of the nodes on both sides.
    struct Periodic {
        PeriodicNodes nodes;
        std::array<std::vector<std::int64_t>, 2> tags;
    };

    std::size_t points = 0;
    std::function<void(std::size_t begin, std::size_t end, const TakePoints& take)> each_point;
    Numbers point_tags;
    std::vector<Block> blocks;
    std::vector<Entity> entities;
    std::function<std::vector<Eigen::AlignedBox3d>()> boxes; ///< computes the bounding boxes of the entities
    std::size_t node_entity = 0; ///< entity of all nodes, for formats that allow only one
    std::vector<Field> fields;
    /// Named lists of entity numbers or of point indices.
    std::vector<std::pair<std::string, std::vector<int>>> lists;
    std::vector<Periodic> periodic;
    std::vector<ContactPair> contacts; ///< contacts of a deck
    /// For each block, the directions of its cells; empty for blocks without solids. Null: not requested.
    std::shared_ptr<const std::vector<std::vector<CellFrame>>> frames;
    std::vector<GroupTag> group_tags; ///< group tags to keep from the source file
    std::vector<Region> regions;      ///< regions of a deck
    std::vector<Set> sets;            ///< sets of a deck
    std::optional<KeptText> kept;     ///< kept text, if the source file has the format to be written
    bool is_deck = false; ///< cells have regions, and entities of all dimensions are numbered together
    std::string unnamed;  ///< name for entities without groups; may be empty
    std::string source;   ///< path of the file from which a part of the mesh was read; empty: none

    [[nodiscard]] std::size_t cells() const;
};

/// The part that each cell of a view belongs to, for partitioned files.
struct ViewParts {
    int parts = 1;
    std::vector<Runs> of;                         ///< for each block: the part of each of its cells, from 0
    std::vector<std::pair<Index, Ranges>> points; ///< part, and indices of the points that it owns
    std::vector<Ranges> used; ///< for each part: points of its cells and ghosts, ascending
    /// Cells of one block that are owned by one part and are ghosts in the same other parts. Ghost: a cell of
    /// another part that a part has as a copy, because the two parts share nodes.
    struct Ghosts {
        Index part = 0;      ///< part that owns the cells
        std::vector<int> of; ///< parts that have them as ghosts, ascending
        std::size_t block = 0;
        Ranges cells;
    };
    std::vector<Ghosts> ghosts;
    bool has_ghosts = false;
};

} // namespace lacuna::mesh
