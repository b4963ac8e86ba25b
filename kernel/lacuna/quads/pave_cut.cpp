// SPDX-License-Identifier: MIT
#include <lacuna/quads/detail/pave_cut.h>

#include <lacuna/core/shared/criteria.h>
#include <lacuna/quads/detail/loop_sides.h>
#include <lacuna/quads/detail/patch_template.h>

namespace lacuna::quads::paving {
namespace {

/// Square of the difference between an angle and the nearest multiple of a right angle, in units of half a
/// right angle.
double angle_cost(double angle)
{
    const double off = (angle - quads_in(angle) * kRightAngle) / (kRightAngle / 2);
    return off * off;
}

/// Finds the best line across a loop.
class CutFinder {
public:
    CutFinder(const PartialMesh& partial, const Cycle& cycle, const std::vector<double>& angles)
        : partial_(partial), cycle_(cycle), angles_(angles), sides_(partial, cycle), n_(cycle.size())
    {
        arc_.assign(n_ + 1, 0);
        heading_.resize(n_);
        pace_.resize(n_);
        for (std::size_t i = 0; i < n_; ++i) {
            const Vec2 side = at(i + 1) - at(i);
            arc_[i + 1] = arc_[i] + side.norm();
            heading_[i] = std::atan2(side.y(), side.x());
            pace_[i] = 1 / partial.size(at(i));
            if (angles[i] < kCornerBelow * kDegree) corners_.push_back(i);
        }
    }

    std::optional<Cut> find()
    {
        const std::vector<std::size_t> places = candidates();
        for (std::size_t t = 1; t < places.size(); ++t) {
            for (std::size_t s = 0; s < t; ++s) {
                if (auto line = line_between(places[s], places[t])) lines_.push_back(*line);
            }
        }
        return cheapest();
    }

private:
    /// The cheapest line that crosses nothing. A line is checked only if it may be cheaper than the cheapest
    /// line so far.
    std::optional<Cut> cheapest()
    {
        // Minimum distance of a line from the nodes that it passes, as a share of its edge length. Nodes at a
        // smaller distance would get quads of half the size. If all lines pass nodes at a smaller distance,
        // the cheapest of them is used.
        constexpr double kAway = 0.5;
        std::optional<Choice> best, near_miss;
        // Lines are taken in order of `Line::cost`. `judge()` adds the cost of the number of edges, so
        // `Line::cost` is a lower bound of the total cost. The search therefore ends after few lines.
        const auto later = [](const Line& a, const Line& b) { return a.cost > b.cost; };
        std::ranges::make_heap(lines_, later);
        for (auto end = lines_.end(); end != lines_.begin();) {
            std::pop_heap(lines_.begin(), end, later);
            const Line& next = *--end;
            if (best && next.cost >= best->cost) break;
            const auto choice = judge(next, best ? best->cost : kInfinity);
            if (!choice || !sides_.is_clear(cycle_[next.from], cycle_[next.to])) continue;
            if (keeps_away(*choice, kAway))
                best = choice;
            else if (!near_miss || choice->cost < near_miss->cost)
                near_miss = choice;
        }
        if (best) return refine(*best, kAway).cut;
        if (near_miss) return refine(*near_miss, 0).cut;
        return std::nullopt;
    }

    struct Choice {
        Cut cut;
        double cost = 0;
    };

    /// A candidate line, before its number of edges is chosen.
    struct Line {
        std::size_t from = 0, to = 0;
        double cost = 0;                   ///< cost of the length, and of the angles at both ends
        double part_from = 0, part_to = 0; ///< angles between the outline and the line
    };

    /// Reduction of a line's cost if it ends at node `i` and the outline turns inward there.
    [[nodiscard]] double gain(std::size_t i) const
    {
        return angles_[i] > kReversalAbove * kDegree ? partial_.weights.bent : 0.0;
    }

