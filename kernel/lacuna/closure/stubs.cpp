// SPDX-License-Identifier: MIT
#include <lacuna/closure/detail/stubs.h>

#include <lacuna/topology/shared/face_parts.h>

#include <algorithm>
#include <set>

namespace lacuna::closure {

using namespace topology;

namespace {

/// Number of rims of `part` whose edges are all in `end`; -1 if only some edges of a rim are.
int whole_rims(const std::vector<Rim>& part, const std::set<EdgeId>& end)
{
    int whole = 0;
    for (const Rim& rim : part) {
        const auto on_end = std::ranges::count_if(rim.uses,
                                                  [&](const EdgeUse& use) { return end.contains(use.edge); });
        if (on_end == 0) continue;
        if (on_end != static_cast<std::ptrdiff_t>(rim.uses.size())) return -1;
        ++whole;
    }
    return whole;
}

} // namespace

std::vector<FaceId> lend_stubs_to_ends(OpenVolume& volume)
{
    const std::set<EdgeId> source = rim_edges(volume.model, volume.faces(Role::source));
    const std::set<EdgeId> target = rim_edges(volume.model, volume.faces(Role::target));
    std::vector<FaceId> lent;
    for (const std::vector<FaceId>& part : connected_parts(volume.model, volume.faces(Role::wall))) {
        const std::vector<Rim> open = rims(volume.model, part);
        if (open.size() != 2) continue;
        const int on_source = whole_rims(open, source);
        const int on_target = whole_rims(open, target);
        if (on_source + on_target != 1 || on_source < 0 || on_target < 0) continue;
        for (const FaceId face : part)
            volume.role[face.index()] = on_source == 1 ? Role::source : Role::target;
        lent.insert(lent.end(), part.begin(), part.end());
    }
    return lent;
}

} // namespace lacuna::closure
