// SPDX-License-Identifier: MIT
#include <lacuna/matching/arc_pairs.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <tuple>

namespace lacuna::matching {

namespace {

/// Vertices no further apart than this stand in one place: how far a loop may have been laid, of its length.
constexpr double kSame = 1.0 / 128;

double share(double x) { return x - std::floor(x); }

/// A map of the circle that takes the target's shares to the source's: piecewise linear between hard pairs, a turn without them.
class Stretch {
public:
    Stretch(double offset, bool backward, std::vector<std::pair<double, double>> fixed)
        : sign_(backward ? -1 : 1), offset_(offset)
    {
        for (auto& [s, t] : fixed) knots_.emplace_back(s, turned(t));
        std::sort(knots_.begin(), knots_.end());
    }

    [[nodiscard]] double to_source(double t) const { return between(turned(t), true); }
    [[nodiscard]] double to_target(double s) const { return share(offset_ + sign_ * between(s, false)); }

private:
    [[nodiscard]] double turned(double t) const { return share(sign_ * (t - offset_)); }

    /// From the target's turned shares to the source's, or back.
    [[nodiscard]] double between(double x, bool from_target) const
    {
        if (knots_.empty()) return share(x);
        const auto at = [&](const std::pair<double, double>& knot) {
            return from_target ? knot.second : knot.first;
        };
        const auto other = [&](const std::pair<double, double>& knot) {
            return from_target ? knot.first : knot.second;
        };
        for (std::size_t k = 0; k < knots_.size(); ++k) {
            const auto& low = knots_[k];
            const auto& high = knots_[(k + 1) % knots_.size()];
            double run = share(at(high) - at(low)), rise = share(other(high) - other(low));
            if (knots_.size() == 1) run = rise = 1;
            const double along = share(x - at(low));
            if (along < run) return share(other(low) + rise * along / run);
        }
        return share(x);
    }

    double sign_, offset_;
    std::vector<std::pair<double, double>> knots_; ///< (source, turned target)
};

} // namespace

ArcPairs pair_by_arc(const ArcLoop& source, const ArcLoop& target, double offset, bool backward,
                     const std::vector<std::pair<VertexId, VertexId>>& hard)
{
    const auto index_of = [](const ArcLoop& loop, VertexId v) {
        return static_cast<std::size_t>(std::find(loop.vertices.begin(), loop.vertices.end(), v) -
                                        loop.vertices.begin());
    };
    std::vector<std::size_t> partner(source.vertices.size(), target.vertices.size());
    std::vector<bool> taken(target.vertices.size(), false);
    std::vector<std::pair<double, double>> fixed;
    for (const auto& [s, t] : hard) {
        const std::size_t i = index_of(source, s), j = index_of(target, t);
        if (i == source.vertices.size() || j == target.vertices.size()) continue;
        partner[i] = j;
        taken[j] = true;
        fixed.emplace_back(source.at[i], target.at[j]);
    }
    const Stretch stretch(offset, backward, fixed);

    std::vector<std::tuple<double, std::size_t, std::size_t>> near;
    const double reach = 0.25 / static_cast<double>(std::max(source.vertices.size(), target.vertices.size()));
    for (std::size_t i = 0; i < source.vertices.size(); ++i) {
        for (std::size_t j = 0; j < target.vertices.size(); ++j) {
            if (partner[i] < target.vertices.size() || taken[j]) continue;
            const double apart = share(stretch.to_source(target.at[j]) - source.at[i]);
            const double distance = std::min(apart, 1 - apart);
            if (distance < (source.corner[i] && target.corner[j] ? reach : kSame))
                near.emplace_back(distance, i, j);
        }
    }
    std::sort(near.begin(), near.end());
    for (const auto& [distance, i, j] : near) {
        if (partner[i] < target.vertices.size() || taken[j]) continue;
        partner[i] = j;
        taken[j] = true;
    }

    ArcPairs result;
    for (std::size_t i = 0; i < source.vertices.size(); ++i) {
        if (partner[i] < target.vertices.size())
            result.vertices.emplace_back(source.vertices[i], target.vertices[partner[i]]);
        else
            result.split_target.emplace_back(source.vertices[i], stretch.to_target(source.at[i]));
    }
    for (std::size_t j = 0; j < target.vertices.size(); ++j) {
        if (!taken[j] && target.corner[j])
            result.split_source.emplace_back(target.vertices[j], stretch.to_source(target.at[j]));
    }
    return result;
}

} // namespace lacuna::matching
