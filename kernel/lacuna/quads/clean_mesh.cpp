// SPDX-License-Identifier: MIT
#include <lacuna/quads/detail/clean_mesh.h>

#include <lacuna/quads/detail/corner_sine.h>
#include <lacuna/quads/shared/measure_plane.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace lacuna::quads::cleaning {

namespace {

/// A boundary point may keep its number of quads if its angle, divided by 90°, differs from this number by
/// less than `kFits`. The value exceeds 0.5, so that two numbers are accepted if the angle is about halfway
/// between multiples of 90°. Larger values leave more distorted corners.
constexpr double kFits = 0.65;
/// Weight of size against shape: the loss is kSizeLoss if the area of a quad deviates from its target by a
/// factor e = 2.718. The loss is quadratic in the logarithm of the factor. For a folded quad, kFarOff is used
/// as the logarithm.
constexpr double kSizeLoss = 0.1, kFarOff = 10;

} // namespace

QuadLoss loss_of(std::span<const Vec2> points, const Quad& quad, const CleanOptions& options)
{
    QuadLoss result;
    result.jacobian = scaled_jacobian(points, quad);
    result.loss = 1 - result.jacobian;
    if (!options.size) return result;
    const auto at = [&](std::size_t k) -> const Vec2& { return points[index(quad[k])]; };
    const Vec2 u = at(2) - at(0), v = at(3) - at(1);
    const double size = options.size((at(0) + at(1) + at(2) + at(3)) / 4);
    const double ratio = cross(u, v) / (2 * size * size);
    const double off = ratio > 0 ? std::log(ratio) : kFarOff;
    result.loss += kSizeLoss * off * off;
    return result;
}

CleanMesh::CleanMesh(const PlanarQuads& mesh, std::size_t fixed, const CleanOptions& options)
    : options_(options),
      points_(mesh.points),
      net_(mesh.points.size(), mesh.quads),
      fixed_(fixed),
      ideal_(mesh.points.size(), 4),
      version_(mesh.quads.size(), 0)
{
    for (Index p = 0; p < static_cast<Index>(points_.size()); ++p) {
        if (net_.is_used(p) && net_.on_boundary(p)) ideal_[index(p)] = right_angles(p);
    }
}

bool CleanMesh::is_sound() const
{
    for (Index p = 0; p < static_cast<Index>(points_.size()); ++p) {
        if (!net_.is_used(p)) continue;
        int in_fan = 0;
        net_.for_sides(p, [&](Index) { ++in_fan; });
        if (in_fan != net_.valence(p)) return false;
        if (index(p) >= fixed_ && net_.on_boundary(p)) return false;
    }
    return true;
}

int CleanMesh::right_angles(Index p) const
{
    Vec2 first(0, 0), last(0, 0);
    bool any = false;
    net_.for_sides(p, [&](Index side) {
        if (!any) first = at(net_.to(side)) - at(p);
        any = true;
        last = at(net_.from(QuadNet::before(side))) - at(p);
    });
    // If the angle is about halfway between two multiples of 90°, either valence suits it, and the present
    // one is kept.
    const double fit = turn_between(first, last) / kRightAngle;
    const int valence = net_.valence(p);
    return std::abs(fit - valence) < kFits ? valence : std::max(1, static_cast<int>(std::lround(fit)));
}

void CleanMesh::remove_doublets()
{
    std::vector<Index> left;
    for (std::size_t p = fixed_; p < points_.size(); ++p) left.push_back(static_cast<Index>(p));
    while (!left.empty()) {
        const Index p = left.back();
        left.pop_back();
        if (!net_.is_used(p) || net_.valence(p) != 2 || net_.on_boundary(p)) continue;
        std::vector<Index> sides;
        net_.for_sides(p, [&](Index side) { sides.push_back(side); });
        const Index a = net_.to(sides[0]), b = net_.to(QuadNet::after(sides[0]));
        const Index c = net_.to(sides[1]), d = net_.to(QuadNet::after(sides[1]));
        if (b == d) continue;
        const std::array<Index, 2> old{sides[0] / 4, sides[1] / 4};
        const std::array<Quad, 1> merged{{{a, b, c, d}}};
        replace(old, merged);
        for (const Index q : {a, c}) {
            if (index(q) >= fixed_) left.push_back(q);
        }
    }
}

Index CleanMesh::add_point(const Vec2& position)
{
    points_.push_back(position);
    ideal_.push_back(4);
    return net_.add_point();
}

void CleanMesh::replace(std::span<const Index> removed, std::span<const Quad> added)
{
    const std::vector<Index> numbers = net_.replace(removed, added);
    version_.resize(net_.quad_slots(), 0);
    for (const Index q : numbers) ++version_[index(q)];
}

PlanarQuads CleanMesh::result() const
{
    PlanarQuads mesh;
    std::vector<Index> number(points_.size(), -1);
    for (std::size_t p = 0; p < points_.size(); ++p) {
        if (p >= fixed_ && !net_.is_used(static_cast<Index>(p))) continue;
        number[p] = static_cast<Index>(mesh.points.size());
        mesh.points.push_back(points_[p]);
    }
    for (Index q = 0; q < static_cast<Index>(net_.quad_slots()); ++q) {
        if (!net_.is_live(q)) continue;
        Quad quad = net_.quad(q);
        for (Index& p : quad) p = number[index(p)];
        mesh.quads.push_back(quad);
    }
    return mesh;
}

} // namespace lacuna::quads::cleaning