    [[nodiscard]] const Vec2& at(std::size_t i) const { return partial_.at(cycle_[i % n_]); }

    /// Whether the distance of a line from all nodes that it passes is at least this share of its edge
    /// length.
    [[nodiscard]] bool keeps_away(const Choice& c, double away) const
    {
        const Vec2 &a = at(c.cut.from), &b = at(c.cut.to), along = b - a;
        const double length = along.norm(), least = away * (length / static_cast<double>(c.cut.edges));
        const Vec2 low = a.cwiseMin(b) - Vec2::Constant(least), high = a.cwiseMax(b) + Vec2::Constant(least);
        return std::ranges::none_of(cycle_, [&](Index p) {
            const Vec2& x = partial_.at(p);
            if (x.x() < low.x() || x.y() < low.y() || x.x() > high.x() || x.y() > high.y()) return false;
            const double at = (x - a).dot(along) / length;
            return at > least && at < length - least && std::abs(cross(along, x - a)) < least * length;
        });
    }

    [[nodiscard]] std::vector<std::size_t> candidates()
    {
        std::vector<std::size_t> bent;
        for (std::size_t i = 0; i < n_; ++i) {
            if (angles_[i] > kReversalAbove * kDegree) bent.push_back(i);
        }
        stride_ = n_ <= kPlacesTried ? 1 : std::max<std::size_t>(2, n_ / kPlacesTried);
        std::vector<std::size_t> places;
        for (std::size_t i = 0; i < n_; i += stride_) places.push_back(i);
        const std::size_t skip = bent.size() / kPlacesTried + 1;
        for (std::size_t i = 0; i < bent.size(); i += skip) places.push_back(bent[i]);
        std::ranges::sort(places);
        places.erase(std::unique(places.begin(), places.end()), places.end());
        return places;
    }

    /// @return empty if the line would be too close to the outline
    [[nodiscard]] std::optional<Line> line_between(std::size_t i, std::size_t j) const
    {
        if (cycle_[i] == cycle_[j]) return std::nullopt;
        const CutWeights& weights = partial_.weights;
        const Vec2 along = at(j) - at(i);
        const double heading = std::atan2(along.y(), along.x());
        const double part_i = whole_turn(heading - heading_[i]);
        // A quad with a sharper angle would be flat.
        if (part_i < kFlatQuad || part_i > angles_[i] - kFlatQuad) return std::nullopt;
        const double part_j = whole_turn(heading + std::numbers::pi - heading_[j]);
        if (part_j < kFlatQuad || part_j > angles_[j] - kFlatQuad) return std::nullopt;
        const double arc = arc_[j] - arc_[i];
        // Length relative to the outline that the line cuts off.
        const double reach = along.norm() / std::min(arc, arc_[n_] - arc);
        const double cost = weights.length * reach - (gain(i) + gain(j)) +
                            end_cost(angles_[i], part_i, weights) * firmness(i) +
                            end_cost(angles_[j], part_j, weights) * firmness(j);
        return Line{i, j, cost, part_i, part_j};
    }

