// SPDX-License-Identifier: MIT
#include <lacuna/quads/detail/pave_gaps.h>

namespace lacuna::quads::paving {

GapFinder::GapFinder(const PartialMesh& partial, const std::vector<Cycle>& loops) : partial_(partial)
{
    double sum = 0, count = 0;
    Eigen::AlignedBox2d box;
    for_sides_of(loops, [&](Index from, Index to) {
        const Vec2& p = partial.at(from);
        box.extend(p);
        sum += (partial.at(to) - p).norm();
        count += 1;
    });
    low_ = box.min();
    diagonal_ = box.sizes().norm();
    // With cells as wide as a mean side, the number of entries is proportional to the number of sides.
    cell_ = std::max(sum / count, std::numeric_limits<double>::min());
    for_sides_of(loops, [&](Index from, Index to) {
        const Vec2 a = (partial.at(from) - low_) / cell_, b = (partial.at(to) - low_) / cell_;
        const auto steps = static_cast<int>((b - a).cwiseAbs().maxCoeff() * 2) + 1;
        std::int64_t last = -1;
        for (int k = 0; k <= steps; ++k) {
            const Vec2 p = a + (b - a) * k / steps;
            const std::int64_t at = key(static_cast<std::int64_t>(std::floor(p.x())),
                                        static_cast<std::int64_t>(std::floor(p.y())));
            if (at != last) sides_[at].push_back({from, to});
            last = at;
        }
    });
}

double GapFinder::ahead(Index before, Index node, Index after, const Vec2& direction, double reach) const
{
    const Vec2& p = partial_.at(node);
    const Vec2 a = (p - low_) / cell_, b = (p + reach * direction - low_) / cell_;
    const auto span = [](double u, double v) {
        return std::pair(static_cast<std::int64_t>(std::floor(std::min(u, v))) - 1,
                         static_cast<std::int64_t>(std::floor(std::max(u, v))) + 1);
    };
    const auto [x0, x1] = span(a.x(), b.x());
    const auto [y0, y1] = span(a.y(), b.y());
    double nearest = reach;
    for (std::int64_t x = x0; x <= x1; ++x) {
        for (std::int64_t y = y0; y <= y1; ++y) {
            const auto found = sides_.find(key(x, y));
            if (found == sides_.end()) continue;
            for (const Segment& side : found->second) {
                if (side[0] == node || side[1] == node || side[0] == before || side[1] == before ||
                    side[0] == after || side[1] == after)
                    continue;
                const Vec2 from = partial_.at(side[0]) - p,
                           along = partial_.at(side[1]) - partial_.at(side[0]);
                const double det = cross(direction, along);
                if (det == 0) continue;
                const double t = cross(from, along) / det, s = cross(from, direction) / det;
                // A ray that passes an end of a side within a fifth of the side's length counts as meeting
                // the side. With a larger share, rows near such ends are lower. With a smaller share, rows
                // may meet.
                constexpr double kBeyond = 0.2;
                if (t > 0 && s >= -kBeyond && s <= 1 + kBeyond) nearest = std::min(nearest, t);
            }
        }
    }
    return nearest;
}

} // namespace lacuna::quads::paving
