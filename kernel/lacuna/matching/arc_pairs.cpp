// SPDX-License-Identifier: MIT
//
// All positions are shares of the source loop's length. `ShareMap` maps positions on the target to such
// shares.
#include <lacuna/matching/detail/arc_pairs.h>

#include <lacuna/core/shared/constants.h>
#include <lacuna/core/shared/limits.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <tuple>

namespace lacuna::matching {

namespace {

/// Corners further apart than this share of the longest side next to them are not paired. On equal sides,
/// another corner is then closer.
constexpr double kFarCorner = 0.5;

double share(double x)
{
    const double s = x - std::floor(x);
    return s < 1 ? s : 0; // x may be tiny and negative: then s is rounded to 1
}

double round_distance(double a, double b)
{
    const double apart = share(a - b);
    return std::min(apart, 1 - apart);
}

/// Maps shares of the target's length to shares of the source's length, and back: linearly between
/// consecutive pairs; without pairs, by the offset and the direction.
class ShareMap {
public:
    ShareMap(double offset, bool backward, const std::vector<std::pair<double, double>>& fixed)
        : sign_(backward ? -1 : 1), offset_(offset)
    {
        for (const auto& [s, t] : fixed) knots_.emplace_back(s, turned(t));
        std::sort(knots_.begin(), knots_.end());
    }

    [[nodiscard]] double to_source(double t) const { return between(turned(t), true); }
    [[nodiscard]] double to_target(double s) const { return share(offset_ + sign_ * between(s, false)); }

private:
    [[nodiscard]] double turned(double t) const { return share(sign_ * (t - offset_)); }

    /// Convert a share of the target, after `turned()`, to a share of the source, or back.
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

/// Assign to each value of `few` a different value of `many`, in order, with the least sum of squared
/// distances. Both ascend, and `many` has at least as many values.
/// @return the assignment and its sum.
std::pair<std::vector<std::size_t>, double> in_line(const std::vector<double>& few,
                                                    const std::vector<double>& many)
{
    const std::size_t n = few.size(), m = many.size();
    std::vector<std::vector<double>> cost(n + 1, std::vector<double>(m + 1, kInfinity));
    cost[0].assign(m + 1, 0);
    for (std::size_t i = 1; i <= n; ++i) {
        for (std::size_t j = i; j <= m; ++j)
            cost[i][j] = std::min(cost[i][j - 1], cost[i - 1][j - 1] + std::pow(few[i - 1] - many[j - 1], 2));
    }
    std::vector<std::size_t> chosen(n);
    for (std::size_t i = n, j = m; i > 0; --j) {
        if (cost[i][j] == cost[i][j - 1]) continue;
        chosen[--i] = j - 1;
    }
    return {chosen, cost[n][m]};
}

/// The assignment of `in_line()` on a circle: every partner of the first value is tried, and the others are
/// assigned in order.
std::vector<std::size_t> round_about(const std::vector<double>& few, const std::vector<double>& many)
{
    std::vector<std::size_t> best;
    double least = kInfinity;
    for (std::size_t r = 0; r < many.size(); ++r) {
        const double first = many[r] + std::round(few[0] - many[r]);
        const double alone = std::pow(few[0] - first, 2);
        if (alone >= least) continue;
        std::vector<double> rest(few.begin() + 1, few.end()), onward;
        for (std::size_t k = 1; k < many.size(); ++k)
            onward.push_back(first + share(many[(r + k) % many.size()] - many[r]));
        const auto [chosen, cost] = in_line(rest, onward);
        if (alone + cost >= least) continue;
        least = alone + cost;
        best = {r};
        for (const std::size_t k : chosen) best.push_back((r + 1 + k) % many.size());
    }
    return best;
}

/// The state of pairing two loops.
class Pairing {
public:
    Pairing(const ArcLoop& source, const ArcLoop& target, double offset, bool backward, double most_twist)
        : source_(source),
          target_(target),
          offset_(offset),
          backward_(backward),
          most_twist_(most_twist),
          partner_(source.vertices.size(), kNoIndex),
          taken_(target.vertices.size(), kNoIndex)
    {
        fit_shares();
    }

