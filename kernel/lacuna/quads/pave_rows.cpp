// SPDX-License-Identifier: MIT
#include <lacuna/quads/detail/pave_rows.h>

#include <lacuna/geometry/triangulate.h>
#include <lacuna/quads/detail/pave_gaps.h>

#include <optional>

namespace lacuna::quads::paving {
namespace {

constexpr int kMostQuads = 4;      ///< at a node: a reversal
constexpr double kLeastSine = 0.1; ///< a flatter quad of a row is taken for a fold

Vec2 rotated(const Vec2& v, double angle)
{
    return {v.x() * std::cos(angle) - v.y() * std::sin(angle),
            v.x() * std::sin(angle) + v.y() * std::cos(angle)};
}

/// Height of the row at every node: no more than a third of the way to the other side, and, but for exact rows, changing slowly.
std::vector<double> row_heights(const Draft& draft, const Cycle& cycle, const std::vector<double>& angles,
                                const Gaps& gaps, const std::function<double(const Vec2&)>& height,
                                RowKind kind)
{
    const std::size_t n = cycle.size();
    std::vector<double> heights(n);
    for (std::size_t i = 0; i < n; ++i) {
        const Index before = cycle[(i + n - 1) % n], after = cycle[(i + 1) % n];
        const double wanted = height(draft.at(cycle[i])), reach = std::min(3 * wanted, gaps.diagonal());
        const Vec2 inward = rotated((draft.at(after) - draft.at(cycle[i])).normalized(), angles[i] / 2);
        heights[i] = std::min(wanted, gaps.ahead(before, cycle[i], after, inward, reach) / 3);
    }
    if (kind == RowKind::exact) return heights;
    constexpr double kChange = 1.3; ///< from one node to the next
    for (int pass = 0; pass < 2; ++pass) {
        for (std::size_t k = 0; k < 2 * n; ++k) {
            const std::size_t i = k % n, b = (i + n - 1) % n;
            heights[i] = std::min(heights[i], kChange * heights[b]);
        }
        std::reverse(heights.begin(), heights.end());
    }
    return heights;
}

/// The row of one loop, on trial.
class Row {
public:
    Row(Draft& draft, const Cycle& cycle, RowKind kind)
        : draft_(draft),
          cycle_(cycle),
          n_(cycle.size()),
          kind_(kind),
          least_quads_(kind == RowKind::buffer ? 2 : 1)
    {
    }

    /// The inner side of the row; nothing, and the draft as it was, where it cannot be laid.
    std::optional<Cycle> lay(const Gaps& gaps, const std::function<double(const Vec2&)>& height)
    {
        const std::size_t points = draft_.points.size(), quads = draft_.quads.size();
        for (std::size_t i = 0; i < n_; ++i) angles_.push_back(inner_angle(draft_, cycle_, i));
        heights_ = row_heights(draft_, cycle_, angles_, gaps, height, kind_);
        if (ends_far_apart() && high_enough(height)) {
            place_nodes();
            Cycle inner = add_quads();
            bool good = inner.size() >= 4;
            for (std::size_t q = quads; q < draft_.quads.size() && good; ++q)
                good = least_sine(draft_, draft_.quads[q]) > (least_quads_ > 1 ? 0 : kLeastSine);
            if (good) return inner;
        }
        draft_.points.resize(points);
        draft_.quads.resize(quads);
        return std::nullopt;
    }

private:
    [[nodiscard]] int kind(std::size_t i) const
    {
        return std::clamp(quads_in(angles_[i % n_]), least_quads_, kMostQuads);
    }
    [[nodiscard]] const Vec2& at(std::size_t i) const { return draft_.at(cycle_[i % n_]); }

    /// Each end takes a node off either side: sides of three edges at least keep one.
    [[nodiscard]] bool ends_far_apart() const
    {
        constexpr std::size_t kApart = 3;
        std::size_t first = n_, last = n_;
        for (std::size_t i = 0; i < n_; ++i) {
            if (kind(i) != 1) continue;
            if (last < n_ && i - last < kApart) return false;
            if (first == n_) first = i;
            last = i;
        }
        return first == n_ || first == last || first + n_ - last >= kApart;
    }

    /// A row squeezed on much of its way is worse than none; an exact one may not be squeezed at all.
    [[nodiscard]] bool high_enough(const std::function<double(const Vec2&)>& height) const
    {
        if (kind_ != RowKind::tall && kind_ != RowKind::exact) return true;
        const double kSqueezed = kind_ == RowKind::exact ? 0.99 : 0.6,
                     kMost = kind_ == RowKind::exact ? 0 : 0.25;
        std::size_t squeezed = 0;
        for (std::size_t i = 0; i < n_; ++i) squeezed += heights_[i] < kSqueezed * height(at(i)) ? 1U : 0U;
        return static_cast<double>(squeezed) <= kMost * static_cast<double>(n_);
    }

