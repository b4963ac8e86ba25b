// SPDX-License-Identifier: MIT
#include <lacuna/closure/detail/end_holes.h>

#include <lacuna/closure/detail/void_entities.h>
#include <lacuna/closure/detail/void_faces.h>
#include <lacuna/core/shared/attempt.h>
#include <lacuna/geometry/newell.h>
#include <lacuna/topology/shared/use_places.h>

#include <algorithm>
#include <iterator>
#include <utility>

namespace lacuna::closure {

using namespace topology;

std::vector<EndHole> holes_without_walls(const OpenVolume& volume)
{
    const Model& model = volume.model;
    const auto enclosed = [&](const Rim& rim) {
        return geometry::newell_vector(loop_places(model, rim.uses)).norm();
    };
    const auto is_free = [&](const EdgeUse& use) { return model.uses_of_edge(use.edge).size() == 1; };
    std::vector<EndHole> holes;
    for (const Role end : {Role::source, Role::target}) {
        for (const std::vector<FaceId>& part : connected_parts(model, volume.faces(end))) {
            std::vector<Rim> all = rims(model, part);
            if (all.size() < 2) continue;
            all.erase(std::ranges::max_element(all, {}, enclosed));
            for (Rim& rim : all) {
                if (!std::ranges::all_of(rim.uses, is_free)) continue;
                const FaceId beside = model.uses_of_edge(rim.uses.front().edge).front().face;
                holes.push_back({end, beside, std::move(rim)});
            }
        }
    }
    return holes;
}

std::vector<double> shares_without_walls(const OpenVolume& volume)
{
    std::vector<double> shares;
    for (const Rim& rim : rims(volume.model, volume.faces(Role::source))) {
        const auto bare = std::ranges::count_if(
            rim.uses, [&](const EdgeUse& use) { return volume.model.uses_of_edge(use.edge).size() == 1; });
        shares.push_back(static_cast<double>(bare) / static_cast<double>(rim.uses.size()));
    }
    return shares;
}

std::vector<FaceId> cover_holes(OpenVolume& volume, const std::vector<EndHole>& holes,
                                const RunContext& context)
{
    std::vector<FaceId> covers;
    for (const Role end : {Role::source, Role::target}) {
        std::vector<VoidFilling> fillings;
        for (const EndHole& hole : holes) {
            if (hole.end != end) continue;
            fillings.push_back(fill(volume, {reversed(hole.rim)}, nullptr,
                                    {"the cover of a hole of ", {entity_of(volume.model, hole.face)}},
                                    context));
        }
        std::ranges::copy(add_void_faces(volume, std::move(fillings), end), std::back_inserter(covers));
    }
    return covers;
}

HoleVolumes hole_volumes(const OpenVolume& volume, const CloseOptions& options, const RunContext& context)
{
    RunContext quiet = context;
    quiet.log = nullptr;
    const auto encloses = [&](Holes holes) {
        CloseOptions asked = options;
        asked.holes = holes;
        asked.roles_by = RolesBy::finding;
        return unless_refused([&] { return enclosed_volume(close(volume, {}, asked, quiet).volume); });
    };
    return {encloses(Holes::cover), encloses(Holes::through)};
}

} // namespace lacuna::closure
