// SPDX-License-Identifier: MIT
#include <lacuna/sweep/detail/cell_energy.h>

#include <lacuna/core/shared/constants.h>
#include <lacuna/core/shared/vector_code.h>
#include <lacuna/geometry/shared/foldover.h>
#include <lacuna/mesh/hex_mesh.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numbers>

namespace lacuna::sweep {

namespace {

using geometry::kSizeShare;

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

/// Call `visit(corner, after, before, above)` for the six corners of a wedge. The three edges from a corner
/// to `after`, `before` and `above` are right-handed.
template <class Visit>
void each_wedge_corner(const Visit& visit)
{
    for (const std::size_t corner : {0, 1, 2, 4, 5, 6}) {
        const auto& [after, before, above] = mesh::kWedgeNeighbours[corner];
        visit(corner, after, before, above);
    }
}

/// Computes four corners at once with vector instructions. All functions are inlined and compiled for the
/// processor at hand. No vector is passed by value, because the calling convention for vectors depends on the
/// processor.
class FourCorners {
public:
    /// The three edges at each corner, right-handed.
    using Ends = std::array<const Vec3*, 3>;
    LACUNA_INLINE void set(const Ends& a, const Ends& b, const Ends& c, const Ends& d)
    {
        for (int k = 0; k < 3; ++k) {
            u_[k] = Four{(*a[0])[k], (*b[0])[k], (*c[0])[k], (*d[0])[k]};
            v_[k] = Four{(*a[1])[k], (*b[1])[k], (*c[1])[k], (*d[1])[k]};
            w_[k] = Four{(*a[2])[k], (*b[2])[k], (*c[2])[k], (*d[2])[k]};
        }
    }

    /// @param best  factor that makes the scaled Jacobian of an ideal corner 1
    LACUNA_INLINE void measure(const CellEnergy& energy, double volume, const Vec3& by_square, double best)
    {
        Vector vw, wu, uv;
        cross(v_, w_, vw);
        cross(w_, u_, wu);
        cross(u_, v_, uv);
        const Four det = u_[0] * vw[0] + u_[1] * vw[1] + u_[2] * vw[2];
        const Vector squares{u_[0] * u_[0] + u_[1] * u_[1] + u_[2] * u_[2],
                             v_[0] * v_[0] + v_[1] * v_[1] + v_[2] * v_[2],
                             w_[0] * w_[0] + w_[1] * w_[1] + w_[2] * w_[2]};
        // The foldover-free energy. It needs the determinant relative to the volume of the reference box, and
        // the squares of the edges relative to the edges of the box.
        const Four determinant = det / volume;
        const Four tall = energy.epsilon * energy.epsilon + determinant * determinant;
        Four root{}, power{};
        for (int i = 0; i < 4; ++i) root[i] = std::sqrt(tall[i]);
        const Four chi = (determinant + root) / 2, chi_slope = chi / root;
        by_cube_root(chi, power);
        power = power * power;
        const Four shape =
            (squares[0] * by_square[0] + squares[1] * by_square[1] + squares[2] * by_square[2]) * power;
        const Four spread = (1 + determinant * determinant) / chi;
        value_ = energy.shape * ((1 - kSizeShare) * shape + kSizeShare * spread);
        Four by_det = energy.shape *
                      ((1 - kSizeShare) * (-2.0 / 3) * shape / chi * chi_slope +
                       kSizeShare * (2 * determinant - spread * chi_slope) / chi) /
                      volume;
        const Four by_squares = 2 * energy.shape * ((1 - kSizeShare) * power);
        Vector by_edge{by_squares * by_square[0], by_squares * by_square[1], by_squares * by_square[2]};
        if (energy.sharpness > 0) add_sharpness(energy.sharpness, best, det, squares, by_det, by_edge);
        for (int c = 0; c < 3; ++c) {
            by_u_[c] = by_det * vw[c] + by_edge[0] * u_[c];
            by_v_[c] = by_det * wu[c] + by_edge[1] * v_[c];
            by_w_[c] = by_det * uv[c] + by_edge[2] * w_[c];
        }
    }

    [[nodiscard]] LACUNA_INLINE double value(std::size_t lane) const { return value_[lane]; }
    /// The gradient of a corner's energy with respect to its three edges.
    [[nodiscard]] LACUNA_INLINE std::array<Vec3, 3> slopes(std::size_t lane) const
    {
        return {Vec3(by_u_[0][lane], by_u_[1][lane], by_u_[2][lane]),
                Vec3(by_v_[0][lane], by_v_[1][lane], by_v_[2][lane]),
                Vec3(by_w_[0][lane], by_w_[1][lane], by_w_[2][lane])};
    }

private:
    using Vector = Four[3];

    LACUNA_INLINE static void cross(const Vector& a, const Vector& b, Vector& product)
    {
        product[0] = a[1] * b[2] - a[2] * b[1];
        product[1] = a[2] * b[0] - a[0] * b[2];
        product[2] = a[0] * b[1] - a[1] * b[0];
    }

