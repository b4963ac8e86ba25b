// SPDX-License-Identifier: MIT
#include <lacuna/quality/cell_batch.h>
#include <lacuna/quality/lanes.h>
#include <lacuna/quality/quality.h>

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
            // An edge along p counts its ends in d and q, one along q in d and p, the lower direction fastest.
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

#if defined(__GNUC__) && defined(__x86_64__)
[[gnu::target("avx512f,avx512dq")]] void evaluate_avx512(const CellBatch<kLanes>& batch,
                                                         CellValues<kLanes>& values)
{
    evaluate_lanes<kLanes>(batch, values);
}

[[gnu::target("avx2")]] void evaluate_avx2(const CellBatch<kLanes>& batch, CellValues<kLanes>& values)
{
    evaluate_lanes<kLanes>(batch, values);
}
#endif

void evaluate_plain(const CellBatch<kLanes>& batch, CellValues<kLanes>& values)
{
    evaluate_lanes<kLanes>(batch, values);
}

CellBatch<1> batch_of(std::span<const Vec3, 8> corners)
{
    CellBatch<1> batch;
    for (std::size_t c = 0; c < 8; ++c)
        for (int d = 0; d < 3; ++d) batch.corner[c][d][0] = corners[c][d];
    return batch;
}

using Coefficients = std::array<double, 27>;

/// Cut along the direction of `stride` at its middle (de Casteljau).
void split(const Coefficients& whole, int stride, Coefficients& low, Coefficients& high)
{
    for (int i = 0; i < 27; ++i) {
        if ((i / stride) % 3 != 0) continue;
        const double a = whole[i];
        const double b = whole[i + stride];
        const double c = whole[i + 2 * stride];
        const double ab = 0.5 * (a + b);
        const double bc = 0.5 * (b + c);
        const double abc = 0.5 * (ab + bc);
        low[i] = a;
        low[i + stride] = ab;
        low[i + 2 * stride] = high[i] = abc;
        high[i + stride] = bc;
        high[i + 2 * stride] = c;
    }
}

enum class Verdict { positive, negative, unknown };

Verdict judge(const Coefficients& c)
{
    for (const int corner : {0, 2, 6, 8, 18, 20, 24, 26})
        if (!(c[corner] > 0)) return Verdict::negative;
    for (const double value : c)
        if (!(value > 0)) return Verdict::unknown;
    return Verdict::positive;
}

/// Depth first: the eight parts of a cell live on the stack of their level.
bool positive_parts(const Coefficients& whole, int depth)
{
    switch (judge(whole)) {
    case Verdict::positive:
        return true;
    case Verdict::negative:
        return false;
    case Verdict::unknown:
        break;
    }
    if (depth <= 0) return false;
    Coefficients halves[2], quarters[2], eighths[2];
    split(whole, 1, halves[0], halves[1]);
    for (const Coefficients& half : halves) {
        split(half, 3, quarters[0], quarters[1]);
        for (const Coefficients& quarter : quarters) {
            split(quarter, 9, eighths[0], eighths[1]);
            for (const Coefficients& eighth : eighths)
                if (!positive_parts(eighth, depth - 1)) return false;
        }
    }
    return true;
}

} // namespace

void evaluate(const CellBatch<kLanes>& batch, CellValues<kLanes>& values)
{
#if defined(__GNUC__) && defined(__x86_64__)
    static const bool avx512 = __builtin_cpu_supports("avx512f") != 0 &&
                               __builtin_cpu_supports("avx512dq") != 0;
    static const bool avx2 = __builtin_cpu_supports("avx2") != 0;
    if (avx512) return evaluate_avx512(batch, values);
    if (avx2) return evaluate_avx2(batch, values);
#endif
    evaluate_plain(batch, values);
}

void evaluate(const CellBatch<1>& batch, CellValues<1>& values) { evaluate_lanes<1>(batch, values); }

bool positive_everywhere(const double (&bezier)[27], int max_depth)
{
    Coefficients whole;
    for (int i = 0; i < 27; ++i) whole[i] = bezier[i];
    return positive_parts(whole, max_depth);
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
    double bezier[27];
    for (int i = 0; i < 27; ++i) bezier[i] = values.bezier[i][0];
    return positive_everywhere(bezier, max_depth);
}

} // namespace lacuna::quality
