// SPDX-License-Identifier: MIT
#include <lacuna/quads/symmetry.h>

#include <lacuna/core/edge_key.h>
#include <lacuna/geometry/union_find.h>
#include <lacuna/quads/detail/outline_symmetry.h>
#include <lacuna/quads/detail/segment_symmetry.h>
#include <lacuna/quads/measure_plane.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <unordered_map>

namespace lacuna::quads {
namespace {

class SymmetryFinder {
public:
    SymmetryFinder(const PlanarQuads& mesh, const PlanarRegion& region) : mesh_(mesh), region_(region) {}

    /// All symmetries of the mesh but the identity.
    std::vector<Symmetry> run()
    {
        std::vector<Symmetry> found, outline = outline_symmetries(region_);
        if (outline.empty()) return found;
        for (std::size_t q = 0; q < mesh_.quads.size(); ++q) {
            for (std::size_t k = 0; k < 4; ++k)
                side_[directed_key(mesh_.quads[q][k], mesh_.quads[q][(k + 1) % 4])] = 4 * q + k;
        }
        for (Symmetry& symmetry : outline) {
            symmetry.to.resize(mesh_.points.size(), -1);
            if (maps_quads(symmetry)) found.push_back(std::move(symmetry));
        }
        return found;
    }

private:
    /// Follow the quads from the boundary inward. @return false where one has no image
    [[nodiscard]] bool maps_quads(Symmetry& symmetry) const
    {
        const bool mirrors = symmetry.map.mirrors;
        std::vector<char> seen(mesh_.quads.size(), 0);
        std::vector<std::size_t> next;
        const auto follow = [&](Index a, Index b) { // a side whose ends have images
            const auto own = side_.find(directed_key(a, b));
            if (own == side_.end() || seen[own->second / 4]) return true;
            const Index to_a = symmetry.to[index(a)], to_b = symmetry.to[index(b)];
            const auto image = side_.find(mirrors ? directed_key(to_b, to_a) : directed_key(to_a, to_b));
            if (image == side_.end()) return false;
            const std::size_t q = own->second / 4, k = own->second % 4;
            const Quad &quad = mesh_.quads[q], &onto = mesh_.quads[image->second / 4];
            const std::size_t start = image->second % 4;
            for (std::size_t i = 0; i < 4; ++i) {
                const Index to = onto[mirrors ? (start + 5 - i) % 4 : (start + i) % 4];
                Index& known = symmetry.to[index(quad[(k + i) % 4])];
                if (known >= 0 && known != to) return false;
                known = to;
            }
            seen[q] = 1;
            next.push_back(q);
            return true;
        };
        const auto& loop = region_.loops[0];
        if (!follow(loop[0], loop[1])) return false;
        while (!next.empty()) {
            const Quad& quad = mesh_.quads[next.back()];
            next.pop_back();
            for (std::size_t k = 0; k < 4; ++k) {
                if (!follow(quad[(k + 1) % 4], quad[k])) return false;
            }
        }
        return true;
    }

    const PlanarQuads& mesh_;
    const PlanarRegion& region_;
    std::unordered_map<std::uint64_t, std::size_t> side_; ///< 4 × quad + place, by a side's ends
};

} // namespace

std::size_t symmetrise(PlanarQuads& mesh, const PlanarRegion& region)
{
    const std::vector<Symmetry> symmetries = SymmetryFinder(mesh, region).run();
    if (symmetries.empty()) return 1;
    PlanarQuads made = mesh;
    const double share = 1.0 / static_cast<double>(symmetries.size() + 1);
    for (std::size_t p = region.points.size(); p < made.points.size(); ++p) {
        Vec2 sum = mesh.points[p];
        for (const Symmetry& symmetry : symmetries)
            sum += symmetry.map.back(mesh.points[static_cast<std::size_t>(symmetry.to[p])]);
        made.points[p] = share * sum;
    }
    // Means of nodes that smoothing left nearly where their images are do not make quads worse, but may
    // where it stopped early.
    constexpr double kWorse = 0.01; // a choice, not a measurement
    const double before = least_scaled_jacobian(mesh.points, mesh.quads);
    if (least_scaled_jacobian(made.points, made.quads) < before - kWorse) return 1;
    mesh = std::move(made);
    return symmetries.size() + 1;
}

std::vector<std::size_t> segments_alike(const PlanarRegion& region, std::span<const int> segment)
{
    std::size_t count = 0;
    for (const int s : segment) count = std::max(count, static_cast<std::size_t>(s) + 1);
    geometry::UnionFind sets(count);
    for (const SegmentSymmetry& symmetry : segment_symmetries(region, segment)) {
        for (std::size_t s = 0; s < count; ++s) sets.unite_least(s, symmetry.onto[s]);
    }
    std::vector<std::size_t> least(count);
    for (std::size_t s = 0; s < count; ++s) least[s] = sets.find(s);
    return least;
}

} // namespace lacuna::quads
