// SPDX-License-Identifier: GPL-2.0-or-later
#include <lacuna/cad/load.h>

#include <lacuna/cad/gmsh_api.h>
#include <lacuna/cad/session.h>
#include <lacuna/geometry/triangulate.h>
#include <lacuna/surface/triangle_quads.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <unordered_map>

namespace lacuna::cad {

namespace {

using surface::Loops;
using surface::can_halve;
using surface::halve;
using surface::in_order;
using surface::MixedMesh;

/// Wanted edge lengths on a raster: what the caller asks for, but growing no faster away from the rim than
/// quads can. The raster spares the caller's function, which may be a script, a call for every node.
class SizeRaster {
public:
    SizeRaster(const surface::PlanarRegion& region, const Eigen::AlignedBox2d& box) : low_(box.min())
    {
        std::vector<std::pair<Vec2, double>> rim;
        double least = std::numeric_limits<double>::infinity();
        for (const std::vector<Index>& loop : region.loops) {
            for (std::size_t i = 0; i < loop.size(); ++i) {
                const Vec2& before = at(region, loop[(i + loop.size() - 1) % loop.size()]);
                const Vec2& here = at(region, loop[i]);
                const Vec2& after = at(region, loop[(i + 1) % loop.size()]);
                rim.emplace_back(here, ((here - before).norm() + (after - here).norm()) / 2);
                least = std::min(least, rim.back().second);
            }
        }
        const double extent = box.sizes().maxCoeff();
        const double cells = std::clamp(extent / least, kLeastCells, kMostCells);
        step_ = extent / cells;
        nx_ = static_cast<int>(std::ceil(box.sizes().x() / step_)) + 1;
        ny_ = static_cast<int>(std::ceil(box.sizes().y() / step_)) + 1;
        for (int j = 0; j < ny_; ++j) {
            for (int i = 0; i < nx_; ++i) values_.push_back(wanted(region, rim, low_ + step_ * Vec2(i, j)));
        }
    }

    [[nodiscard]] double operator()(const Vec2& p) const
    {
        const Vec2 q = (p - low_) / step_;
        const int i = std::clamp(static_cast<int>(q.x()), 0, std::max(0, nx_ - 2));
        const int j = std::clamp(static_cast<int>(q.y()), 0, std::max(0, ny_ - 2));
        const double s = std::clamp(q.x() - i, 0.0, 1.0);
        const double t = std::clamp(q.y() - j, 0.0, 1.0);
        return (1 - t) * ((1 - s) * value(i, j) + s * value(i + 1, j)) +
               t * ((1 - s) * value(i, j + 1) + s * value(i + 1, j + 1));
    }

private:
    static constexpr double kLeastCells = 8, kMostCells = 128;
    static constexpr double kGrowth = 0.3; ///< of the edge length, per length away from the rim

    static const Vec2& at(const surface::PlanarRegion& region, Index p)
    {
        return region.points[static_cast<std::size_t>(p)];
    }

    static double wanted(const surface::PlanarRegion& region, const std::vector<std::pair<Vec2, double>>& rim,
                         const Vec2& p)
    {
        double size = std::numeric_limits<double>::infinity();
        for (const auto& [place, spacing] : rim)
            size = std::min(size, spacing + kGrowth * (place - p).norm());
        if (!region.size) return size;
        const double asked = region.size(p);
        return std::isfinite(asked) && asked > 0 ? std::min(size, asked) : size;
    }

    [[nodiscard]] double value(int i, int j) const
    {
        i = std::min(i, nx_ - 1);
        j = std::min(j, ny_ - 1);
        return values_[static_cast<std::size_t>(j) * static_cast<std::size_t>(nx_) +
                       static_cast<std::size_t>(i)];
    }