    /// Choose the number of edges on a line, and add the cost of this number to the cost of the line.
    /// @return  the cut and its total cost; empty if no number of edges is possible, or if the cost is `most`
    ///          or more
    [[nodiscard]] std::optional<Choice> judge(const Line& line, double most) const
    {
        const auto& [i, j, cost, part_i, part_j] = line;
        Choice choice{{i, j, 0}, cost};
        if (choice.cost >= most) return std::nullopt;
        // The number of edges is the length times the mean of 1 / size.
        const double wanted = (at(j) - at(i)).norm() *
                              (pace_[i] + 1 / partial_.size((at(i) + at(j)) / 2) + pace_[j]) / 3;
        const std::size_t between = j - i, rest = n_ - between;
        auto edges = static_cast<std::size_t>(std::max(1L, std::lround(wanted)));
        edges = std::min(edges, n_);
        if ((edges + between) % 2 != 0) {
            // Take the nearer of the two neighbouring numbers that have the right parity.
            edges += static_cast<double>(edges) > wanted && edges > 1 ? std::size_t(-1) : 1;
        }
        while (edges > 1 && edges >= std::min(between, rest)) edges -= 2;
        if (edges == 0 || edges >= n_ || edges >= std::min(between, rest) || edges + between < 4 ||
            edges + rest < 4)
            return std::nullopt;
        if (edges == 1 && partial_.linked(cycle_[i], cycle_[j])) return std::nullopt;
        const double ratio = std::abs(std::log2(static_cast<double>(edges) / wanted));
        choice.cut.edges = edges;
        choice.cost += ratio * ratio / 2;
        if (choice.cost >= most) return std::nullopt;
        choice.cost += partial_.weights.mismatch * mismatch(choice.cut, part_i, part_j);
        if (choice.cost >= most) return std::nullopt;
        return choice;
    }

    /// Convert an angle between -2π and 4π to the range from 0 to 2π.
    static double whole_turn(double angle)
    {
        if (angle < 0) return angle + kFullTurn;
        return angle < kFullTurn ? angle : angle - kFullTurn;
    }

    /// Weight of the angles at an end of a line. It is lower at an inner node, because smoothing can move
    /// this node.
    [[nodiscard]] double firmness(std::size_t i) const { return partial_.is_fixed(cycle_[i]) ? 1 : 0.6; }

    /// Cost of unequal numbers of edges on opposite sides, in both parts.
    [[nodiscard]] double mismatch(const Cut& cut, double part_i, double part_j) const
    {
        return part_mismatch(cut.from, cut.to, cut.edges, part_i, angles_[cut.to] - part_j) +
               part_mismatch(cut.to, cut.from, cut.edges, part_j, angles_[cut.from] - part_i);
    }

    /// Mismatch of the part between the line and the outline from `from` to `to`. Parts that a grid can fill
    /// cost least, then patches with one irregular node, then all others.
    [[nodiscard]] double part_mismatch(std::size_t from, std::size_t to, std::size_t edges, double angle_from,
                                       double angle_to) const
    {
        const std::size_t span = (to + n_ - from) % n_, whole = span + edges;
        std::array<std::size_t, 5> corner{};
        std::size_t count = 0;
        const auto add = [&](std::size_t place) {
            if (count < corner.size()) corner[count] = place;
            ++count;
        };
        if (angle_from < kCornerBelow * kDegree) add(0);
        auto next = std::upper_bound(corners_.begin(), corners_.end(), from);
        for (std::size_t k = 0; k < corners_.size() && count <= corner.size(); ++k, ++next) {
            if (next == corners_.end()) next = corners_.begin();
            const std::size_t place = (*next + n_ - from) % n_;
            if (place == 0 || place >= span) break;
            add(place);
        }
        if (angle_to < kCornerBelow * kDegree) add(span);
        if (count < 3 || count > 5) return 0.3;
        SideCounts sides{{}, count};
        for (std::size_t k = 0; k < count; ++k)
            sides.side[k] = static_cast<int>((k + 1 < count ? corner[k + 1] : corner[0] + whole) - corner[k]);
        const auto& side = sides.side;
        if (count == 4) {
            const double off = std::abs(side[0] - side[2]) + std::abs(side[1] - side[3]);
            return off == 0 ? 0 : 0.1 + std::min(0.4, off / 20);
        }
        std::array<int, kMostSides> feet{};
        return spoke_feet(sides, false, feet) ? 0.1 : 0.4;
    }

