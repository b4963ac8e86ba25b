// SPDX-License-Identifier: MIT
#include <lacuna/closure/detail/connecting_tubes.h>

#include <lacuna/closure/detail/outline.h>
#include <lacuna/closure/detail/pieces.h>
#include <lacuna/geometry/shared/affine.h>
#include <lacuna/topology/shared/section.h>
#include <lacuna/topology/shared/use_places.h>

#include <algorithm>
#include <cstddef>
#include <utility>

namespace lacuna::closure {

using namespace topology;

std::vector<StepPiece> cut_connecting_tubes(const OpenVolume& volume, const Branching& found,
                                            const RunContext& context)
{
    std::vector<std::vector<Vec3>> mouths_of(found.faces.size()); // by region: the centres of its mouths
    for (const Mouth& mouth : found.mouths)
        for (const std::size_t region : {mouth.host, mouth.branch})
            mouths_of[region].push_back(geometry::mean_point(places(volume.model, mouth.edges)));
    PartedVolume parted{volume};
    std::vector<std::size_t> region_of = found.region;
    for (std::size_t region = 0; region < mouths_of.size(); ++region) {
        const std::vector<Vec3>& mouths = mouths_of[region];
        if (mouths.size() != 2 || !found.ends[region].empty()) continue;
        check_cancelled(context);
        const geometry::Plane plane = geometry::plane_across((mouths[0] + mouths[1]) / 2,
                                                             (mouths[1] - mouths[0]).normalized());
        std::vector<FaceId> tube;
        for (std::size_t f = 0; f < region_of.size(); ++f)
            if (region_of[f] == region) tube.emplace_back(f);
        Model& model = parted.volume.model;
        const std::vector<SectionWalk> walks = section_walks(model, tube, plane, model.tolerance);
        if (walks.empty() || !std::ranges::all_of(walks, &SectionWalk::closed)) continue;
        const WalkImprint made = imprint(parted.volume, walks, plane, context);
        Partition partition;
        std::vector<std::vector<Vec2>> flat;
        for (const std::vector<EdgeUse>& line : made.lines) {
            partition.behind.insert(partition.behind.end(), line.begin(), line.end());
            flat.push_back(flat_places(plane, loop_places(model, line)));
        }
        std::vector<std::vector<EdgeUse>> rings;
        const std::vector<std::size_t> outer_first = regions_of(flat).front();
        for (const std::size_t ring : outer_first) rings.push_back(made.lines[ring]);
        for (std::size_t f = region_of.size(); f < made.parent.size(); ++f)
            region_of.push_back(region_of[made.parent[f].index()]);
        partition.face = add_partition(model, rings, plane, partition_name(model), context);
        parted.volume.role.push_back(Role::wall);
        region_of.push_back(found.faces.size()); // the partition is in no region
        parted.partitions.push_back(partition);
    }
    if (parted.partitions.empty()) return {};
    parted.volume.model = with_loops(std::move(parted.volume.model));
    return pieces_of(parted, {"the cut across a tube"}, context);
}

} // namespace lacuna::closure