    void pair(VertexId s, VertexId t)
    {
        const auto index = [](const ArcLoop& loop, VertexId v) {
            return static_cast<std::size_t>(std::find(loop.vertices.begin(), loop.vertices.end(), v) -
                                            loop.vertices.begin());
        };
        const std::size_t i = index(source_, s), j = index(target_, t);
        if (i < partner_.size() && j < taken_.size()) pair(i, j);
    }

    /// Compute the positions of the target's vertices from the current pairs.
    void fit_shares()
    {
        std::vector<std::pair<double, double>> knots;
        for (std::size_t i = 0; i < partner_.size(); ++i) {
            if (partner_[i] != kNoIndex) knots.emplace_back(source_.at[i], target_.at[partner_[i]]);
        }
        shares_.emplace(offset_, backward_, knots);
        place_.clear();
        for (const double t : target_.at) place_.push_back(shares_->to_source(t));
    }

    void pair_corners()
    {
        std::vector<std::size_t> knots;
        for (std::size_t i = 0; i < partner_.size(); ++i) {
            if (partner_[i] != kNoIndex) knots.push_back(i);
        }
        if (knots.empty()) pair_corners(0, 1, true);
        for (std::size_t k = 0; k < knots.size(); ++k) {
            const double from = source_.at[knots[k]];
            const double run = knots.size() == 1 ? 1
                                                 : share(source_.at[knots[(k + 1) % knots.size()]] - from);
            pair_corners(from, run, false);
        }
        fit_shares();
    }

    void pair_near()
    {
        std::vector<std::tuple<double, std::size_t, std::size_t>> near;
        for (std::size_t i = 0; i < partner_.size(); ++i) {
            for (std::size_t j = 0; j < taken_.size(); ++j) {
                if (!wants(source_, partner_, i) || !wants(target_, taken_, j)) continue;
                const double reach = std::min(
                    most_twist_, kOnePoint * std::min(side(source_, i, true), side(target_, j, true)));
                const double distance = round_distance(source_.at[i], place_[j]);
                if (distance <= reach) near.emplace_back(distance, i, j);
            }
        }
        std::sort(near.begin(), near.end());
        for (const auto& [distance, i, j] : near) {
            if (partner_[i] == kNoIndex && taken_[j] == kNoIndex) pair(i, j);
        }
        fit_shares();
    }

    ArcPairs result() const
    {
        ArcPairs found;
        for (std::size_t i = 0; i < partner_.size(); ++i) {
            if (partner_[i] != kNoIndex)
                found.vertices.emplace_back(source_.vertices[i], target_.vertices[partner_[i]]);
            else if (source_.corner[i] && wants(source_, partner_, i))
                found.split_target.emplace_back(source_.vertices[i], to_target(i));
        }
        for (std::size_t j = 0; j < taken_.size(); ++j) {
            if (target_.corner[j] && wants(target_, taken_, j))
                found.split_source.emplace_back(target_.vertices[j], place_[j]);
        }
        if (found.vertices.empty() && found.split_target.empty() && found.split_source.empty())
            add_one(found);
        return found;
    }

private:
    void pair(std::size_t i, std::size_t j)
    {
        partner_[i] = j;
        taken_[j] = i;
    }

    [[nodiscard]] double to_target(std::size_t i) const { return shares_->to_target(source_.at[i]); }

    static bool wants(const ArcLoop& loop, const std::vector<std::size_t>& partner, std::size_t i)
    {
        return loop.open[i] && partner[i] == kNoIndex;
    }

    /// Length of the shorter or the longer side next to a vertex, as a share of the loop.
    static double side(const ArcLoop& loop, std::size_t i, bool shorter)
    {
        const std::size_t n = loop.at.size();
        if (n == 1) return 1;
        const double before = share(loop.at[i] - loop.at[(i + n - 1) % n]),
                     after = share(loop.at[(i + 1) % n] - loop.at[i]);
        return shorter ? std::min(before, after) : std::max(before, after);
    }