    Vec2 low_;
    double step_ = 1;
    int nx_ = 1, ny_ = 1;
    std::vector<double> values_;
};

bool inside(const surface::PlanarRegion& region, const Vec2& p)
{
    bool in = false;
    for (const std::vector<Index>& loop : region.loops) {
        for (std::size_t i = 0; i < loop.size(); ++i) {
            const Vec2& a = region.points[static_cast<std::size_t>(loop[i])];
            const Vec2& b = region.points[static_cast<std::size_t>(loop[(i + 1) % loop.size()])];
            if ((a.y() > p.y()) != (b.y() > p.y()) &&
                p.x() < a.x() + (p.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x()))
                in = !in;
        }
    }
    return in;
}

/// About how many quads the sizes will make.
double expected_quads(const surface::PlanarRegion& region, const SizeRaster& size,
                      const Eigen::AlignedBox2d& box)
{
    constexpr int kSamples = 48;
    double sum = 0;
    for (int i = 0; i < kSamples; ++i) {
        for (int j = 0; j < kSamples; ++j) {
            const Vec2 p = box.min() +
                           box.sizes().cwiseProduct(Vec2((i + 0.5) / kSamples, (j + 0.5) / kSamples));
            if (inside(region, p)) sum += 1 / (size(p) * size(p));
        }
    }
    return sum * box.sizes().prod() / (kSamples * kSamples);
}

/// How Gmsh is asked.
struct Attempt {
    int algorithm; ///< Gmsh's 6: frontal, 5: Delaunay, 1: adaptive
    int halvings;  ///< the boundary's every 2^halvings-th node is meshed, the cells then cut so many times
    bool blossom;  ///< Gmsh pairs the triangles, rather than `match_triangles()`
    double size;   ///< of what is wanted: finer cells leave more freedom between coarse sides
};

/// Triangles and quads over the loops given, nodes on them kept, nothing added there.
MixedMesh mesh_with_gmsh(Session& session, const std::vector<Vec2>& points, const Loops& loops,
                         const SizeRaster& size, const Attempt& attempt)
{
    GmshModel model(session);
    const double factor = attempt.size * (1 << attempt.halvings);
    MixedMesh mesh;
    session.run([&] {
        // 8, which is made for quads, gives other coordinates each time: its cross field is solved in an
        // order that depends on addresses.
        session.set("Mesh.Algorithm", attempt.algorithm);
        std::vector<int> wires;
        std::vector<std::pair<Index, int>> tags;
        for (const std::vector<Index>& loop : loops) {
            std::vector<int> corners, lines;
            for (const Index p : loop) {
                const Vec2& at = points[static_cast<std::size_t>(p)];
                corners.push_back(gmsh::model::geo::addPoint(at.x(), at.y(), 0));
                tags.emplace_back(p, corners.back());
            }
            for (std::size_t i = 0; i < corners.size(); ++i) {
                lines.push_back(gmsh::model::geo::addLine(corners[i], corners[(i + 1) % corners.size()]));
                gmsh::model::geo::mesh::setTransfiniteCurve(lines.back(), 2);
            }
            wires.push_back(gmsh::model::geo::addCurveLoop(lines));
        }
        const int face = gmsh::model::geo::addPlaneSurface(wires);
        gmsh::model::geo::synchronize();
        if (attempt.blossom) gmsh::model::mesh::setRecombine(2, face);
        const auto wanted = [&](double x, double y) { return factor * size(Vec2(x, y)); };
        // Later versions hand over their own wish as well.
        gmsh::model::mesh::setSizeCallback(
            [&](int, int, double x, double y, double, auto...) { return wanted(x, y); });
        gmsh::model::mesh::generate(2);
        gmsh::model::mesh::removeSizeCallback();

        std::unordered_map<std::size_t, Index> place;
        mesh.points.resize(tags.size());
        mesh.fixed = tags.size();
        std::vector<std::size_t> nodes;
        std::vector<double> at, parameters;
        Index count = 0;
        for (const auto& [p, tag] : tags) {
            gmsh::model::mesh::getNodes(nodes, at, parameters, 0, tag, false, false);
            place[nodes.at(0)] = count;
            mesh.points[static_cast<std::size_t>(count++)] = points[static_cast<std::size_t>(p)];
        }
        gmsh::model::mesh::getNodes(nodes, at, parameters, 2, face, false, false);
        for (std::size_t i = 0; i < nodes.size(); ++i) {
            place[nodes[i]] = static_cast<Index>(mesh.points.size());
            mesh.points.emplace_back(at[3 * i], at[3 * i + 1]);
        }
        for (const auto& [type, corners] : {std::pair(2, 3), std::pair(3, 4)}) {
            std::vector<std::size_t> elements, of;
            gmsh::model::mesh::getElementsByType(type, elements, of, face);
            for (std::size_t e = 0; e < elements.size(); ++e) {
                Quad cell{-1, -1, -1, -1};
                for (int k = 0; k < corners; ++k) {
                    cell[static_cast<std::size_t>(k)] = place.at(
                        of[e * static_cast<std::size_t>(corners) + static_cast<std::size_t>(k)]);
                }
                mesh.cells.push_back(cell);
            }
        }
    });
    return mesh;
}

/// Make all cells run counter-clockwise.
void orient(MixedMesh& mesh)
{
    double area = 0;
    for (const Quad& cell : mesh.cells) {
        const std::size_t n = MixedMesh::is_triangle(cell) ? 3 : 4;
        for (std::size_t k = 0; k < n; ++k) {
            const Vec2& a = mesh.at(cell[k]);
            const Vec2& b = mesh.at(cell[(k + 1) % n]);
            area += a.x() * b.y() - a.y() * b.x();
        }
    }
    if (area >= 0) return;
    for (Quad& cell : mesh.cells)
        std::reverse(cell.begin(), MixedMesh::is_triangle(cell) ? cell.end() - 1 : cell.end());
}

/// All quads, the boundary sides exactly those of the loops, no quad turned over?
bool is_sound(const MixedMesh& mesh, const Loops& loops)
{
    std::map<std::pair<Index, Index>, int> sides;
    for (const Quad& q : mesh.cells) {
        if (MixedMesh::is_triangle(q)) return false;
        double area = 0;
        for (std::size_t k = 0; k < 4; ++k) {
            const Vec2& a = mesh.at(q[k]);
            const Vec2& b = mesh.at(q[(k + 1) % 4]);
            area += a.x() * b.y() - a.y() * b.x();
            if (++sides[{q[k], q[(k + 1) % 4]}] > 1) return false;
        }
        if (!(area > 0)) return false;
    }
    std::size_t border = 0;
    for (const auto& [side, count] : sides) border += sides.contains({side.second, side.first}) ? 0 : 1;
    std::size_t expected = 0;
    Index start = 0;
    for (const std::vector<Index>& loop : loops) {
        const auto n = static_cast<Index>(loop.size());
        for (Index i = 0; i < n; ++i) {
            if (!sides.contains({start + i, start + (i + 1) % n})) return false;
        }
        expected += loop.size();
        start += n;
    }
    return border == expected;
}

double worst_of(const MixedMesh& mesh)
{
    double worst = 1;
    for (const Quad& q : mesh.cells) worst = std::min(worst, scaled_jacobian(mesh, q));
    return worst;
}

void check_region(const surface::PlanarRegion& region)
{
    std::size_t sides = 0;
    for (const std::vector<Index>& loop : region.loops) sides += loop.size();
    if (region.loops.empty() || sides % 2 != 0 || sides < 4) {
        throw NotSweepable(
            "cad.odd_rim",
            "a region with " + std::to_string(sides) +
                " boundary sides cannot be filled with quads; their number must be even and 4 at least");
    }
}

} // namespace

surface::PlanarQuads recombine(const surface::PlanarRegion& given, const RunContext& context)
{
    check_region(given);
    check_cancelled(context);
    Eigen::AlignedBox2d bounds;
    for (const std::vector<Index>& loop : given.loops) {
        for (const Index p : loop) bounds.extend(given.points[static_cast<std::size_t>(p)]);
    }
    // Gmsh has tolerances of its own that are lengths: it gets a region of size 1.
    const Vec2 origin = bounds.min();
    const double scale = bounds.sizes().maxCoeff();
    surface::PlanarRegion region = given;
    for (Vec2& p : region.points) p = (p - origin) / scale;
    if (given.size) region.size = [&](const Vec2& p) { return given.size(origin + scale * p) / scale; };
    const Eigen::AlignedBox2d box(Vec2::Zero(), Vec2(bounds.sizes() / scale));
    const SizeRaster size(region, box);

    // Cells cut from coarser ones are more regular, so regions are meshed coarser and cut as long as this
    // many quads are left.
    constexpr double kWorthHalving = 1500;
    std::vector<Loops> coarser{region.loops};
    double quads = expected_quads(region, size, box);
    for (; quads > kWorthHalving; quads /= 4) {
        if (std::any_of(coarser.back().begin(), coarser.back().end(),
                        [](const auto& loop) { return loop.size() % 2 != 0; }))
            break;
        Loops half = halve(region.points, coarser.back());
        if (!can_halve(region.points, coarser.back(), half)) break;
        coarser.push_back(std::move(half));
    }

    Session session("a region to be filled with quads");
    session.set("Mesh.RecombinationAlgorithm", 1); // Blossom
    session.set("Mesh.CrossFieldClosestPoint", 0); // without ANN the default crashes
    for (const char* off :
         {"Mesh.MeshSizeFromPoints", "Mesh.MeshSizeFromCurvature", "Mesh.MeshSizeExtendFromBoundary",
          "Mesh.MeshSizeFromParametricPoints", "Mesh.SubdivisionAlgorithm", "Mesh.SecondOrderLinear"}) {
        session.set(off, 0);
    }
    session.set("Mesh.MeshSizeMin", 0);
    session.set("Mesh.MeshSizeMax", 1e22);
    session.set("Mesh.MeshSizeFactor", 1);
    session.set("Mesh.ElementOrder", 1);
    session.set("Mesh.RecombineAll", 0);
    session.set("Mesh.Smoothing", 1);

    // The time Blossom takes grows with the square of the quads; beyond this many it is seconds.
    constexpr double kMostBlossom = 8000;
    // Gmsh aims at equilateral triangles, whose pairs have less area than the square of their side.
    const double kPairSize = std::sqrt(2 / std::sqrt(3.0));
    MixedMesh best;
    double best_quality = -2;
    const int most = static_cast<int>(coarser.size()) - 1;
    for (const Attempt& attempt :
         {Attempt{6, most, quads < kMostBlossom, kPairSize}, Attempt{5, most, false, kPairSize},
          Attempt{6, 0, false, 0.7}, Attempt{6, 0, false, 0.5}}) {
        check_cancelled(context);
        MixedMesh mesh;
        try {
            mesh = mesh_with_gmsh(session, region.points, coarser[static_cast<std::size_t>(attempt.halvings)],
                                  size, attempt);
        } catch (const BackendError& error) {
            log_line(context, error.what());
            continue;
        }
        orient(mesh);
        match_triangles(mesh);
        pair_triangles(mesh);
        for (int level = attempt.halvings; level > 0; --level) {
            const auto l = static_cast<std::size_t>(level);
            mesh = refine(mesh, region.points, coarser[l - 1], coarser[l]);
        }
        if (!std::any_of(mesh.cells.begin(), mesh.cells.end(), MixedMesh::is_triangle)) improve(mesh);
        if (!is_sound(mesh, region.loops)) continue;
        const double quality = worst_of(mesh);
        if (quality > best_quality) {
            best_quality = quality;
            best = std::move(mesh);
        }
        if (best_quality > 0) break;
    }
    if (best_quality == -2) {
        throw NotSweepable(
            "cad.recombine",
            "Gmsh could not fill a region of " + std::to_string(in_order(region.loops).size()) +
                " boundary nodes with quads alone; use quads = \"paved\", or other edge counts");
    }
    return deliver(best, given, region.loops, origin, scale);
}

} // namespace lacuna::cad
