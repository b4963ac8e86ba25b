// SPDX-License-Identifier: MIT
#include <lacuna/sweep/detail/rim_arcs.h>

#include <lacuna/core/shared/criteria.h>
#include <lacuna/topology/shared/side_points.h>

#include <algorithm>
#include <optional>

namespace lacuna::sweep {

using namespace topology;

namespace {

/// Curvature vector at the point between two chords, which points to the inside of the bend. Empty at a
/// corner.
std::optional<Vec3> curvature(const Vec3& before, const Vec3& after, double least_cosine)
{
    const double a = before.norm(), b = after.norm();
    if (!(a > 0) || !(b > 0) || before.dot(after) <= least_cosine * a * b) return std::nullopt;
    return Vec3((after / b - before / a) / ((a + b) / 2));
}

/// Add the chords of a closed loop. The start of an edge is a corner, unless the curve is smooth there.
void add_chords(const std::vector<Vec3>& points, const std::vector<bool>& starts,
                std::vector<RimChord>& chords)
{
    const std::size_t count = points.size();
    const auto way = [&](std::size_t i) { return Vec3(points[(i + 1) % count] - points[i]); };
    std::vector<std::optional<Vec3>> bend(count);
    for (std::size_t i = 0; i < count; ++i)
        bend[i] = curvature(way((i + count - 1) % count), way(i), starts[i] ? kOneCurve : 0);
    for (std::size_t i = 0; i < count; ++i) {
        const std::optional<Vec3>&before = bend[i], &after = bend[(i + 1) % count];
        const Vec3 sum = before.value_or(Vec3::Zero()) + after.value_or(Vec3::Zero());
        const Vec3 mean = before && after ? Vec3(sum / 2) : sum;
        chords.push_back({points[i], points[(i + 1) % count], -mean * way(i).squaredNorm() / 8});
    }
}

} // namespace

std::set<EdgeId> rim_edges(const Model& model, FaceId face)
{
    std::set<EdgeId> edges;
    for (const Loop& loop : border_loops(model, face))
        for (const EdgeUse& use : loop.uses) edges.insert(use.edge);
    return edges;
}

OnLine closest_on(std::span<const Vec3> line, const Vec3& p)
{
    OnLine best;
    double before = 0;
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
        const double f = fraction_along(p, line[i], line[i + 1]), length = (line[i + 1] - line[i]).norm();
        const double distance = (p - ((1 - f) * line[i] + f * line[i + 1])).norm();
        if (distance < best.distance) best = {before + f * length, distance};
        before += length;
    }
    return best;
}

std::vector<RimChord> rim_chords(const Model& model, FaceId face)
{
    std::vector<RimChord> chords;
    for (const Loop& loop : border_loops(model, face)) {
        std::vector<Vec3> points;
        std::vector<bool> starts;
        for (const EdgeUse& use : loop.uses) {
            const std::vector<Index> line = use_points(model, use);
            const bool smooth = loop.uses.size() == 1; // a closed edge has no corner
            for (std::size_t i = 0; i + 1 < line.size(); ++i) {
                points.push_back(model.at(line[i]));
                starts.push_back(i == 0 && !smooth);
            }
        }
        if (!points.empty()) add_chords(points, starts, chords);
    }
    return chords;
}

double off_arcs(const Vec3& p, std::span<const RimChord> rim)
{
    double nearest = kInfinity;
    for (const RimChord& chord : rim) {
        const double f = fraction_along(p, chord.from, chord.to), height = 4 * f * (1 - f);
        const Vec3 place = (1 - f) * chord.from + f * chord.to + height * chord.bulge;
        nearest = std::min(nearest, (p - place).norm() - kArcError * height * chord.bulge.norm());
    }
    return std::max(0.0, nearest);
}

double arcs_apart(std::span<const RimChord> one, std::span<const RimChord> other)
{
    double apart = 0;
    for (const RimChord& chord : one) apart = std::max(apart, off_arcs(chord.from, other));
    for (const RimChord& chord : other) apart = std::max(apart, off_arcs(chord.from, one));
    return apart;
}

double area_under_arcs(std::span<const RimChord> one, std::span<const RimChord> other, double tolerance)
{
    const auto sum = [&](std::span<const RimChord> own, std::span<const RimChord> there) {
        double area = 0;
        for (const RimChord& chord : own) {
            // The area under a parabola is two thirds of its chord times its height.
            const double whole = 2 * (chord.to - chord.from).norm() * chord.bulge.norm() / 3;
            if (whole > 0 && off_arcs(chord.from, there) <= tolerance &&
                off_arcs(chord.to, there) <= tolerance)
                area += whole;
        }
        return area;
    };
    return (1 + kArcError) * (sum(one, other) + sum(other, one));
}

} // namespace lacuna::sweep
