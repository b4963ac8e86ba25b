// SPDX-License-Identifier: MIT
#include <lacuna/surface/detail/round_sides.h>

#include <lacuna/core/shared/criteria.h>
#include <lacuna/surface/detail/edge_turning.h>
#include <lacuna/surface/detail/face_sides.h>
#include <lacuna/surface/shared/edge_nodes.h>
#include <lacuna/topology/open_volume.h>

#include <algorithm>
#include <cmath>

namespace lacuna::surface {

using namespace topology;

namespace {

/// Relative depth of the rows along a round side, as in the disc patterns (`quads::pattern_counts()`).
constexpr double kRowsOfRadius = 1.0 / 3;

} // namespace

std::optional<RoundSide> bulge_of(const Model& model, FaceId face,
                                  const std::vector<std::vector<EdgeId>>& sides, const SizeField& size)
{
    std::optional<RoundSide> found;
    const Vec3 centre = face_centroid(model, face);
    for (std::size_t s = 0; s < sides.size(); ++s) {
        double turn = 0;
        for (const EdgeId edge : sides[s]) {
            const EdgeTurning turning(model, edge);
            turn += turning.between(0, turning.length());
        }
        if (turn < (180 - kCornerBelow) * kDegree) continue;
        if (found) return {};
        const EdgeId longest = *std::ranges::max_element(
            sides[s], [&](EdgeId a, EdgeId b) { return edge_length(model, a) < edge_length(model, b); });
        const double at[] = {0, 0.5, 1};
        const std::vector<Vec3> points = edge_points(model, longest, at);
        const Vec3 bend = points[1] - (points[0] + points[2]) / 2;
        if (bend.dot(points[1] - centre) <= 0) return {};
        found = RoundSide{s, turn, length_of(model, sides[s]) / turn, size(points[1])};
    }
    return found;
}

double wish_rows(const RoundSide& bulge, int parts, const std::vector<std::size_t>& round, std::size_t rows,
                 IntervalProgram& program)
{
    const double deep = kRowsOfRadius * bulge.radius, angle = bulge.turn / parts / 2;
    // The inner line of one part has three points: a corner on the ray through the middle of the part, and
    // its ends on the rays through the ends of the part. All three have the same distance from the round
    // side.
    const double left = bulge.radius - deep;
    const double line = 2 * parts * std::hypot(left * std::sin(angle), left * (1 - std::cos(angle)));
    program.wishes.push_back({{rows}, deep / bulge.size});
    program.wishes.push_back({round, line / bulge.size});
    return line / bulge.size / (2 * parts);
}

} // namespace lacuna::surface
