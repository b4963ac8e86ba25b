// SPDX-License-Identifier: MIT
#include <lacuna/quads/shared/symmetry.h>

#include <lacuna/core/shared/criteria.h>
#include <lacuna/geometry/shared/union_find.h>
#include <lacuna/mesh/quad_mesh.h>
#include <lacuna/quads/detail/mesh_symmetry.h>
#include <lacuna/quads/detail/segment_symmetry.h>
#include <lacuna/quads/shared/measure_plane.h>

#include <algorithm>

namespace lacuna::quads {
namespace {

class SymmetryFinder {
public:
    SymmetryFinder(const PlanarQuads& mesh, const PlanarRegion& region) : mesh_(mesh), region_(region) {}

    /// All symmetries of the mesh except the identity.
    std::vector<Symmetry> run()
    {
        std::vector<Symmetry> found, outline = outline_symmetries(region_);
        if (outline.empty()) return found;
        opposite_ = mesh::opposite_sides(mesh_.quads, static_cast<Index>(mesh_.points.size()));
        rim_.assign(region_.points.size(), -1);
        for (std::size_t side = 0; side < opposite_.size(); ++side) {
            if (opposite_[side] >= 0) continue;
            const std::size_t start = index(mesh_.quads[side / 4][side % 4]);
            if (opposite_[side] != mesh::kRimSide || start >= rim_.size())
                return found; // the quads are not a mesh of the region
            rim_[start] = static_cast<Index>(side);
        }
        if (std::ranges::find(rim_, -1) != rim_.end()) return found;
        for (Symmetry& symmetry : outline) {
            symmetry.to.resize(mesh_.points.size(), -1);
            if (maps_quads(symmetry)) found.push_back(std::move(symmetry));
        }
        return found;
    }

private:
    /// A side and the side onto which it is mapped.
    struct SidePair {
        Index own, image;
    };

    /// Map the quads from the boundary inward. @return false if a quad has no image
    [[nodiscard]] bool maps_quads(Symmetry& symmetry) const
    {
        std::vector<char> seen(mesh_.quads.size(), 0);
        std::vector<SidePair> next;
        const auto follow = [&](const SidePair& side) {
            if (side.own < 0 || seen[index(side.own) / 4]) return true;
            if (side.image < 0 || !maps_corners(symmetry, side)) return false;
            seen[index(side.own) / 4] = 1;
            next.push_back(side);
            return true;
        };
        const auto& loop = region_.loops[0];
        const Index image = symmetry.to[index(loop[symmetry.map.mirrors ? 1 : 0])];
        if (!follow({rim_[index(loop[0])], rim_[index(image)]})) return false;
        while (!next.empty()) {
            const SidePair side = next.back();
            next.pop_back();
            for (Index i = 1; i < 4; ++i) {
                const SidePair beside{beyond(side.own, i),
                                      beyond(side.image, symmetry.map.mirrors ? 4 - i : i)};
                if (!follow({opposite_[index(beside.own)], opposite_[index(beside.image)]})) return false;
            }
        }
        return true;
    }

    /// The side of the same quad that follows `by` sides after a side.
    static Index beyond(Index side, Index by) { return (side & ~3) + ((side + by) & 3); }

    /// Map the corners of the quad that has a given side. @return  false if a corner already has another
    /// image
    bool maps_corners(Symmetry& symmetry, const SidePair& side) const
    {
        for (Index i = 0; i < 4; ++i) {
            const auto own = index(beyond(side.own, i)),
                       image = index(beyond(side.image, symmetry.map.mirrors ? 5 - i : i));
            const Index to = mesh_.quads[image / 4][image % 4];
            Index& known = symmetry.to[index(mesh_.quads[own / 4][own % 4])];
            if (known >= 0 && known != to) return false;
            known = to;
        }
        return true;
    }

    const PlanarQuads& mesh_;
    const PlanarRegion& region_;
    std::vector<Index> opposite_; ///< for each side, its twin; side k of quad q has the number 4 q + k
    std::vector<Index> rim_;      ///< for each boundary node, the boundary side that starts there
};

} // namespace

std::vector<Symmetry> mesh_symmetries(const PlanarQuads& mesh, const PlanarRegion& region)
{
    return SymmetryFinder(mesh, region).run();
}

std::size_t symmetrise(PlanarQuads& mesh, const PlanarRegion& region)
{
    return symmetrise(mesh, region.points.size(), mesh_symmetries(mesh, region));
}

std::size_t symmetrise(PlanarQuads& mesh, std::size_t fixed, std::span<const Symmetry> symmetries)
{
    if (symmetries.empty()) return 1;
    PlanarQuads made = mesh;
    const double share = 1.0 / static_cast<double>(symmetries.size() + 1);
    for (std::size_t p = fixed; p < made.points.size(); ++p) {
        Vec2 sum = mesh.points[p];
        for (const Symmetry& symmetry : symmetries)
            sum += symmetry.map.back(mesh.points[index(symmetry.to[p])]);
        made.points[p] = share * sum;
    }
    // After complete smoothing, nodes are close to the means of their images, and moving them to these means
    // does not reduce the quality. If smoothing stopped early, the moves may reduce the quality; the mesh is
    // then left unchanged.
    const double before = least_scaled_jacobian(mesh.points, mesh.quads);
    if (least_scaled_jacobian(made.points, made.quads) < before - kAlikeSizes) return 1;
    mesh = std::move(made);
    return symmetries.size() + 1;
}

std::vector<std::size_t> segments_alike(const PlanarRegion& region, std::span<const int> segment)
{
    std::vector<std::size_t> least(segment_count(segment));
    geometry::UnionFind sets(least.size());
    for (const SegmentSymmetry& symmetry : segment_symmetries(region, segment)) {
        for (std::size_t s = 0; s < least.size(); ++s) sets.unite_least(s, symmetry.onto[s]);
    }
    for (std::size_t s = 0; s < least.size(); ++s) least[s] = sets.find(s);
    return least;
}

} // namespace lacuna::quads
