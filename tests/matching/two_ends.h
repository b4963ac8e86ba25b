// SPDX-License-Identifier: MIT
#pragma once

// Source and target with nothing between them, made of outlines whose vertices stand wherever a test wants
// them.
#include "support/refusal.h"

#include <lacuna/core/error.h>
#include <lacuna/geometry/newell.h>
#include <lacuna/geometry/shared/triangulate.h>
#include <lacuna/topology/open_volume.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

namespace lacuna::test {

/// A closed line in the plane, not repeating its first point, and which of its points are vertices.
struct Outline {
    std::vector<Vec2> points;
    std::vector<std::size_t> vertices; ///< rising, not empty
};

using Ends = std::vector<Outline>;
using Place = std::function<Vec3(const Vec2&)>;

/// A circle with vertices at shares of its length; points between them even.
inline Outline circle(const std::vector<double>& shares, double radius = 1, int points = 60,
                      const Vec2& centre = {0, 0})
{
    Outline outline;
    const std::size_t n = shares.size();
    for (std::size_t i = 0; i < n; ++i) {
        const double from = shares[i], to = i + 1 < n ? shares[i + 1] : shares[0] + 1;
        const int pieces = std::max(1, static_cast<int>(std::lround((to - from) * points)));
        outline.vertices.push_back(outline.points.size());
        for (int k = 0; k < pieces; ++k) {
            const double angle = 2 * std::numbers::pi * (from + (to - from) * k / pieces);
            outline.points.emplace_back(centre + radius * Vec2(std::cos(angle), std::sin(angle)));
        }
    }
    return outline;
}

/// Even shares, the first at `phase` of a step.
inline std::vector<double> even(int count, double phase = 0)
{
    std::vector<double> shares;
    for (int i = 0; i < count; ++i) shares.push_back((i + phase) / count);
    return shares;
}

/// Straight sides between corners, each a vertex, and vertices on sides: {side, share of it}.
inline Outline polygon(const std::vector<Vec2>& corners, int cuts = 4,
                       const std::vector<std::pair<std::size_t, double>>& extra = {})
{
    Outline outline;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const Vec2 &a = corners[i], &b = corners[(i + 1) % corners.size()];
        std::vector<double> shares;
        for (int k = 0; k < cuts; ++k) shares.push_back(static_cast<double>(k) / cuts);
        for (const auto& [side, share] : extra) {
            if (side == i) shares.push_back(share);
        }
        std::sort(shares.begin(), shares.end());
        shares.erase(
            std::unique(shares.begin(), shares.end(), [](double x, double y) { return y - x < 1e-9; }),
            shares.end());
        for (const double share : shares) {
            const bool wanted = std::any_of(extra.begin(), extra.end(), [&](const auto& e) {
                return e.first == i && std::abs(e.second - share) < 1e-9;
            });
            if (share == 0 || wanted) outline.vertices.push_back(outline.points.size());
            outline.points.emplace_back((1 - share) * a + share * b);
        }
    }
    return outline;
}

inline std::vector<Vec2> regular(int corners, double radius = 1, double turn = 0)
{
    std::vector<Vec2> result;
    for (int i = 0; i < corners; ++i) {
        const double angle = 2 * std::numbers::pi * (i + turn) / corners;
        result.emplace_back(radius * Vec2(std::cos(angle), std::sin(angle)));
    }
    return result;
}

inline void add_end(topology::ModelBuilder& model, const Ends& ends, const Place& place, bool upward)
{
    using namespace topology;
    std::vector<Vec2> flat;
    std::vector<std::vector<Index>> loops;
    const auto base = static_cast<Index>(model.points.size());
    for (const Outline& outline : ends) {
        std::vector<Index>& loop = loops.emplace_back();
        const auto first = static_cast<Index>(flat.size());
        for (const Vec2& p : outline.points) {
            loop.push_back(static_cast<Index>(flat.size()));
            flat.push_back(p);
        }
        const std::size_t n = outline.vertices.size(), vertex = model.vertices.size();
        for (std::size_t i = 0; i < n; ++i) {
            const auto at = static_cast<Index>(outline.vertices[i]);
            model.vertices.push_back(
                {base + first + at, static_cast<int>(model.vertices.size()) + 1, Origin::given});
            Edge edge;
            edge.tag = static_cast<int>(model.edges.size()) + 1;
            edge.from = VertexId(vertex + i);
            edge.to = VertexId(vertex + (i + 1) % n);
            const std::size_t size = outline.points.size();
            const std::size_t next = i + 1 < n ? outline.vertices[i + 1] : outline.vertices[0] + size;
            for (std::size_t k = outline.vertices[i]; k <= next; ++k)
                edge.points.push_back(base + first + static_cast<Index>(k % size));
            model.edges.push_back(edge);
        }
    }
    geometry::TriangulateOptions options;
    options.grading = 0.5;
    const auto cells = geometry::triangulate(flat, loops, options);
    for (const Vec2& p : cells.points) model.points.push_back(place(p));
    Face face;
    face.tag = static_cast<int>(model.faces.size()) + 1;
    for (Triangle t : cells.triangles) {
        if (!upward) std::swap(t[1], t[2]);
        for (Index& p : t) p += base;
        face.triangles.push_back(t);
    }
    model.faces.push_back(face);
}

/// Source at z = 0, looking down, and target wherever `place` has it. Vertex tags count from 1 in the order
/// of outlines, source first.
inline topology::OpenVolume two_ends(const Ends& low, const Ends& high, const Place& place)
{
    topology::ModelBuilder model;
    add_end(
        model, low, [](const Vec2& p) { return Vec3(p.x(), p.y(), 0); }, false);
    add_end(model, high, place, true);
    Vec3 least = model.points.front(), most = least;
    for (const Vec3& p : model.points) {
        least = least.cwiseMin(p);
        most = most.cwiseMax(p);
    }
    model.diagonal = (most - least).norm();
    model.tolerance = 1e-6 * model.diagonal;
    model.build_loops();
    return open_volume(std::move(model).finish(), {{FaceId(std::size_t(0))}, {FaceId(std::size_t(1))}, {}});
}

inline Place lifted(double height, double scale = 1, double turn = 0, const Vec2& shift = {0, 0})
{
    return [=](const Vec2& p) {
        const double c = std::cos(turn), s = std::sin(turn);
        return Vec3(scale * (c * p.x() - s * p.y()) + shift.x(), scale * (s * p.x() + c * p.y()) + shift.y(),
                    height);
    };
}

} // namespace lacuna::test