    /// Pair the unpaired corners between two pairs, or on the whole loops. Corners on walls are included,
    /// because a wall may end before the target.
    void pair_corners(double from, double run, bool whole)
    {
        std::vector<std::pair<double, std::size_t>> low, high;
        const auto add = [&](auto& list, double at, std::size_t i) {
            const double along = share(at - from);
            if (whole || (along > 0 && along < run)) list.emplace_back(along, i);
        };
        for (std::size_t i = 0; i < partner_.size(); ++i) {
            if (source_.corner[i] && partner_[i] == kNoIndex) add(low, source_.at[i], i);
        }
        for (std::size_t j = 0; j < taken_.size(); ++j) {
            if (target_.corner[j] && taken_[j] == kNoIndex) add(high, place_[j], j);
        }
        if (low.empty() || high.empty()) return;
        std::sort(low.begin(), low.end());
        std::sort(high.begin(), high.end());
        const bool more_above = low.size() <= high.size();
        const auto& few = more_above ? low : high;
        const auto& many = more_above ? high : low;
        const auto places = [](const auto& list) {
            std::vector<double> at;
            for (const auto& entry : list) at.push_back(entry.first);
            return at;
        };
        const std::vector<std::size_t> chosen = whole ? round_about(places(few), places(many))
                                                      : in_line(places(few), places(many)).first;
        for (std::size_t k = 0; k < few.size(); ++k) {
            const std::size_t a = few[k].second, b = many[chosen[k]].second;
            const std::size_t i = more_above ? a : b, j = more_above ? b : a;
            const double reach = kFarCorner * std::max(side(source_, i, false), side(target_, j, false));
            if (round_distance(source_.at[i], place_[j]) <= reach) pair(i, j);
        }
    }

    /// Add one split: a loop needs at least one void edge.
    void add_one(ArcPairs& found) const
    {
        std::size_t best = kNoIndex;
        double farthest = -1;
        for (std::size_t i = 0; i < partner_.size(); ++i) {
            if (!source_.open[i]) continue;
            double nearest = 1;
            for (const double place : place_)
                nearest = std::min(nearest, round_distance(source_.at[i], place));
            if (nearest <= farthest) continue;
            farthest = nearest;
            best = i;
        }
        if (best != kNoIndex) found.split_target.emplace_back(source_.vertices[best], to_target(best));
    }

    const ArcLoop& source_;
    const ArcLoop& target_;
    double offset_;
    bool backward_;
    double most_twist_;
    std::vector<std::size_t> partner_; ///< by source vertex: index of its target vertex
    std::vector<std::size_t> taken_;   ///< by target vertex: index of its source vertex
    std::optional<ShareMap> shares_;
    std::vector<double> place_; ///< by target vertex: its position, as a share of the source loop's length
};

} // namespace

ArcPairs pair_by_arc(const ArcLoop& source, const ArcLoop& target, double offset, bool backward,
                     const std::vector<std::pair<VertexId, VertexId>>& hard, double most_twist)
{
    Pairing pairing(source, target, offset, backward, most_twist);
    for (const auto& [s, t] : hard) pairing.pair(s, t);
    pairing.fit_shares();
    pairing.pair_corners();
    pairing.pair_near();
    return pairing.result();
}

bool keeps_order(const ArcLoop& source, const ArcLoop& target, bool backward,
                 const std::vector<std::pair<VertexId, VertexId>>& pairs)
{
    std::vector<std::size_t> places;
    for (const VertexId s : source.vertices) {
        for (const auto& [from, to] : pairs) {
            const auto found = std::find(target.vertices.begin(), target.vertices.end(), to);
            if (from == s && found != target.vertices.end())
                places.push_back(static_cast<std::size_t>(found - target.vertices.begin()));
        }
    }
    if (backward) std::reverse(places.begin(), places.end());
    std::size_t falls = 0;
    for (std::size_t k = 0; k < places.size(); ++k)
        falls += places[(k + 1) % places.size()] <= places[k] ? 1 : 0;
    return falls <= 1;
}

} // namespace lacuna::matching
