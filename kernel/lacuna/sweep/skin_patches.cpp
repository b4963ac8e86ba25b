// SPDX-License-Identifier: MIT
#include <lacuna/sweep/detail/skin_patches.h>

#include <lacuna/topology/shared/skin_groups.h>

#include <algorithm>
#include <map>
#include <string>
#include <utility>

namespace lacuna::sweep {

using namespace topology;

namespace {

/// SkinPatches of the skin, one a face, with the groups a person reads.
class SkinPatches {
public:
    SkinPatches(const OpenVolume& volume, mesh::HexMesh& mesh)
        : volume_(volume), mesh_(mesh), groups_(topology::skin_groups(volume))
    {
    }

    /// Face of each patch.
    [[nodiscard]] std::vector<FaceId> faces() const
    {
        std::vector<FaceId> faces(patch_.size());
        for (const auto& [face, patch] : patch_) faces[static_cast<std::size_t>(patch)] = face;
        return faces;
    }

    Index of(FaceId face)
    {
        const auto [found, fresh] = patch_.try_emplace(face, static_cast<Index>(mesh_.patches.size()));
        if (fresh) {
            const Face& f = volume_.model[face];
            mesh::SkinPatch patch;
            patch.tag = static_cast<int>(mesh_.patches.size()) + 1;
            if (f.origin != Origin::made_void) patch.face = f.tag;
            patch.groups = groups_[face.index()];
            mesh_.patches.push_back(std::move(patch));
        }
        return found->second;
    }

private:
    const OpenVolume& volume_;
    mesh::HexMesh& mesh_;
    std::vector<std::vector<std::string>> groups_; ///< of each face
    std::map<FaceId, Index> patch_;
};

} // namespace

std::vector<FaceId> set_patches(const OpenVolume& volume, const surface::SourceMesh& source,
                                const EndFaces& ends, const std::vector<surface::WallMesh>& walls,
                                mesh::HexMesh& mesh)
{
    SkinPatches patches(volume, mesh);
    for (const FaceId face : ends.source) mesh.source_patch.push_back(patches.of(face));
    for (const FaceId face : ends.target) mesh.target_patch.push_back(patches.of(face));

    // A linking surface's sides run with the linking surface or against it; each side of the rim finds its
    // place by the nodes it joins.
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
            mesh.wall_patch.push_back(
                patches.of(walls[place.link].face[static_cast<std::size_t>(layer) * n + place.side]));
        }
    }
    return patches.faces();
}

} // namespace lacuna::sweep
