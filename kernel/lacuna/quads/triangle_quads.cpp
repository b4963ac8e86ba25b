// SPDX-License-Identifier: MIT
#include <lacuna/quads/detail/triangle_quads.h>

#include <lacuna/core/error.h>
#include <lacuna/core/shared/criteria.h>
#include <lacuna/geometry/shared/triangulate.h>
#include <lacuna/mesh/quad_mesh.h>
#include <lacuna/quads/detail/region_loops.h>
#include <lacuna/quads/detail/split_cells.h>
#include <lacuna/quads/shared/measure_plane.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <tuple>
#include <unordered_map>

namespace lacuna::quads {

namespace {

/// Triangles over a region, as a mixed mesh: the loops' nodes first, loop after loop.
MixedMesh triangles_over(const PlanarRegion& region, double by_size)
{
    const PlanarRegion own = region_within(region.points, region.loops).region;
    MixedMesh mesh;
    mesh.fixed = own.points.size();
    geometry::TriangulateOptions options;
    if (region.size) options.size = [&](const Vec2& p) { return by_size * region.size(p); };
    geometry::Triangulation triangles = geometry::triangulate(own.points, own.loops, options);
    mesh.points = std::move(triangles.points);
    for (const Triangle& t : triangles.triangles) mesh.cells.push_back({t[0], t[1], t[2], t[2]});
    return mesh;
}

/// Pairs of neighbouring triangles to be merged into quads.
class Matching {
public:
    explicit Matching(const MixedMesh& mesh)
        : mesh_(mesh),
          opposite_(mesh::opposite_sides(mesh.cells, static_cast<Index>(mesh.points.size()))),
          neighbours_(mesh.cells.size()),
          mate_(mesh.cells.size(), -1)
    {
        for (std::size_t c = 0; c < neighbours_.size(); ++c) {
            for (const std::size_t k : kTriangleSides) {
                const Index other = opposite_[4 * c + k];
                if (other < 0) continue;
                const double quality = scaled_jacobian(mesh.points, merged(static_cast<Index>(c), other / 4));
                if (quality > kFlatQuad) neighbours_[c].emplace_back(quality, other / 4);
            }
            std::ranges::sort(neighbours_[c], std::greater<>());
        }
    }

    /// Pair the best pairs first.
    void greedy()
    {
        std::vector<std::tuple<double, Index, Index>> pairs;
        for (std::size_t c = 0; c < neighbours_.size(); ++c) {
            for (const auto& [quality, other] : neighbours_[c]) {
                if (static_cast<Index>(c) < other) pairs.emplace_back(-quality, static_cast<Index>(c), other);
            }
        }
        std::ranges::sort(pairs);
        for (const auto& [quality, a, b] : pairs) {
            if (mate(a) >= 0 || mate(b) >= 0) continue;
            mate(a) = b;
            mate(b) = a;
        }
    }

    /// Augmenting paths between two unpaired triangles. Odd cycles (blossoms) are not contracted, so a few
    /// triangles may be left that could be paired.
    void augment()
    {
        for (std::size_t c = 0; c < mate_.size(); ++c) {
            if (mate_[c] < 0 && !neighbours_[c].empty()) augment_from(static_cast<Index>(c));
        }
    }

    [[nodiscard]] std::vector<Quad> cells() const
    {
        std::vector<Quad> cells;
        for (std::size_t c = 0; c < mate_.size(); ++c) {
            if (mate_[c] < 0)
                cells.push_back(mesh_.cells[c]);
            else if (static_cast<Index>(c) < mate_[c])
                cells.push_back(merged(static_cast<Index>(c), mate_[c]));
        }
        return cells;
    }

private:
    /// Sides of a triangle as a quad with its last corner twice.
    static constexpr std::array<std::size_t, 3> kTriangleSides{0, 1, 3};

    Index& mate(Index c) { return mate_[index(c)]; }

    /// The quad of two triangles. @pre they share a side
    [[nodiscard]] Quad merged(Index a, Index b) const
    {
        const Quad& one = mesh_.cells[index(a)];
        const auto leads_to = [&](std::size_t i) {
            const Index other = opposite_[4 * index(a) + kTriangleSides[i]];
            return other >= 0 && other / 4 == b;
        };
        const std::size_t i = leads_to(0) ? 0 : leads_to(1) ? 1 : 2;
        const Index from = one[i], to = one[(i + 1) % 3];
        const Quad& two = mesh_.cells[index(b)];
        const auto far = std::ranges::find_if(two, [&](Index p) { return p != from && p != to; });
        return {from, *far, to, one[(i + 2) % 3]};
    }

    void augment_from(Index start)
    {
        // Triangles reached by an even number of steps, each with its predecessor.
        std::unordered_map<Index, Index> before{{start, -1}};
        std::vector<Index> queue{start};
        for (std::size_t i = 0; i < queue.size(); ++i) {
            const Index here = queue[i];
            for (const auto& [quality, other] : neighbours_[index(here)]) {
                // Reached from both sides: an odd cycle.
                if (before.contains(other)) continue;
                const Index next = mate(other);
                if (next < 0) {
                    change_partners(here, other, before);
                    return;
                }
                if (next >= 0 && before.try_emplace(next, here).second) queue.push_back(next);
            }
        }
    }

    void change_partners(Index here, Index other, const std::unordered_map<Index, Index>& before)
    {
        while (here >= 0) {
            const Index left = mate(here);
            mate(here) = other;
            mate(other) = here;
            other = left;
            here = before.at(here);
        }
    }

    const MixedMesh& mesh_;
    std::vector<Index> opposite_;
    std::vector<std::vector<std::pair<double, Index>>> neighbours_;
    std::vector<Index> mate_;
};

} // namespace

PlanarQuads quads_of_triangles(const PlanarRegion& region)
{
    // Two equilateral triangles have less area than a square on their side, and splitting halves most edges.
    const double kBySize = 2 * std::sqrt(2 / std::sqrt(3.0));
    MixedMesh mesh;
    try {
        mesh = triangles_over(region, kBySize);
    } catch (const InvalidInput&) {
        return {}; // loops that touch cannot be triangulated
    }
    Matching matching(mesh);
    matching.greedy();
    matching.augment();
    mesh.cells = matching.cells();
    mesh = split_cells(mesh);

    PlanarQuads result{region.points, {}};
    add_filling(result, region_within(region.points, region.loops).own,
                {std::move(mesh.points), std::move(mesh.cells)});
    return result;
}

} // namespace lacuna::quads
