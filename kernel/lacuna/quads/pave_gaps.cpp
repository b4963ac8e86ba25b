// SPDX-License-Identifier: MIT
#include <lacuna/quads/detail/pave_gaps.h>

namespace lacuna::quads::paving {

Gaps::Gaps(const Draft& draft, const std::vector<Cycle>& loops) : draft_(draft)
{
    double sum = 0, count = 0;
    low_ = Vec2::Constant(std::numeric_limits<double>::infinity());
    Vec2 high = -low_;
    for (const Cycle& loop : loops) {
        for (std::size_t i = 0; i < loop.size(); ++i) {
            const Vec2& p = draft.at(loop[i]);
            low_ = low_.cwiseMin(p);
            high = high.cwiseMax(p);
            sum += (draft.at(loop[(i + 1) % loop.size()]) - p).norm();
            count += 1;
        }
    }
    diagonal_ = (high - low_).norm();
    // As many cells as sides at the most, however far apart they lie.
    cell_ = std::max({sum / count, (high - low_).maxCoeff() / 4096, std::numeric_limits<double>::min()});
    for (const Cycle& loop : loops) {
        for (std::size_t i = 0; i < loop.size(); ++i) {
            const Segment side{loop[i], loop[(i + 1) % loop.size()]};
            const Vec2 a = (draft.at(side[0]) - low_) / cell_, b = (draft.at(side[1]) - low_) / cell_;
            const auto steps = static_cast<int>((b - a).cwiseAbs().maxCoeff() * 2) + 1;
            std::int64_t last = -1;
            for (int k = 0; k <= steps; ++k) {
                const Vec2 p = a + (b - a) * k / steps;
                const std::int64_t at = key(static_cast<std::int64_t>(std::floor(p.x())),
                                            static_cast<std::int64_t>(std::floor(p.y())));
                if (at != last) sides_[at].push_back(side);
                last = at;
            }
        }
    }
}

double Gaps::ahead(Index before, Index node, Index after, const Vec2& direction, double reach) const
{
    const Vec2& p = draft_.at(node);
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
                const Vec2 from = draft_.at(side[0]) - p, along = draft_.at(side[1]) - draft_.at(side[0]);
                const double det = cross(direction, along);
                if (det == 0) continue;
                const double t = cross(from, along) / det, s = cross(from, direction) / det;
                // A little beyond both ends: passing close by is meeting.
                if (t > 0 && s >= -0.2 && s <= 1.2) nearest = std::min(nearest, t);
            }
        }
    }
    return nearest;
}

} // namespace lacuna::quads::paving
