// SPDX-License-Identifier: MIT
#include <lacuna/geometry/detail/patch_mesh.h>

#include <lacuna/core/edge_key.h>
#include <lacuna/geometry/sparse_factor.h>

#include <Eigen/SparseCore>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace lacuna::geometry {
namespace {

// Sides longer than this multiple of the target length are split: the halves are then closer to it than the
// side was (Botsch and Kobbelt 2004).
constexpr double kTooLong = 4.0 / 3.0;
// Opposite angles may sum to π up to rounding, as in squares; without a tolerance,
// flips would alternate for ever.
constexpr double kDelaunaySlack = 1e-9;

} // namespace

PatchMesh::PatchMesh(std::vector<Vec3> points, std::vector<Triangle> triangles, std::vector<Triangle> next)
    : points_(std::move(points)),
      triangles_(std::move(triangles)),
      next_(std::move(next)),
      fixed_(points_.size(), true)
{
    for (std::size_t t = 0; t < triangles_.size(); ++t) {
        for (int side = 0; side < 3; ++side) {
            const auto triangle = static_cast<Index>(t);
            if (across(triangle, side) < triangle) {
                count_side(corner(triangle, side + 1), corner(triangle, side + 2), 1);
            }
        }
    }
}

int PatchMesh::side_towards(Index triangle, Index neighbour, Index from) const
{
    for (int side = 0; side < 3; ++side) {
        if (across(triangle, side) == neighbour && corner(triangle, side + 1) == from) return side;
    }
    return -1;
}

Vec3 PatchMesh::area_vector(const Triangle& triangle) const
{
    return (at(triangle[1]) - at(triangle[0])).cross(at(triangle[2]) - at(triangle[0])) / 2;
}

double PatchMesh::area() const
{
    double sum = 0;
    for (const Triangle& triangle : triangles_) sum += area_vector(triangle).norm();
    return sum;
}

double PatchMesh::cotangent(Index triangle, int i) const
{
    const Vec3 u = at(corner(triangle, i + 1)) - at(corner(triangle, i));
    const Vec3 v = at(corner(triangle, i + 2)) - at(corner(triangle, i));
    const double sine = u.cross(v).norm();
    const double cosine = u.dot(v);
    // Cotangents of degenerate triangles are limited; larger values would make all others lost in rounding.
    constexpr double bound = 1e6;
    return std::abs(cosine) < bound * sine ? cosine / sine : std::copysign(bound, cosine);
}

PatchMesh::TrianglePair PatchMesh::pair_at(Index triangle, int side) const
{
    const Index other = across(triangle, side);
    const Index c = corner(triangle, side + 2);
    const int far = side_towards(other, triangle, c);
    return {other,
            corner(triangle, side),
            corner(triangle, side + 1),
            c,
            corner(other, far),
            across(triangle, (side + 1) % 3),
            across(triangle, (side + 2) % 3),
            across(other, (far + 1) % 3),
            across(other, (far + 2) % 3)};
}

void PatchMesh::count_side(Index a, Index b, int change)
{
    int& count = sides_[edge_key(a, b)];
    count += change;
    if (count == 0) sides_.erase(edge_key(a, b));
}

std::size_t PatchMesh::joined(Index a, Index b) const
{
    const auto found = sides_.find(edge_key(a, b));
    return found == sides_.end() ? 0 : static_cast<std::size_t>(found->second);
}

bool PatchMesh::may_flip(Index triangle, int side) const
{
    const Index other = across(triangle, side);
    if (other < 0 || other == triangle) return false;
    const int far = side_towards(other, triangle, corner(triangle, side + 2));
    const Index a = corner(triangle, side);
    const Index b = corner(other, far);
    return a != b && joined(a, b) == 0;
}

void PatchMesh::relink(Index triangle, Index before, Index after, Index from)
{
    if (triangle < 0) return;
    next_[index(triangle)][static_cast<std::size_t>(side_towards(triangle, before, from))] = after;
}

///      d                d        `triangle` a-b-c with its side b → c, and `other` d-c-b across it, become
///    /   \            / | \      a-b-d and a-d-c.
///   c --- b    →     c  |  b
///    \   /            \ | /
///      a                a
void PatchMesh::flip(Index triangle, int side)
{
    const auto [other, a, b, c, d, over_ca, over_ab, over_bd, over_dc] = pair_at(triangle, side);
    relink(over_ca, triangle, other, a);
    relink(over_bd, other, triangle, d);
    triangles_[index(triangle)] = {a, b, d};
    next_[index(triangle)] = {over_bd, other, over_ab};
    triangles_[index(other)] = {a, d, c};
    next_[index(other)] = {over_dc, over_ca, triangle};
    count_side(b, c, -1);
    count_side(a, d, 1);
}

