// SPDX-License-Identifier: MIT
#include <lacuna/surface/detail/face_sides.h>

#include <lacuna/core/shared/criteria.h>
#include <lacuna/quads/shared/submap.h>
#include <lacuna/topology/open_volume.h>
#include <lacuna/topology/shared/facet_area.h>
#include <lacuna/topology/shared/use_places.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace lacuna::surface {

using namespace topology;

namespace {

std::vector<EdgeUse> side_uses(const Loop& loop, const std::vector<std::size_t>& corners, std::size_t side)
{
    std::vector<EdgeUse> uses;
    const std::size_t n = loop.uses.size();
    for (std::size_t i = corners[side]; i != corners[(side + 1) % corners.size()]; i = (i + 1) % n)
        uses.push_back(loop.uses[i]);
    return uses;
}

std::vector<EdgeId> side_edges(const Loop& loop, const std::vector<std::size_t>& corners, std::size_t side)
{
    std::vector<EdgeId> edges;
    for (const EdgeUse& use : side_uses(loop, corners, side)) edges.push_back(use.edge);
    return edges;
}

/// Whether a line from the start of use i of a side is square to the side.
bool is_square(const Model& model, const std::vector<EdgeUse>& side, std::size_t i, const Vec3& line)
{
    const std::vector<Vec3> before = use_places(model, side[i - 1]), after = use_places(model, side[i]);
    const Vec3 along = (before.back() - before[before.size() - 2]).stableNormalized() +
                       (after[1] - after.front()).stableNormalized();
    return std::abs(along.dot(line)) < std::sin(kCreaseAngle * kDegree) * along.norm() * line.norm();
}

} // namespace

double inner_angle(const Model& model, FaceId face, const Loop& loop, std::size_t i)
{
    const std::vector<Index> before = use_points(model,
                                                 loop.uses[(i + loop.uses.size() - 1) % loop.uses.size()]);
    const std::vector<Index> after = use_points(model, loop.uses[i]);
    const Index at = after.front();
    Vec3 normal = Vec3::Zero();
    for (const Triangle& t : model[face].triangles) {
        // Sum up the angles of the facets between the two edges at this corner. If the vertex is on a seam,
        // the face has further facets at it.
        const bool touches = std::ranges::find(t, at) != t.end();
        const bool on_side = std::ranges::find(t, after[1]) != t.end() ||
                             std::ranges::find(t, before[before.size() - 2]) != t.end();
        if (!touches || !on_side) continue;
        normal += facet_area_vector(model, t);
    }
    const Vec3 out = model.at(after[1]) - model.at(at);
    const Vec3 back = model.at(before[before.size() - 2]) - model.at(at);
    const double angle = std::atan2(normal.stableNormalized().dot(out.cross(back)), out.dot(back)) * 180 /
                         std::numbers::pi;
    return angle < 0 ? angle + 360 : angle;
}

std::optional<std::vector<std::size_t>> corners_of(const Model& model, FaceId face)
{
    const std::vector<Loop>& loops = model[face].loops;
    if (loops.size() != 1) return std::nullopt;
    std::vector<std::size_t> corners;
    for (std::size_t i = 0; i < loops[0].uses.size(); ++i) {
        const double angle = inner_angle(model, face, loops[0], i);
        if (angle > kReversalAbove) return std::nullopt;
        if (angle < kCornerBelow) corners.push_back(i);
    }
    return corners;
}

std::optional<std::vector<std::size_t>> four_corners(const Model& model, FaceId face)
{
    auto corners = corners_of(model, face);
    return corners && corners->size() == 4 ? corners : std::nullopt;
}

std::vector<SidePair> side_pairs(const Model& model, FaceId face, const std::vector<std::size_t>& corners)
{
    const Loop& loop = model[face].loops[0];
    return {{side_edges(loop, corners, 0), side_edges(loop, corners, 2)},
            {side_edges(loop, corners, 1), side_edges(loop, corners, 3)}};
}

std::vector<SidePair> opposite_edges(const Model& model, FaceId face, const std::vector<std::size_t>& corners)
{
    std::vector<SidePair> pairs;
    for (const std::size_t s : {0, 1}) {
        const std::vector<EdgeUse> one = side_uses(model[face].loops[0], corners, s),
                                   other = side_uses(model[face].loops[0], corners, s + 2);
        const std::size_t n = one.size();
        bool opposite = n == other.size();
        for (std::size_t i = 1; i < n && opposite; ++i) {
            const Vec3 across = use_places(model, other[n - i]).front() - use_places(model, one[i]).front();
            opposite = is_square(model, one, i, across) && is_square(model, other, n - i, across);
        }
        std::vector<SidePair> own;
        for (std::size_t i = 0; i < n && opposite; ++i)
            own.push_back({{{one[i].edge}, {other[n - 1 - i].edge}}});
        if (n > 1 && alike(model, own)) pairs.insert(pairs.end(), own.begin(), own.end());
    }
    return pairs;
}

std::vector<SidePair> grid_sides(const Model& model, FaceId face)
{
    std::vector<SidePair> pairs;
    int outer = 0;
    for (const Loop& loop : model[face].loops) {
        std::array<std::vector<EdgeId>, 4> along;
        int heading = 0, turns = 0;
        for (std::size_t i = 0; i < loop.uses.size(); ++i) {
            const int quads = quads::grid_quads(inner_angle(model, face, loop, i) * std::numbers::pi / 180);
            if (quads == 0) return {};
            turns += 2 - quads;
            if (i > 0) heading = (heading + 2 - quads + 8) % 4;
            along[static_cast<std::size_t>(heading)].push_back(loop.uses[i].edge);
        }
        if (turns != 4 && turns != -4) return {};
        outer += turns == 4 ? 1 : 0;
        pairs.push_back({along[0], along[2]});
        pairs.push_back({along[1], along[3]});
    }
    return outer == 1 ? pairs : std::vector<SidePair>();
}

bool alike(const Model& model, const std::vector<SidePair>& pairs)
{
    return std::ranges::all_of(pairs, [&](const SidePair& sides) {
        const double a = length_of(model, sides[0]), b = length_of(model, sides[1]);
        return std::max(a, b) <= kUnlike * std::min(a, b);
    });
}

double length_of(const Model& model, const std::vector<EdgeId>& edges)
{
    return std::accumulate(edges.begin(), edges.end(), 0.0,
                           [&](double sum, EdgeId e) { return sum + edge_length(model, e); });
}

std::vector<std::vector<EdgeId>> sides_by_corners(const Model& model, FaceId face)
{
    std::vector<std::vector<EdgeId>> sides;
    const auto corners = corners_of(model, face);
    for (std::size_t s = 0; corners && s < corners->size(); ++s)
        sides.push_back(side_edges(model[face].loops[0], *corners, s));
    return sides;
}

bool is_tube(const Model& model, FaceId face)
{
    const std::vector<Loop> border = border_loops(model, face);
    const auto has_seam = [&](const Loop& loop) { // from the loop into the face
        return std::ranges::none_of(border,
                                    [&](const Loop& own) { return own.uses.size() == loop.uses.size(); });
    };
    if (model[face].loops.size() != 2 || border.size() != 2 || euler_number(model, {face}) != 0 ||
        std::ranges::any_of(model[face].loops, has_seam))
        return false;
    const Vec3 normal = face_area_vector(model, face).stableNormalized();
    return std::ranges::any_of(model[face].triangles, [&](const Triangle& t) {
        const Vec3 area = facet_area_vector(model, t);
        return area.dot(normal) < -kPoorQuad * area.norm();
    });
}

} // namespace lacuna::surface
