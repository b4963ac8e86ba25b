// SPDX-License-Identifier: MIT
#include <lacuna/quads/detail/pave_rows.h>

#include <lacuna/core/shared/criteria.h>
#include <lacuna/geometry/shared/triangulate.h>
#include <lacuna/quads/detail/corner_sine.h>
#include <lacuna/quads/detail/pattern_ring.h>
#include <lacuna/quads/detail/pave_gaps.h>

#include <optional>

namespace lacuna::quads::paving {
namespace {

Vec2 rotated(const Vec2& v, double angle)
{
    return {v.x() * std::cos(angle) - v.y() * std::sin(angle),
            v.x() * std::sin(angle) + v.y() * std::cos(angle)};
}

/// The height of the row at every node. It is at most a third of the distance to the opposite side, except in
/// exact rows. In other rows, heights change gradually.
std::vector<double> row_heights(const PartialMesh& partial, const Cycle& cycle,
                                const std::vector<double>& angles, const GapFinder& gaps,
                                const SizeField& height, RowKind kind)
{
    const std::size_t n = cycle.size();
    std::vector<double> heights(n);
    for (std::size_t i = 0; i < n; ++i) {
        const Index before = cycle[(i + n - 1) % n], after = cycle[(i + 1) % n];
        const double wanted = height(partial.at(cycle[i])), reach = std::min(3 * wanted, gaps.diagonal());
        const Vec2 inward = rotated((partial.at(after) - partial.at(cycle[i])).normalized(), angles[i] / 2);
        heights[i] = std::min(wanted, gaps.ahead(before, cycle[i], after, inward, reach) / 3);
    }
    if (kind == RowKind::exact) return heights;
    for (int pass = 0; pass < 2; ++pass) {
        for (std::size_t k = 0; k < 2 * n; ++k) {
            const std::size_t i = k % n, b = (i + n - 1) % n;
            heights[i] = std::min(heights[i], (1 + kGrading) * heights[b]);
        }
        std::ranges::reverse(heights);
    }
    return heights;
}

/// Places the row of one loop. A row that is not good is removed.
class RowTrial {
public:
    RowTrial(PartialMesh& partial, const Cycle& cycle, RowKind kind)
        : partial_(partial), cycle_(cycle), n_(cycle.size()), kind_(kind)
    {
    }

    /// @return the inner side of the row. Empty if the row cannot be placed; the mesh is then unchanged.
    std::optional<Cycle> lay(const GapFinder& gaps, const SizeField& height)
    {
        const std::size_t points = partial_.points.size(), quads = partial_.quads.size();
        angles_ = corner_angles(partial_.points, cycle_);
        heights_ = row_heights(partial_, cycle_, angles_, gaps, height, kind_);
        if (ends_far_apart() && high_enough(height)) {
            place_nodes();
            Cycle inner = add_quads();
            bool good = inner.size() >= 4;
            for (std::size_t q = quads; q < partial_.quads.size() && good; ++q)
                good = least_sine(partial_, partial_.quads[q]) > kFoldedQuad;
            if (good) return inner;
        }
        partial_.points.resize(points);
        partial_.quads.resize(quads);
        return std::nullopt;
    }

private:
    [[nodiscard]] int kind(std::size_t i) const { return quads_in(angles_[i % n_]); }
    [[nodiscard]] const Vec2& at(std::size_t i) const { return partial_.at(cycle_[i % n_]); }

    [[nodiscard]] bool ends_far_apart() const
    {
        std::vector<std::size_t> ends;
        for (std::size_t i = 0; i < n_; ++i)
            if (kind(i) == 1) ends.push_back(i);
        return ends.size() < 2 || ends_apart(ends, n_);
    }

    /// Whether the row is high enough. A row that is lower than 0.6 of its height on a quarter of its length
    /// is worse than no row. Stricter bounds drop more rows. An exact row may deviate from its height by a
    /// hundredth, which allows for rounding.
    [[nodiscard]] bool high_enough(const SizeField& height) const
    {
        const double kSqueezed = kind_ == RowKind::exact ? 0.99 : 0.6,
                     kMost = kind_ == RowKind::exact ? 0 : 0.25;
        std::size_t squeezed = 0;
        for (std::size_t i = 0; i < n_; ++i) squeezed += heights_[i] < kSqueezed * height(at(i)) ? 1U : 0U;
        return static_cast<double>(squeezed) <= kMost * static_cast<double>(n_);
    }

