// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/types.h>
#include <lacuna/topology/model.h>

#include <span>
#include <vector>

namespace lacuna::topology {

/// The sides of triangles by the points they run between: side 3·t + i runs from corner i of triangle t to
/// the next corner.
///
/// Sides are put in heaps by the point they leave, each sorted by the point they reach. So making the table
/// is linear in the triangles, but for the sorting of the few sides at a point, and needs no hashing. A table
/// can be used for the triangles of one face after another: what it costs is in the triangles of each.
class DirectedSides {
public:
    /// @param points  every corner lies in [0, points).
    explicit DirectedSides(std::size_t points) : local_(points, -1) {}

    /// Forget what there was and take these triangles, which must outlive the table's use.
    void read(std::span<const Triangle> triangles);

    [[nodiscard]] std::size_t size() const { return 3 * triangles_.size(); }
    [[nodiscard]] Index from(std::size_t side) const { return triangles_[side / 3][side % 3]; }
    [[nodiscard]] Index to(std::size_t side) const { return triangles_[side / 3][(side + 1) % 3]; }
    /// The first side from one point to another; -1 where there is none.
    [[nodiscard]] Index find(Index from, Index to) const;
    /// The side that runs the other way.
    [[nodiscard]] Index across(std::size_t side) const { return find(to(side), from(side)); }
    /// The first side that runs as one before it does; -1 where there is none.
    [[nodiscard]] Index first_repeated() const;

    /// How many points the triangles use, and how many sides they have whichever way these run.
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
    std::vector<Index> local_; ///< place of each point among `used_`; -1: none
    std::vector<Index> used_;
    std::vector<Index> start_; ///< of each used point's heap in `entries_`
    std::vector<Entry> entries_;
};

/// euler_number() of open_volume.h for one set of faces after another. Linear in the facets of each.
/// @param sides  a table for the model's points; holds no triangles afterwards.
long euler_number(const Model& model, const std::vector<FaceId>& faces, DirectedSides& sides);

} // namespace lacuna::topology
