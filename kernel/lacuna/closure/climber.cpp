// SPDX-License-Identifier: MIT
#include <lacuna/closure/detail/climber.h>

#include <lacuna/core/shared/criteria.h>
#include <lacuna/geometry/shared/polyline.h>
#include <lacuna/topology/shared/face_parts.h>
#include <lacuna/topology/shared/use_places.h>

#include <algorithm>

namespace lacuna::closure {

using namespace topology;

Climber::Climber(const OpenVolume& volume) : model_(volume.model)
{
    std::vector<FaceId> ends = volume.faces(Role::source);
    std::ranges::copy(volume.faces(Role::target), std::back_inserter(ends));
    const std::set<EdgeId> of_ends = edges_of(model_, ends);
    on_end_ = vertices_of(model_, ends);
    walls_ = edges_of(model_, volume.faces(Role::wall));
    for (const EdgeId edge : walls_) {
        if (of_ends.contains(edge)) continue;
        for (const bool reversed : {false, true})
            leaving_[use_from(model_, {edge, reversed})].push_back({edge, reversed});
    }
}

std::vector<EdgeUse> Climber::climb(VertexId start) const
{
    std::vector<EdgeUse> way;
    std::set<VertexId> passed{start};
    Vec3 onward = off_rim(start);
    for (VertexId at = start; way.empty() || !on_end_.contains(at);) {
        const std::optional<EdgeUse> next = straightest(at, onward, way.empty() ? -1 : kContinues);
        if (!next || !passed.insert(use_to(model_, *next)).second) break;
        way.push_back(*next);
        at = use_to(model_, *next);
        onward = geometry::end_tangent(use_places(model_, *next));
    }
    return way;
}

bool Climber::joined(VertexId from, VertexId to, const std::vector<const Rim*>& loops) const
{
    for (const Rim* rim : loops) {
        const Rim& loop = *rim;
        const std::size_t uses = loop.uses.size();
        const auto leads = [&](std::size_t at, VertexId wanted) {
            for (std::size_t k = 0; k < uses; ++k) {
                const VertexId next = use_to(model_, loop.uses[(at + k) % uses]);
                if (next == wanted) return true;
                if (on_end_.contains(next)) return false;
            }
            return false;
        };
        const auto leaves = [&](VertexId vertex) {
            return std::ranges::find_if(loop.uses,
                                        [&](const EdgeUse& use) { return use_from(model_, use) == vertex; });
        };
        const auto a = leaves(from), b = leaves(to);
        if (a == loop.uses.end() || b == loop.uses.end()) continue;
        const auto place = [&](auto at) { return static_cast<std::size_t>(at - loop.uses.begin()); };
        return leads(place(a), to) != leads(place(b), from);
    }
    return false;
}

Vec3 Climber::off_rim(VertexId at) const
{
    Vec3 sum = Vec3::Zero();
    const auto found = leaving_.find(at);
    if (found == leaving_.end()) return sum;
    for (const EdgeUse& use : found->second) sum += start_of(use);
    return sum.stableNormalized();
}

Vec3 Climber::start_of(EdgeUse use) const
{
    const std::vector<Index> points = use_points(model_, use);
    return (model_.at(points[1]) - model_.at(points[0])).stableNormalized();
}

std::optional<EdgeUse> Climber::straightest(VertexId at, const Vec3& onward, double least) const
{
    std::optional<EdgeUse> best;
    const auto found = leaving_.find(at);
    if (found == leaving_.end()) return best;
    for (const EdgeUse& use : found->second) {
        const double along = start_of(use).dot(onward);
        if (along < least || (best && along <= start_of(*best).dot(onward))) continue;
        best = use;
    }
    return best;
}

} // namespace lacuna::closure
