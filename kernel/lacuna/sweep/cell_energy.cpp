// SPDX-License-Identifier: MIT
#include <lacuna/sweep/detail/cell_energy.h>

#include <lacuna/core/shared/constants.h>
#include <lacuna/mesh/hex_mesh.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lacuna::sweep {

namespace {

/// Weight of the volume term against the shape term, as Garanzha et al.
constexpr double kVolumeShare = 1.0 / 128;

/// Ends of the four edges along each of u, v, w.
constexpr std::array<std::array<std::array<std::size_t, 2>, 4>, 3> kEdges{{
    {{{0, 1}, {3, 2}, {4, 5}, {7, 6}}},
    {{{0, 3}, {1, 2}, {4, 7}, {5, 6}}},
    {{{0, 4}, {1, 5}, {2, 6}, {3, 7}}},
}};
/// Indices of the edges that meet at each corner.
constexpr std::array<std::array<std::size_t, 3>, 8> kAt{
    {{0, 0, 0}, {0, 1, 1}, {1, 1, 2}, {1, 0, 3}, {2, 2, 0}, {2, 3, 1}, {3, 3, 2}, {3, 2, 3}}};

using Edges = std::array<std::array<Vec3, 4>, 3>;

Edges edges_of(const std::array<Vec3, 8>& corners)
{
    Edges edges;
    for (std::size_t d = 0; d < 3; ++d) {
        for (std::size_t e = 0; e < 4; ++e) {
            edges[d][e] = corners[kEdges[d][e][1]] - corners[kEdges[d][e][0]];
        }
    }
    return edges;
}

/// Call `visit(corner, after, before, above)` for the six corners of a wedge; the three edges that lead from
/// the first to the others are right-handed.
template <class Visit>
void each_wedge_corner(const Visit& visit)
{
    for (const std::size_t corner : {0, 1, 2, 4, 5, 6}) {
        const auto& [after, before, above] = mesh::kWedgeNeighbours[corner];
        visit(corner, after, before, above);
    }
}

/// The foldover-free energy of a corner and its derivatives. Arguments are the corner's determinant divided
/// by that of the box, and the squares of its edges divided by those of the box.
struct Shape {
    double value, by_determinant, by_squares;
};

Shape shape_energy(double epsilon, double determinant, double squares)
{
    const double root = std::sqrt(epsilon * epsilon + determinant * determinant);
    const double chi = (determinant + root) / 2;
    const double chi_slope = chi / root;
    const double cube_root = std::cbrt(chi);
    const double power = 1 / (cube_root * cube_root);
    const double shape = squares * power;
    const double volume = (1 + determinant * determinant) / chi;
    return {(1 - kVolumeShare) * shape + kVolumeShare * volume,
            (1 - kVolumeShare) * (-2.0 / 3) * shape / chi * chi_slope +
                kVolumeShare * (2 * determinant - volume * chi_slope) / chi,
            (1 - kVolumeShare) * power};
}

/// Energy of a corner; its gradient by the three edges is added to the output. `best` is the factor that
/// makes the scaled Jacobian of an ideal corner 1.
double corner_energy(const CellEnergy& energy, const std::array<const Vec3*, 3>& edge, double volume,
                     const Vec3& by_square, double best, const std::array<Vec3*, 3>& by_edge)
{
    const Vec3 &u = *edge[0], &v = *edge[1], &w = *edge[2];
    const Vec3 vw = v.cross(w), wu = w.cross(u), uv = u.cross(v);
    const double det = u.dot(vw);
    const Vec3 squares(u.squaredNorm(), v.squaredNorm(), w.squaredNorm());
    const Shape shape = shape_energy(energy.epsilon, det / volume, squares.dot(by_square));
    double sum = energy.shape * shape.value;
    double by_det = energy.shape * shape.by_determinant / volume;
    Vec3 by_edge_itself = 2 * energy.shape * shape.by_squares * by_square;
    if (energy.sharpness > 0) {
        const double lengths = std::sqrt(squares.prod());
        if (lengths > 0) {
            const double scaled = best * det / lengths;
            const double term = std::exp(-energy.sharpness * scaled);
            const double by_scaled = -energy.sharpness * term;
            sum += term;
            by_det += best * by_scaled / lengths;
            by_edge_itself -= by_scaled * scaled * squares.cwiseInverse();
        }
    }
    *by_edge[0] += by_det * vw + by_edge_itself[0] * u;
    *by_edge[1] += by_det * wu + by_edge_itself[1] * v;
    *by_edge[2] += by_det * uv + by_edge_itself[2] * w;
    return sum;
}

Vec3 mean_wedge_edges(const std::array<Vec3, 8>& corners)
{
    Vec3 mean = Vec3::Zero();
    each_wedge_corner([&](std::size_t at, std::size_t after, std::size_t, std::size_t above) {
        mean[0] += (corners[after] - corners[at]).norm() / 6;
        mean[2] += (corners[above] - corners[at]).norm() / 6;
    });
    mean[1] = mean[0];
    return mean;
}

double wedge_energy(const CellEnergy& energy, const std::array<Vec3, 8>& corners, const Vec3& box,
                    std::array<Vec3, 8>& slope)
{
    slope.fill(Vec3::Zero());
    const double volume = box.prod();
    const Vec3 by_square = box.cwiseAbs2().cwiseInverse();
    double sum = 0;
    each_wedge_corner([&](std::size_t at, std::size_t one, std::size_t other, std::size_t above) {
        const std::array<std::size_t, 3> ends{one, other, above};
        std::array<Vec3, 3> edge, by_edge;
        for (std::size_t d = 0; d < 3; ++d) {
            edge[d] = corners[ends[d]] - corners[at];
            by_edge[d].setZero();
        }
        sum += corner_energy(energy, {&edge[0], &edge[1], &edge[2]}, volume, by_square,
                             2 * std::numbers::inv_sqrt3, {&by_edge[0], &by_edge[1], &by_edge[2]});
        for (std::size_t d = 0; d < 3; ++d) {
            slope[ends[d]] += by_edge[d];
            slope[at] -= by_edge[d];
        }
    });
    return sum;
}

} // namespace

