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
/// Sides are bucketed by start point, each bucket sorted by end point. Building the table is thus linear in
/// the triangles, except for the sorting of the few sides at a point, and needs no hashing. A table can be
/// reused for one face after another; the cost depends only on the triangles of each.
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

/// euler_number() of open_volume.h for a series of face sets. Linear in the facets of each.
/// @param sides  a table for the model's points; empty afterwards.
long euler_number(const Model& model, const std::vector<FaceId>& faces, DirectedSides& sides);

} // namespace lacuna::topology
