// SPDX-License-Identifier: MIT
#include <lacuna/topology/detail/wall_parts.h>

#include <lacuna/topology/shared/use_places.h>

#include <algorithm>

namespace lacuna::topology {

WallParts::WallParts(const PatchMap& map, const std::vector<EdgeUse>& free)
    : map_(map),
      free_(free),
      part_of_(map.patches.size()),
      vertex_seen_(map.at.size()),
      edge_seen_(map.of_use.size() / 2),
      use_seen_(map.of_use.size())
{
}

std::size_t WallParts::free_loops()
{
    std::vector<WallPart> all(1);
    use_seen_.clear();
    for (const EdgeUse use : free_) count_rim(use, all);
    return all.front().rims;
}

bool WallParts::on_wall(EdgeUse use) const
{
    const std::size_t patch = map_.of_use[number_of(use)];
    return patch != kNoIndex && part_of_[patch] != kNoIndex;
}

std::vector<WallPart> WallParts::between(std::size_t source, std::size_t target)
{
    constexpr std::size_t unseen = kNoIndex - 1;
    std::fill(part_of_.begin(), part_of_.end(), unseen);
    part_of_[source] = kNoIndex;
    if (target != kNoIndex) part_of_[target] = kNoIndex;
    windows_ = 0;
    std::vector<WallPart> parts;
    for (std::size_t start = 0; start < map_.patches.size(); ++start) {
        if (part_of_[start] != unseen) continue;
        part_of_[start] = parts.size();
        parts.push_back({flood(start, unseen), 0, kNoIndex, kNoIndex, false});
    }
    use_seen_.clear();
    for (const EdgeUse use : free_) count_rim(use, parts);
    touch(source, &WallPart::source_rim, parts);
    if (target != kNoIndex) touch(target, &WallPart::target_rim, parts);
    return parts;
}

long WallParts::flood(std::size_t start, std::size_t unseen)
{
    vertex_seen_.clear();
    edge_seen_.clear();
    std::vector<std::size_t> front{start};
    long euler = 0;
    for (std::size_t i = 0; i < front.size(); ++i) {
        const SmoothPatch& patch = map_.patches[front[i]];
        euler += patch.inner_euler;
        for (const VertexId v : patch.vertices) euler += vertex_seen_.add(v.index()) ? 1 : 0;
        for (const EdgeId e : patch.edges) {
            if (!edge_seen_.add(e.index())) continue;
            --euler;
            for (const std::size_t use : {2 * e.index(), 2 * e.index() + 1}) {
                const std::size_t other = map_.of_use[use];
                if (other == kNoIndex || part_of_[other] != unseen) continue;
                part_of_[other] = part_of_[start];
                front.push_back(other);
            }
        }
    }
    return euler;
}

void WallParts::count_rim(EdgeUse use, std::vector<WallPart>& parts)
{
    if (!on_wall(use) || on_wall(opposite(use)) || use_seen_.has(number_of(use))) return;
    ++parts[part_of_[map_.of_use[number_of(use)]]].rims;
    bool free = true;
    while (use_seen_.add(number_of(use))) {
        free = free && map_.of_use[number_of(opposite(use))] == kNoIndex;
        use = map_.next[number_of(use)];
        for (std::size_t turns = 0; on_wall(opposite(use)) && turns <= map_.next.size(); ++turns)
            use = map_.next[number_of(opposite(use))];
    }
    windows_ += free ? 1 : 0;
}

void WallParts::touch(std::size_t end, std::size_t WallPart::*rim, std::vector<WallPart>& parts)
{
    const std::vector<Rim>& all = map_.patches[end].rims;
    for (std::size_t r = 0; r < all.size(); ++r) {
        for (const EdgeUse& use : all[r].uses) {
            if (!on_wall(opposite(use))) continue;
            count_rim(opposite(use), parts);
            WallPart& part = parts[part_of_[map_.of_use[number_of(opposite(use))]]];
            part.several = part.several || (part.*rim != kNoIndex && part.*rim != r);
            part.*rim = r;
        }
    }
}

} // namespace lacuna::topology
