// SPDX-License-Identifier: GPL-2.0-or-later
#include "gmsh_quads.h"

#include <gmsh.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <unordered_map>

namespace lacuna::bench {

namespace {

using test::PlaneCurve;

/// Gmsh, for as long as this lives.
class Session {
public:
    Session()
    {
        gmsh::initialize(0, nullptr, false);
        gmsh::option::setNumber("General.Terminal", 0);
        gmsh::option::setNumber("General.NumThreads", 1);
    }
    ~Session()
    {
        try {
            gmsh::finalize();
        } catch (...) { // nothing is lost: the process ends
        }
    }
    Session(const Session&) = delete;
    Session& operator=(const Session&) = delete;
};

double seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// The outline with as many sides on each curve as the region has; free curves are drawn as lines of two
/// sides, which Gmsh may halve. Of a mesh that is to be cut in four, every other node.
int draw(const test::PlaneDomain& domain, const test::SeededDomain& seeded, int every)
{
    std::vector<int> wires;
    Index first = 0;
    for (std::size_t l = 0; l < domain.loops.size(); ++l) {
        const auto total = static_cast<Index>(seeded.region.loops[l].size());
        std::unordered_map<Index, int> made;
        const auto corner = [&](Index i) {
            i %= total;
            const auto found = made.find(i);
            if (found != made.end()) return found->second;
            const Vec2& p = seeded.region.points[static_cast<std::size_t>(first + i)];
            return made[i] = gmsh::model::geo::addPoint(p.x(), p.y(), 0);
        };
        std::vector<int> lines;
        Index at = 0;
        for (std::size_t c = 0; c < domain.loops[l].size(); ++c) {
            const PlaneCurve& curve = domain.loops[l][c];
            const Index sides = seeded.sides[l][c];
            const bool free = curve.kind == PlaneCurve::Kind::free;
            for (Index i = 0; i < sides; i += free ? 2 : sides) {
                const int from = corner(at + i), to = corner(at + i + (free ? 2 : sides));
                if (curve.kind == PlaneCurve::Kind::arc) {
                    const int centre = gmsh::model::geo::addPoint(curve.centre.x(), curve.centre.y(), 0);
                    lines.push_back(gmsh::model::geo::addCircleArc(from, centre, to));
                } else {
                    lines.push_back(gmsh::model::geo::addLine(from, to));
                }
                gmsh::model::geo::mesh::setTransfiniteCurve(lines.back(), (free ? 2 : sides) / every + 1);
            }
            at += sides;
        }
        wires.push_back(gmsh::model::geo::addCurveLoop(lines));
        first += total;
    }
    return gmsh::model::geo::addPlaneSurface(wires);
}

/// The nearest boundary node, in bins as wide as the size.
class Nearest {
public:
    Nearest(const quads::PlanarRegion& region, double size) : region_(region), size_(size)
    {
        for (std::size_t p = 0; p < region.points.size(); ++p)
            bins_[key(region.points[p], 0, 0)].push_back(static_cast<Index>(p));
    }
    [[nodiscard]] Index operator()(const Vec2& p) const
    {
        Index best = -1;
        double least = std::numeric_limits<double>::infinity();
        for (int i = -1; i <= 1; ++i) {
            for (int j = -1; j <= 1; ++j) {
                const auto bin = bins_.find(key(p, i, j));
                if (bin == bins_.end()) continue;
                for (const Index q : bin->second) {
                    const double d = (region_.points[static_cast<std::size_t>(q)] - p).squaredNorm();
                    if (d < least) {
                        least = d;
                        best = q;
                    }
                }
            }
        }
        return best;
    }

private:
    [[nodiscard]] long key(const Vec2& p, int i, int j) const
    {
        return (std::lround(p.x() / size_) + i) * 1000003L + std::lround(p.y() / size_) + j;
    }
    const quads::PlanarRegion& region_;
    double size_;
    std::unordered_map<long, std::vector<Index>> bins_;
};

void read_mesh(const test::SeededDomain& seeded, int face, GmshQuads& result)
{
    const Nearest nearest(seeded.region, seeded.size);
    result.mesh.points = seeded.region.points;
    std::unordered_map<std::size_t, Index> place;
    std::vector<std::size_t> nodes;
    std::vector<double> at, parameters;
    for (int dim = 0; dim < 3; ++dim) {
        gmsh::vectorpair entities;
        gmsh::model::getEntities(entities, dim);
        for (const auto& [d, tag] : entities) {
            gmsh::model::mesh::getNodes(nodes, at, parameters, d, tag, false, false);
            for (std::size_t i = 0; i < nodes.size(); ++i) {
                const Vec2 p(at[3 * i], at[3 * i + 1]);
                if (dim < 2) {
                    place[nodes[i]] = nearest(p);
                    continue;
                }
                place[nodes[i]] = static_cast<Index>(result.mesh.points.size());
                result.mesh.points.push_back(p);
            }
        }
    }
    std::vector<std::size_t> elements, corners;
    gmsh::model::mesh::getElementsByType(2, elements, corners, face);
    result.triangles = elements.size();
    gmsh::model::mesh::getElementsByType(3, elements, corners, face);
    double area = 0;
    for (std::size_t e = 0; e < elements.size(); ++e) {
        Quad quad;
        for (std::size_t k = 0; k < 4; ++k) quad[k] = place.at(corners[4 * e + k]);
        const auto point = [&](std::size_t k) {
            return result.mesh.points[static_cast<std::size_t>(quad[k])];
        };
        const Vec2 u = point(2) - point(0), v = point(3) - point(1);
        area += u.x() * v.y() - u.y() * v.x();
        result.mesh.quads.push_back(quad);
    }
    if (area >= 0) return;
    for (Quad& quad : result.mesh.quads) std::reverse(quad.begin(), quad.end());
}

} // namespace

GmshQuads gmsh_quads(const test::PlaneDomain& domain, const test::SeededDomain& seeded, const GmshWay& way)
{
    const Session session;
    gmsh::option::setNumber("Mesh.Algorithm", way.algorithm);
    gmsh::option::setNumber("Mesh.CrossFieldClosestPoint", 0);
    gmsh::option::setNumber("Mesh.RecombinationAlgorithm", way.recombination);
    gmsh::option::setNumber("Mesh.SubdivisionAlgorithm", way.subdivision ? 1 : 0);
    gmsh::option::setNumber("Mesh.MeshSizeExtendFromBoundary", 0);
    gmsh::option::setNumber("Mesh.MeshSizeFromPoints", 0);
    gmsh::model::add("domain");
    const int face = draw(domain, seeded, way.subdivision ? 2 : 1);
    gmsh::model::geo::synchronize();
    gmsh::model::mesh::setRecombine(2, face);
    // A recombination to full quads halves the size itself; the division asked for does not.
    const double factor = way.subdivision ? 2 : 1;
    if (domain.relative_size) {
        gmsh::model::mesh::setSizeCallback([&](int, int, double x, double y, double, auto...) {
            return factor * seeded.region.size(Vec2(x, y));
        });
    } else {
        gmsh::option::setNumber("Mesh.MeshSizeMin", factor * seeded.size);
        gmsh::option::setNumber("Mesh.MeshSizeMax", factor * seeded.size);
    }
    GmshQuads result;
    gmsh::model::mesh::generate(1);
    const double start = seconds();
    gmsh::model::mesh::generate(2);
    result.seconds = seconds() - start;
    read_mesh(seeded, face, result);
    return result;
}

namespace {

/// A fine line as arcs of a quarter turn at most where it is part of a circle; else as it is.
std::vector<PlaneCurve> as_arcs(const PlaneCurve& curve)
{
    // What the points of an exact circle are off by, over its radius, and the radius over the chord of what
    // is straight.
    constexpr double kOff = 1e-7, kStraight = 1e4;
    const std::vector<Vec2>& line = curve.through;
    const Vec2 a = line[line.size() / 3] - line[0], b = line[2 * line.size() / 3] - line[0];
    const double twice = 2 * (a.x() * b.y() - a.y() * b.x());
    if (std::abs(twice) * kStraight < (a - b).norm() * a.norm()) return {curve};
    const Vec2 centre = line[0] + Vec2(b.y() * a.squaredNorm() - a.y() * b.squaredNorm(),
                                       a.x() * b.squaredNorm() - b.x() * a.squaredNorm()) /
                                      twice;
    const double radius = (line[0] - centre).norm();
    for (const Vec2& p : line) {
        if (std::abs((p - centre).norm() - radius) > kOff * radius) return {curve};
    }
    // Gmsh's arcs are shorter than half a circle.
    double turn = 0;
    for (std::size_t i = 1; i < line.size(); ++i) {
        const Vec2 from = line[i - 1] - centre, to = line[i] - centre;
        turn += std::atan2(from.x() * to.y() - from.y() * to.x(), from.dot(to));
    }
    const int pieces = std::max(1,
                                static_cast<int>(std::ceil(std::abs(turn) / (std::numbers::pi / 2) - 1e-6)));
    std::vector<PlaneCurve> arcs;
    Vec2 from = curve.from;
    for (int k = 1; k <= pieces; ++k) {
        const Vec2 to = k == pieces
                            ? curve.to
                            : Vec2(centre + Eigen::Rotation2Dd(turn * k / pieces) * (curve.from - centre));
        arcs.push_back({PlaneCurve::Kind::arc, from, to, centre, turn < 0, {}});
        from = to;
    }
    return arcs;
}

} // namespace

test::PlaneDomain face_domain(const std::string& file, int face)
{
    const Session session;
    gmsh::vectorpair shapes;
    gmsh::model::occ::importShapes(file, shapes, false);
    gmsh::model::occ::synchronize();
    std::vector<double> low, high, normals, points;
    gmsh::model::getParametrizationBounds(2, face, low, high);
    gmsh::model::getNormal(face, {(low[0] + high[0]) / 2, (low[1] + high[1]) / 2}, normals);
    const Vec3 normal(normals[0], normals[1], normals[2]);
    const Vec3 across = normal.unitOrthogonal(), up = normal.cross(across);

    // Curves one by one, as fine polylines; joined to loops where ends meet.
    gmsh::vectorpair curves;
    gmsh::model::getBoundary({{2, face}}, curves, false, false, false);
    std::vector<PlaneCurve> left;
    for (const auto& [dim, tag] : curves) {
        gmsh::model::getParametrizationBounds(1, tag, low, high);
        std::vector<double> parameters;
        constexpr int kPieces = 512;
        for (int i = 0; i <= kPieces; ++i) parameters.push_back(low[0] + (high[0] - low[0]) * i / kPieces);
        gmsh::model::getValue(1, tag, parameters, points);
        PlaneCurve curve;
        curve.kind = PlaneCurve::Kind::free;
        for (std::size_t i = 0; i + 2 < points.size(); i += 3) {
            const Vec3 p(points[i], points[i + 1], points[i + 2]);
            curve.through.emplace_back(p.dot(across), p.dot(up));
        }
        curve.from = curve.through.front();
        curve.to = curve.through.back();
        left.push_back(std::move(curve));
    }
    test::PlaneDomain domain;
    std::vector<double> areas;
    while (!left.empty()) {
        std::vector<PlaneCurve> loop{left.back()};
        left.pop_back();
        const auto near = [](const Vec2& a, const Vec2& b) { return (a - b).norm() < 1e-6 * (1 + a.norm()); };
        while (!near(loop.back().to, loop.front().from)) {
            const auto found = std::find_if(left.begin(), left.end(), [&](const PlaneCurve& c) {
                return near(c.from, loop.back().to) || near(c.to, loop.back().to);
            });
            if (found == left.end()) throw std::runtime_error("the outline of the face does not close");
            PlaneCurve next = *found;
            left.erase(found);
            if (!near(next.from, loop.back().to)) {
                std::reverse(next.through.begin(), next.through.end());
                std::swap(next.from, next.to);
            }
            next.through.front() = next.from = loop.back().to;
            loop.push_back(std::move(next));
        }
        loop.back().to = loop.back().through.back() = loop.front().from;
        double area = 0;
        for (const PlaneCurve& curve : loop) {
            for (std::size_t i = 1; i < curve.through.size(); ++i) {
                const Vec2 &a = curve.through[i - 1], &b = curve.through[i];
                area += (a.x() * b.y() - a.y() * b.x()) / 2;
            }
        }
        domain.loops.push_back(std::move(loop));
        areas.push_back(area);
    }
    // The largest is the outer one; it runs counter-clockwise, the others clockwise.
    const auto outer = static_cast<std::size_t>(
        std::max_element(areas.begin(), areas.end(),
                         [](double a, double b) { return std::abs(a) < std::abs(b); }) -
        areas.begin());
    std::swap(domain.loops[0], domain.loops[outer]);
    std::swap(areas[0], areas[outer]);
    for (std::size_t l = 0; l < areas.size(); ++l) {
        if ((areas[l] > 0) == (l == 0)) continue;
        std::reverse(domain.loops[l].begin(), domain.loops[l].end());
        for (PlaneCurve& curve : domain.loops[l]) {
            std::reverse(curve.through.begin(), curve.through.end());
            std::swap(curve.from, curve.to);
        }
    }
    for (std::vector<PlaneCurve>& loop : domain.loops) {
        std::vector<PlaneCurve> exact;
        for (const PlaneCurve& curve : loop) {
            const std::vector<PlaneCurve> arcs = as_arcs(curve);
            exact.insert(exact.end(), arcs.begin(), arcs.end());
        }
        loop = std::move(exact);
    }
    return domain;
}

} // namespace lacuna::bench
