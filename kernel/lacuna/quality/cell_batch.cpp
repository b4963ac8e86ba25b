// SPDX-License-Identifier: MIT
#include <lacuna/core/shared/criteria.h>
#include <lacuna/quality/detail/cell_batch.h>
#include <lacuna/quality/detail/lanes.h>
#include <lacuna/quality/quality.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace lacuna::quality {
namespace {

template <int N>
using Lanes3 = double[3][N];

/// det(a, b, c) for all lanes; loops of fixed length, which compilers vectorise.
template <int N>
LACUNA_INLINE void determinant(const Lanes3<N>& a, const Lanes3<N>& b, const Lanes3<N>& c, double* out)
{
    for (int i = 0; i < N; ++i) {
        out[i] = a[0][i] * (b[1][i] * c[2][i] - b[2][i] * c[1][i]) +
                 a[1][i] * (b[2][i] * c[0][i] - b[0][i] * c[2][i]) +
                 a[2][i] * (b[0][i] * c[1][i] - b[1][i] * c[0][i]);
    }
}

/// Edge vectors of the cells. along[d][e] runs in direction d; e is the position in the other two directions
/// as in `kEdgeNodes`: U(v, w) at v + 2w, V(u, w) at u + 2w, W(u, v) at u + 2v.
template <int N>
struct Edges {
    alignas(64) double along[3][4][3][N];
    alignas(64) double square[3][4][N]; ///< squared lengths
};

template <int N>
LACUNA_INLINE void find_edges(const CellBatch<N>& batch, Edges<N>& edges)
{
    for (int d = 0; d < 3; ++d) {
        for (int e = 0; e < 4; ++e) {
            const auto& from = batch.corner(kEdgeNodes[d][e][0]);
            const auto& to = batch.corner(kEdgeNodes[d][e][1]);
            auto& edge = edges.along[d][e];
            for (int i = 0; i < N; ++i) {
                const double x = to[0][i] - from[0][i];
                const double y = to[1][i] - from[1][i];
                const double z = to[2][i] - from[2][i];
                edge[0][i] = x;
                edge[1][i] = y;
                edge[2][i] = z;
                edges.square[d][e][i] = x * x + y * y + z * z;
            }
        }
    }
}

/// Coefficients at the corners, and the smallest scaled Jacobian. Its signed square is compared, so that one
/// square root per cell is enough.
template <int N>
LACUNA_INLINE void find_corners(const Edges<N>& edges, CellValues<N>& values)
{
    alignas(64) double least[N];
    for (int i = 0; i < N; ++i) least[i] = 1;
    for (int w = 0; w < 2; ++w) {
        for (int v = 0; v < 2; ++v) {
            for (int u = 0; u < 2; ++u) {
                double* det = values.bezier[2 * u + 6 * v + 18 * w];
                determinant<N>(edges.along[0][v + 2 * w], edges.along[1][u + 2 * w],
                               edges.along[2][u + 2 * v], det);
                const double* square_u = edges.square[0][v + 2 * w];
                const double* square_v = edges.square[1][u + 2 * w];
                const double* square_w = edges.square[2][u + 2 * v];
                for (int i = 0; i < N; ++i) {
                    const double lengths = square_u[i] * square_v[i] * square_w[i];
                    const double ratio = det[i] * std::abs(det[i]) / lengths;
                    const double safe = lengths > 0 && lengths <= std::numeric_limits<double>::max() ? ratio
                                                                                                     : 0.0;
                    least[i] = safe < least[i] ? safe : least[i];
                }
            }
        }
    }
    for (int i = 0; i < N; ++i) {
        const double root = std::sqrt(std::abs(least[i]));
        values.scaled[i] = least[i] < 0 ? -root : root;
    }
}

/// Change of edges across the cells. Let p < q be the two directions other than r. Then across[r][s] is the
/// edge along p at the upper end of q minus the edge along p at the lower end of q, both at end s of r. It is
/// zero if the two edges are parallel and of equal length.
template <int N>
struct Turns {
    alignas(64) double across[3][2][3][N];
};

template <int N>
LACUNA_INLINE void find_turns(const Edges<N>& edges, Turns<N>& turns)
{
    for (int r = 0; r < 3; ++r) {
        const int p = r == 0 ? 1 : 0;
        for (int s = 0; s < 2; ++s) {
            // In the index of an edge along p, r is the lower of the two directions, except for r = 2.
            const auto& low = edges.along[p][r == 2 ? 2 * s : s];
            const auto& high = edges.along[p][r == 2 ? 2 * s + 1 : s + 2];
            for (int d = 0; d < 3; ++d)
                for (int i = 0; i < N; ++i) turns.across[r][s][d][i] = high[d][i] - low[d][i];
        }
    }
}

/// The volume is the integral of J. It follows from the means of the edges and of their changes; all other
/// terms vanish by symmetry.
template <int N>
LACUNA_INLINE void find_volume(const Edges<N>& edges, const Turns<N>& turns, CellValues<N>& values)
{
    alignas(64) double edge[3][3][N], turn[3][3][N]; // sums of four edges, and of two changes
    for (int d = 0; d < 3; ++d) {
        for (int c = 0; c < 3; ++c) {
            const auto& along = edges.along[d];
            const auto& across = turns.across[d];
            for (int i = 0; i < N; ++i) {
                edge[d][c][i] = (along[0][c][i] + along[1][c][i]) + (along[2][c][i] + along[3][c][i]);
                turn[d][c][i] = across[0][c][i] + across[1][c][i];
            }
        }
    }
    alignas(64) double straight[N], u[N], v[N], w[N];
    determinant<N>(edge[0], edge[1], edge[2], straight);
    determinant<N>(edge[0], turn[2], turn[1], u);
    determinant<N>(turn[2], edge[1], turn[0], v);
    determinant<N>(turn[1], turn[0], edge[2], w);
    for (int i = 0; i < N; ++i)
        values.volume[i] = straight[i] * (1.0 / 64) + (u[i] + v[i] + w[i]) * (1.0 / 192);
}

/// Store an inexpensive lower bound of each cell's coefficients in `smallest`.
///
/// Let d = det(edge, change, change) for each edge of the cell, with the changes of the other two edge
/// vectors along this edge. Coefficients of the Jacobian:
/// - at the middle of an edge: the mean of the two at its ends, minus d / 2;
/// - at the middle of a side: the mean of the four at its corners, minus a quarter of the sum of its four d;
/// - at the centre: the mean of the eight at the corners, minus an eighth of the sum of all twelve d.
///
/// So no coefficient is below the smallest one at a corner minus 3/2 of the largest |d|. The largest |d| is
/// bounded by the product of the largest lengths of edges and changes. Edges of swept cells change little
/// across a cell, so the bound decides most of them.
/// @return  whether the bounds of all cells are positive.
template <int N>
LACUNA_INLINE bool find_bound(const Edges<N>& edges, const Turns<N>& turns, CellValues<N>& values)
{
    alignas(64) double edge[3][N], turn[3][N], least[N]; // largest squares; smallest J at the corners
    for (int d = 0; d < 3; ++d) {
        const auto& square = edges.square[d];
        for (int i = 0; i < N; ++i) {
            const double low = square[0][i] > square[1][i] ? square[0][i] : square[1][i];
            const double high = square[2][i] > square[3][i] ? square[2][i] : square[3][i];
            edge[d][i] = low > high ? low : high;
            double squares[2];
            for (int s = 0; s < 2; ++s) {
                const auto& t = turns.across[d][s];
                squares[s] = t[0][i] * t[0][i] + t[1][i] * t[1][i] + t[2][i] * t[2][i];
            }
            turn[d][i] = squares[0] > squares[1] ? squares[0] : squares[1];
        }
    }
    for (int i = 0; i < N; ++i) least[i] = values.bezier[0][i];
    for (int corner = 1; corner < 8; ++corner) {
        const auto& other = values.bezier[2 * (corner % 2) + 6 * (corner / 2 % 2) + 18 * (corner / 4)];
        for (int i = 0; i < N; ++i) least[i] = other[i] < least[i] ? other[i] : least[i];
    }
    for (int i = 0; i < N; ++i) {
        const double u = edge[0][i] * turn[1][i] * turn[2][i];
        const double v = edge[1][i] * turn[0][i] * turn[2][i];
        const double w = edge[2][i] * turn[0][i] * turn[1][i];
        const double uv = u > v ? u : v;
        const double bound = least[i] - 1.5 * (1 + kFileAccuracy) * std::sqrt(uv > w ? uv : w);
        // Leave flatter cells, where rounding may matter, to the coefficients and to subdivision.
        const double low = values.scaled[i] - kFileAccuracy;
        values.smallest[i] = least[i] = low > 0 ? bound : low;
    }
    for (int half = N / 2; half > 0; half /= 2)
        for (int i = 0; i < half; ++i) least[i] = least[i] < least[i + half] ? least[i] : least[i + half];
    return least[0] > 0;
}

/// Coefficient at the middle of an edge, `stride` from the coefficients at its two ends. It follows from the
/// edge vector and the changes of the other two edge vectors along it, given in the order of u, v, w.
template <int N>
LACUNA_INLINE void find_middle(CellValues<N>& values, int low, int stride, const Lanes3<N>& u,
                               const Lanes3<N>& v, const Lanes3<N>& w)
{
    alignas(64) double turn[N];
    determinant<N>(u, v, w, turn);
    auto& c = values.bezier;
    for (int k = 0; k < N; ++k) c[low + stride][k] = 0.5 * (c[low][k] + c[low + 2 * stride][k] - turn[k]);
}

template <int N>
LACUNA_INLINE void find_middles(const Edges<N>& edges, const Turns<N>& turns, CellValues<N>& values)
{
    const auto& along = edges.along;
    const auto& across = turns.across;
    for (int j = 0; j < 2; ++j) {
        for (int i = 0; i < 2; ++i) { // ends in the other two directions
            const int e = i + 2 * j;
            find_middle<N>(values, 6 * i + 18 * j, 1, along[0][e], across[2][j], across[1][i]);
            find_middle<N>(values, 2 * i + 18 * j, 3, across[2][j], along[1][e], across[0][i]);
            find_middle<N>(values, 2 * i + 6 * j, 9, across[1][j], across[0][i], along[2][e]);
        }
    }
}

/// Coefficient at the middle of the square spanned by two strides: (2 · edges - corners) / 4.
template <int N>
LACUNA_INLINE void find_square(CellValues<N>& values, int at, int p, int q)
{
    auto& c = values.bezier;
    for (int k = 0; k < N; ++k) {
        const double middles = (c[at - p][k] + c[at + p][k]) + (c[at - q][k] + c[at + q][k]);
        const double corners = (c[at - p - q][k] + c[at + p - q][k]) + (c[at - p + q][k] + c[at + p + q][k]);
        c[at][k] = 0.5 * middles - 0.25 * corners;
    }
}

enum class Wanted {
    all,     ///< all values of a cell
    verdict, ///< coefficients only if the inexpensive bound does not decide
    corners  ///< the scaled Jacobian, and the coefficients at the corners
};

template <int N, Wanted kWanted>
LACUNA_INLINE void evaluate_lanes(const CellBatch<N>& batch, CellValues<N>& values)
{
    Edges<N> edges;
    find_edges<N>(batch, edges);
    find_corners<N>(edges, values);
    if constexpr (kWanted == Wanted::corners) return;
    Turns<N> turns;
    find_turns<N>(edges, turns);
    if (kWanted == Wanted::verdict && find_bound<N>(edges, turns, values))
        return find_volume<N>(edges, turns, values);
    find_middles<N>(edges, turns, values);
    for (const int end : {0, 2}) {
        find_square<N>(values, 1 + 3 + 9 * end, 1, 3);
        find_square<N>(values, 1 + 3 * end + 9, 1, 9);
        find_square<N>(values, end + 3 + 9, 3, 9);
    }
    find_square<N>(values, 13, 1, 3);

    // All products of quadratic Bernstein polynomials have the same integral, 1/27.
    alignas(64) double sum[N];
    alignas(64) double least[N];
    for (int i = 0; i < N; ++i) sum[i] = least[i] = values.bezier[0][i];
    for (int c = 1; c < 27; ++c) {
        for (int i = 0; i < N; ++i) {
            const double value = values.bezier[c][i];
            sum[i] += value;
            least[i] = value < least[i] ? value : least[i];
        }
    }
    for (int i = 0; i < N; ++i) {
        values.volume[i] = sum[i] * (1.0 / 27.0);
        values.smallest[i] = least[i];
    }
}

using Batch = CellBatch<kLanes>;
using Values = CellValues<kLanes>;

/// Evaluate a batch with the widest vectors of the processor.
template <Wanted kWanted>
void evaluate_widest(const Batch& batch, Values& values)
{
    with_avx512([&]() LACUNA_INLINE_BODY { evaluate_lanes<kLanes, kWanted>(batch, values); });
}

CellBatch<1> batch_of(std::span<const Vec3, 8> corners)
{
    CellBatch<1> batch;
    for (std::size_t c = 0; c < 8; ++c)
        for (int d = 0; d < 3; ++d) batch.corner(c)[d][0] = corners[c][d];
    return batch;
}

} // namespace

void evaluate(const CellBatch<kLanes>& batch, CellValues<kLanes>& values)
{
    evaluate_widest<Wanted::verdict>(batch, values);
}

void evaluate_scaled(const CellBatch<kLanes>& batch, double (&scaled)[kLanes])
{
    Values values;
    evaluate_widest<Wanted::corners>(batch, values);
    std::copy_n(values.scaled, kLanes, scaled);
}

void evaluate(const CellBatch<1>& batch, CellValues<1>& values)
{
    evaluate_lanes<1, Wanted::all>(batch, values);
}

double scaled_jacobian(std::span<const Vec3, 8> corners)
{
    CellValues<1> values;
    evaluate(batch_of(corners), values);
    return values.scaled[0];
}

bool certified_positive(std::span<const Vec3, 8> corners, int max_depth)
{
    CellValues<1> values;
    evaluate(batch_of(corners), values);
    return positive_everywhere(view_of(values, 0), max_depth);
}

} // namespace lacuna::quality
