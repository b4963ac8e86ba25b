// SPDX-License-Identifier: MIT
#pragma once

// Families of source meshes and of motions for the sweep tests.
#include <lacuna/mesh/quad_mesh.h>
#include <lacuna/sweep/shared/rim_columns.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <string>
#include <vector>

namespace lacuna::test {

using Map = std::function<Vec3(const Vec3&)>;
using Motion = std::function<Vec3(const Vec3&, double)>; ///< point, height in [0, 1]

/// Node cycles of the boundary, chained from the sides.
inline void set_loops(mesh::QuadMesh& mesh)
{
    mesh.face.assign(mesh.quads.size(), 0);
    std::map<Index, Index> next;
    for (const auto& side : mesh::boundary_sides(mesh.quads)) next[side.from] = side.to;
    while (!next.empty()) {
        std::vector<Index>& loop = mesh.loops.emplace_back();
        for (Index node = next.begin()->first; next.contains(node);) {
            loop.push_back(node);
            const Index to = next[node];
            next.erase(node);
            node = to;
        }
    }
}

/// Unit-spaced cells (i, j) that `keep` keeps, scaled to [-1, 1]².
inline mesh::QuadMesh cells(int count, const std::function<bool(int, int)>& keep)
{
    mesh::QuadMesh mesh;
    std::map<std::pair<int, int>, Index> number;
    const auto node = [&](int i, int j) {
        const auto [at, added] = number.try_emplace({i, j}, static_cast<Index>(mesh.nodes.size()));
        if (added) mesh.nodes.emplace_back(2.0 * i / count - 1, 2.0 * j / count - 1, 0);
        return at->second;
    };
    for (int j = 0; j < count; ++j) {
        for (int i = 0; i < count; ++i) {
            if (!keep(i, j)) continue;
            const Index a = node(i, j);
            const Index b = node(i + 1, j);
            const Index c = node(i + 1, j + 1);
            mesh.quads.push_back({a, b, c, node(i, j + 1)});
        }
    }
    set_loops(mesh);
    return mesh;
}

inline mesh::QuadMesh square(int count)
{
    return cells(count, [](int, int) { return true; });
}

inline mesh::QuadMesh l_shape(int count)
{
    return cells(count, [=](int i, int j) { return 2 * i < count || 2 * j < count; });
}

/// Two square holes of different size.
inline mesh::QuadMesh holed_plate(int count)
{
    return cells(count, [=](int i, int j) {
        const double x = (i + 0.5) / count;
        const double y = (j + 0.5) / count;
        const bool first = std::abs(x - 0.3) < 0.13 && std::abs(y - 0.3) < 0.13;
        const bool second = std::abs(x - 0.7) < 0.2 && std::abs(y - 0.7) < 0.1;
        return !first && !second;
    });
}

/// A disc of radius 1: a square core and rings around it.
inline mesh::QuadMesh disc(int core, int rings)
{
    mesh::QuadMesh mesh;
    const auto at = [&](int i, int j) { return static_cast<Index>(j * (core + 1) + i); };
    for (int j = 0; j <= core; ++j) {
        for (int i = 0; i <= core; ++i)
            mesh.nodes.emplace_back(0.5 * (2.0 * i / core - 1), 0.5 * (2.0 * j / core - 1), 0);
    }
    for (int j = 0; j < core; ++j) {
        for (int i = 0; i < core; ++i)
            mesh.quads.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
    }
    std::vector<Index> inner;
    for (int i = 0; i < core; ++i) inner.push_back(at(i, 0));
    for (int j = 0; j < core; ++j) inner.push_back(at(core, j));
    for (int i = core; i > 0; --i) inner.push_back(at(i, core));
    for (int j = core; j > 0; --j) inner.push_back(at(0, j));
    const std::vector<Index> foot = inner;
    for (int r = 1; r <= rings; ++r) {
        std::vector<Index> outer;
        for (std::size_t k = 0; k < foot.size(); ++k) {
            const double angle = 2 * std::numbers::pi *
                                 (static_cast<double>(k) / static_cast<double>(foot.size()) - 0.375);
            const Vec3 base = mesh.nodes[static_cast<std::size_t>(foot[k])];
            const double part = static_cast<double>(r) / rings;
            outer.push_back(static_cast<Index>(mesh.nodes.size()));
            mesh.nodes.push_back((1 - part) * base + part * Vec3(std::cos(angle), std::sin(angle), 0));
        }
        for (std::size_t k = 0; k < foot.size(); ++k) {
            const std::size_t n = (k + 1) % foot.size();
            mesh.quads.push_back({inner[k], outer[k], outer[n], inner[n]});
        }
        inner = outer;
    }
    set_loops(mesh);
    return mesh;
}

/// Rings between radius `inner` and 1.
inline mesh::QuadMesh annulus(int sectors, int rings, double inner = 0.4)
{
    mesh::QuadMesh mesh;
    for (int r = 0; r <= rings; ++r) {
        for (int s = 0; s < sectors; ++s) {
            const double angle = 2 * std::numbers::pi * s / sectors;
            const double radius = inner + (1 - inner) * r / rings;
            mesh.nodes.emplace_back(radius * std::cos(angle), radius * std::sin(angle), 0);
        }
    }
    for (int r = 0; r < rings; ++r) {
        for (int s = 0; s < sectors; ++s) {
            const Index a = r * sectors + s;
            const Index b = r * sectors + (s + 1) % sectors;
            mesh.quads.push_back({a, a + sectors, b + sectors, b});
        }
    }
    set_loops(mesh);
    return mesh;
}

/// The skin of a cylinder of radius 1 about z, from z = 0 to `height`, normals outward: two rims, no plane.
inline mesh::QuadMesh tube(int sectors, int rings, double height = 2)
{
    mesh::QuadMesh mesh = annulus(sectors, rings, 0.5);
    for (std::size_t i = 0; i < mesh.nodes.size(); ++i) {
        Vec3& p = mesh.nodes[i];
        const double z = height * static_cast<double>(static_cast<int>(i) / sectors) / rings;
        p = Vec3(p[0], p[1], 0).normalized();
        p[2] = z;
    }
    for (Quad& quad : mesh.quads) std::swap(quad[1], quad[3]);
    mesh.loops.clear();
    set_loops(mesh);
    return mesh;
}

struct Family {
    std::string name;
    mesh::QuadMesh mesh;
};

inline std::vector<Family> planar_families()
{
    return {{"square", square(6)},
            {"L", l_shape(8)},
            {"holed plate", holed_plate(20)},
            {"disc", disc(6, 4)},
            {"annulus", annulus(24, 4)},
            {"one quad", square(1)},
            {"a row", cells(5, [](int, int j) { return j == 0; })}};
}

inline std::vector<Index> rim_nodes(const mesh::QuadMesh& mesh)
{
    std::vector<Index> rim;
    for (const auto& loop : mesh.loops) rim.insert(rim.end(), loop.begin(), loop.end());
    std::reverse(rim.begin(), rim.end()); // an order of its own, so that nothing leans on the loops'
    return rim;
}

inline mesh::QuadMesh mapped(mesh::QuadMesh mesh, const Map& map)
{
    for (Vec3& p : mesh.nodes) p = map(p);
    return mesh;
}

inline std::vector<Vec3> moved(const mesh::QuadMesh& mesh, const Motion& motion, double height)
{
    std::vector<Vec3> nodes;
    for (const Vec3& p : mesh.nodes) nodes.push_back(motion(p, height));
    return nodes;
}

/// RimColumns that follow a motion which leaves the source in place at height 0.
inline sweep::RimColumns columns_along(const mesh::QuadMesh& mesh, int layers, const Motion& motion)
{
    sweep::RimColumns columns;
    columns.layers = layers;
    columns.rim = rim_nodes(mesh);
    for (int l = 0; l <= layers; ++l) {
        for (const Index node : columns.rim) {
            const Vec3& p = mesh.nodes[static_cast<std::size_t>(node)];
            columns.points.push_back(l == 0 ? p : motion(p, static_cast<double>(l) / layers));
        }
    }
    return columns;
}

/// Smallest scaled Jacobian at a corner of a hex between two layers.
inline double worst_hex(const mesh::QuadMesh& mesh, const std::vector<Vec3>& nodes, int layers)
{
    double worst = 1;
    const std::size_t count = mesh.nodes.size();
    for (int l = 0; l < layers; ++l) {
        for (const Quad& quad : mesh.quads) {
            for (int top = 0; top < 2; ++top) {
                for (std::size_t i = 0; i < 4; ++i) {
                    const auto at = [&](std::size_t corner, int up) {
                        return nodes[static_cast<std::size_t>(l + up) * count +
                                     static_cast<std::size_t>(quad[corner])];
                    };
                    const Vec3 u = (at((i + 1) % 4, top) - at(i, top)).normalized();
                    const Vec3 v = (at((i + 3) % 4, top) - at(i, top)).normalized();
                    const Vec3 w = (at(i, 1) - at(i, 0)).normalized();
                    worst = std::min(worst, u.cross(v).dot(w));
                }
            }
        }
    }
    return worst;
}

// --- motions: height 0 leaves the point in place, the volume lies above the source's normal -------------

inline Vec3 about(const Vec3& p, const Vec3& axis, double angle)
{
    return Eigen::AngleAxisd(angle, axis.normalized()) * p;
}

inline Motion lifted(double height)
{
    return [=](const Vec3& p, double t) { return Vec3(p + Vec3(0, 0, height * t)); };
}

/// Turned about z while it rises.
inline Motion twisted(double height, double degrees)
{
    return [=](const Vec3& p, double t) {
        return Vec3(about(p, Vec3::UnitZ(), t * degrees * std::numbers::pi / 180) + Vec3(0, 0, height * t));
    };
}

/// Turned about an axis that lies along y at x = -radius: a pipe's bend.
inline Motion bent(double radius, double degrees)
{
    return [=](const Vec3& p, double t) {
        const Vec3 pivot(-radius, 0, 0);
        return Vec3(pivot + about(p - pivot, -Vec3::UnitY(), t * degrees * std::numbers::pi / 180));
    };
}

inline Motion tapered(double height, double end_scale)
{
    return [=](const Vec3& p, double t) {
        const double scale = 1 + t * (end_scale - 1);
        return Vec3(scale * p[0], scale * p[1], scale * p[2] + height * t);
    };
}

} // namespace lacuna::test
