// SPDX-License-Identifier: MIT
#include <lacuna/quality/shared/second_order.h>

#include <lacuna/core/shared/criteria.h>
#include <lacuna/core/shared/limits.h>
#include <lacuna/core/shared/parallel.h>
#include <lacuna/quality/detail/curved_other.h>
#include <lacuna/quality/detail/lanes.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace lacuna::quality {
namespace {

constexpr std::size_t kSide = 6; ///< coefficients in each direction, for degree five
/// Coefficients; (a, b, c) is at a + 6 b + 36 c.
using Bezier = std::array<double, kSide * kSide * kSide>;

/// Position of each node of a hex27 in the grid of 3³ points, a + 3 b + 9 c.
constexpr std::array<std::uint8_t, 27> kGrid{0,  2,  8, 6,  18, 20, 26, 24, 1,  5,  7, 3,  19, 23,
                                             25, 21, 9, 11, 17, 15, 12, 14, 10, 16, 4, 22, 13};

/// Values or derivatives of the quadratic Lagrange polynomials for 0, ½ and 1, at N equidistant points from 0
/// to 1.
template <std::size_t N>
using Table = std::array<std::array<double, 3>, N>;

template <std::size_t N>
constexpr Table<N> lagrange(bool slopes)
{
    Table<N> table{};
    for (std::size_t i = 0; i < N; ++i) {
        const double t = static_cast<double>(i) / static_cast<double>(N - 1);
        if (slopes)
            table[i] = {4 * t - 3, 4 - 8 * t, 4 * t - 1};
        else
            table[i] = {(1 - t) * (1 - 2 * t), 4 * t * (1 - t), t * (2 * t - 1)};
    }
    return table;
}

/// Converts values at 0, 1/5 … 1 to Bézier coefficients of degree five: the inverse of the Bernstein matrix.
constexpr std::array<std::array<double, kSide>, kSide> kToBezier = [] {
    std::array<std::array<double, 2 * kSide>, kSide> m{};
    constexpr double kChoose[kSide] = {1, 5, 10, 10, 5, 1};
    for (std::size_t i = 0; i < kSide; ++i) {
        const double t = static_cast<double>(i) / 5;
        for (std::size_t j = 0; j < kSide; ++j) {
            double value = kChoose[j];
            for (std::size_t k = 0; k < j; ++k) value *= t;
            for (std::size_t k = j; k < 5; ++k) value *= 1 - t;
            m[i][j] = value;
        }
        m[i][kSide + i] = 1;
    }
    for (std::size_t c = 0; c < kSide; ++c) { // Gauss-Jordan elimination; the matrix is totally positive
        const double pivot = m[c][c];
        for (double& value : m[c]) value /= pivot;
        for (std::size_t r = 0; r < kSide; ++r) {
            if (r == c) continue;
            const double factor = m[r][c];
            for (std::size_t k = 0; k < 2 * kSide; ++k) m[r][k] -= factor * m[c][k];
        }
    }
    std::array<std::array<double, kSide>, kSide> inverse{};
    for (std::size_t i = 0; i < kSide; ++i)
        for (std::size_t j = 0; j < kSide; ++j) inverse[i][j] = m[i][kSide + j];
    return inverse;
}();

/// Evaluate a field, given at the nodes, on a grid of N³ points, with one table per direction.
template <std::size_t N>
LACUNA_INLINE void to_grid(const std::array<double, 27>& nodes, const Table<N>& u, const Table<N>& v,
                           const Table<N>& w, double* out)
{
    std::array<double, 9 * N> first;
    std::array<double, 3 * N * N> second;
    for (std::size_t r = 0; r < 9; ++r)
        for (std::size_t i = 0; i < N; ++i)
            first[N * r + i] = u[i][0] * nodes[3 * r] + u[i][1] * nodes[3 * r + 1] +
                               u[i][2] * nodes[3 * r + 2];
    for (std::size_t c = 0; c < 3; ++c)
        for (std::size_t j = 0; j < N; ++j)
            for (std::size_t i = 0; i < N; ++i)
                second[(c * N + j) * N + i] = v[j][0] * first[N * (3 * c) + i] +
                                              v[j][1] * first[N * (3 * c + 1) + i] +
                                              v[j][2] * first[N * (3 * c + 2) + i];
    for (std::size_t k = 0; k < N; ++k)
        for (std::size_t p = 0; p < N * N; ++p)
            out[k * N * N + p] = w[k][0] * second[p] + w[k][1] * second[N * N + p] +
                                 w[k][2] * second[2 * N * N + p];
}

/// Derivatives of the map on a grid of N³ points: [direction][coordinate].
template <std::size_t N>
struct Slopes {
    std::array<double, N * N * N> at[3][3];
};

template <std::size_t N>
LACUNA_INLINE void find_slopes(const std::array<double, 27> (&nodes)[3], Slopes<N>& slopes)
{
    static constexpr Table<N> kValues = lagrange<N>(false), kSlopes = lagrange<N>(true);
    for (std::size_t d = 0; d < 3; ++d) {
        to_grid<N>(nodes[d], kSlopes, kValues, kValues, slopes.at[0][d].data());
        to_grid<N>(nodes[d], kValues, kSlopes, kValues, slopes.at[1][d].data());
        to_grid<N>(nodes[d], kValues, kValues, kSlopes, slopes.at[2][d].data());
    }
}

template <std::size_t N>
LACUNA_INLINE void determinants(const Slopes<N>& s, double* out)
{
    const auto& [u, v, w] = s.at;
    for (std::size_t p = 0; p < N * N * N; ++p)
        out[p] = u[0][p] * (v[1][p] * w[2][p] - v[2][p] * w[1][p]) +
                 u[1][p] * (v[2][p] * w[0][p] - v[0][p] * w[2][p]) +
                 u[2][p] * (v[0][p] * w[1][p] - v[1][p] * w[0][p]);
}

/// Convert values on the grid of 6³ points to coefficients, direction by direction.
LACUNA_INLINE void to_bezier(Bezier& values)
{
    Bezier next;
    for (std::size_t row = 0; row < kSide * kSide; ++row)
        for (std::size_t i = 0; i < kSide; ++i) {
            double sum = 0;
            for (std::size_t j = 0; j < kSide; ++j) sum += kToBezier[i][j] * values[kSide * row + j];
            next[kSide * row + i] = sum;
        }
    for (std::size_t c = 0; c < kSide; ++c)
        for (std::size_t i = 0; i < kSide; ++i) {
            double* out = &values[(c * kSide + i) * kSide];
            std::fill_n(out, kSide, 0.0);
            for (std::size_t j = 0; j < kSide; ++j)
                for (std::size_t a = 0; a < kSide; ++a)
                    out[a] += kToBezier[i][j] * next[(c * kSide + j) * kSide + a];
        }
    for (std::size_t i = 0; i < kSide; ++i) {
        double* out = &next[i * kSide * kSide];
        std::fill_n(out, kSide * kSide, 0.0);
        for (std::size_t j = 0; j < kSide; ++j)
            for (std::size_t a = 0; a < kSide * kSide; ++a)
                out[a] += kToBezier[i][j] * values[j * kSide * kSide + a];
    }
    values = next;
}

/// Bisect along a direction (de Casteljau): `whole` becomes the lower half.
void split(Bezier& whole, Bezier& high, std::size_t stride)
{
    for (std::size_t at = 0; at < Bezier().size(); ++at) {
        if (at / stride % kSide != 0) continue;
        std::array<double, kSide> c;
        for (std::size_t i = 0; i < kSide; ++i) c[i] = whole[at + i * stride];
        for (std::size_t i = 0; i < kSide; ++i) {
            whole[at + i * stride] = c[0];
            high[at + (kSide - 1 - i) * stride] = c[kSide - 1 - i];
            for (std::size_t k = 0; k + 1 < kSide - i; ++k) c[k] = (c[k] + c[k + 1]) / 2;
        }
    }
}

constexpr std::array<std::size_t, 3> kStrides{1, kSide, kSide* kSide};

/// Whether a polynomial exceeds `floor` everywhere, by depth-first subdivision along the direction with the
/// smallest inner coefficients.
bool positive_parts(const Bezier& bezier, double floor, std::array<int, 3> cuts_left)
{
    const std::size_t last = kSide - 1;
    for (std::size_t corner = 0; corner < 8; ++corner) {
        std::size_t at = 0;
        for (std::size_t d = 0; d < 3; ++d) at += (corner >> d & 1) * last * kStrides[d];
        if (!(bezier[at] > floor)) return false;
    }
    if (*std::min_element(bezier.begin(), bezier.end()) > floor) return true;
    std::array<double, 3> inner;
    inner.fill(kInfinity);
    for (std::size_t at = 0; at < bezier.size(); ++at)
        for (std::size_t d = 0; d < 3; ++d) {
            const std::size_t i = at / kStrides[d] % kSide;
            if (i > 0 && i < last) inner[d] = std::min(inner[d], bezier[at]);
        }
    int best = -1;
    for (int d = 0; d < 3; ++d)
        if (cuts_left[static_cast<std::size_t>(d)] > 0 &&
            (best < 0 || inner[static_cast<std::size_t>(d)] < inner[static_cast<std::size_t>(best)]))
            best = d;
    if (best < 0) return false;
    --cuts_left[static_cast<std::size_t>(best)];
    Bezier low = bezier, high;
    split(low, high, kStrides[static_cast<std::size_t>(best)]);
    return positive_parts(low, floor, cuts_left) && positive_parts(high, floor, cuts_left);
}

/// The smallest scaled Jacobian at the 27 nodes.
LACUNA_INLINE double least_scaled(const std::array<double, 27> (&nodes)[3])
{
    Slopes<3> slopes;
    find_slopes<3>(nodes, slopes);
    std::array<double, 27> det;
    determinants<3>(slopes, det.data());
    double least = 1;
    for (std::size_t p = 0; p < 27; ++p) {
        double square = 1;
        for (const auto& along : slopes.at)
            square *= along[0][p] * along[0][p] + along[1][p] * along[1][p] + along[2][p] * along[2][p];
        const double scaled = square > 0 ? det[p] / std::sqrt(square) : 0;
        least = scaled < least ? scaled : least;
    }
    return std::max(least, -1.0);
}

/// Compute the coefficients. @return the smallest scaled Jacobian at the nodes.
LACUNA_INLINE double find_coefficients(const std::array<double, 27> (&nodes)[3], Bezier& bezier)
{
    Slopes<kSide> slopes;
    find_slopes<kSide>(nodes, slopes);
    determinants<kSide>(slopes, bezier.data());
    to_bezier(bezier);
    return least_scaled(nodes);
}

/// Divide a polynomial by 1 - t along a direction; it must be a multiple of 1 - t. Its degree along the
/// direction falls by one.
/// @param degree  degree along the direction before the division; higher coefficients are not used
void divide(Bezier& bezier, std::size_t stride, std::size_t degree)
{
    for (std::size_t at = 0; at < Bezier().size(); ++at) {
        if (at / stride % kSide != 0) continue;
        const auto c = [&](std::size_t i) -> double& { return bezier[at + i * stride]; };
        for (std::size_t i = 0; i < degree; ++i)
            c(i) *= static_cast<double>(degree) / static_cast<double>(degree - i);
        c(degree) = 0;
    }
}

/// Raise the degree along a direction to five.
void elevate(Bezier& bezier, std::size_t stride, std::size_t degree)
{
    for (std::size_t at = 0; at < Bezier().size(); ++at) {
        if (at / stride % kSide != 0) continue;
        const auto c = [&](std::size_t i) -> double& { return bezier[at + i * stride]; };
        for (std::size_t n = degree + 1; n < kSide; ++n)
            for (std::size_t i = n; i > 0; --i) {
                const double share = static_cast<double>(i) / static_cast<double>(n);
                c(i) = share * c(i - 1) + (1 - share) * (i < n ? c(i) : 0);
            }
    }
}

/// Judge a cell by the coefficients of its Jacobian, or of the Jacobian divided by positive factors.
void decide(CurvedCell& cell, const Bezier& bezier, double scaled, int max_depth)
{
    double largest = 0, least = kInfinity;
    for (const double value : bezier) {
        largest = std::max(largest, std::abs(value));
        least = std::min(least, value);
    }
    if (!std::isfinite(cell.volume) || !(largest > 0)) {
        cell = {};
        return;
    }
    cell.bound = cell.volume != 0 ? least / std::abs(cell.volume) : -1;
    cell.scaled_jacobian = scaled;
    const double floor = kRoundoff * largest; // conversion to Bézier amplifies rounding by less than 1e4
    cell.positive = cell.scaled_jacobian > kRoundoff &&
                    (least > floor || positive_parts(bezier, floor, {max_depth, max_depth, max_depth}));
}

/// The integral of the Jacobian.
double integral(const Bezier& bezier)
{
    double sum = 0;
    for (const double value : bezier) sum += value;
    return sum / static_cast<double>(bezier.size());
}

/// Whether corner `c` of a hexahedron is at the end of direction `d`.
constexpr bool is_high(std::size_t c, std::size_t d)
{
    return ((d == 0 ? c + 1 : c) & (d == 2 ? 4u : 2u)) != 0;
}

/// For each edge, the vector from the midpoint of its ends to its middle node. Last, for the node at the
/// centre of the base, the vector to it from the place interpolated between the other nodes of the base; 0 if
/// there is no such node.
std::array<Vec3, 13> deviations(std::span<const Vec3> nodes)
{
    std::array<Vec3, 13> all;
    for (std::size_t e = 0; e < 12; ++e)
        all[e] = nodes[8 + e] -
                 (nodes[index(mesh::kHexEdges[e][0])] + nodes[index(mesh::kHexEdges[e][1])]) / 2;
    all[12].setZero();
    if (nodes.size() > 20) all[12] = nodes[20];
    for (std::size_t k = 0; k < 4 && nodes.size() > 20; ++k) all[12] -= nodes[8 + k] / 2 - nodes[k] / 4;
    return all;
}

/// The map of a wedge, pyramid or tetrahedron of order 2 at a point of the unit cube, relative to corner 0.
/// The map of the corners alone has order 1. Each edge adds its deviation times 4 a b, where a and b are the
/// shape functions of its two ends in the triangle, in the square or along the height. The node at the centre
/// of the base, if any, adds its deviation with a weight of the same kind.
Vec3 collapsed_place(CellKind kind, std::span<const Vec3> nodes, const std::array<Vec3, 13>& deviation,
                     const std::array<double, 3>& at)
{
    Vec3 place(0, 0, 0);
    for (std::size_t c = 0; c < 8; ++c) {
        double weight = 1;
        for (std::size_t d = 0; d < 3; ++d) weight *= is_high(c, d) ? at[d] : 1 - at[d];
        place += weight * (nodes[c] - nodes[0]);
    }
    for (std::size_t e = 0; e < 12; ++e) {
        const auto a = index(mesh::kHexEdges[e][0]), b = index(mesh::kHexEdges[e][1]);
        double weight = 4;
        for (std::size_t d = 0; d < 3; ++d) {
            const double t = is_high(a, d) ? at[d] : 1 - at[d];
            const bool along = is_high(a, d) != is_high(b, d);
            weight *= along ? t * (1 - t) : t;
            if (along && d == 0 && kind != CellKind::pyramid) weight *= 1 - at[1];
            if (along && d != 2 && kind != CellKind::wedge) weight *= 1 - at[2];
        }
        place += weight * deviation[e];
    }
    double weight = 16 * (1 - at[2]) * (1 - at[2]);
    for (const std::size_t d : {0, 1}) weight *= at[d] * (1 - at[d]);
    return place + weight * deviation[12];
}

/// The smallest scaled Jacobian at the corners.
double scaled_at_corners(CellKind kind, std::span<const Vec3> nodes)
{
    const std::span<const std::uint8_t> corners = corners_of(kind);
    const Hex places = mesh::merged_corners(static_cast<int>(corners.size()));
    // The corner of the cell that a corner of the hexahedron is merged with.
    const auto merged = [&](int c) { return std::size_t(corners[index(places[index(c)])]); };
    double least = 1;
    for (const auto& [at, next] : neighbours_in(kind)) {
        std::array<Vec3, 3> tangents;
        for (std::size_t k = 0; k < 3; ++k) {
            const auto edge = std::ranges::find_if(
                mesh::kHexEdges, [&, from = at, to = next[k]](const auto& e) {
                    const std::size_t a = merged(e[0]), b = merged(e[1]);
                    return (a == from && b == to) || (a == to && b == from);
                });
            const auto middle = 8 + static_cast<std::size_t>(edge - mesh::kHexEdges.begin());
            tangents[k] = 4 * nodes[middle] - 3 * nodes[at] - nodes[next[k]];
        }
        const double determinant = tangents[0].dot(tangents[1].cross(tangents[2]));
        least = std::min(least, scaled_determinant(kind, determinant, tangents));
    }
    return std::max(least, -1.0);
}

} // namespace