bool PatchMesh::resolve_doubled()
{
    for (bool doubled = true; doubled;) {
        doubled = false;
        bool changed = false;
        for (Index t = 0; t < static_cast<Index>(triangles_.size()); ++t) {
            for (int side = 0; side < 3; ++side) {
                if (joined(corner(t, side + 1), corner(t, side + 2)) < 2) continue;
                doubled = true;
                if (!may_flip(t, side)) continue;
                flip(t, side);
                changed = true;
            }
        }
        if (doubled && !changed) return false;
    }
    return true;
}

void PatchMesh::make_delaunay()
{
    std::vector<std::pair<Index, int>> pending;
    for (Index t = 0; t < static_cast<Index>(triangles_.size()); ++t) {
        for (int side = 0; side < 3; ++side) {
            if (across(t, side) > t) pending.emplace_back(t, side);
        }
    }
    // On a curved surface, flips may not terminate; this limit is far above the number needed in a plane.
    std::size_t budget = 20 * pending.size() + 100;
    while (!pending.empty() && budget-- > 0) {
        const auto [t, side] = pending.back();
        pending.pop_back();
        const Index other = across(t, side);
        if (other < 0) continue;
        const int far = side_towards(other, t, corner(t, side + 2));
        if (cotangent(t, side) + cotangent(other, far) >= -kDelaunaySlack || !may_flip(t, side)) continue;
        const Index a = corner(t, side), b = corner(t, side + 1), c = corner(t, side + 2),
                    d = corner(other, far);
        const Vec3 was = area_vector({a, b, c}) + area_vector({d, c, b});
        if (area_vector({a, b, d}).dot(was) <= 0 || area_vector({a, d, c}).dot(was) <= 0) continue;
        flip(t, side);
        pending.emplace_back(t, 0);
        pending.emplace_back(t, 2);
        pending.emplace_back(other, 0);
        pending.emplace_back(other, 1);
    }
}

std::vector<double> PatchMesh::rim_sizes() const
{
    std::vector<double> sum(points_.size(), 0);
    std::vector<int> count(points_.size(), 0);
    for (Index t = 0; t < static_cast<Index>(triangles_.size()); ++t) {
        for (int side = 0; side < 3; ++side) {
            if (across(t, side) >= 0) continue;
            const Index a = corner(t, side + 1), b = corner(t, side + 2);
            for (const Index p : {a, b}) {
                sum[index(p)] += (at(a) - at(b)).norm();
                ++count[index(p)];
            }
        }
    }
    for (std::size_t p = 0; p < sum.size(); ++p) sum[p] /= std::max(count[p], 1);
    return sum;
}

double PatchMesh::wanted_between(Index a, Index b, double grading) const
{
    return std::min(size_[index(a)], size_[index(b)]) + grading * (at(a) - at(b)).norm() / 2;
}

///      d                d
///    /   \            / | \      The side b – c of `triangle` a-b-c, with d-c-b across it, is split at its
///   c --- b    →     c-m-b     midpoint m; the old numbers are used for a-b-m and d-c-m.
///    \   /            \ | /
///      a                a
void PatchMesh::split(Index triangle, int side, double wanted)
{
    const auto [other, a, b, c, d, over_ca, over_ab, over_bd, over_dc] = pair_at(triangle, side);
    const auto m = static_cast<Index>(points_.size());
    const auto amc = static_cast<Index>(triangles_.size());
    const Index dmb = amc + 1;
    points_.push_back((at(b) + at(c)) / 2);
    fixed_.push_back(false);
    size_.push_back(wanted);
    relink(over_ca, triangle, amc, a);
    relink(over_bd, other, dmb, d);
    triangles_[index(triangle)] = {a, b, m};
    next_[index(triangle)] = {dmb, amc, over_ab};
    triangles_[index(other)] = {d, c, m};
    next_[index(other)] = {amc, dmb, over_dc};
    triangles_.push_back({a, m, c});
    next_.push_back({other, over_ca, triangle});
    triangles_.push_back({d, m, b});
    next_.push_back({triangle, over_bd, other});
    count_side(b, c, -1);
    for (const Index p : {a, b, c, d}) count_side(p, m, 1);
}

