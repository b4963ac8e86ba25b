// SPDX-License-Identifier: MIT
#include <lacuna/quality/detail/cell_batch.h>
#include <lacuna/quality/detail/lanes.h>
#include <lacuna/quality/quality.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace lacuna::quality {
namespace {

template <int N>
using Lanes3 = double[3][N];

/// det(a, b, c), all lanes; plain loops of fixed length, which compilers turn into vector code.
template <int N>
LACUNA_INLINE void determinant(const Lanes3<N>& a, const Lanes3<N>& b, const Lanes3<N>& c, double* out)
{
    for (int i = 0; i < N; ++i) {
        out[i] = a[0][i] * (b[1][i] * c[2][i] - b[2][i] * c[1][i]) +
                 a[1][i] * (b[2][i] * c[0][i] - b[0][i] * c[2][i]) +
                 a[2][i] * (b[0][i] * c[1][i] - b[1][i] * c[0][i]);
    }
}

/// det(a, b0 + b1, c0 + c1)
template <int N>
LACUNA_INLINE void determinant(const Lanes3<N>& a, const Lanes3<N>& b0, const Lanes3<N>& b1,
                               const Lanes3<N>& c0, const Lanes3<N>& c1, double* out)
{
    for (int i = 0; i < N; ++i) {
        const double bx = b0[0][i] + b1[0][i];
        const double by = b0[1][i] + b1[1][i];
        const double bz = b0[2][i] + b1[2][i];
        const double cx = c0[0][i] + c1[0][i];
        const double cy = c0[1][i] + c1[1][i];
        const double cz = c0[2][i] + c1[2][i];
        out[i] = a[0][i] * (by * cz - bz * cy) + a[1][i] * (bz * cx - bx * cz) +
                 a[2][i] * (bx * cy - by * cx);
    }
}

/// Edges of the cells: along[d][e] runs in direction d; e counts the ends in the other two directions, the
/// lower direction fastest: U(v, w) at v + 2w, V(u, w) at u + 2w, W(u, v) at u + 2v.
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
            const auto& from = batch.corner[kEdgeNodes[d][e][0]];
            const auto& to = batch.corner[kEdgeNodes[d][e][1]];
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

/// Coefficients at the corners, and the smallest scaled Jacobian. It is compared squared, with its sign, so
/// that one root a cell is enough.
template <int N>
LACUNA_INLINE void find_corners(const Edges<N>& edges, CellValues<N>& values)
{
    constexpr double kLargest = std::numeric_limits<double>::max();
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
                    const double safe = lengths > 0 && lengths <= kLargest ? ratio : 0.0;
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

/// Coefficients in the middle of the edges.
template <int N>
LACUNA_INLINE void find_middles(const Edges<N>& edges, CellValues<N>& values)
{
    constexpr int kStride[3] = {1, 3, 9};
    for (int d = 0; d < 3; ++d) {
        const int p = d == 0 ? 1 : 0; // the other two directions, p < q
        const int q = d == 2 ? 1 : 2;
        for (int e = 0; e < 4; ++e) {
            const int i = e % 2; // end in direction p
            const int j = e / 2; // end in direction q
            const int at = 2 * i * kStride[p] + 2 * j * kStride[q] + kStride[d];
            // An edge along p counts its ends in d and q, one along q in d and p, the lower direction
            // fastest.
            const auto p_edge = [&](int s) { return d < q ? s + 2 * j : j + 2 * s; };
            const auto q_edge = [&](int s) { return d < p ? s + 2 * i : i + 2 * s; };
            const auto& ps = edges.along[p];
            const auto& qs = edges.along[q];
            double* out = values.bezier[at];
            determinant<N>(edges.along[d][e], ps[p_edge(0)], ps[p_edge(1)], qs[q_edge(0)], qs[q_edge(1)],
                           out);
            const double sign = d == 1 ? -1.0 : 1.0; // (v, u, w) is an odd order of (u, v, w)
            const double* first = values.bezier[at - kStride[d]];
            const double* last = values.bezier[at + kStride[d]];
            for (int k = 0; k < N; ++k) out[k] = 0.5 * (sign * out[k] - first[k] - last[k]);
        }
    }
}

/// Coefficient in the middle of the square spanned by two strides: (2 · edges - corners) / 4.
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

template <int N>
LACUNA_INLINE void evaluate_lanes(const CellBatch<N>& batch, CellValues<N>& values)
{
    Edges<N> edges;
    find_edges<N>(batch, edges);
    find_corners<N>(edges, values);
    find_middles<N>(edges, values);
    for (const int end : {0, 2}) {
        find_square<N>(values, 1 + 3 + 9 * end, 1, 3);
        find_square<N>(values, 1 + 3 * end + 9, 1, 9);
        find_square<N>(values, end + 3 + 9, 3, 9);
    }
    find_square<N>(values, 13, 1, 3);

    // Every product of Bernstein polynomials of degree two has the same integral, 1/27.
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

/// The scaled Jacobian, and of the coefficients those at the corners.
template <int N>
LACUNA_INLINE void evaluate_corners(const CellBatch<N>& batch, CellValues<N>& values)
{
    Edges<N> edges;
    find_edges<N>(batch, edges);
    find_corners<N>(edges, values);
}

using Batch = CellBatch<kLanes>;
using Values = CellValues<kLanes>;

enum class Wanted { all, corners };

template <Wanted kWanted>
LACUNA_INLINE void evaluate_wanted(const Batch& batch, Values& values)
{
    if constexpr (kWanted == Wanted::all)
        evaluate_lanes<kLanes>(batch, values);
    else
        evaluate_corners<kLanes>(batch, values);
}

#if defined(LACUNA_WIDER_VECTORS)
template <Wanted kWanted>
[[gnu::target("avx512f,avx512dq")]] void evaluate_avx512(const Batch& batch, Values& values)
{
    evaluate_wanted<kWanted>(batch, values);
}

template <Wanted kWanted>
[[gnu::target("avx2")]] void evaluate_avx2(const Batch& batch, Values& values)
{
    evaluate_wanted<kWanted>(batch, values);
}
#endif

/// With the widest vectors the machine has.
template <Wanted kWanted>
void evaluate_widest(const Batch& batch, Values& values)
{
#if defined(LACUNA_WIDER_VECTORS)
    if (has_avx512()) return evaluate_avx512<kWanted>(batch, values);
    if (has_avx2()) return evaluate_avx2<kWanted>(batch, values);
#endif
    evaluate_wanted<kWanted>(batch, values);
}

CellBatch<1> batch_of(std::span<const Vec3, 8> corners)
{
    CellBatch<1> batch;
    for (std::size_t c = 0; c < 8; ++c)
        for (int d = 0; d < 3; ++d) batch.corner[c][d][0] = corners[c][d];
    return batch;
}

} // namespace

void evaluate(const CellBatch<kLanes>& batch, CellValues<kLanes>& values)
{
    evaluate_widest<Wanted::all>(batch, values);
}

void evaluate_scaled(const CellBatch<kLanes>& batch, double (&scaled)[kLanes])
{
    Values values;
    evaluate_widest<Wanted::corners>(batch, values);
    std::copy_n(values.scaled, kLanes, scaled);
}

void evaluate(const CellBatch<1>& batch, CellValues<1>& values) { evaluate_lanes<1>(batch, values); }

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