CurvedCell judge(std::span<const Vec3, 27> places, int max_depth)
{
    std::array<double, 27> nodes[3];
    for (std::size_t n = 0; n < 27; ++n) // relative to a corner, to keep precision far from the origin
        for (int d = 0; d < 3; ++d) nodes[d][kGrid[n]] = places[n][d] - places[0][d];
    Bezier bezier;
    const double scaled = with_avx512([&]() LACUNA_INLINE_BODY { return find_coefficients(nodes, bezier); });
    CurvedCell cell{.volume = integral(bezier)};
    decide(cell, bezier, scaled, max_depth);
    return cell;
}

std::optional<CurvedCell> judge_other(CellKind kind, std::span<const Vec3> places, int max_depth)
{
    const std::array<Vec3, 13> deviation = deviations(places);
    double size = places[0].cwiseAbs().maxCoeff(), most = 0;
    for (const Vec3& corner : places.first<8>())
        size = std::max(size, (corner - places[0]).cwiseAbs().maxCoeff());
    for (const Vec3& by : deviation) most = std::max(most, by.cwiseAbs().maxCoeff());
    if (most <= kRoundoff * size) return std::nullopt;
    std::array<double, 27> nodes[3];
    for (std::size_t p = 0; p < 27; ++p) {
        const std::array<double, 3> at{double(p % 3) / 2, double(p / 3 % 3) / 2, double(p / 9) / 2};
        const Vec3 place = collapsed_place(kind, places, deviation, at);
        for (int d = 0; d < 3; ++d) nodes[d][p] = place[d];
    }
    Bezier bezier;
    with_avx512([&]() LACUNA_INLINE_BODY { return find_coefficients(nodes, bezier); });
    CurvedCell cell{.volume = integral(bezier)};
    if (kind != CellKind::pyramid) {
        divide(bezier, kStrides[1], 5);
        elevate(bezier, kStrides[1], 4);
    }
    if (kind != CellKind::wedge) {
        divide(bezier, kStrides[2], 5);
        divide(bezier, kStrides[2], 4);
        elevate(bezier, kStrides[2], 3);
    }
    decide(cell, bezier, scaled_at_corners(kind, places), max_depth);
    return cell;
}

