// SPDX-License-Identifier: MIT
#include <lacuna/quads/detail/pave_core.h>

#include <lacuna/geometry/shared/predicates.h>
#include <lacuna/quads/detail/pave_cut.h>
#include <lacuna/quads/detail/pave_fit.h>
#include <lacuna/quads/detail/pave_patch.h>

#include <tuple>

namespace lacuna::quads::paving {
namespace {

/// Finds the best bridge between any two loops. Bridges are cached, because only one loop changes at a time.
/// Pairs of loops farther apart than the best bridge costs are skipped, because no bridge costs less than its
/// length.
class BridgeFinder {
public:
    BridgeFinder(const PartialMesh& partial, const std::vector<Cycle>& loops)
        : partial_(partial), loops_(loops)
    {
        for (const Cycle& loop : loops) {
            box_.emplace_back();
            for (const Index p : loop) box_.back().extend(partial.at(p));
        }
        known_.resize(loops.size() * loops.size());
    }

    [[nodiscard]] std::optional<LoopBridge> find()
    {
        std::vector<std::tuple<double, std::size_t, std::size_t>> pairs;
        for (std::size_t a = 0; a < loops_.size(); ++a) {
            for (std::size_t b = a + 1; b < loops_.size(); ++b) {
                if (!loops_[a].empty() && !loops_[b].empty())
                    pairs.emplace_back(box_[a].exteriorDistance(box_[b]), a, b);
            }
        }
        std::ranges::sort(pairs);
        std::optional<LoopBridge> best;
        for (const auto& [gap, a, b] : pairs) {
            if (best && gap > best->cost) break;
            Known& known = known_[a * loops_.size() + b];
            if (!known.looked) known = {best_bridge(partial_, loops_, a, b), true};
            if (!known.bridge) continue;
            const LoopBridge& bridge = *known.bridge;
            if (!best || std::tie(bridge.cost, a, b) < std::tie(best->cost, best->loop_a, best->loop_b))
                best = bridge;
        }
        return best;
    }

    /// Record that loop a has absorbed loop b, which is now empty, by a line between two nodes.
    void joined(std::size_t a, std::size_t b, Index from, Index to)
    {
        box_[a].extend(box_[b]);
        for (std::size_t i = 0; i < loops_.size(); ++i) {
            for (std::size_t j = i + 1; j < loops_.size(); ++j) {
                Known& known = known_[i * loops_.size() + j];
                if (i == a || j == a || (known.bridge && i != b && j != b && meets(*known.bridge, from, to)))
                    known.looked = false;
            }
        }
    }

private:
    struct Known {
        std::optional<LoopBridge> bridge;
        bool looked = false;
    };

    /// Whether a bridge crosses or touches a line between two nodes.
    [[nodiscard]] bool meets(const LoopBridge& bridge, Index from, Index to) const
    {
        const Vec2 &a = partial_.at(loops_[bridge.loop_a][bridge.cut.from]),
                   &b = partial_.at(loops_[bridge.loop_b][bridge.cut.to]), &c = partial_.at(from),
                   &d = partial_.at(to);
        const auto apart = [](double u, double v) { return (u > 0 && v > 0) || (u < 0 && v < 0); };
        return !apart(geometry::orient2d(a, b, c), geometry::orient2d(a, b, d)) &&
               !apart(geometry::orient2d(c, d, a), geometry::orient2d(c, d, b));
    }

    const PartialMesh& partial_;
    const std::vector<Cycle>& loops_;
    std::vector<Eigen::AlignedBox2d> box_;
    std::vector<Known> known_;
};

/// Join all loops into one, the nearest first.
Cycle join_all(PartialMesh& partial, std::vector<Cycle> loops)
{
    BridgeFinder finder(partial, loops);
    for (std::size_t left = loops.size(); left > 1; --left) {
        std::optional<LoopBridge> best = finder.find();
        if (!best) best = blind_bridge(partial, loops);
        const Index from = loops[best->loop_a][best->cut.from], to = loops[best->loop_b][best->cut.to];
        const Cycle line = nodes_along(partial, from, to, best->cut.edges);
        if (best->cut.edges == 1) partial.link(line.front(), line.back());
        loops[best->loop_a] = join(loops[best->loop_a], loops[best->loop_b], best->cut, line);
        loops[best->loop_b].clear();
        finder.joined(best->loop_a, best->loop_b, from, to);
    }
    return std::move(loops.front());
}

/// The quality above which a part with this many nodes is filled without a cut. A cut costs a few irregular
/// nodes whatever the size of the part; a poor patch makes all its quads poor.
double good_patch(const CutWeights& weights, std::size_t nodes)
{
    // It rises by kSlope with each doubling of the outline above kFrom nodes. A steeper slope cuts large
    // parts more often.
    constexpr double kSlope = 0.2, kFrom = 32;
    return std::clamp(weights.least_patch + kSlope * std::log2(static_cast<double>(nodes) / kFrom),
                      weights.least_patch, weights.most_patch);
}

} // namespace

bool fill_core(PartialMesh& partial, const std::vector<Cycle>& loops, const RunContext& context)
{
    bool is_one_patch = false;
    for_sides_of(loops, [&](Index a, Index b) { partial.link(a, b); });
    std::vector<Cycle> parts{join_all(partial, loops)};
    for (bool is_whole = true; !parts.empty(); is_whole = false) {
        check_cancelled(context);
        const Cycle cycle = std::move(parts.back());
        parts.pop_back();
        if (cycle.size() < 4) continue;
        if (cycle.size() <= 6) {
            fill_small(partial, cycle);
            continue;
        }
        const std::vector<double> angles = corner_angles(partial.points, cycle);
        const PatchFit fit = fit_patch(partial, cycle, angles);
        std::optional<Cut> cut;
        if (fit.quality < good_patch(partial.weights, cycle.size())) cut = best_cut(partial, cycle, angles);
        if (!cut && fit.quality > 0 && fill_patch(partial, cycle, fit.corners)) {
            is_one_patch = is_whole;
            continue;
        }
        if (!cut) cut = blind_cut(partial, cycle);
        const Cycle line = nodes_along(partial, cycle[cut->from], cycle[cut->to], cut->edges);
        if (cut->edges == 1) partial.link(line.front(), line.back());
        auto [one, two] = divide(cycle, *cut, line);
        parts.push_back(std::move(two));
        parts.push_back(std::move(one));
    }
    return is_one_patch;
}

} // namespace lacuna::quads::paving
