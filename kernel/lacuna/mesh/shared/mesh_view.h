// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/types.h>
#include <lacuna/mesh/cell_shape.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace lacuna::mesh {

/// A list of places or numbers that is kept as ranges.
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
    /// Call `visit(first, last)` for the ranges that the list's places [begin, end) are, in order.
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

private:
    struct Range {
        std::size_t first;  ///< its first value
        std::size_t before; ///< values of the list before it
    };
    [[nodiscard]] std::size_t range_at(std::size_t i) const;

    std::vector<Range> ranges_;
    std::size_t count_ = 0;
};

/// Numbers of nodes or cells by their places: given in an array, in ranges, or counted from 1.
class Numbers {
public:
    Numbers() = default;
    /// @param held  read, not kept
    explicit Numbers(std::span<const std::int64_t> held) : held_(held) {}
    explicit Numbers(Ranges ranges) : ranges_(std::move(ranges)) {}

    [[nodiscard]] bool given() const { return !held_.empty() || ranges_.count() > 0; }
    [[nodiscard]] std::int64_t operator[](std::size_t i) const
    {
        if (!held_.empty()) return held_[i];
        return static_cast<std::int64_t>(ranges_.count() > 0 ? ranges_[i] : i + 1);
    }
    /// Call `visit(i, number)` for the places [begin, end).
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
        if (ranges_.count() > 0) return ranges_.each(begin, end, count_up);
        count_up(begin + 1, end + 1);
    }
    /// The lowest and the highest of `count` numbers. @pre count > 0
    [[nodiscard]] std::pair<std::int64_t, std::int64_t> bounds(std::size_t count) const;

private:
    std::span<const std::int64_t> held_;
    Ranges ranges_;
};

/// Where runs of places end, rising, and what each run is of.
using Runs = std::vector<std::pair<std::size_t, Index>>;

/// Let a run end at `end`; one of the same goes on.
void add_run(Runs& runs, std::size_t end, Index of);
/// Call `visit(first, last, of)` for the runs among the places [begin, end).
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

/// A mesh as writers see it, whatever holds it: a swept mesh, layers that are made as they are written, a
/// deck, several meshes that are one. Nothing is called for a single cell: callbacks hand over nodes and
/// cells in blocks. They may be called by several threads at once, for any range and in any order, and give
/// the same each time.
struct MeshView {
    /// Takes values that follow each other.
    using TakePoints = std::function<void(std::span<const Vec3>)>;

    /// Cells of one dimension and region that are in the same groups.
    struct Entity {
        int dimension = 3;
        int tag = 0;                       ///< its number among those of its dimension, > 0
        int number = 0;                    ///< where entities of all dimensions are numbered together, >= 0
        int region = 0;                    ///< number of the region; 0: none
        std::vector<std::string> groups{}; ///< names
        std::size_t main = 0;              ///< the group where a cell is in one alone, a place in `groups`
        std::vector<int> bounds{};         ///< tags of the entities that bound it, where they are known
    };
    /// Cells of one shape.
    struct Block {
        /// Cells handed over at once: of 27 nodes 27 kB, which stay in the first-level cache.
        static constexpr std::size_t kAtOnce = 256;

        CellShape shape = CellShape::hex8;
        std::string type{}; ///< as the file they come from calls them; may be empty
        std::size_t count = 0;
        /// Nodes of the cells [begin, end), one cell after the other in the order of `CellShape`, by their
        /// places from 0.
        std::function<void(std::size_t begin, std::size_t end, Index* out)> nodes;
        Numbers tags;  ///< not given: cells are numbered from 1 as they come in the file
        Runs entities; ///< places of the entities that the cells are of

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
    /// A number of each cell.
    struct Field {
        std::string name;
        /// Of the cells [begin, end) of a block, by its place.
        std::function<void(std::size_t block, std::size_t begin, std::size_t end, double* out)> values;

        /// Call `visit(i, value)` for these cells.
        template <class Visit>
        void each(std::size_t block, std::size_t begin, std::size_t end, const Visit& visit) const
        {
            std::array<double, 1024> room; // stays in the first-level cache: a choice
            while (begin < end) {
                const std::size_t count = std::min(room.size(), end - begin);
                values(block, begin, begin + count, room.data());
                for (std::size_t k = 0; k < count; ++k) visit(begin + k, room[k]);
                begin += count;
            }
        }
    };
    struct GroupTag {
        int dimension = 0;
        std::string group;
        int tag = 0;
    };

    std::size_t points = 0;
    std::function<void(std::size_t begin, std::size_t end, const TakePoints& take)> each_point;
    Numbers point_tags;
    std::vector<Block> blocks;
    std::vector<Entity> entities;
    std::function<std::vector<Eigen::AlignedBox3d>()> boxes; ///< makes those round the entities
    std::size_t node_entity = 0; ///< the one that has all nodes where only one may have them
    std::vector<Field> fields;
    /// Names with the numbers of the entities, or the places of the points, that are in them.
    std::vector<std::pair<std::string, std::vector<int>>> lists;
    std::vector<GroupTag> group_tags; ///< that groups have in the file they come from
    bool is_deck = false; ///< cells have regions, and entities of all dimensions are numbered together
    std::string unnamed;  ///< what entities without groups are called; may be empty
    std::string source;   ///< path of the file that some of it comes from; empty: none

    [[nodiscard]] std::size_t cells() const;
};

/// Which part the cells of a view belong to, for files in parts.
struct ViewParts {
    int parts = 1;
    std::vector<Runs> of;                         ///< of each block, the parts from 0
    std::vector<std::pair<Index, Ranges>> points; ///< parts, and places of the points that are theirs
    /// Cells of a block that are ghosts of the same parts.
    struct Ghosts {
        Index part = 0;      ///< whose they are
        std::vector<int> of; ///< the parts they are ghosts of, rising
        std::size_t block = 0;
        Ranges cells;
    };
    std::vector<Ghosts> ghosts;
    bool has_ghosts = false;
};

} // namespace lacuna::mesh
