// SPDX-License-Identifier: GPL-2.0-or-later
#include <lacuna/cad_worker/recombine.h>

#include <lacuna/cad_worker/detail/gmsh_api.h>
#include <lacuna/cad_worker/session.h>

#include <algorithm>
#include <cmath>
#include <unordered_map>

namespace lacuna::cad_worker {

using cad_protocol::RecombineReply;
using cad_protocol::RecombineRequest;

namespace {

/// Add the loops to Gmsh as lines that it must not divide. @return the face, and for each region point on a
/// loop the Gmsh point.
std::pair<int, std::unordered_map<Index, int>> draw(const RecombineRequest& region, const Vec2& origin,
                                                    double scale)
{
    std::unordered_map<Index, int> drawn;
    std::vector<int> wires;
    for (const std::vector<Index>& loop : region.loops) {
        for (const Index p : loop) {
            const Vec2 at = (region.points.at(index(p)) - origin) / scale;
            drawn[p] = gmsh::model::geo::addPoint(at.x(), at.y(), 0);
        }
        std::vector<int> lines;
        for (std::size_t i = 0; i < loop.size(); ++i) {
            lines.push_back(gmsh::model::geo::addLine(drawn[loop[i]], drawn[loop[(i + 1) % loop.size()]]));
            gmsh::model::geo::mesh::setTransfiniteCurve(lines.back(), 2);
        }
        wires.push_back(gmsh::model::geo::addCurveLoop(lines));
    }
    const int face = gmsh::model::geo::addPlaneSurface(wires);
    gmsh::model::geo::synchronize();
    return {face, std::move(drawn)};
}

/// The quads that Gmsh made, counter-clockwise; the points of the region come first.
RecombineReply read_quads(const RecombineRequest& region, int face,
                          const std::unordered_map<Index, int>& drawn, const Vec2& origin, double scale)
{
    RecombineReply mesh{region.points, {}};
    std::unordered_map<std::size_t, Index> number;
    std::vector<std::size_t> nodes;
    std::vector<double> at, parameters;
    for (const auto& [p, tag] : drawn) {
        gmsh::model::mesh::getNodes(nodes, at, parameters, 0, tag, false, false);
        number[nodes.at(0)] = p;
    }
    gmsh::model::mesh::getNodes(nodes, at, parameters, 2, face, false, false);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        number[nodes[i]] = static_cast<Index>(mesh.points.size());
        mesh.points.push_back(origin + scale * Vec2(at[3 * i], at[3 * i + 1]));
    }
    std::vector<std::size_t> elements, corners;
    gmsh::model::mesh::getElementsByType(2, elements, corners, face);
    if (!elements.empty()) {
        throw NotSweepable(Message("cad.recombine", "Gmsh left {} triangles in a region of {} boundary sides",
                                   found(elements.size()), drawn.size())
                               .remedy("use quads = \"auto\""));
    }
    gmsh::model::mesh::getElementsByType(3, elements, corners, face);
    double area = 0;
    for (std::size_t e = 0; e < elements.size(); ++e) {
        Quad quad;
        for (std::size_t k = 0; k < 4; ++k) quad[k] = number.at(corners[4 * e + k]);
        const auto point = [&](std::size_t k) { return mesh.points[index(quad[k])]; };
        const Vec2 u = point(2) - point(0), v = point(3) - point(1);
        area += u.x() * v.y() - u.y() * v.x();
        mesh.quads.push_back(quad);
    }
    if (area < 0) {
        for (Quad& quad : mesh.quads) std::reverse(quad.begin(), quad.end());
    }
    return mesh;
}

/// Size at a point, interpolated bilinearly in the raster.
double size_at(const cad_protocol::SizeRaster& raster, const Vec2& place)
{
    const std::size_t columns = index(raster.columns), rows = raster.sizes.size() / columns;
    const Vec2 at = (place - raster.origin) / raster.step;
    if (!at.allFinite()) return raster.sizes.front();
    const auto cell = [](double x, std::size_t lines) {
        return static_cast<std::size_t>(std::clamp(std::floor(x), 0.0, static_cast<double>(lines - 2)));
    };
    const std::size_t i = cell(at.x(), columns), j = cell(at.y(), rows);
    const double u = std::clamp(at.x() - static_cast<double>(i), 0.0, 1.0);
    const double v = std::clamp(at.y() - static_cast<double>(j), 0.0, 1.0);
    const double* low = raster.sizes.data() + j * columns + i;
    const double* high = low + columns;
    const double below = low[0] + u * (low[1] - low[0]), above = high[0] + u * (high[1] - high[0]);
    return below + v * (above - below);
}

} // namespace

RecombineReply recombine(const RecombineRequest& region)
{
    // Some tolerances of Gmsh are absolute, so scale the region to size 1.
    Eigen::AlignedBox2d box;
    for (const std::vector<Index>& loop : region.loops) {
        for (const Index p : loop) box.extend(region.points.at(index(p)));
    }
    const Vec2 origin = box.min();
    const double scale = box.sizes().maxCoeff();

    Session session("a region to be filled with quads");
    // Algorithm 6, frontal. Algorithm 8, made for quads, is not deterministic: the order in which it solves
    // its cross field depends on memory addresses.
    session.set("Mesh.Algorithm", 6);
    session.set("Mesh.RecombinationAlgorithm", 1); // Blossom
    session.set("Mesh.CrossFieldClosestPoint", 0); // without the library ANN, the default crashes
    session.set_sizes_from_boundary();
    session.set("Mesh.RecombineAll", 0);
    session.set("Mesh.Smoothing", 10);
    GmshModel model(session);
    return session.run([&] {
        const auto [face, drawn] = draw(region, origin, scale);
        gmsh::model::mesh::setRecombine(2, face);
        const bool sized = !region.size.sizes.empty();
        // Newer versions of Gmsh also pass their own target size to the callback.
        if (sized) {
            gmsh::model::mesh::setSizeCallback([&](int, int, double x, double y, double, auto...) {
                return size_at(region.size, origin + scale * Vec2(x, y)) / scale;
            });
        }
        gmsh::model::mesh::generate(2);
        if (sized) gmsh::model::mesh::removeSizeCallback();
        return read_quads(region, face, drawn, origin, scale);
    });
}

} // namespace lacuna::cad_worker