    /// Place the new nodes of the row. If a node gets several new nodes, these are placed in order from the
    /// edge after the node to the edge before the node.
    void place_nodes()
    {
        inner_.assign(n_, {});
        for (std::size_t i = 0; i < n_; ++i) {
            const int quads = kind(i);
            if (quads == 1) continue;
            const Vec2 ahead = (at(i + 1) - at(i)).normalized();
            const double step = angles_[i] / quads;
            // A spoke is the edge from a node to the new node above it. Where the boundary edges bend
            // slightly, the end of a spoke is at the row's height above both edges. The clamps here and below
            // limit the length of spokes at sharp bends.
            const double spoke = heights_[i] / std::clamp(std::sin(step), 0.7, 1.0);
            for (int k = quads - 1; k >= 1; --k) {
                inner_[i].push_back(partial_.add(at(i) + rotated(ahead, k * step) * spoke));
                if (k == 1) break;
                const double diagonal = heights_[i] / std::clamp(std::sin(step / 2), 0.5, 1.0);
                inner_[i].push_back(partial_.add(at(i) + rotated(ahead, (k - 0.5) * step) * diagonal));
            }
        }
        for (std::size_t i = 0; i < n_; ++i) {
            if (kind(i) != 1) continue;
            const std::size_t before = (i + n_ - 1) % n_, after = (i + 1) % n_;
            const Index shared = inner_[before].back();
            partial_.points[index(shared)] = at(before) + at(after) - at(i);
            inner_[after].front() = shared;
        }
    }

    Cycle add_quads()
    {
        Cycle loop;
        for (std::size_t i = 0; i < n_; ++i) {
            const std::size_t after = (i + 1) % n_, before = (i + n_ - 1) % n_;
            if (kind(i) == 1) {
                partial_.quads.push_back({cycle_[before], cycle_[i], cycle_[after], inner_[after].front()});
                continue;
            }
            for (std::size_t k = 0; k + 2 < inner_[i].size(); k += 2)
                partial_.quads.push_back({cycle_[i], inner_[i][k + 2], inner_[i][k + 1], inner_[i][k]});
            for (const Index p : inner_[i]) {
                if (loop.empty() || loop.back() != p) loop.push_back(p);
            }
            if (kind(after) != 1)
                partial_.quads.push_back({cycle_[i], cycle_[after], inner_[after].front(), inner_[i].back()});
        }
        if (loop.size() > 1 && loop.front() == loop.back()) loop.pop_back();
        return loop;
    }

    PartialMesh& partial_;
    const Cycle& cycle_;
    std::size_t n_;
    RowKind kind_;
    std::vector<double> angles_, heights_;
    std::vector<Cycle> inner_;
};

} // namespace

bool needs_row(const PartialMesh& partial, const Cycle& cycle)
{
    double off = 0;
    for (const double angle : corner_angles(partial.points, cycle))
        off += std::abs(angle - quads_in(angle) * kRightAngle);
    return off > kRightAngle / 2;
}

int lay_rows(PartialMesh& partial, std::vector<Cycle>& loops, std::vector<bool>& wanted,
             const SizeField& height, RowKind kind)
{
    std::vector<std::optional<Cycle>> inner(loops.size());
    const std::size_t points = partial.points.size(), quads = partial.quads.size();
    while (true) {
        const GapFinder gaps(partial, loops);
        for (std::size_t l = 0; l < loops.size(); ++l) {
            inner[l].reset();
            if (!wanted[l]) continue;
            inner[l] = RowTrial(partial, loops[l], kind).lay(gaps, height);
            if (!inner[l]) wanted[l] = false;
        }
        std::vector<Cycle> next;
        for (std::size_t l = 0; l < loops.size(); ++l) next.push_back(inner[l] ? *inner[l] : loops[l]);
        const auto crossing = geometry::find_crossing(partial.points, next);
        if (!crossing) break;
        // If two rows cross, the shorter loop gets no row, and all rows are placed again.
        std::size_t out = crossing->loop_a;
        if (!inner[out] || (inner[crossing->loop_b] && loops[crossing->loop_b].size() < loops[out].size()))
            out = crossing->loop_b;
        if (!inner[out]) break; // the given loops cross
        wanted[out] = false;
        partial.points.resize(points);
        partial.quads.resize(quads);
    }
    int laid = 0;
    for (std::size_t l = 0; l < loops.size(); ++l) {
        if (!inner[l]) continue;
        loops[l] = std::move(*inner[l]);
        ++laid;
    }
    return laid;
}

} // namespace lacuna::quads::paving