    /// Try the nodes near the ends of a line, in decreasing steps. This is not needed if all nodes were
    /// tried.
    [[nodiscard]] Choice refine(Choice best, double away) const
    {
        if (stride_ == 1) return best;
        const auto consider = [&](std::size_t one, std::size_t other) {
            const auto [i, j] = std::minmax({one % n_, other % n_});
            if (i == j) return;
            const auto line = line_between(i, j);
            const auto choice = line ? judge(*line, best.cost) : std::nullopt;
            if (choice && sides_.is_clear(cycle_[i], cycle_[j]) && (away == 0 || keeps_away(*choice, away)))
                best = *choice;
        };
        for (std::size_t step = stride_; step > 0; step /= 2) {
            const Choice start = best;
            for (const std::size_t i : {n_ - step, n_, n_ + step}) {
                for (const std::size_t j : {n_ - step, n_, n_ + step})
                    consider(start.cut.from + i, start.cut.to + j);
            }
        }
        // The numbers of edges match only for particular nodes. Therefore every node near either end is
        // tried.
        const Choice start = best;
        for (std::size_t k = 0; k <= 2 * stride_; ++k) {
            consider(start.cut.from + n_ + k - stride_, start.cut.to);
            consider(start.cut.to + n_ + k - stride_, start.cut.from);
        }
        return best;
    }

    const PartialMesh& partial_;
    const Cycle& cycle_;
    const std::vector<double>& angles_;
    LoopSides sides_;
    std::size_t n_;
    std::vector<double> arc_;     ///< for each node, the running length along the loop up to it
    std::vector<double> heading_; ///< direction of the side that leaves each node [radians]
    std::vector<double> pace_;    ///< 1 / size at each node
    std::vector<std::size_t> corners_;
    std::vector<Line> lines_; ///< lines between the candidate nodes
    std::size_t stride_ = 1;
};

} // namespace

double end_cost(double whole, double part, const CutWeights& weights)
{
    const double rest = whole - part;
    const int added = quads_in(part) + quads_in(rest) - quads_in(whole);
    return weights.corners * ((angle_cost(part) + angle_cost(rest)) / 2 + weights.added * std::abs(added));
}

double local_size(const PartialMesh& partial, const Vec2& a, const Vec2& b)
{
    // The number of edges is the length times the mean of 1 / size.
    return 3 / (1 / partial.size(a) + 1 / partial.size((a + b) / 2) + 1 / partial.size(b));
}

std::optional<Cut> best_cut(const PartialMesh& partial, const Cycle& cycle, const std::vector<double>& angles)
{
    return CutFinder(partial, cycle, angles).find();
}

Cycle nodes_along(PartialMesh& partial, Index from, Index to, std::size_t edges)
{
    Cycle line{from};
    for (const Vec2& p : points_between(partial.at(from), partial.at(to), edges, partial.size))
        line.push_back(partial.add(p));
    line.push_back(to);
    return line;
}

std::pair<Cycle, Cycle> divide(const Cycle& cycle, const Cut& cut, const Cycle& line)
{
    const auto at = [&](std::size_t i) { return cycle.begin() + static_cast<std::ptrdiff_t>(i); };
    Cycle one(at(cut.from), at(cut.to) + 1);
    one.insert(one.end(), line.rbegin() + 1, line.rend() - 1);
    Cycle two(at(cut.to), cycle.end());
    two.insert(two.end(), cycle.begin(), at(cut.from) + 1);
    two.insert(two.end(), line.begin() + 1, line.end() - 1);
    return {std::move(one), std::move(two)};
}

Cycle join(const Cycle& a, const Cycle& b, const Cut& cut, const Cycle& line)
{
    Cycle whole;
    whole.reserve(a.size() + b.size() + 2 * line.size());
    for (std::size_t k = 0; k <= a.size(); ++k) whole.push_back(a[(cut.from + k) % a.size()]);
    whole.insert(whole.end(), line.begin() + 1, line.end() - 1);
    for (std::size_t k = 0; k <= b.size(); ++k) whole.push_back(b[(cut.to + k) % b.size()]);
    whole.insert(whole.end(), line.rbegin() + 1, line.rend() - 1);
    return whole;
}

} // namespace lacuna::quads::paving