namespace {

/// The cells for which `is(cell)` is false, ascending. Parallel.
template <class Is>
std::vector<std::size_t> cells_that_are_not(std::size_t count, const RunContext& context, const Is& is)
{
    std::vector<std::uint8_t> lacks(count, 0);
    parallel_each(context, count, kPerTask, [&](std::size_t c) { lacks[c] = is(c) ? 0 : 1; });
    std::vector<std::size_t> cells;
    for (std::size_t c = 0; c < count; ++c)
        if (lacks[c] != 0) cells.push_back(c);
    return cells;
}

} // namespace

bool is_straight(std::span<const Vec3, 27> nodes)
{
    const std::array<Vec3, 27> straight = mesh::as_hex27(nodes.first<8>());
    const double slack = kRoundoff *
                         ((nodes[6] - nodes[0]).cwiseAbs().maxCoeff() + nodes[0].cwiseAbs().maxCoeff());
    for (std::size_t n = 8; n < 27; ++n)
        if (!((nodes[n] - straight[n]).cwiseAbs().maxCoeff() <= slack)) return false;
    return true;
}

std::array<Vec3, 27> hex27_of(const mesh::HexMesh& mesh, std::size_t cell)
{
    const mesh::CellNodes nodes = mesh::cell_nodes(mesh, cell);
    std::array<Vec3, 27> places;
    for (std::size_t n = 0; n < nodes.count; ++n) places[n] = mesh.node(index(nodes.node[n]));
    return nodes.count == 27 ? places : mesh::as_hex27(std::span(places).first(nodes.count));
}

