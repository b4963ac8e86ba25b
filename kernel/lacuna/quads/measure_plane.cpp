// SPDX-License-Identifier: MIT
#include <lacuna/quads/shared/measure_plane.h>

#include <lacuna/core/message.h>
#include <lacuna/core/shared/criteria.h>
#include <lacuna/core/shared/parallel.h>
#include <lacuna/mesh/quad_mesh.h>
#include <lacuna/quads/detail/corner_sine.h>
#include <lacuna/quads/detail/plane_stars.h>
#include <lacuna/quads/detail/region_loops.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace lacuna::quads {

namespace {

const Vec2& at(std::span<const Vec2> points, Index p) { return points[index(p)]; }

/// @param first, second  ideal angles of the quad at the two ends of the side
bool stands_well(std::span<const Vec2> points, const Quad& quad, std::size_t side, double height,
                 double first, double second)
{
    const std::array<double, 4> wanted{first, second, 2 * kRightAngle - second, 2 * kRightAngle - first};
    for (std::size_t i = 0; i < 4; ++i) {
        const std::size_t k = (side + i) % 4;
        const Vec2& here = at(points, quad[k]);
        const double corner = turn_between(at(points, quad[(k + 1) % 4]) - here,
                                           at(points, quad[(k + 3) % 4]) - here);
        if (std::abs(corner - wanted[i]) > kRowOffRight) return false;
    }
    const Vec2& from = at(points, quad[side]);
    const Vec2 along = (at(points, quad[(side + 1) % 4]) - from).normalized();
    for (const std::size_t far : {side + 2, side + 3}) {
        const double above = cross(along, at(points, quad[far % 4]) - from);
        if (std::abs(above - height) > kRowOffHeight * height) return false;
    }
    return true;
}

/// Number of boundary nodes whose number of quads does not fit their angle.
std::size_t boundary_irregular(const PlanarRegion& region, const std::vector<double>& angles,
                               const std::vector<Index>& valence)
{
    std::size_t count = 0, i = 0;
    for (const std::vector<Index>& loop : region.loops) {
        for (const Index p : loop) {
            const double wanted = std::max(1.0, std::round(angles[i++] / kRightAngle));
            if (valence[index(p)] != static_cast<Index>(wanted)) ++count;
        }
    }
    return count;
}

/// Find a corner of a quad whose point number is invalid, or that occurs twice in the quad.
std::string find_bad_corner(const PlanarQuads& mesh)
{
    for (std::size_t q = 0; q < mesh.quads.size(); ++q) {
        const Quad& quad = mesh.quads[q];
        for (std::size_t k = 0; k < 4; ++k) {
            if (quad[k] < 0 || index(quad[k]) >= mesh.points.size())
                return formatted("quad {} has corner {}, which is not a point", q, quad[k]);
            for (std::size_t j = 0; j < k; ++j) {
                if (quad[j] == quad[k]) return formatted("quad {} has corner {} twice", q, quad[k]);
            }
        }
    }
    return {};
}

/// Find a side of a quad that breaks the mesh: it is used three times, or twice in one direction, or it is
/// used once without being a boundary side. Also finds boundary sides without a quad. `edges` returns the
/// number of sides.
std::string find_bad_side(const PlanarQuads& mesh, const PlanarRegion& region, std::size_t& edges)
{
    const std::vector<Index> opposite = mesh::opposite_sides(mesh.quads,
                                                             static_cast<Index>(mesh.points.size()));
    std::vector<std::pair<Index, Index>> rim, wanted;
    for (std::size_t side = 0; side < opposite.size(); ++side) {
        const Quad& quad = mesh.quads[side / 4];
        const Index a = quad[side % 4], b = quad[(side + 1) % 4];
        if (opposite[side] == mesh::kBadSide)
            return formatted("side {}-{} is used by more than two quads or twice in one direction", a, b);
        if (opposite[side] == mesh::kRimSide) rim.emplace_back(a, b);
    }
    edges = (opposite.size() + rim.size()) / 2;
    for_sides_of(region.loops, [&](Index a, Index b) { wanted.emplace_back(a, b); });
    std::ranges::sort(rim);
    std::ranges::sort(wanted);
    if (rim == wanted) return {};
    std::vector<std::pair<Index, Index>> odd;
    std::set_difference(wanted.begin(), wanted.end(), rim.begin(), rim.end(), std::back_inserter(odd));
    if (!odd.empty()) return formatted("boundary side {}-{} has no quad", odd[0].first, odd[0].second);
    std::set_difference(rim.begin(), rim.end(), wanted.begin(), wanted.end(), std::back_inserter(odd));
    return formatted("side {}-{} has one quad but is not on the boundary", odd[0].first, odd[0].second);
}

} // namespace

double scaled_jacobian(std::span<const Vec2> points, const Quad& quad)
{
    // By rounding, the sine of a right angle may exceed 1.
    return std::min(
        1.0, least_sine(at(points, quad[0]), at(points, quad[1]), at(points, quad[2]), at(points, quad[3])));
}

double least_scaled_jacobian(std::span<const Vec2> points, std::span<const Quad> quads)
{
    double least = 1;
    for (const Quad& quad : quads) least = std::min(least, scaled_jacobian(points, quad));
    return least;
}

double least_scaled_jacobian(std::span<const Vec2> points, std::span<const Quad> quads,
                             const RunContext& context)
{
    return parallel_min(context, quads.size(), kBetweenPolls, 1, [&](std::size_t begin, std::size_t end) {
        return least_scaled_jacobian(points, quads.subspan(begin, end - begin));
    });
}