void PatchMesh::refine(double grading, std::size_t max_points, const RunContext& context)
{
    size_ = rim_sizes();
    const std::size_t limit = points_.size() + max_points;
    while (points_.size() < limit) {
        check_cancelled(context);
        std::vector<std::pair<double, std::pair<Index, int>>> longest;
        for (Index t = 0; t < static_cast<Index>(triangles_.size()); ++t) {
            for (int side = 0; side < 3; ++side) {
                if (across(t, side) <= t) continue; // the boundary, and sides already visited
                const Index b = corner(t, side + 1), c = corner(t, side + 2);
                const double ratio = (at(b) - at(c)).norm() / wanted_between(b, c, grading);
                if (ratio > kTooLong) longest.push_back({-ratio, {t, side}});
            }
        }
        if (longest.empty()) break;
        // Split each triangle once per round, at its longest side; its halves are examined in the next round.
        std::sort(longest.begin(), longest.end());
        std::vector<bool> touched(triangles_.size(), false);
        for (const auto& [ratio, where] : longest) {
            const auto [t, side] = where;
            const Index other = across(t, side);
            const bool other_is_new = index(other) >= touched.size();
            if (touched[index(t)] || other_is_new || touched[index(other)] || points_.size() >= limit)
                continue;
            touched[index(t)] = touched[index(other)] = true;
            split(t, side, wanted_between(corner(t, side + 1), corner(t, side + 2), grading));
        }
        make_delaunay();
        relax();
    }
}

/// Shape quality: 1 for an equilateral triangle, 0 for a degenerate one, negative
/// if it faces away from `normal`.
double PatchMesh::shape(const Triangle& triangle, const Vec3& normal) const
{
    double sides = 0;
    for (std::size_t k = 0; k < 3; ++k) sides += (at(triangle[k]) - at(triangle[(k + 1) % 3])).squaredNorm();
    return 4 * std::numbers::sqrt3 * area_vector(triangle).dot(normal) / sides;
}

void PatchMesh::relax()
{
    std::vector<Index> start(points_.size() + 1, 0);
    for (const Triangle& triangle : triangles_)
        for (const Index p : triangle) ++start[index(p) + 1];
    for (std::size_t p = 1; p < start.size(); ++p) start[p] += start[p - 1];
    std::vector<Index> around(index(start.back()));
    std::vector<Index> fill(start.begin(), start.end() - 1);
    for (std::size_t t = 0; t < triangles_.size(); ++t) {
        for (const Index p : triangles_[t]) around[index(fill[index(p)]++)] = static_cast<Index>(t);
    }
    for (std::size_t p = 0; p < points_.size(); ++p) {
        if (fixed_[p]) continue;
        const std::span<const Index> star(around.data() + start[p], index(start[p + 1] - start[p]));
        Vec3 normal = Vec3::Zero();
        Vec3 middle = Vec3::Zero();
        for (const Index t : star) {
            normal += area_vector(triangles_[index(t)]);
            for (const Index q : triangles_[index(t)])
                if (index(q) != p) middle += at(q);
        }
        if (!(normal.norm() > 0)) continue;
        normal.normalize();
        const auto worst = [&] {
            double least = 1;
            for (const Index t : star) least = std::min(least, shape(triangles_[index(t)], normal));
            return least;
        };
        const Vec3 old = points_[p];
        const double before = worst();
        const Vec3 move = middle / static_cast<double>(2 * star.size()) - old;
        points_[p] = old + move - normal * normal.dot(move);
        if (!(worst() > before)) points_[p] = old;
    }
}

void PatchMesh::place_harmonic(const RunContext& context)
{
    std::vector<Index> row(points_.size(), -1);
    Index rows = 0;
    for (std::size_t p = 0; p < points_.size(); ++p) row[p] = fixed_[p] ? -1 : rows++;
    if (rows == 0) return;
    std::vector<Eigen::Triplet<double>> entries;
    Eigen::MatrixX3d right = Eigen::MatrixX3d::Zero(rows, 3);
    for (Index t = 0; t < static_cast<Index>(triangles_.size()); ++t) {
        for (int side = 0; side < 3; ++side) {
            const Index other = across(t, side);
            if (other < t) continue; // the boundary has no free points; visit inner sides once
            const int far = side_towards(other, t, corner(t, side + 2));
            const double sum = cotangent(t, side) + cotangent(other, far);
            if (!(sum > 0))
                continue; // only where a flip was refused: skip the side, so that no triangle is flipped over
            const Index a = corner(t, side + 1), b = corner(t, side + 2);
            for (const auto& [p, q] : {std::pair(a, b), std::pair(b, a)}) {
                if (row[index(p)] < 0) continue;
                entries.emplace_back(row[index(p)], row[index(p)], sum);
                if (row[index(q)] < 0)
                    right.row(row[index(p)]) += sum * at(q).transpose();
                else
                    entries.emplace_back(row[index(p)], row[index(q)], -sum);
            }
        }
    }
    Eigen::SparseMatrix<double> matrix(rows, rows);
    matrix.setFromTriplets(entries.begin(), entries.end());
    const SparseFactor solver(matrix, context);
    if (!solver.good()) return; // a point has no weights: keep the surface
    const Eigen::MatrixX3d placed = solver.solve(right);
    if (!placed.allFinite()) return;
    for (std::size_t p = 0; p < points_.size(); ++p) {
        if (row[p] >= 0) points_[p] = placed.row(row[p]).transpose();
    }
}

} // namespace lacuna::geometry
