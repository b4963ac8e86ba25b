// SPDX-License-Identifier: MIT
#include <lacuna/quality/detail/other_cells.h>

#include <lacuna/core/shared/constants.h>
#include <lacuna/core/shared/criteria.h>
#include <lacuna/quality/detail/wedge.h>

#include <algorithm>

namespace lacuna::quality {
namespace {

constexpr CornerNeighbours kWedgeCorners[]{{0, {1, 2, 4}}, {1, {2, 0, 5}}, {2, {0, 1, 6}},
                                           {4, {6, 5, 0}}, {5, {4, 6, 1}}, {6, {5, 4, 2}}};
constexpr CornerNeighbours kBaseCorners[]{{0, {1, 3, 4}}, {1, {2, 0, 4}}, {2, {3, 1, 4}}, {3, {0, 2, 4}}};
constexpr CornerNeighbours kTetCorners[]{{0, {1, 2, 4}}, {1, {2, 0, 4}}, {2, {0, 1, 4}}, {4, {0, 2, 1}}};

OtherValues wedge_values(const CellCorners& corners)
{
    const WedgeValues wedge = evaluate_wedge(
        WedgeCorners{corners[0], corners[1], corners[2], corners[4], corners[5], corners[6]});
    OtherValues values{wedge.scaled, kInfinity, wedge.volume};
    for (const std::array<double, 3>& along : wedge.coefficients)
        values.jacobian = std::min({values.jacobian, along.front(), along.back()});
    values.positive = wedge.scaled > kRoundoff &&
                      (wedge.smallest > 0 || positive_everywhere(view_of(over_cube(wedge)), kCertifyDepth));
    return values;
}

} // namespace

std::span<const CornerNeighbours> neighbours_in(CellKind kind)
{
    if (kind == CellKind::wedge) return kWedgeCorners;
    return kind == CellKind::pyramid ? std::span<const CornerNeighbours>(kBaseCorners) : kTetCorners;
}

OtherValues evaluate_other(CellKind kind, const CellCorners& corners)
{
    if (kind == CellKind::wedge) return wedge_values(corners);
    OtherValues values{1, kInfinity, 0};
    for (const auto& [at, next] : neighbours_in(kind)) {
        std::array<Vec3, 3> edges;
        for (std::size_t k = 0; k < 3; ++k) edges[k] = corners[next[k]] - corners[at];
        const double determinant = edges[0].dot(edges[1].cross(edges[2]));
        values.scaled = std::min(values.scaled, scaled_determinant(kind, determinant, edges));
        values.jacobian = std::min(values.jacobian, determinant);
        values.volume += determinant;
    }
    // The mean of the four determinants, times the integral of (1 - w)² or of the tetrahedron.
    values.volume /= kind == CellKind::pyramid ? 12 : 24;
    values.positive = values.scaled > kRoundoff && values.jacobian > 0;
    return values;
}

std::optional<double> other_metric(Metric metric, const OtherValues& values)
{
    if (metric == Metric::scaled_jacobian) return values.scaled;
    if (metric == Metric::volume) return values.volume;
    if (metric == Metric::jacobian) return values.jacobian;
    return std::nullopt;
}

} // namespace lacuna::quality
