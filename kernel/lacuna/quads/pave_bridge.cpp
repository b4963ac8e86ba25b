// SPDX-License-Identifier: MIT
#include <lacuna/quads/detail/pave_bridge.h>

#include <lacuna/geometry/shared/union_find.h>
#include <lacuna/quads/detail/loop_sides.h>
#include <lacuna/quads/detail/patch_template.h>
#include <lacuna/quads/detail/pave_cut.h>

#include <deque>
#include <queue>
#include <tuple>
#include <unordered_map>

namespace lacuna::quads::paving {
namespace {

/// Number of nearest loops to which lines from a loop are tried. In a plane, a loop has six neighbours on
/// average. More are tried because other loops may be in between.
constexpr std::size_t kNearest = 16;

/// Step between the nodes of a loop from which lines are tried.
std::size_t stride_of(std::size_t n) { return std::max<std::size_t>(1, n / kPlacesTried); }

class LoopJoiner {
public:
    LoopJoiner(PartialMesh& partial, const std::vector<Cycle>& loops)
        : partial_(partial), loops_(loops), cycles_(loops), joined_(loops.size())
    {
        for (const Cycle& loop : loops) {
            angles_.push_back(corner_angles(partial.points, loop));
            sides_.emplace_back(partial, loop);
        }
    }

    std::optional<Cycle> run()
    {
        add_pairs();
        for (std::size_t left = loops_.size(); left > 1;) {
            if (waiting_.empty()) return std::nullopt;
            const Bridge next = waiting_.top();
            waiting_.pop();
            if (joined_.find(next.a) == joined_.find(next.b)) continue;
            if (next.from < 0 || !is_current(next)) {
                if (const auto found = best_between(next.a, next.b)) waiting_.push(*found);
                continue;
            }
            if (lay(next)) --left;
        }
        return std::move(cycles_.front());
    }

private:
    /// A line between two loops. Until a line is searched for, `cost` is a lower bound of the distance of the
    /// loops, and so of the cost of every line between them.
    struct Bridge {
        double cost = 0;
        std::size_t a = 0, b = 0;
        Index from = -1, to = -1; ///< nodes; -1: no line was searched for yet
        std::size_t lines = 0;    ///< number of lines placed before this one was found
        bool operator>(const Bridge& other) const
        {
            return std::tie(cost, a, b) > std::tie(other.cost, other.a, other.b);
        }
    };

    void add_pairs()
    {
        std::vector<std::pair<std::size_t, std::size_t>> pairs;
        std::vector<std::pair<double, std::size_t>> near;
        for (std::size_t a = 0; a < loops_.size(); ++a) {
            near.clear();
            for (std::size_t b = 0; b < loops_.size(); ++b)
                if (b != a) near.emplace_back(sides_[a].gap(sides_[b]), b);
            const auto end = near.begin() + static_cast<std::ptrdiff_t>(std::min(near.size(), kNearest));
            std::ranges::partial_sort(near, end);
            for (auto one = near.begin(); one != end; ++one) pairs.emplace_back(std::minmax(a, one->second));
        }
        std::ranges::sort(pairs);
        pairs.erase(std::ranges::unique(pairs).begin(), pairs.end());
        for (const auto& [a, b] : pairs) waiting_.push({sides_[a].gap(sides_[b]), a, b});
    }

    /// Whether a line is still valid: no line that was placed after its search touches it.
    [[nodiscard]] bool is_current(const Bridge& bridge) const
    {
        for (std::size_t k = bridge.lines; k < lines_.size(); ++k)
            if (std::ranges::count(lines_[k], bridge.from) > 0 ||
                std::ranges::count(lines_[k], bridge.to) > 0 ||
                !of_lines_[k].is_clear(bridge.from, bridge.to))
                return false;
        return true;
    }

    /// A corner of a loop that a line divides: its position, its angle, and the part of the angle up to the
    /// line.
    struct Corner {
        std::size_t at;
        double angle, part;
    };

    /// The corner at a node of a loop, as it is after all joins so far, that a line in direction `along`
    /// divides. Empty if there is none.
    std::optional<Corner> corner_now(std::size_t loop, Index node, const Vec2& along)
    {
        const Cycle& cycle = cycles_[joined_.find(loop)];
        const std::size_t n = cycle.size();
        for (std::size_t k = 0; k < n; ++k) {
            if (cycle[k] != node) continue;
            const Vec2 next = partial_.at(cycle[(k + 1) % n]) - partial_.at(node),
                       last = partial_.at(cycle[(k + n - 1) % n]) - partial_.at(node);
            const Corner corner{k, turn_between(next, last), turn_between(next, along)};
            if (corner.part < corner.angle) return corner;
        }
        return std::nullopt;
    }

    /// The cost of one end of a line; 0 if the end divides the angle well. Empty if the line leads out of the
    /// region.
    std::optional<double> end_cost_at(std::size_t loop, std::size_t i, const Vec2& along)
    {
        const Cycle& own = loops_[loop];
        const Vec2& p = partial_.at(own[i]);
        double angle = angles_[loop][i],
               part = turn_between(partial_.at(own[i + 1 == own.size() ? 0 : i + 1]) - p, along);
        if (const auto divided = corners_.find(own[i]); divided != corners_.end())
            for (const auto& [last, next] : divided->second) {
                angle = turn_between(partial_.at(next) - p, partial_.at(last) - p);
                part = turn_between(partial_.at(next) - p, along);
                if (part < angle) break;
            }
        if (part >= angle) return std::nullopt;
        return end_cost(angle, part, partial_.weights);
    }

