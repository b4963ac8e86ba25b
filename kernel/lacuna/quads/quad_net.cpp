// SPDX-License-Identifier: MIT
#include <lacuna/quads/detail/quad_net.h>

#include <lacuna/mesh/quad_mesh.h>

#include <algorithm>
#include <tuple>

namespace lacuna::quads {

QuadNet::QuadNet(std::size_t points, std::vector<Quad> quads)
    : quads_(std::move(quads)), out_(points, -1), valence_(points, 0)
{
    opposite_ = mesh::opposite_sides(quads_, static_cast<Index>(points));
    for (std::size_t side = 0; side < opposite_.size(); ++side) {
        const auto p = index(quads_[side / 4][side % 4]);
        if (out_[p] < 0 || opposite_[side] < 0) out_[p] = static_cast<Index>(side);
        ++valence_[p];
    }
}

void QuadNet::turn_to_boundary(Index point)
{
    Index& out = out_[index(point)];
    const Index first = out;
    while (opposite(out) >= 0) {
        out = after(opposite(out));
        if (out == first) break;
    }
}

std::vector<Index> QuadNet::replace(std::span<const Index> removed, std::span<const Quad> added)
{
    struct Link {
        Index from, to, side;
    };
    const auto less = [](const Link& a, const Link& b) {
        return std::tie(a.from, a.to) < std::tie(b.from, b.to);
    };
    // All sides of the removed quads; `side` is the same side in the neighbouring quad.
    std::vector<Link> outline;
    for (const Index q : removed) {
        for (const Index p : quad(q)) {
            out_[index(p)] = -1;
            --valence_[index(p)];
        }
    }
    for (const Index q : removed) {
        for (Index side = 4 * q; side < 4 * q + 4; ++side)
            outline.push_back({from(side), to(side), opposite(side)});
    }
    for (const Index q : removed) {
        quads_[index(q)] = {-1, -1, -1, -1};
        free_.push_back(q);
    }
    std::ranges::sort(outline, less);

    std::vector<Index> numbers;
    std::vector<Link> sides;
    for (const Quad& quad_added : added) {
        Index q = static_cast<Index>(quads_.size());
        if (free_.empty()) {
            quads_.push_back(quad_added);
            opposite_.resize(opposite_.size() + 4, -1);
        } else {
            q = free_.back();
            free_.pop_back();
            quads_[index(q)] = quad_added;
        }
        numbers.push_back(q);
        for (Index side = 4 * q; side < 4 * q + 4; ++side) {
            sides.push_back({from(side), to(side), side});
            out_[index(from(side))] = side;
            ++valence_[index(from(side))];
        }
    }
    std::ranges::sort(sides, less);
    const auto find = [&](const std::vector<Link>& list, Index a, Index b) {
        const auto found = std::lower_bound(list.begin(), list.end(), Link{a, b, 0}, less);
        return found != list.end() && found->from == a && found->to == b ? &*found : nullptr;
    };
    for (const Link& link : sides) {
        Index other = -1;
        if (const Link* inner = find(sides, link.to, link.from)) {
            other = inner->side;
        } else if (const Link* outer = find(outline, link.from, link.to)) {
            other = outer->side;
            if (other >= 0) opposite_[index(other)] = link.side;
        }
        opposite_[index(link.side)] = other;
    }
    for (const Link& link : sides) turn_to_boundary(link.from);
    return numbers;
}

} // namespace lacuna::quads