    /// New nodes over every node, from the side of the edge before to that of the edge after.
    void place_nodes()
    {
        inner_.assign(n_, {});
        for (std::size_t i = 0; i < n_; ++i) {
            const int quads = kind(i);
            if (quads == 1) continue;
            const Vec2 ahead = (at(i + 1) - at(i)).normalized();
            const double step = angles_[i] / quads;
            // A spoke keeps the row's height over both edges where they bend a little.
            const double spoke = heights_[i] / std::clamp(std::sin(step), 0.7, 1.0);
            for (int k = quads - 1; k >= 1; --k) {
                inner_[i].push_back(draft_.add(at(i) + rotated(ahead, k * step) * spoke));
                if (k == 1) break;
                const double diagonal = heights_[i] / std::clamp(std::sin(step / 2), 0.5, 1.0);
                inner_[i].push_back(draft_.add(at(i) + rotated(ahead, (k - 0.5) * step) * diagonal));
            }
        }
        for (std::size_t i = 0; i < n_; ++i) {
            if (kind(i) != 1) continue;
            const std::size_t before = (i + n_ - 1) % n_, after = (i + 1) % n_;
            const Index shared = inner_[before].back();
            draft_.points[static_cast<std::size_t>(shared)] = at(before) + at(after) - at(i);
            inner_[after].front() = shared;
        }
    }

    Cycle add_quads()
    {
        Cycle loop;
        for (std::size_t i = 0; i < n_; ++i) {
            const std::size_t after = (i + 1) % n_, before = (i + n_ - 1) % n_;
            if (kind(i) == 1) {
                draft_.quads.push_back({cycle_[before], cycle_[i], cycle_[after], inner_[after].front()});
                continue;
            }
            for (std::size_t k = 0; k + 2 < inner_[i].size(); k += 2)
                draft_.quads.push_back({cycle_[i], inner_[i][k + 2], inner_[i][k + 1], inner_[i][k]});
            for (const Index p : inner_[i]) {
                if (loop.empty() || loop.back() != p) loop.push_back(p);
            }
            if (kind(after) != 1)
                draft_.quads.push_back({cycle_[i], cycle_[after], inner_[after].front(), inner_[i].back()});
        }
        if (loop.size() > 1 && loop.front() == loop.back()) loop.pop_back();
        return loop;
    }

    Draft& draft_;
    const Cycle& cycle_;
    std::size_t n_;
    RowKind kind_;
    int least_quads_;
    std::vector<double> angles_, heights_;
    std::vector<Cycle> inner_;
};

} // namespace

bool needs_row(const Draft& draft, const Cycle& cycle)
{
    double off = 0;
    for (std::size_t i = 0; i < cycle.size(); ++i) {
        const double angle = inner_angle(draft, cycle, i);
        off += std::abs(angle - quads_in(angle) * kRightAngle);
    }
    return off > kRightAngle / 2;
}

namespace {

std::optional<Cycle> lay_one(Draft& draft, const Cycle& cycle, const Gaps& gaps,
                             const std::function<double(const Vec2&)>& height, RowKind kind)
{
    if (kind != RowKind::buffer) return Row(draft, cycle, kind).lay(gaps, height);
    constexpr int kFlatter = 5; // tries, each half as high
    for (double part = 1; part > std::ldexp(1.0, -kFlatter); part /= 2) {
        auto inner = Row(draft, cycle, kind).lay(gaps, [&](const Vec2& p) { return part * height(p); });
        if (inner) return inner;
    }
    return std::nullopt;
}

} // namespace

int lay_rows(Draft& draft, std::vector<Cycle>& loops, std::vector<bool>& wanted,
             const std::function<double(const Vec2&)>& height, RowKind kind)
{
    std::vector<std::optional<Cycle>> inner(loops.size());
    const std::size_t points = draft.points.size(), quads = draft.quads.size();
    while (true) {
        const Gaps gaps(draft, loops);
        for (std::size_t l = 0; l < loops.size(); ++l) {
            inner[l].reset();
            if (!wanted[l]) continue;
            inner[l] = lay_one(draft, loops[l], gaps, height, kind);
            if (!inner[l]) wanted[l] = false;
        }
        std::vector<Cycle> next;
        for (std::size_t l = 0; l < loops.size(); ++l) next.push_back(inner[l] ? *inner[l] : loops[l]);
        const auto crossing = geometry::find_crossing(draft.points, next);
        if (!crossing) break;
        // Rows that run into each other: the shorter loop gives way, and all are laid again.
        std::size_t out = crossing->loop_a;
        if (!inner[out] || (inner[crossing->loop_b] && loops[crossing->loop_b].size() < loops[out].size()))
            out = crossing->loop_b;
        if (!inner[out]) break; // loops that cross as they were given
        wanted[out] = false;
        draft.points.resize(points);
        draft.quads.resize(quads);
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