    std::optional<Bridge> best_between(std::size_t a, std::size_t b)
    {
        const Cycle &one = loops_[a], &two = loops_[b];
        const Eigen::AlignedBox2d both = sides_[a].box().merged(sides_[b].box());
        std::vector<const LoopSides*> near; // loops and lines that a line may cross
        const auto add = [&](const LoopSides& sides) {
            if (sides.box().intersects(both)) near.push_back(&sides);
        };
        std::ranges::for_each(sides_, add);
        std::ranges::for_each(of_lines_, add);
        std::optional<Bridge> best;
        Cut place;
        // A line is checked only if it may be cheaper than the cheapest line so far. No line costs less than
        // its length.
        const auto consider = [&](std::size_t i, std::size_t j) {
            const Vec2 along = partial_.at(two[j]) - partial_.at(one[i]);
            const double length = along.norm();
            if (one[i] == two[j] || (best && length >= best->cost)) return;
            const auto start = end_cost_at(a, i, along);
            const auto end = start ? end_cost_at(b, j, -along) : std::nullopt;
            if (!end) return;
            const double cost = length * (1 + 0.3 * (*start + *end));
            if (best && cost >= best->cost) return;
            if (!std::ranges::all_of(near,
                                     [&](const LoopSides* sides) { return sides->is_clear(one[i], two[j]); }))
                return;
            best = {cost, a, b, one[i], two[j], lines_.size()};
            place = {i, j};
        };
        const std::size_t n = one.size(), m = two.size(), step_n = stride_of(n), step_m = stride_of(m);
        // The shortest lines are tried first, until no shorter one is left than the cost of the best one.
        std::vector<std::tuple<double, std::size_t, std::size_t>> lines;
        for (std::size_t i = 0; i < n; i += step_n)
            for (std::size_t j = 0; j < m; j += step_m)
                lines.emplace_back((partial_.at(two[j]) - partial_.at(one[i])).norm(), i, j);
        std::ranges::make_heap(lines, std::greater<>());
        while (!lines.empty() && !(best && std::get<0>(lines.front()) >= best->cost)) {
            std::ranges::pop_heap(lines, std::greater<>());
            consider(std::get<1>(lines.back()), std::get<2>(lines.back()));
            lines.pop_back();
        }
        if (!best) return std::nullopt;
        const Cut found = place; // then try the nodes between those that were tried
        for (std::size_t i = 0; i <= 2 * step_n; ++i)
            for (std::size_t j = 0; j <= 2 * step_m; ++j)
                consider((found.from + n + i - step_n) % n, (found.to + m + j - step_m) % m);
        return best;
    }

    /// Place a line. @return  false if it divides no corner of the present joined loops
    bool lay(const Bridge& bridge)
    {
        const Vec2 &p = partial_.at(bridge.from), &q = partial_.at(bridge.to);
        const double wanted = (q - p).norm() / local_size(partial_, p, q);
        const auto from = corner_now(bridge.a, bridge.from, q - p),
                   to = corner_now(bridge.b, bridge.to, p - q);
        if (!from || !to) return false;
        lines_.push_back({bridge.from, bridge.to});
        of_lines_.emplace_back(partial_, lines_.back());
        join_cycles(bridge.a, bridge.b,
                    {from->at, to->at, static_cast<std::size_t>(std::max(1L, std::lround(wanted)))});
        return true;
    }

    void join_cycles(std::size_t a, std::size_t b, Cut cut)
    {
        a = joined_.find(a), b = joined_.find(b);
        // The joined loop that contains the first loop stays at the first index.
        if (a > b) std::swap(a, b), std::swap(cut.from, cut.to);
        const Cycle &one = cycles_[a], &two = cycles_[b];
        const Cycle line = nodes_along(partial_, one[cut.from], two[cut.to], cut.edges);
        if (cut.edges == 1) partial_.link(line.front(), line.back());
        divide_corner(one, cut.from, line[1]);
        divide_corner(two, cut.to, line[line.size() - 2]);
        cycles_[a] = join(one, two, cut, line);
        cycles_[b].clear();
        joined_.unite(a, b);
    }

    /// Divide a corner of a cycle by a line to node `to`.
    void divide_corner(const Cycle& cycle, std::size_t at, Index to)
    {
        const std::size_t n = cycle.size();
        const std::pair whole{cycle[(at + n - 1) % n], cycle[(at + 1) % n]};
        auto& corners = corners_[cycle[at]];
        std::erase(corners, whole);
        corners.insert(corners.end(), {{whole.first, to}, {to, whole.second}});
    }

    PartialMesh& partial_;
    const std::vector<Cycle>& loops_;
    /// Each joined loop is stored at the index of one of its loops; the entries of its other loops are empty.
    std::vector<Cycle> cycles_;
    geometry::UnionFind joined_;
    std::vector<std::vector<double>> angles_;
    std::vector<LoopSides> sides_;
    std::deque<Cycle> lines_; ///< the two end nodes of each line
    std::deque<LoopSides> of_lines_;
    /// At the nodes where lines end: the last and the next node at each of the corners.
    std::unordered_map<Index, std::vector<std::pair<Index, Index>>> corners_;
    std::priority_queue<Bridge, std::vector<Bridge>, std::greater<>> waiting_;
};

} // namespace

std::optional<Cycle> join_loops(PartialMesh& partial, const std::vector<Cycle>& loops)
{
    return LoopJoiner(partial, loops).run();
}

} // namespace lacuna::quads::paving
