// SPDX-License-Identifier: MIT
#include <lacuna/topology/detail/directed_sides.h>

#include <lacuna/topology/shared/face_parts.h>

#include <algorithm>

namespace lacuna::topology {

void DirectedSides::read(std::span<const Triangle> triangles)
{
    for (const Index p : used_) local_[index(p)] = -1;
    used_.clear();
    triangles_ = triangles;
    start_.assign(1, 0);
    for (const Triangle& t : triangles) {
        for (const Index p : t) {
            if (local_[index(p)] < 0) {
                local_[index(p)] = static_cast<Index>(used_.size());
                used_.push_back(p);
                start_.push_back(0);
            }
            ++start_[index(local_[index(p)]) + 1];
        }
    }
    for (std::size_t p = 0; p < used_.size(); ++p) start_[p + 1] += start_[p];
    entries_.resize(size());
    std::vector<Index> next(start_.begin(), start_.end() - 1);
    for (std::size_t side = 0; side < size(); ++side)
        entries_[index(next[index(local_[index(from(side))])]++)] = {to(side), static_cast<Index>(side)};
    for (std::size_t p = 0; p < used_.size(); ++p)
        std::sort(entries_.begin() + start_[p], entries_.begin() + start_[p + 1]);
}

Index DirectedSides::find(Index from, Index to) const
{
    if (local_[index(from)] < 0) return -1;
    const std::span<const Entry> heap = leaving(index(local_[index(from)]));
    const auto found = std::lower_bound(heap.begin(), heap.end(), Entry{to, 0});
    return found != heap.end() && found->to == to ? found->side : -1;
}

Index DirectedSides::first_repeated() const
{
    Index first = -1;
    for (std::size_t p = 0; p < used_.size(); ++p) {
        const std::span<const Entry> heap = leaving(p);
        for (std::size_t i = 1; i < heap.size(); ++i)
            if (heap[i].to == heap[i - 1].to && (first < 0 || heap[i].side < first)) first = heap[i].side;
    }
    return first;
}

std::size_t DirectedSides::undirected_count() const
{
    std::size_t count = 0;
    for (std::size_t p = 0; p < used_.size(); ++p) {
        const std::span<const Entry> heap = leaving(p);
        for (std::size_t i = 0; i < heap.size(); ++i) {
            if (i > 0 && heap[i].to == heap[i - 1].to) continue;
            if (used_[p] < heap[i].to || find(heap[i].to, used_[p]) < 0) ++count;
        }
    }
    return count;
}

long euler_number(const Model& model, const std::vector<FaceId>& faces, DirectedSides& sides)
{
    const std::vector<Triangle> triangles = facets_of(model, faces);
    sides.read(triangles);
    const long number = static_cast<long>(sides.point_count()) - static_cast<long>(sides.undirected_count()) +
                        static_cast<long>(triangles.size());
    sides.read({});
    return number;
}

} // namespace lacuna::topology