    /// Compute 1 / ∛x of positive values, to rounding error. The bits of a floating-point number grow nearly
    /// as its logarithm, which gives the result within 9 %; each step of Newton's method squares the error.
    LACUNA_INLINE static void by_cube_root(const Four& x, Four& result)
    {
        constexpr auto one = std::bit_cast<std::int64_t>(1.0);
        for (int i = 0; i < 4; ++i)
            result[i] = std::bit_cast<double>(one / 3 * 4 - std::bit_cast<std::int64_t>(x[i]) / 3);
        for (int step = 0; step < 5; ++step)
            result += result * (1 - x * result * result * result) * (1.0 / 3);
    }

    /// Add the term of the scaled Jacobian. Corners with an edge of zero length have no such term.
    LACUNA_INLINE void add_sharpness(double sharpness, double best, const Four& det, const Vector& squares,
                                     Four& by_det, Vector& by_edge)
    {
        const Four product = squares[0] * squares[1] * squares[2];
        Four lengths{}, term{};
        for (int i = 0; i < 4; ++i) lengths[i] = std::sqrt(product[i]);
        const auto some = lengths > 0;
        const Four over = some ? lengths : Four{1, 1, 1, 1};
        const Four scaled = best * det / over;
        for (int i = 0; i < 4; ++i) term[i] = some[i] != 0 ? std::exp(-sharpness * scaled[i]) : 0;
        const Four by_scaled = -sharpness * term, by_square = by_scaled * scaled;
        value_ += term;
        by_det += best * by_scaled / over;
        for (int d = 0; d < 3; ++d) by_edge[d] -= some ? by_square * (1 / squares[d]) : Four{};
    }

    Vector u_, v_, w_, by_u_, by_v_, by_w_;
    Four value_;
};

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

LACUNA_INLINE double wedge_energy(const CellEnergy& energy, const std::array<Vec3, 8>& corners,
                                  const Vec3& box, std::array<Vec3, 8>& slope)
{
    std::array<std::array<Vec3, 3>, 6> edges;
    std::size_t set = 0;
    each_wedge_corner([&](std::size_t at, std::size_t one, std::size_t other, std::size_t above) {
        const Vec3& p = corners[at];
        edges[set++] = {corners[one] - p, corners[other] - p, corners[above] - p};
    });
    const auto ends = [&](std::size_t k) {
        return FourCorners::Ends{&edges[k][0], &edges[k][1], &edges[k][2]};
    };
    std::array<FourCorners, 2> lanes;
    lanes[0].set(ends(0), ends(1), ends(2), ends(3));
    lanes[1].set(ends(4), ends(5), ends(5), ends(5)); // the last two lanes are idle
    const Vec3 by_square = box.cwiseAbs2().cwiseInverse();
    for (FourCorners& four : lanes) four.measure(energy, box.prod(), by_square, 2 * std::numbers::inv_sqrt3);
    double sum = 0;
    std::size_t k = 0;
    each_wedge_corner([&](std::size_t at, std::size_t one, std::size_t other, std::size_t above) {
        const std::array<std::size_t, 3> tips{one, other, above};
        const std::array<Vec3, 3> by_edge = lanes[k / 4].slopes(k % 4);
        sum += lanes[k / 4].value(k % 4);
        for (std::size_t d = 0; d < 3; ++d) {
            slope[tips[d]] += by_edge[d];
            slope[at] -= by_edge[d];
        }
        ++k;
    });
    return sum;
}

LACUNA_INLINE double hex_energy(const CellEnergy& energy, const std::array<Vec3, 8>& corners, const Vec3& box,
                                std::array<Vec3, 8>& slope)
{
    const Edges edges = edges_of(corners);
    std::array<FourCorners, 2> lanes;
    const auto ends = [&](std::size_t k) {
        return FourCorners::Ends{&edges[0][kAt[k][0]], &edges[1][kAt[k][1]], &edges[2][kAt[k][2]]};
    };
    lanes[0].set(ends(0), ends(1), ends(2), ends(3));
    lanes[1].set(ends(4), ends(5), ends(6), ends(7));
    const Vec3 by_square = box.cwiseAbs2().cwiseInverse();
    for (FourCorners& four : lanes) four.measure(energy, box.prod(), by_square, 1);
    Edges by_edge;
    for (auto& along : by_edge) along.fill(Vec3::Zero());
    double sum = 0;
    for (std::size_t k = 0; k < 8; ++k) {
        const std::array<Vec3, 3> by = lanes[k / 4].slopes(k % 4);
        for (std::size_t d = 0; d < 3; ++d) by_edge[d][kAt[k][d]] += by[d];
        sum += lanes[k / 4].value(k % 4);
    }
    for (std::size_t d = 0; d < 3; ++d) {
        for (std::size_t e = 0; e < 4; ++e) {
            slope[kEdges[d][e][1]] += by_edge[d][e];
            slope[kEdges[d][e][0]] -= by_edge[d][e];
        }
    }
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
    slope.fill(Vec3::Zero());
    return with_avx2([&]() LACUNA_INLINE_BODY {
        return kind == CellKind::wedge ? wedge_energy(energy, corners, box, slope)
                                       : hex_energy(energy, corners, box, slope);
    });
}

} // namespace lacuna::sweep
