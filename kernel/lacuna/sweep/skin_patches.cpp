// SPDX-License-Identifier: MIT
#include <lacuna/sweep/detail/skin_patches.h>

#include <lacuna/topology/shared/skin_groups.h>

#include <algorithm>
#include <map>
#include <string>
#include <utility>

namespace lacuna::sweep {

using namespace topology;

std::vector<FaceId> set_patches(const OpenVolume& volume, const surface::SourceMesh& source,
                                const EndFaces& ends, const std::vector<surface::WallMesh>& walls,
                                mesh::HexMesh& mesh)
{
    const std::vector<std::vector<std::string>> groups = skin_groups(volume); // for each face
    std::vector<FaceId> faces;                                                // for each patch
    std::map<FaceId, Index> patches;
    const auto patch_of = [&](FaceId face) {
        const auto [found, fresh] = patches.try_emplace(face, static_cast<Index>(faces.size()));
        if (!fresh) return found->second;
        faces.push_back(face);
        const Face& f = volume.model[face];
        mesh::SkinPatch& patch = mesh.patches.emplace_back();
        patch.tag = static_cast<int>(mesh.patches.size());
        if (f.origin != Origin::made_void) patch.face = f.tag;
        patch.groups = groups[face.index()];
        return found->second;
    };
    for (const FaceId face : ends.source) mesh.source_patch.push_back(patch_of(face));
    for (const FaceId face : ends.target) mesh.target_patch.push_back(patch_of(face));

    // A linking surface's sides run with its direction or against it; each rim side is found by its two
    // nodes.
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
    for (const Segment& side : mesh.rim)
        along_rim.push_back(places.at({std::min(side[0], side[1]), std::max(side[0], side[1])}));
    for (int layer = 0; layer < mesh.layers; ++layer) {
        for (const RimPosition& place : along_rim) {
            const std::size_t n = source.links[place.link].source_at.size();
            mesh.wall_patch.push_back(patch_of(walls[place.link].face[index(layer) * n + place.side]));
        }
    }
    return faces;
}

} // namespace lacuna::sweep
