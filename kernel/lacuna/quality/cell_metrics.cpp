// SPDX-License-Identifier: MIT
#include <lacuna/quality/detail/cell_metrics.h>

#include <lacuna/quality/detail/lanes.h>

#include <cmath>

// The trilinear map of a cell, with r, s, t from -1 to 1:
//     x = (sum of corners + a r + b s + c t + ab rs + ac rt + bc st + abc rst) / 8
// a, b, c are the axes times four; ab, ac, bc are the differences of opposite edges (Taylor and Flanagan
// 1989).

namespace lacuna::quality {
namespace {

/// Limit of Verdict: smaller lengths, areas and volumes count as zero. Metrics that are then undefined get
/// its reciprocal.
constexpr double kNothing = 1e-30;

constexpr int N = kMetricLanes;
using Real = Lanes<N>;
using Vector = Vectors<N>;
using Batch = CellBatch<N>;

/// Quantities shared by several metrics.
struct Parts {
    Vector edge[3][4]; ///< in the order of `kEdgeNodes`
    Real square[3][4]; ///< their squared lengths
    Real corner[8];    ///< Jacobian at the corner with bits u, v, w
    Vector a, b, c;
    Real aa, bb, cc; ///< their squared lengths
    Real centre;     ///< Jacobian at the centre, for the map of the unit cube
};

/// The three edges at a corner, in the order u, v, w. The bits of the corner's number give its position along
/// u, v, w.
struct CornerEdges {
    int u, v, w;
};
constexpr CornerEdges edges_at(int corner)
{
    const int u = corner & 1;
    const int v = corner >> 1 & 1;
    const int w = corner >> 2;
    return {v + 2 * w, u + 2 * w, u + 2 * v};
}

LACUNA_INLINE Vector node(const Batch& batch, int i)
{
    Vector p;
    for (int k = 0; k < N; ++k) {
        p.x.v[k] = batch.corner(i)[0][k];
        p.y.v[k] = batch.corner(i)[1][k];
        p.z.v[k] = batch.corner(i)[2][k];
    }
    return p;
}

LACUNA_INLINE void find_parts(const Batch& batch, Parts& p)
{
    for (int d = 0; d < 3; ++d)
        for (int e = 0; e < 4; ++e) {
            p.edge[d][e] = node(batch, kEdgeNodes[d][e][1]) - node(batch, kEdgeNodes[d][e][0]);
            p.square[d][e] = dot(p.edge[d][e], p.edge[d][e]);
        }
    for (int i = 0; i < 8; ++i) {
        const CornerEdges at = edges_at(i);
        p.corner[i] = determinant(p.edge[0][at.u], p.edge[1][at.v], p.edge[2][at.w]);
    }
    const auto sum = [&](int d) { return (p.edge[d][0] + p.edge[d][1]) + (p.edge[d][2] + p.edge[d][3]); };
    p.a = sum(0);
    p.b = sum(1);
    p.c = sum(2);
    p.aa = dot(p.a, p.a);
    p.bb = dot(p.b, p.b);
    p.cc = dot(p.c, p.c);
    p.centre = (1.0 / 64) * determinant(p.a, p.b, p.c);
}

LACUNA_INLINE Real least_corner(const Parts& p)
{
    Real r = p.corner[0];
    for (int i = 1; i < 8; ++i) r = least(p.corner[i], r);
    return r;
}

/// Call `body(squared lengths of the three edges, Jacobian)` for every corner.
template <class Body>
LACUNA_INLINE void for_each_corner(const Parts& p, const Body& body)
{
    for (int i = 0; i < 8; ++i) {
        const CornerEdges at = edges_at(i);
        body(p.square[0][at.u], p.square[1][at.v], p.square[2][at.w], p.corner[i]);
    }
}

LACUNA_INLINE Real shortest_square(const Parts& p)
{
    Real r = p.square[0][0];
    for (const auto& squares : p.square)
        for (const Real& square : squares) r = least(square, r);
    return r;
}

LACUNA_INLINE Real longest_square(const Parts& p)
{
    Real r = p.square[0][0];
    for (const auto& squares : p.square)
        for (const Real& square : squares) r = greatest(square, r);
    return r;
}

LACUNA_INLINE Real with_sign(const Real& square)
{
    Real r = root(magnitude(square));
    for (int i = 0; i < N; ++i) r.v[i] = square.v[i] < 0 ? -r.v[i] : r.v[i];
    return r;
}

/// Signed square of the scaled Jacobian, so that one square root per cell is enough.
LACUNA_INLINE Real scaled_square(const Parts& p)
{
    Real r = Real::all(1);
    for_each_corner(p, [&](const Real& u, const Real& v, const Real& w, const Real& det) {
        const Real lengths = u * v * w;
        r = least(where_above(lengths, 0, det * magnitude(det) / lengths, 0), r);
    });
    return r;
}

LACUNA_INLINE Real scaled_jacobian_of(const Parts& p) { return with_sign(scaled_square(p)); }

LACUNA_INLINE Real scaled_with_centre(const Parts& p)
{
    const Real det = 64 * p.centre;
    const Real r = with_sign(least(det * magnitude(det) / (p.aa * p.bb * p.cc), scaled_square(p)));
    const Real shortest = least(shortest_square(p), least(p.aa, least(p.bb, p.cc)));
    return where_above(shortest, kNothing, r, 0);
}

LACUNA_INLINE Real jacobian(const Parts& p) { return least(p.centre, least_corner(p)); }

LACUNA_INLINE Real shear(const Parts& p)
{
    const Real r = where_above(least_corner(p), kNothing, scaled_jacobian_of(p), 0);
    return where_above(shortest_square(p), kNothing, r, 0);
}

/// Smallest 3 det^(2/3) / |edges|², compared as its cube.
LACUNA_INLINE Real shape(const Parts& p)
{
    Real r = Real::all(1);
    for_each_corner(p, [&](const Real& u, const Real& v, const Real& w, const Real& det) {
        const Real squares = u + v + w;
        r = least(27 * (det * det) / (squares * squares * squares), r);
    });
    return where_above(least_corner(p), kNothing, cube_root(r), 0);
}

/// |J|² |adj J|² / det², of corner `i`.
LACUNA_INLINE Real condition_square(const Parts& p, int i)
{
    const CornerEdges at = edges_at(i);
    const Vector& u = p.edge[0][at.u];
    const Vector& v = p.edge[1][at.v];
    const Vector& w = p.edge[2][at.w];
    const Vector uv = cross(u, v);
    const Vector vw = cross(v, w);
    const Vector wu = cross(w, u);
    const Real& det = p.corner[i];
    const Real r = (p.square[0][at.u] + p.square[1][at.v] + p.square[2][at.w]) *
                   (dot(uv, uv) + dot(vw, vw) + dot(wu, wu)) / (det * det);
    return where_above(det, kNothing, r, 1 / (kNothing * kNothing));
}

LACUNA_INLINE Real condition(const Parts& p)
{
    Real r = condition_square(p, 0);
    for (int i = 1; i < 8; ++i) r = greatest(condition_square(p, i), r);
    return (1.0 / 3) * root(r);
}

LACUNA_INLINE Real med_aspect_frobenius(const Parts& p)
{
    Real r = Real::all(0);
    for (int i = 0; i < 8; ++i) r = r + root(condition_square(p, i));
    return (1.0 / 24) * r;
}

/// (|G|² - |J|⁴ / 3)³ / det⁴ with the metric tensor G.
LACUNA_INLINE Real oddy_cubed(const Vector& u, const Vector& v, const Vector& w, const Real& uu,
                              const Real& vv, const Real& ww, const Real& det)
{
    const Real uv = dot(u, v);
    const Real uw = dot(u, w);
    const Real vw = dot(v, w);
    const Real trace = uu + vv + ww;
    const Real tensor = (uu * uu + vv * vv + ww * ww) + 2 * (uv * uv + uw * uw + vw * vw);
    const Real part = tensor - (1.0 / 3) * (trace * trace);
    const Real square = det * det;
    return where_above(det, kNothing, (part * part * part) / (square * square),
                       1 / (kNothing * kNothing * kNothing));
}

LACUNA_INLINE Real oddy(const Parts& p)
{
    Real r = greatest(oddy_cubed(p.a, p.b, p.c, p.aa, p.bb, p.cc, 64 * p.centre), Real::all(0));
    for (int i = 0; i < 8; ++i) {
        const CornerEdges at = edges_at(i);
        r = greatest(oddy_cubed(p.edge[0][at.u], p.edge[1][at.v], p.edge[2][at.w], p.square[0][at.u],
                                p.square[1][at.v], p.square[2][at.w], p.corner[i]),
                     r);
    }
    return cube_root(r);
}

LACUNA_INLINE Real skew(const Parts& p)
{
    const Real la = root(p.aa);
    const Real lb = root(p.bb);
    const Real lc = root(p.cc);
    const Real ab = magnitude(dot(p.a, p.b)) / (la * lb);
    const Real ac = magnitude(dot(p.a, p.c)) / (la * lc);
    const Real bc = magnitude(dot(p.b, p.c)) / (lb * lc);
    return where_above(least(la, least(lb, lc)), kNothing, greatest(ab, greatest(ac, bc)), 1 / kNothing);
}

/// Differences of opposite edges: ab, ac, bc of the map.
struct Differences {
    Vector ab, ac, bc;
};
LACUNA_INLINE Differences differences(const Parts& p)
{
    const auto& u = p.edge[0];
    const auto& v = p.edge[1];
    return {(u[1] - u[0]) + (u[3] - u[2]), (u[2] - u[0]) + (u[3] - u[1]), (v[2] - v[0]) + (v[3] - v[1])};
}

LACUNA_INLINE Real ratio(const Real& above, const Real& below, double otherwise)
{
    return where_above(below, kNothing, above / below, otherwise);
}

LACUNA_INLINE Real taper(const Parts& p)
{
    const Differences d = differences(p);
    const Real la = root(p.aa);
    const Real lb = root(p.bb);
    const Real lc = root(p.cc);
    const Real ab = ratio(root(dot(d.ab, d.ab)), least(la, lb), 1 / kNothing);
    const Real ac = ratio(root(dot(d.ac, d.ac)), least(la, lc), 1 / kNothing);
    const Real bc = ratio(root(dot(d.bc, d.bc)), least(lb, lc), 1 / kNothing);
    return greatest(ab, greatest(ac, bc));
}

LACUNA_INLINE Real max_edge_ratio(const Parts& p)
{
    return ratio(root(greatest(p.aa, greatest(p.bb, p.cc))), root(least(p.aa, least(p.bb, p.cc))),
                 1 / kNothing);
}

LACUNA_INLINE Real edge_ratio(const Parts& p, const Real& longest)
{
    const Real shortest = shortest_square(p);
    return where_above(shortest, kNothing, root(longest / shortest), 1 / kNothing);
}

/// As in VTK 9.1, the longest of the edges 0-1, 1-2, 2-3, 3-0, 4-5 and 5-6 only.
LACUNA_INLINE Real vtk_edge_ratio(const Parts& p)
{
    const auto& u = p.square[0];
    const auto& v = p.square[1];
    const Real bottom = greatest(greatest(u[0], u[1]), greatest(v[0], v[1]));
    return edge_ratio(p, greatest(bottom, greatest(u[2], v[3])));
}

/// Squared lengths of the shortest and longest of the four body diagonals.
LACUNA_INLINE void diagonals(const Batch& batch, Real& shortest, Real& longest)
{
    constexpr int kEnds[4][2] = {{0, 6}, {1, 7}, {2, 4}, {3, 5}};
    for (int i = 0; i < 4; ++i) {
        const Vector line = node(batch, kEnds[i][1]) - node(batch, kEnds[i][0]);
        const Real square = dot(line, line);
        shortest = i == 0 ? square : least(square, shortest);
        longest = i == 0 ? square : greatest(square, longest);
    }
}

LACUNA_INLINE Real stretch(const Parts& p, const Batch& batch)
{
    Real shortest, longest;
    diagonals(batch, shortest, longest);
    return ratio(root(3 * shortest_square(p)), root(longest), 0);
}

LACUNA_INLINE Real diagonal(const Batch& batch)
{
    Real shortest, longest;
    diagonals(batch, shortest, longest);
    return ratio(root(shortest), root(longest), 0);
}

/// 64 × the volume: det(a, b, c) + (det(a, ab, ac) + det(ab, b, bc) + det(ac, bc, c)) / 3.
LACUNA_INLINE Real volume_64(const Parts& p, const Differences& d)
{
    const Real rest = determinant(p.a, d.ab, d.ac) + determinant(d.ab, p.b, d.bc) +
                      determinant(d.ac, d.bc, p.c);
    return 64 * p.centre + (1.0 / 3) * rest;
}

/// V / sqrt(2 |dV/dx|²) over all nodes x (Flanagan and Belytschko 1981). The coefficients of the map are
/// products of the nodes with orthogonal sign vectors of length √8, so |dV/dx|² is 8 × the sum of the squared
/// derivatives by the coefficients.
LACUNA_INLINE Real dimension(const Parts& p)
{
    const Differences d = differences(p);
    const double third = 1.0 / 3;
    const Vector by[6] = {
        cross(p.b, p.c) + third * cross(d.ab, d.ac),   cross(p.c, p.a) + third * cross(d.bc, d.ab),
        cross(p.a, p.b) + third * cross(d.ac, d.bc),   third * (cross(d.ac, p.a) + cross(p.b, d.bc)),
        third * (cross(p.a, d.ab) + cross(d.bc, p.c)), third * (cross(d.ab, p.b) + cross(p.c, d.ac))};
    Real squares = Real::all(0);
    for (const Vector& gradient : by) squares = squares + dot(gradient, gradient);
    return where_above(squares, 0, magnitude(volume_64(p, d)) / (4 * root(squares)), 0);
}

/// Jacobian at the Gauss point near the given corner: interpolated between near and far edges.
LACUNA_INLINE Real gauss_jacobian(const Parts& p, int corner)
{
    const double far = 0.5 - std::sqrt(1.0 / 12); // weight of the farther side
    const double u = corner & 1 ? 1 - far : far;
    const double v = corner & 2 ? 1 - far : far;
    const double w = corner & 4 ? 1 - far : far;
    const auto between = [&](const Vector(&e)[4], double first, double second) {
        return (1 - second) * ((1 - first) * e[0] + first * e[1]) +
               second * ((1 - first) * e[2] + first * e[3]);
    };
    return determinant(between(p.edge[0], v, w), between(p.edge[1], u, w), between(p.edge[2], u, v));
}

LACUNA_INLINE Real distortion(const Parts& p)
{
    Real smallest = least_corner(p);
    Real mean = Real::all(0);
    for (int i = 0; i < 8; ++i) {
        const Real jacobian = gauss_jacobian(p, i);
        smallest = least(jacobian, smallest);
        mean = mean + 0.125 * jacobian;
    }
    return where_above(magnitude(mean), 0, smallest / mean, 0);
}

LACUNA_INLINE Real relative_size_squared(const Parts& p, double average_volume)
{
    Real sum = p.corner[0];
    for (int i = 1; i < 8; ++i) sum = sum + p.corner[i];
    if (!(average_volume >= kNothing)) return Real::all(0);
    const Real size = (0.125 / average_volume) * sum;
    const Real relative = least(size, Real::all(1) / size);
    return where_above(sum, kNothing, relative * relative, 0);
}

LACUNA_INLINE Real value_of(Metric metric, const Parts& p, const Batch& batch, double average_volume)
{
    switch (metric) {
    case Metric::scaled_jacobian:
        return scaled_jacobian_of(p);
    case Metric::scaled_jacobian_with_centre:
        return scaled_with_centre(p);
    case Metric::jacobian:
        return jacobian(p);
    case Metric::shape:
        return shape(p);
    case Metric::shear:
        return shear(p);
    case Metric::condition:
    case Metric::max_aspect_frobenius:
        return condition(p);
    case Metric::med_aspect_frobenius:
        return med_aspect_frobenius(p);
    case Metric::oddy:
        return oddy(p);
    case Metric::skew:
        return skew(p);
    case Metric::taper:
        return taper(p);
    case Metric::max_edge_ratio:
        return max_edge_ratio(p);
    case Metric::edge_ratio:
        return vtk_edge_ratio(p);
    case Metric::full_edge_ratio:
        return edge_ratio(p, longest_square(p));
    case Metric::stretch:
        return stretch(p, batch);
    case Metric::diagonal:
        return diagonal(batch);
    case Metric::dimension:
        return dimension(p);
    case Metric::volume:
        return p.centre;
    case Metric::distortion:
        return distortion(p);
    case Metric::relative_size_squared:
        return relative_size_squared(p, average_volume);
    case Metric::shape_and_size:
        return shape(p) * relative_size_squared(p, average_volume);
    case Metric::shear_and_size:
        return shear(p) * relative_size_squared(p, average_volume);
    }
    return Real::all(0);
}

LACUNA_INLINE void evaluate_lanes(const Batch& batch, std::span<const Metric> metrics, double average_volume,
                                  double* values)
{
    Parts parts;
    find_parts(batch, parts);
    Real size = Real::all(0); // not finite if a node is not finite
    for (const auto& squares : parts.square)
        for (const Real& square : squares) size = size + square;
    for (const Metric metric : metrics) {
        const Real value = value_of(metric, parts, batch, average_volume);
        const double otherwise = metric_info(metric).larger_is_better ? 0 : 1 / kNothing;
        for (int i = 0; i < N; ++i)
            *values++ = std::isfinite(size.v[i]) && std::isfinite(value.v[i]) ? value.v[i] : otherwise;
    }
}

} // namespace

void evaluate_metrics(const CellBatch<kMetricLanes>& batch, std::span<const Metric> metrics,
                      double average_volume, double* values)
{
    with_avx2([&]() LACUNA_INLINE_BODY { evaluate_lanes(batch, metrics, average_volume, values); });
}

double metric(Metric metric, std::span<const Vec3, 8> corners, double average_volume)
{
    CellBatch<kMetricLanes> batch;
    for (std::size_t c = 0; c < 8; ++c)
        for (int d = 0; d < 3; ++d)
            for (double& lane : batch.corner(c)[d]) lane = corners[c][d];
    double values[kMetricLanes];
    evaluate_metrics(batch, {&metric, 1}, average_volume, values);
    return values[0];
}

} // namespace lacuna::quality
