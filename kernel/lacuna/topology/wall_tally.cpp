// SPDX-License-Identifier: MIT
#include <lacuna/topology/detail/wall_tally.h>

#include <lacuna/geometry/shared/union_find.h>

#include <algorithm>

namespace lacuna::topology {

WallTally::WallTally(const PatchMap& map, std::size_t free_loops) : map_(map), taken_(map.patches.size())
{
    geometry::UnionFind hang(map_.patches.size());
    for (std::size_t u = 0; u < map_.of_use.size(); ++u) {
        const std::size_t p = map_.of_use[u], q = map_.of_use[u ^ 1];
        if (p == kNoIndex) continue;
        if (u % 2 == 0 || q == kNoIndex) whole_.edges += 1;
        if (q == kNoIndex || (q == p && u % 2 == 0)) ++taken_[p].edges;
        if (q == kNoIndex || q == p) continue;
        ++taken_[p].contacts;
        hang.unite_least(p, q);
    }
    for (std::size_t p = 0; p < map_.patches.size(); ++p) {
        euler_ += map_.patches[p].inner_euler;
        taken_[p].part = hang.find(p);
        parts_ += taken_[p].part == p ? 1 : 0;
    }
    for (const std::vector<std::size_t>& at : map_.at) {
        whole_.vertices += at.empty() ? 0 : 1;
        if (at.size() == 1) ++taken_[at.front()].vertices;
    }
    count_fans();
    whole_.contacts = static_cast<long>(free_loops);
}

/// Count the fans. Fan: a set of corners of patches round a vertex that are connected over edges. Also count
/// by how many the number of fans decreases if a patch is removed.
void WallTally::count_fans()
{
    // A corner has the number of the use that leaves it. The next corner round the vertex lies beyond that
    // use.
    const auto next = [&](std::size_t use) {
        return map_.of_use[use ^ 1] == kNoIndex ? kNoIndex : number_of(map_.next[use ^ 1]);
    };
    std::vector<bool> has_before(map_.of_use.size(), false), seen(map_.of_use.size(), false);
    for (std::size_t u = 0; u < map_.of_use.size(); ++u)
        if (map_.of_use[u] != kNoIndex && next(u) != kNoIndex) has_before[next(u)] = true;
    std::vector<std::size_t> run; // patches of a fan's corners in order; consecutive equal ones listed once
    const auto count_fan = [&](std::size_t first) {
        ++whole_.fans;
        run.clear();
        std::size_t corner = first;
        while (corner != kNoIndex && !seen[corner]) {
            seen[corner] = true;
            if (run.empty() || run.back() != map_.of_use[corner]) run.push_back(map_.of_use[corner]);
            corner = next(corner);
        }
        const bool round = corner == first;
        if (round && run.size() > 1 && run.front() == run.back()) run.pop_back();
        if (round && run.size() == 1) {
            ++taken_[run.front()].fans;
            return;
        }
        // At each entry of a patch in this list, the removal of the patch splits the fan.
        for (const std::size_t p : run) --taken_[p].fans;
        if (round) {
            std::sort(run.begin(), run.end());
            run.erase(std::unique(run.begin(), run.end()), run.end());
            for (const std::size_t p : run) ++taken_[p].fans; // the first split only opens a closed fan
        } else {
            ++taken_[run.front()].fans;
            ++taken_[run.back()].fans;
        }
    };
    for (const bool open : {true, false}) {
        for (std::size_t u = 0; u < map_.of_use.size(); ++u)
            if (map_.of_use[u] != kNoIndex && !seen[u] && has_before[u] != open) count_fan(u);
    }
}

/// Upper and lower bound of the walls' Euler number without a patch, summed over the connected parts.
std::pair<long, long> WallTally::euler_without(std::size_t p) const
{
    const long both = taken_[p].edges - map_.patches[p].inner_euler - whole_.edges;
    return {euler_ + whole_.fans + both - taken_[p].fans,
            euler_ + whole_.vertices + both - taken_[p].vertices};
}

long WallTally::at_most(std::size_t p) const
{
    return taken_[p].edges - map_.patches[p].inner_euler - taken_[p].fans + taken_[p].contacts;
}

bool WallTally::can_hold(std::size_t a, std::size_t b) const
{
    // Each rim of the walls is a free loop or contains an edge of an end. This bounds the number of rims.
    const long free_loops = whole_.contacts;
    return map_.patches.size() == 2 ||
           euler_ + whole_.fans - whole_.edges + at_most(a) + at_most(b) + free_loops >= 2;
}

bool WallTally::can_hold(std::size_t p) const
{
    const auto [most, least] = euler_without(p);
    return parts_ == 1 && most >= 0 && least <= 0;
}

} // namespace lacuna::topology
