// SPDX-License-Identifier: MIT
#include <lacuna/sweep/detail/skin_patches.h>

#include <lacuna/core/error.h>
#include <lacuna/core/shared/number_text.h>
#include <lacuna/sweep/shared/face_patches.h>
#include <lacuna/topology/shared/skin_groups.h>

#include <algorithm>
#include <map>
#include <utility>

namespace lacuna::sweep {

using namespace topology;

FacePatches::FacePatches(const OpenVolume& volume, std::vector<mesh::SkinPatch>& patches)
    : model_(volume.model), patches_(patches), groups_(skin_groups(volume))
{
}

Index FacePatches::of(FaceId face)
{
    const auto [found, fresh] = known_.try_emplace(face, static_cast<Index>(faces_.size()));
    if (!fresh) return found->second;
    faces_.push_back(face);
    const Face& own = model_[face];
    mesh::SkinPatch& patch = patches_.emplace_back();
    patch.tag = static_cast<int>(patches_.size());
    if (own.origin != Origin::made_void) patch.face = own.tag;
    patch.groups = groups_[face.index()];
    return found->second;
}

std::vector<FaceId> set_patches(const OpenVolume& volume, const surface::SourceMesh& source,
                                const EndFaces& ends, const std::vector<surface::WallMesh>& walls,
                                mesh::HexMesh& mesh)
{
    FacePatches patches(volume, mesh.patches);
    for (const FaceId face : ends.source) mesh.source_patch.push_back(patches.of(face));
    for (const FaceId face : ends.target) mesh.target_patch.push_back(patches.of(face));

    // For each side of the rim, find its linking surface and its index there. Sides are looked up by their
    // two nodes, because linking surfaces may run in the opposite direction.
    struct RimPosition {
        std::size_t link, side;
    };
    std::map<std::pair<Index, Index>, RimPosition> places;
    for (std::size_t b = 0; b < walls.size(); ++b) {
        const std::size_t n = source.links[b].source_at.size();
        for (std::size_t i = 0; i < n; ++i) {
            const Index a = source.first[b] + static_cast<Index>(i);
            const Index c = source.first[b] + static_cast<Index>((i + 1) % n);
            places[{std::min(a, c), std::max(a, c)}] = {b, i};
        }
    }
    std::vector<RimPosition> along_rim;
    for (const Segment& side : mesh.rim) {
        const auto place = places.find({std::min(side[0], side[1]), std::max(side[0], side[1])});
        if (place == places.end())
            throw NotSweepable(Message("sweep.source_gap",
                                       "the quads on the faces of the source leave a gap near {}",
                                       place_with_digits(source.quads.nodes[index(side[0])], 4))
                                   .remedy("use a smaller 'size'"));
        along_rim.push_back(place->second);
    }
    for (int layer = 0; layer < mesh.layers; ++layer) {
        for (const RimPosition& place : along_rim) {
            const std::size_t n = source.links[place.link].source_at.size();
            mesh.wall_patch.push_back(patches.of(walls[place.link].face[index(layer) * n + place.side]));
        }
    }
    return patches.faces();
}

} // namespace lacuna::sweep