std::vector<double> boundary_angles(const PlanarRegion& region)
{
    std::vector<double> angles;
    for (const Cycle& loop : region.loops) {
        for (std::size_t i = 0; i < loop.size(); ++i) angles.push_back(corner_angle(region.points, loop, i));
    }
    return angles;
}

double row_corner(double angle, Index quads)
{
    // The boundary of a hole with eight sides bends by 45° at each node.
    return quads == 2 && std::abs(angle - 2 * kRightAngle) <= kRightAngle / 2 + kFileAccuracy ? angle / 2
                                                                                              : kRightAngle;
}

bool may_be_good(double angle, Index quads)
{
    return std::abs(angle / static_cast<double>(quads) - row_corner(angle, quads)) <= kRowOffRight;
}

bool may_be_good(double angle) { return may_be_good(angle, quads_in(angle)); }

PlaneQuality measure_plane(const PlanarQuads& mesh, const PlanarRegion& region)
{
    PlaneQuality result;
    result.quads = mesh.quads.size();
    result.points = mesh.points.size();
    const std::vector<Index> valence = valences(mesh.quads, mesh.points.size());
    std::vector<char> on_boundary(mesh.points.size(), 0);
    std::vector<double> wanted(mesh.points.size(), kRightAngle);
    std::vector<char> possible(mesh.points.size(), 1);
    const std::vector<double> angles = boundary_angles(region);
    std::size_t node = 0;
    for (const std::vector<Index>& loop : region.loops) {
        for (const Index p : loop) {
            on_boundary[index(p)] = 1;
            wanted[index(p)] = row_corner(angles[node], valence[index(p)]);
            possible[index(p)] = may_be_good(angles[node++]) ? 1 : 0;
        }
    }
    const std::vector<Index> opposite = mesh::opposite_sides(mesh.quads,
                                                             static_cast<Index>(mesh.points.size()));
    double jacobians = 0, ratios = 0;
    for (std::size_t q = 0; q < mesh.quads.size(); ++q) {
        const Quad& quad = mesh.quads[q];
        const double jacobian = scaled_jacobian(mesh.points, quad);
        result.min_scaled_jacobian = std::min(result.min_scaled_jacobian, jacobian);
        jacobians += jacobian;
        for (std::size_t k = 0; k < 4; ++k) {
            const Index other = opposite[4 * q + k];
            if (other >= 0 && index(other) < 4 * q + k) continue;
            const Vec2& a = at(mesh.points, quad[k]);
            const Vec2& b = at(mesh.points, quad[(k + 1) % 4]);
            const double length = (b - a).norm();
            const double asked = region.size ? region.size((a + b) / 2) : length;
            ++result.edges;
            ratios += length / asked;
            if (length >= kShortestOfSize * asked && length <= kLongestOfSize * asked) ++result.edges_of_size;
            if (other != mesh::kRimSide) continue;
            ++result.rows;
            if (possible[index(quad[k])] != 0 && possible[index(quad[(k + 1) % 4])] != 0)
                ++result.possible_rows;
            if (stands_well(mesh.points, quad, k, asked, wanted[index(quad[k])],
                            wanted[index(quad[(k + 1) % 4])]))
                ++result.good_rows;
        }
    }
    for (std::size_t p = 0; p < valence.size(); ++p) {
        if (on_boundary[p] != 0) continue;
        ++result.interior;
        if (valence[p] != 4) ++result.irregular;
    }
    result.boundary_irregular = boundary_irregular(region, angles, valence);
    if (result.quads > 0) result.mean_scaled_jacobian = jacobians / static_cast<double>(result.quads);
    if (result.edges > 0) result.mean_edge_ratio = ratios / static_cast<double>(result.edges);
    return result;
}

int least_irregular(std::span<const double> angles, int euler, double either)
{
    int low = 4 * euler, high = 4 * euler;
    for (const double angle : angles) {
        const double fit = angle / kRightAngle;
        const int fewest = std::max(1, static_cast<int>(std::ceil(fit - 0.5 - either)));
        const int most = std::max(fewest, static_cast<int>(std::floor(fit + 0.5 + either)));
        low -= 2 - fewest;
        high -= 2 - most;
    }
    return std::max({0, low, -high});
}

int least_irregular(const PlanarRegion& region)
{
    return least_irregular(boundary_angles(region), 2 - static_cast<int>(region.loops.size()));
}

std::string find_fault(const PlanarQuads& mesh, const PlanarRegion& region)
{
    if (mesh.points.size() < region.points.size() ||
        !std::equal(region.points.begin(), region.points.end(), mesh.points.begin()))
        return "the first points of the mesh are not the boundary points";
    if (std::string fault = find_bad_corner(mesh); !fault.empty()) return fault;
    std::size_t edges = 0;
    if (std::string fault = find_bad_side(mesh, region, edges); !fault.empty()) return fault;

    const std::vector<Index> valence = valences(mesh.quads, mesh.points.size());
    const auto unused = std::ranges::find(valence, 0);
    if (unused != valence.end()) return formatted("point {} has no quad", unused - valence.begin());
    // Euler's formula holds for a disc with holes that is in one piece and not pinched.
    const auto euler = static_cast<long>(mesh.points.size() + mesh.quads.size()) - static_cast<long>(edges);
    if (euler != 2 - static_cast<long>(region.loops.size()))
        return formatted(
            "points - sides + quads is {} instead of 2 - loops: the mesh is in several pieces or pinched",
            euler);
    for (std::size_t q = 0; q < mesh.quads.size(); ++q) {
        const double jacobian = scaled_jacobian(mesh.points, mesh.quads[q]);
        if (!(jacobian > 0))
            return formatted("quad {} has a corner that is not positive (scaled Jacobian {:.6f})", q,
                             jacobian);
    }
    return {};
}

} // namespace lacuna::quads
