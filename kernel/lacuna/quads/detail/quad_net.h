// SPDX-License-Identifier: MIT
#pragma once

/// Quads whose connections change; for fixed connections see `Stars`.

#include <lacuna/core/types.h>

#include <cstddef>
#include <span>
#include <vector>

namespace lacuna::quads {

/// Quads with their neighbours. Side i of quad q has the number 4q + i, from corner i to corner i + 1.
class QuadNet {
public:
    /// @pre  sides are used once, or twice in opposite directions
    QuadNet(std::size_t points, std::vector<Quad> quads);

    [[nodiscard]] const Quad& quad(Index q) const { return quads_[index(q)]; }
    [[nodiscard]] std::size_t quad_slots() const { return quads_.size(); }
    [[nodiscard]] std::size_t points() const { return out_.size(); }
    [[nodiscard]] bool is_used(Index point) const { return out_[index(point)] >= 0; }
    [[nodiscard]] bool is_live(Index q) const { return quad(q)[0] >= 0; }
    [[nodiscard]] Index from(Index side) const
    {
        const auto i = index(side);
        return quads_[i / 4][i % 4];
    }
    [[nodiscard]] Index to(Index side) const
    {
        const auto i = index(side);
        return quads_[i / 4][(i + 1) % 4];
    }
    /// The same side in the neighbouring quad, or -1.
    [[nodiscard]] Index opposite(Index side) const { return opposite_[index(side)]; }
    [[nodiscard]] static Index before(Index side) { return (side & ~3) + ((side + 3) & 3); }
    [[nodiscard]] static Index after(Index side) { return (side & ~3) + ((side + 1) & 3); }

    [[nodiscard]] bool on_boundary(Index point) const { return opposite(out_[index(point)]) < 0; }
    /// Quads at a point.
    [[nodiscard]] int valence(Index point) const { return valence_[index(point)]; }
    /// Call `visit(side)` with the side that leaves the point in each of its quads, counter-clockwise.
    template <class Visit>
    void for_sides(Index point, const Visit& visit) const
    {
        const Index first = out_[index(point)];
        Index side = first;
        while (side >= 0) {
            visit(side);
            side = opposite(before(side));
            if (side == first) break;
        }
    }

    Index add_point()
    {
        out_.push_back(-1);
        valence_.push_back(0);
        return static_cast<Index>(out_.size()) - 1;
    }
    /// Replace quads by other quads with the same outline. @return  the numbers of the new quads. New quads
    /// reuse the numbers of removed ones, starting with the quad that was removed last.
    std::vector<Index> replace(std::span<const Index> removed, std::span<const Quad> added);

private:
    void turn_to_boundary(Index point);

    std::vector<Quad> quads_; ///< a removed quad has -1 as its first corner
    std::vector<Index> opposite_;
    std::vector<Index>
        /// For each point, a side that starts there; on the boundary, the first one counter-clockwise; -1: no
        /// quad.
        out_;
    std::vector<int> valence_;
    std::vector<Index> free_;
};

} // namespace lacuna::quads