std::vector<std::size_t> invalid_cells(const mesh::HexMesh& mesh, const RunContext& context)
{
    return cells_that_are_not(mesh.hex_count(), context, [&](std::size_t c) {
        const std::array<Vec3, 27> nodes = hex27_of(mesh, c);
        return is_straight(nodes) ? certified_positive(std::span(nodes).first<8>()) : judge(nodes).positive;
    });
}

std::optional<CurvedCell> judge_listed(std::span<const Vec3> nodes, const mesh::CellNodes& cell)
{
    const std::span<const Index> all = cell.all();
    if (all.size() == 8) return std::nullopt;
    std::array<Vec3, 27> places;
    for (std::size_t n = 0; n < 8; ++n) places[n] = nodes[index(all[n])];
    const std::array<Vec3, 27> straight = mesh::as_hex27(std::span(places).first<8>());
    for (std::size_t n = 8; n < all.size(); ++n) places[n] = all[n] < 0 ? straight[n] : nodes[index(all[n])];
    Hex corners;
    std::copy_n(all.begin(), corners.size(), corners.begin());
    const std::span<const Vec3> given = std::span(places).first(all.size());
    if (const CellKind kind = kind_of(corners); kind != CellKind::hex) return judge_other(kind, given);
    if (all.size() < 27) places = mesh::as_hex27(given);
    if (is_straight(places)) return std::nullopt;
    return judge(places);
}

std::vector<std::size_t> invalid_cells(std::span<const Vec3> nodes, std::span<const mesh::CellNodes> cells,
                                       const RunContext& context)
{
    return cells_that_are_not(cells.size(), context, [&](std::size_t c) {
        const std::optional<CurvedCell> curved = judge_listed(nodes, cells[c]);
        return !curved || curved->positive;
    });
}

} // namespace lacuna::quality