Vec3 mean_edges(const std::array<Vec3, 8>& corners, CellKind kind)
{
    if (kind == CellKind::wedge) return mean_wedge_edges(corners);
    const Edges edges = edges_of(corners);
    Vec3 mean = Vec3::Zero();
    for (int d = 0; d < 3; ++d) {
        for (const Vec3& edge : edges[static_cast<std::size_t>(d)]) mean[d] += edge.norm() / 4;
    }
    return mean;
}

double least_determinant(const std::array<Vec3, 8>& corners, const Vec3& box, CellKind kind)
{
    double least = kInfinity;
    if (kind == CellKind::wedge) {
        each_wedge_corner([&](std::size_t at, std::size_t one, std::size_t other, std::size_t above) {
            const Vec3 &p = corners[at], w = corners[above] - p;
            least = std::min(least, (corners[one] - p).dot((corners[other] - p).cross(w)));
        });
        return least / box.prod();
    }
    const Edges edges = edges_of(corners);
    for (const auto& at : kAt) {
        least = std::min(least, edges[0][at[0]].dot(edges[1][at[1]].cross(edges[2][at[2]])));
    }
    return least / box.prod();
}

double cell_energy(const CellEnergy& energy, const std::array<Vec3, 8>& corners, const Vec3& box,
                   std::array<Vec3, 8>& slope, CellKind kind)
{
    if (kind == CellKind::wedge) return wedge_energy(energy, corners, box, slope);
    const Edges edges = edges_of(corners);
    Edges by_edge;
    for (auto& along : by_edge) along.fill(Vec3::Zero());
    const double volume = box.prod();
    const Vec3 by_square = box.cwiseAbs2().cwiseInverse();
    double sum = 0;
    for (const auto& at : kAt) {
        sum += corner_energy(energy, {&edges[0][at[0]], &edges[1][at[1]], &edges[2][at[2]]}, volume,
                             by_square, 1, {&by_edge[0][at[0]], &by_edge[1][at[1]], &by_edge[2][at[2]]});
    }
    slope.fill(Vec3::Zero());
    for (std::size_t d = 0; d < 3; ++d) {
        for (std::size_t e = 0; e < 4; ++e) {
            slope[kEdges[d][e][1]] += by_edge[d][e];
            slope[kEdges[d][e][0]] -= by_edge[d][e];
        }
    }
    return sum;
}

} // namespace lacuna::sweep
