// SPDX-License-Identifier: MIT
#include <lacuna/surface/detail/alike_edges.h>

#include <lacuna/core/shared/criteria.h>
#include <lacuna/core/shared/limits.h>
#include <lacuna/geometry/newell.h>
#include <lacuna/quads/shared/symmetry.h>
#include <lacuna/surface/detail/plane_loops.h>
#include <lacuna/surface/shared/edge_nodes.h>
#include <lacuna/topology/open_volume.h>

#include <algorithm>
#include <map>
#include <set>

namespace lacuna::surface {

using namespace topology;

std::vector<std::vector<EdgeId>> alike_edges(const Model& model, FaceId face)
{
    const Vec3 normal = face_area_vector(model, face).stableNormalized();
    const geometry::Plane plane = geometry::plane_across(face_centroid(model, face), normal);
    std::vector<double> shares;
    for (std::size_t i = 0; i <= kSamplesPerSide; ++i)
        shares.push_back(static_cast<double>(i) / static_cast<double>(kSamplesPerSide));
    std::vector<EdgeId> edges;
    std::vector<int> segment;
    quads::PlanarRegion region;
    for (const Loop& loop : border_loops(model, face)) {
        std::vector<Index>& cycle = region.loops.emplace_back();
        for (const EdgeUse& use : loop.uses) {
            const std::vector<Vec3> points = edge_points(model, use.edge, shares);
            for (std::size_t i = 0; i < kSamplesPerSide; ++i) {
                cycle.push_back(static_cast<Index>(region.points.size()));
                region.points.push_back(
                    geometry::to_plane(plane, points[use.reversed ? kSamplesPerSide - i : i]));
                segment.push_back(static_cast<int>(edges.size()));
            }
            edges.push_back(use.edge);
        }
    }
    // A seam has the face on both sides, so symmetries are not searched on a face with a seam.
    if (region.loops.empty() || std::set<EdgeId>(edges.begin(), edges.end()).size() < edges.size()) return {};
    sort_outer_first(region.points, region.loops);
    const std::vector<std::size_t> least = quads::segments_alike(region, segment);
    std::map<std::size_t, std::vector<EdgeId>> sets;
    for (std::size_t e = 0; e < edges.size(); ++e) sets[least[e]].push_back(edges[e]);
    std::vector<std::vector<EdgeId>> alike;
    if (sets.size() == edges.size()) return alike;
    for (auto& [first, own] : sets) alike.push_back(std::move(own));
    return alike;
}

namespace {

void ask_alike(Seeds& seeds, const Model& model, FaceId face, AlikeEdges& alike)
{
    for (std::vector<EdgeId>& set : alike_edges(model, face)) {
        double sum = 0;
        bool same = true;
        int most = 1, least = 1;
        for (const EdgeId edge : set) {
            const SeedPiece& piece = seeds.pieces.at(edge).front();
            same = same && seeds.pieces.at(edge).size() == 1 && !piece.fixed && piece.rows() == 0;
            sum += piece.sides;
            most = std::max(most, piece.count);
            least = std::max(least, piece.least);
        }
        const double mean = sum / static_cast<double>(set.size());
        for (const EdgeId edge : set)
            same = same && std::abs(seeds.pieces.at(edge).front().sides - mean) <= kAlikeSizes * mean;
        if (!same) continue;
        // Wanted numbers that differ only by rounding errors must round to the same integer.
        for (const EdgeId edge : set) {
            SeedPiece& piece = seeds.pieces.at(edge).front();
            piece.sides = mean;
            piece.count = most;
            piece.least = least;
        }
        alike[face].push_back(std::move(set));
    }
}

} // namespace

AlikeEdges ask_alike(Seeds& seeds, const Model& model, std::span<const FaceId> faces)
{
    AlikeEdges alike;
    for (const FaceId face : faces) {
        if (!seeds.kept.contains(face)) ask_alike(seeds, model, face, alike);
    }
    return alike;
}

} // namespace lacuna::surface
