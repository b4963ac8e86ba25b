// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/types.h>
#include <lacuna/topology/model.h>

#include <span>
#include <vector>

namespace lacuna::topology {

/// Triangle sides looked up by their end points: side 3·t + i runs from corner i of triangle t to the next
/// corner.
///
/// Sides are grouped by start point, and each group is sorted by end point. Building the table needs no
/// hashing and is linear in the triangles, except for the sorting of the few sides at a point. A table can be
/// reused for one face after another; the cost of each use depends only on the triangles of that face.
class DirectedSides {
public:
    /// @param points  every corner is in [0, points).
    explicit DirectedSides(std::size_t points) : local_(points, -1) {}

    /// Replace the contents by these triangles, which must outlive the use of the table.
    void read(std::span<const Triangle> triangles);

    [[nodiscard]] std::size_t size() const { return 3 * triangles_.size(); }
    [[nodiscard]] Index from(std::size_t side) const { return triangles_[side / 3][side % 3]; }
    [[nodiscard]] Index to(std::size_t side) const { return triangles_[side / 3][(side + 1) % 3]; }
    /// The first side from one point to another; -1: none.
    [[nodiscard]] Index find(Index from, Index to) const;
    /// The first side in the opposite direction; -1: none.
    [[nodiscard]] Index across(std::size_t side) const { return find(to(side), from(side)); }
    /// The first side with the same end points as an earlier one; -1: none.
    [[nodiscard]] Index first_repeated() const;

    /// Number of points that the triangles use, and number of undirected sides.
    [[nodiscard]] std::size_t point_count() const { return used_.size(); }
    [[nodiscard]] std::size_t undirected_count() const;

private:
    struct Entry {
        Index to, side;
        friend constexpr auto operator<=>(const Entry&, const Entry&) = default;
    };
    [[nodiscard]] std::span<const Entry> leaving(std::size_t local) const
    {
        return std::span(entries_).subspan(index(start_[local]), index(start_[local + 1] - start_[local]));
    }

    std::span<const Triangle> triangles_;
    std::vector<Index> local_; ///< index of each point in `used_`; -1: none
    std::vector<Index> used_;
    std::vector<Index> start_; ///< start of each used point's bucket in `entries_`
    std::vector<Entry> entries_;
};

/// As `euler_number()` of open_volume.h, but calls for several sets of faces can share a table. Linear in the
/// facets of the set.
/// @param sides  a table for the model's points; empty afterwards.
long euler_number(const Model& model, const std::vector<FaceId>& faces, DirectedSides& sides);

} // namespace lacuna::topology
