// SPDX-License-Identifier: MIT
#include "support/check_valid.h"

#include <lacuna/quality/quality.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

namespace lacuna::test {
namespace {

using Faults = std::vector<std::string>;

void expect(Faults& faults, bool good, const std::string& fault)
{
    if (!good && faults.size() < 20) faults.push_back(fault);
}

/// Corners of a quad or triangle, each once, from the lowest on.
using Side = std::vector<Index>;

Side begin_lowest(const Quad& quad)
{
    Side side;
    for (const Index node : quad)
        if (side.empty() || side.back() != node) side.push_back(node);
    std::rotate(side.begin(), std::min_element(side.begin(), side.end()), side.end());
    return side;
}

Side reversed(Side side)
{
    std::reverse(side.begin() + 1, side.end());
    return side;
}

/// Whether two columns of a cell's nodes are one.
bool is_wedge(const Hex& hex) { return hex[2] == hex[3] && hex[6] == hex[7]; }

bool good_sizes(const mesh::HexMesh& mesh, Faults& faults)
{
    const auto layers = static_cast<std::size_t>(mesh.layers);
    expect(faults, mesh.cell_count() > 0, "no cells");
    expect(faults, mesh.nodes.size() == (layers + 1) * static_cast<std::size_t>(mesh.nodes_per_layer),
           "node count");
    expect(faults, mesh.source_patch.size() == mesh.quads.size(), "source patch count");
    expect(faults, mesh.target_patch.size() == mesh.quads.size(), "target patch count");
    expect(faults, mesh.wall_patch.size() == mesh.rim.size() * layers, "wall patch count");
    for (const Quad& quad : mesh.quads)
        for (const Index node : quad)
            expect(faults, node >= 0 && node < mesh.nodes_per_layer, "node out of range");
    return faults.empty();
}

/// Sides of all cells, each told by its nodes in any order, with the ways it is run, outward.
std::map<std::set<Index>, std::vector<Side>> all_sides(const mesh::HexMesh& mesh)
{
    std::map<std::set<Index>, std::vector<Side>> sides;
    for (std::size_t cell = 0; cell < mesh.cell_count(); ++cell) {
        const Hex hex = mesh.hex(cell);
        const Quad outward[6] = {{hex[0], hex[3], hex[2], hex[1]}, {hex[4], hex[5], hex[6], hex[7]},
                                 {hex[0], hex[1], hex[5], hex[4]}, {hex[1], hex[2], hex[6], hex[5]},
                                 {hex[2], hex[3], hex[7], hex[6]}, {hex[3], hex[0], hex[4], hex[7]}};
        for (const Quad& quad : outward) {
            if (is_wedge(hex) && quad[0] == quad[1]) continue; // between the columns that are one
            sides[std::set<Index>(quad.begin(), quad.end())].push_back(begin_lowest(quad));
        }
    }
    return sides;
}

void find_conformity_faults(const mesh::HexMesh& mesh, Faults& faults)
{
    std::multiset<Side> lone;
    for (const auto& [nodes, uses] : all_sides(mesh)) {
        expect(faults, nodes.size() == uses[0].size(), "a side uses a node twice");
        expect(faults, uses.size() <= 2, "a side is used by more than two cells");
        if (uses.size() == 2)
            expect(faults, uses[0] == reversed(uses[1]), "a side is run the same way by its two cells");
        if (uses.size() == 1) lone.insert(uses[0]);
    }
    std::multiset<Side> skin;
    std::map<Segment, int> edges;
    for (std::size_t i = 0; i < mesh.skin_count(); ++i) {
        const mesh::SkinQuad quad = mesh::skin_quad(mesh, i);
        expect(faults, quad.patch >= 0 && static_cast<std::size_t>(quad.patch) < mesh.patches.size(),
               "a skin quad without patch");
        skin.insert(begin_lowest(quad.nodes));
        const Side side = begin_lowest(quad.nodes);
        for (std::size_t k = 0; k < side.size(); ++k) ++edges[{side[k], side[(k + 1) % side.size()]}];
    }
    expect(faults, skin == lone, "the skin's quads are not the sides of one cell alone, outward");
    for (const auto& [edge, uses] : edges) {
        const auto back = edges.find({edge[1], edge[0]});
        expect(faults, uses == 1 && back != edges.end() && back->second == 1,
               "an edge of the skin does not join two quads");
    }
}

void find_node_faults(const mesh::HexMesh& mesh, Faults& faults)
{
    std::vector<bool> used(mesh.nodes.size(), false);
    for (std::size_t cell = 0; cell < mesh.cell_count(); ++cell)
        for (const Index node : mesh.hex(cell)) used[static_cast<std::size_t>(node)] = true;
    expect(faults, std::find(used.begin(), used.end(), false) == used.end(), "a node belongs to no cell");

    std::vector<Vec3> sorted = mesh.nodes;
    std::sort(sorted.begin(), sorted.end(), [](const Vec3& a, const Vec3& b) { return a.x() < b.x(); });
    Eigen::AlignedBox3d box;
    for (const Vec3& node : sorted) {
        box.extend(node);
        expect(faults, node.allFinite(), "a node is not finite");
    }
    const double tolerance = 1e-9 * box.diagonal().norm();
    for (std::size_t i = 0; i < sorted.size(); ++i)
        for (std::size_t j = i + 1; j < sorted.size() && sorted[j].x() - sorted[i].x() <= tolerance; ++j)
            expect(faults, (sorted[i] - sorted[j]).norm() > tolerance, "two nodes in one place");
}

constexpr double kCorner[8][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                                  {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};

/// Jacobian of the trilinear map, from the derivatives of the shape functions.
double jacobian(const std::array<Vec3, 8>& corners, const Vec3& at)
{
    Eigen::Matrix3d columns = Eigen::Matrix3d::Zero();
    for (std::size_t c = 0; c < 8; ++c) {
        for (int d = 0; d < 3; ++d) {
            double slope = 1;
            for (int e = 0; e < 3; ++e) {
                const bool upper = kCorner[c][e] > 0;
                if (e == d)
                    slope *= upper ? 1 : -1;
                else
                    slope *= upper ? at[e] : 1 - at[e];
            }
            columns.col(d) += slope * corners[c];
        }
    }
    return columns.determinant();
}

double naive_scaled_jacobian(const std::array<Vec3, 8>& corners)
{
    double least = 1;
    for (const auto& corner : kCorner) {
        const auto find = [&](int flipped) {
            for (std::size_t c = 0; c < 8; ++c) {
                bool same = true;
                for (int e = 0; e < 3; ++e) same = same && (kCorner[c][e] != corner[e]) == (e == flipped);
                if (same) return corners[c];
            }
            return Vec3(0, 0, 0);
        };
        Eigen::Matrix3d edges;
        for (int d = 0; d < 3; ++d)
            edges.col(d) = ((find(d) - find(-1)) * (corner[d] > 0 ? -1 : 1)).normalized();
        least = std::min(least, edges.determinant());
    }
    return least;
}

/// Of a wedge: as a hexahedron's over the sine of the even triangle's corners.
double naive_wedge_jacobian(const std::array<Vec3, 8>& corners)
{
    const std::array<Vec3, 3> low{corners[0], corners[1], corners[2]},
        high{corners[4], corners[5], corners[6]};
    double least = 1;
    for (std::size_t i = 0; i < 3; ++i) {
        for (const auto& [own, other, sign] : {std::tuple(low, high, 1), std::tuple(high, low, -1)}) {
            Eigen::Matrix3d edges;
            edges.col(0) = (own[(i + 1) % 3] - own[i]).normalized();
            edges.col(1) = (own[(i + 2) % 3] - own[i]).normalized();
            edges.col(2) = (other[i] - own[i]).normalized() * sign;
            least = std::min(least, edges.determinant() / std::sin(std::acos(-1.0) / 3));
        }
    }
    return least;
}

const double kGauss[2] = {0.5 - 0.5 / std::sqrt(3.0), 0.5 + 0.5 / std::sqrt(3.0)};

double cell_volume(const std::array<Vec3, 8>& corners)
{
    double volume = 0;
    for (const double u : kGauss)
        for (const double v : kGauss)
            for (const double w : kGauss) volume += jacobian(corners, {u, v, w}) / 8;
    return volume;
}

/// A third of the flux of the position through the bilinear quads: the volume within, by Gauss's theorem.
double skin_volume(const mesh::HexMesh& mesh)
{
    double sum = 0;
    const Vec3 origin = mesh.nodes.front();
    for (std::size_t i = 0; i < mesh.skin_count(); ++i) {
        const Quad quad = mesh::skin_quad(mesh, i).nodes;
        const auto at = [&](std::size_t k) -> Vec3 {
            return mesh.nodes[static_cast<std::size_t>(quad[k])] - origin;
        };
        for (const double u : kGauss) {
            for (const double v : kGauss) {
                const Vec3 along_u = (1 - v) * (at(1) - at(0)) + v * (at(2) - at(3));
                const Vec3 along_v = (1 - u) * (at(3) - at(0)) + u * (at(2) - at(1));
                const Vec3 point = (1 - u) * ((1 - v) * at(0) + v * at(3)) +
                                   u * ((1 - v) * at(1) + v * at(2));
                sum += point.dot(along_u.cross(along_v)) / 12;
            }
        }
    }
    return sum;
}

void find_shape_faults(const mesh::HexMesh& mesh, Faults& faults)
{
    double least = 1;
    double sum = 0;
    double volume = 0;
    for (std::size_t cell = 0; cell < mesh.cell_count(); ++cell) {
        const bool wedge = is_wedge(mesh.hex(cell));
        std::array<Vec3, 8> corners;
        for (std::size_t c = 0; c < 8; ++c)
            corners[c] = mesh.nodes[static_cast<std::size_t>(mesh.hex(cell)[c])];
        for (int i = 0; i < 4; ++i)
            for (int j = 0; j < (wedge ? 3 : 4); ++j) // nothing is left of the last row of a wedge
                for (int k = 0; k < 4; ++k)
                    expect(faults, jacobian(corners, Vec3(i, j, k) / 3) > 0, "a Jacobian is not positive");
        const double scaled = wedge ? naive_wedge_jacobian(corners) : naive_scaled_jacobian(corners);
        least = std::min(least, scaled);
        sum += scaled;
        volume += cell_volume(corners);
    }
    const double within = skin_volume(mesh);
    expect(faults, std::abs(volume - within) <= 1e-9 * std::abs(volume),
           "the skin does not hold the volume of the cells");

    const quality::Quality quality = quality::measure(mesh);
    const double mean = sum / static_cast<double>(mesh.cell_count());
    expect(faults, quality.hexes == mesh.hex_count(), "measured count");
    expect(faults, quality.wedges == mesh.wedge_count(), "measured wedges");
    expect(faults, std::abs(quality.min_scaled_jacobian - least) < 1e-9, "measured least scaled Jacobian");
    expect(faults, std::abs(quality.mean_scaled_jacobian - mean) < 1e-9, "measured mean scaled Jacobian");
    expect(faults, std::abs(quality.volume - volume) <= 1e-9 * std::abs(volume), "measured volume");
    expect(faults, quality.uncertified == 0, "cells without certificate");
}

/// A quadratic that is 1 at `at` (0, ½ or 1), and its slope.
double quadratic(double at, double t)
{
    if (at == 0) return (1 - t) * (1 - 2 * t);
    return at == 1 ? t * (2 * t - 1) : 4 * t * (1 - t);
}
double quadratic_slope(double at, double t)
{
    if (at == 0) return 4 * t - 3;
    return at == 1 ? 4 * t - 1 : 4 - 8 * t;
}

/// Jacobian of the triquadratic map, a sum over the 27 nodes.
double curved_jacobian(const std::array<Vec3, 27>& nodes, const std::array<Vec3, 27>& cube, const Vec3& t)
{
    Eigen::Matrix3d columns = Eigen::Matrix3d::Zero();
    for (std::size_t n = 0; n < 27; ++n) {
        for (int d = 0; d < 3; ++d) {
            double weight = 1;
            for (int e = 0; e < 3; ++e)
                weight *= e == d ? quadratic_slope(cube[n][e], t[e]) : quadratic(cube[n][e], t[e]);
            columns.col(d) += weight * nodes[n];
        }
    }
    return columns.determinant();
}

/// Middle nodes: each of one side, face or cell, none left over; Jacobians positive where they are sampled.
void find_second_order_faults(const mesh::HexMesh& mesh, Faults& faults)
{
    std::array<Vec3, 8> corners;
    for (std::size_t c = 0; c < 8; ++c) corners[c] = Vec3(kCorner[c][0], kCorner[c][1], kCorner[c][2]);
    const std::array<Vec3, 27> cube = mesh::as_hex27(corners);
    std::map<std::set<Index>, Index> middle; // of what has these corners
    std::set<Index> used;
    const auto is_middle_of = [&](const std::set<Index>& of, Index node) {
        used.insert(node);
        const auto [at, fresh] = middle.try_emplace(of, node);
        expect(faults, fresh || at->second == node, "a side with two middle nodes");
    };
    double volume = 0;
    for (std::size_t cell = 0; cell < mesh.hex_count(); ++cell) {
        const mesh::CellNodes nodes = mesh::cell_nodes(mesh, cell);
        const auto& n = nodes.node;
        for (std::size_t e = 0; e < 12; ++e)
            is_middle_of({n[index(mesh::kHexEdges[e][0])], n[index(mesh::kHexEdges[e][1])]}, n[8 + e]);
        for (std::size_t f = 0; f < 6 && nodes.count == 27; ++f) {
            std::set<Index> of;
            for (const Index c : mesh::kHexFaces[f]) of.insert(n[index(c)]);
            is_middle_of(of, n[20 + f]);
        }
        if (nodes.count == 27) is_middle_of({n.begin(), n.begin() + 8}, n[26]);
        std::vector<Vec3> places;
        for (const Index node : nodes.all()) places.push_back(mesh.node(index(node)));
        const std::array<Vec3, 27> all = mesh::as_hex27(places);
        for (int i = 0; i < 5; ++i)
            for (int j = 0; j < 5; ++j)
                for (int k = 0; k < 5; ++k)
                    expect(faults, curved_jacobian(all, cube, Vec3(i, j, k) / 4) > 0,
                           "a Jacobian of order 2 is not positive");
        const double off = std::sqrt(0.15); // Gauss's points
        for (int i = 0; i < 27; ++i) {
            const Vec3 at(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
            const double weight = (at.x() == 0 ? 8 : 5) * (at.y() == 0 ? 8 : 5) * (at.z() == 0 ? 8 : 5) /
                                  5832.;
            volume += weight * curved_jacobian(all, cube, Vec3(0.5, 0.5, 0.5) + off * at);
        }
    }
    expect(faults, used.size() == mesh.middles.nodes.size(), "a middle node belongs to no cell");
    for (std::size_t i = 0; i < mesh.skin_count(); ++i) {
        const mesh::CellNodes nodes = mesh::skin_nodes(mesh, i);
        const auto& n = nodes.node;
        for (std::size_t k = 0; k < 4; ++k) is_middle_of({n[k], n[(k + 1) % 4]}, n[4 + k]);
        if (nodes.count == 9) is_middle_of({n.begin(), n.begin() + 4}, n[8]);
    }
    const quality::Quality quality = quality::measure(mesh);
    expect(faults, std::abs(quality.volume - volume) <= 1e-9 * std::abs(volume),
           "measured volume of order 2");
    expect(faults, quality.uncertified == 0, "cells of order 2 without certificate");
    expect(faults, quality.min_scaled_jacobian > 0, "measured least scaled Jacobian of order 2");
}

} // namespace

std::vector<std::string> faults(const mesh::HexMesh& mesh)
{
    Faults found;
    if (!good_sizes(mesh, found)) return found;
    if (mesh.order() == 2) {
        find_second_order_faults(mesh, found);
        mesh::HexMesh corners = mesh;
        corners.middles = {};
        for (const std::string& fault : faults(corners)) expect(found, false, fault);
        return found;
    }
    find_conformity_faults(mesh, found);
    find_node_faults(mesh, found);
    find_shape_faults(mesh, found);
    return found;
}

void check_valid(const mesh::HexMesh& mesh)
{
    std::string all;
    for (const std::string& fault : faults(mesh)) all += fault + "\n";
    CHECK_MESSAGE(all.empty(), all);
}

} // namespace lacuna::test
