// SPDX-License-Identifier: GPL-2.0-or-later
#include <lacuna/cad_worker/detail/cad_facets.h>

#include <lacuna/cad_worker/detail/face_grid.h>
#include <lacuna/cad_worker/detail/gmsh_api.h>
#include <lacuna/core/shared/criteria.h>
#include <lacuna/core/shared/limits.h>
#include <lacuna/geometry/shared/delaunay.h>
#include <lacuna/geometry/shared/segment.h>

#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <utility>

namespace lacuna::cad_worker {

namespace {

/// Minimum distance of grid points from the boundary. [grid cells]
constexpr double kClearance = 0.5;

/// A curve in the parameter rectangle of a face.
struct BorderChain {
    std::vector<Vec2> uv;
    std::vector<Vec2> other;   ///< second image of the curve, if the surface has a seam there; else empty
    std::vector<Index> points; ///< model points
    bool pole = false;         ///< the curve is a single point
    bool slit = false;         ///< the face is on both sides of the curve, with the same parameters
};

std::vector<Vec2> parameters_on_face(const CadCurveInfo& curve, const std::vector<double>& params, int face,
                                     int which)
{
    std::vector<double> values;
    gmsh::model::reparametrizeOnSurface(1, curve.tag, params, face, values, which);
    return values.size() == 2 * params.size() ? unflat<2>(values) : std::vector<Vec2>{};
}

/// Distance of each point `at[i]` from the surface point at `uv[i]`.
std::vector<double> distances(int face, const std::vector<Vec3>& at, const std::vector<Vec2>& uv)
{
    const std::vector<Vec3> there = surface_points(face, uv);
    std::vector<double> off;
    for (std::size_t i = 0; i < at.size(); ++i) off.push_back((there[i] - at[i]).norm());
    return off;
}

/// Check that the surface gives the point `at` for its parameters. Where it does not, replace the parameters
/// by those of the closest point of the surface.
void mend_parameters(int face, const std::vector<Vec3>& at, std::vector<Vec2>& uv, double allowed)
{
    std::vector<double> off;
    if (uv.size() == at.size()) {
        off = distances(face, at, uv);
        if (std::ranges::all_of(off, [&](double distance) { return distance <= allowed; })) return;
    }
    std::vector<double> values;
    gmsh::model::getParametrization(2, face, flat(at), values);
    if (values.size() != 2 * at.size()) return;
    std::vector<Vec2> closest = unflat<2>(values);
    if (uv.size() != at.size()) {
        uv = std::move(closest);
        return;
    }
    const std::vector<double> least = distances(face, at, closest);
    for (std::size_t i = 0; i < at.size(); ++i)
        if (least[i] < off[i]) uv[i] = closest[i];
}

/// Total distance of parameter points from the parameter rectangle of the face.
double outside(const std::vector<Vec2>& uv, const Eigen::AlignedBox2d& bounds)
{
    double sum = 0;
    for (const Vec2& p : uv) sum += bounds.exteriorDistance(p);
    return sum;
}

/// A curve that was a seam before the face was trimmed has two images. Choose the image inside the parameter
/// rectangle of the face or, if both are inside, the one that connects to the other curves.
void choose_sides(std::vector<BorderChain>& border, int face)
{
    std::vector<double> low, high;
    gmsh::model::getParametrizationBounds(2, face, low, high);
    const Eigen::AlignedBox2d bounds(Vec2(low.at(0), low.at(1)), Vec2(high.at(0), high.at(1)));
    const double near = kFileAccuracy * bounds.diagonal().norm();
    const auto gap = [&](const std::vector<Vec2>& uv, std::size_t own) {
        double sum = 0;
        for (const Vec2& end : {uv.front(), uv.back()}) {
            double nearest = bounds.diagonal().norm();
            for (std::size_t c = 0; c < border.size(); ++c) {
                if (c == own || !border[c].other.empty()) continue;
                nearest = std::min(
                    {nearest, (border[c].uv.front() - end).norm(), (border[c].uv.back() - end).norm()});
            }
            sum += nearest;
        }
        return sum;
    };
    for (std::size_t c = 0; c < border.size(); ++c) {
        BorderChain& chain = border[c];
        if (chain.other.empty()) continue;
        const double here = outside(chain.uv, bounds);
        const double there = outside(chain.other, bounds);
        const bool decided = std::abs(here - there) > near;
        if (decided ? there < here : gap(chain.other, c) < gap(chain.uv, c)) chain.uv = chain.other;
    }
}

/// Each curve of the face as chains of parameter points; a seam gives two chains.
std::vector<BorderChain> border_of(const CadWire& wire, const CadFaceInfo& face, double allowed)
{
    std::vector<BorderChain> border;
    for (const CadFaceInfo::Side& side : face.sides) {
        const CadCurveInfo& curve = wire.curves[side.curve];
        BorderChain chain;
        std::vector<double> params;
        std::vector<Vec3> at;
        if (curve.pieces.empty()) {
            const Index point = wire.vertices[index(curve.from)].point;
            params = {curve.low, curve.high};
            chain.points = {point, point};
            chain.pole = true;
        }
        for (const std::size_t p : curve.pieces) {
            PieceNodes nodes = nodes_of(wire, p);
            const std::size_t shared = params.empty() ? 0 : 1;
            params.insert(params.end(), nodes.params.begin() + static_cast<std::ptrdiff_t>(shared),
                          nodes.params.end());
            chain.points.insert(chain.points.end(),
                                nodes.points.begin() + static_cast<std::ptrdiff_t>(shared),
                                nodes.points.end());
        }
        for (const Index p : chain.points) at.push_back(wire.points[index(p)]);
        chain.uv = parameters_on_face(curve, params, face.tag, 0);
        if (!chain.pole) mend_parameters(face.tag, at, chain.uv, allowed);
        if (chain.uv.size() != params.size()) continue;
        if (!chain.pole) chain.other = parameters_on_face(curve, params, face.tag, 1);
        const bool two_sided = chain.other.size() == chain.uv.size() &&
                               (chain.other.front() - chain.uv.front()).norm() >
                                   kSamePlace * (1 + chain.uv.front().norm());
        if (!two_sided) chain.other.clear();
        chain.slit = side.uses > 1 && !two_sided && !chain.pole;
        if (side.uses > 1 && two_sided) {
            BorderChain& twin = border.emplace_back(chain);
            twin.uv = std::exchange(twin.other, {});
            chain.other.clear();
        }
        border.push_back(std::move(chain));
    }
    choose_sides(border, face.tag);
    return border;
}

ParameterBox box_of(const std::vector<BorderChain>& border, const CadFaceInfo& face, const CadWire& wire)
{
    ParameterBox box;
    Eigen::AlignedBox2d bounds;
    for (const BorderChain& chain : border) {
        for (const Vec2& uv : chain.uv) bounds.extend(uv);
    }
    box.low = bounds.min();
    box.high = bounds.max();
    for (const CadFaceInfo::Side& side : face.sides) {
        const CadCurveInfo& curve = wire.curves[side.curve];
        if (side.uses < 2 || curve.pieces.empty()) continue;
        const auto a = parameters_on_face(curve, {curve.low}, face.tag, 0);
        const auto b = parameters_on_face(curve, {curve.low}, face.tag, 1);
        if (a.empty() || b.empty()) continue;
        for (int k = 0; k < 2; ++k) {
            // The two images of a seam are one period apart, and the face lies between them.
            const double apart = std::abs(a[0][k] - b[0][k]);
            if (apart > 0.99 * (box.high[k] - box.low[k]) && apart > 0) box.closed[index(k)] = true;
        }
    }
    return box;
}

/// The boundary and the grid points inside it, in grid coordinates.
struct GridDomain {
    struct Node {
        Vec2 grid, uv;
        Index point; ///< model point
    };
    struct Segment {
        Index a, b;
        bool slit;
    };
    std::vector<Node> nodes;
    std::vector<Segment> segments;
};

/// Collects the points of the chains as nodes; merges the ends of chains that meet.
class DomainBuilder {
public:
    explicit DomainBuilder(const FaceGrid& grid) : grid_(grid) {}

    void add(const BorderChain& chain)
    {
        if (chain.pole) {
            const Vec2 a = grid_.to_grid(chain.uv.front());
            const Vec2 b = grid_.to_grid(chain.uv.back());
            join(node(a, chain.uv.front(), chain.points.front()),
                 node(b, chain.uv.back(), chain.points.back()));
            return;
        }
        Index last = -1;
        for (std::size_t i = 0; i < chain.uv.size(); ++i) {
            const Index next = node(grid_.to_grid(chain.uv[i]), chain.uv[i], chain.points[i]);
            if (last >= 0 && next != last) domain_.segments.push_back({last, next, chain.slit});
            last = next;
        }
    }

    /// Connect ends that do not meet, because some files omit the curve at a pole.
    GridDomain finish()
    {
        std::vector<int> degree(domain_.nodes.size(), 0);
        for (const GridDomain::Segment& s : domain_.segments) {
            if (s.slit) continue;
            ++degree[index(s.a)];
            ++degree[index(s.b)];
        }
        const std::size_t count = degree.size();
        for (std::size_t i = 0; i < count; ++i) {
            if (degree[i] % 2 == 0) continue;
            std::size_t nearest = count;
            for (std::size_t k = i + 1; k < count; ++k) {
                if (degree[k] % 2 == 0 || domain_.nodes[k].point != domain_.nodes[i].point) continue;
                if (nearest == count || distance(i, k) < distance(i, nearest)) nearest = k;
            }
            if (nearest == count) continue;
            join(static_cast<Index>(i), static_cast<Index>(nearest));
            ++degree[i];
            ++degree[nearest];
        }
        return std::move(domain_);
    }

private:
    [[nodiscard]] double distance(std::size_t a, std::size_t b) const
    {
        return (domain_.nodes[a].grid - domain_.nodes[b].grid).norm();
    }

    Index node(const Vec2& grid, const Vec2& uv, Index point)
    {
        std::vector<Index>& same = nodes_of_point_[point];
        for (const Index n : same) {
            if ((domain_.nodes[index(n)].grid - grid).norm() < kOnePoint) return n;
        }
        same.push_back(static_cast<Index>(domain_.nodes.size()));
        domain_.nodes.push_back({grid, uv, point});
        return same.back();
    }

    /// Insert segments of about one cell between two images of one point.
    void join(Index a, Index b)
    {
        const GridDomain::Node from = domain_.nodes[index(a)];
        const GridDomain::Node to = domain_.nodes[index(b)];
        const int sides = std::max(1, static_cast<int>(std::lround((to.grid - from.grid).norm())));
        Index last = a;
        for (int i = 1; i < sides; ++i) {
            const Vec2 grid = from.grid + (to.grid - from.grid) * i / sides;
            const auto next = static_cast<Index>(domain_.nodes.size());
            domain_.nodes.push_back({grid, grid_.to_uv(grid), from.point});
            domain_.segments.push_back({last, next, false});
            last = next;
        }
        if (last != b) domain_.segments.push_back({last, b, false});
    }

    const FaceGrid& grid_;
    GridDomain domain_;
    std::unordered_map<Index, std::vector<Index>> nodes_of_point_;
};

/// Add the grid points inside the boundary, at some distance from it, as nodes without model points.
void add_grid_points(GridDomain& domain, const FaceGrid& grid)
{
    const int nu = grid.axis[0].cells();
    const int nv = grid.axis[1].cells();
    const auto at = [&](int i, int j) { return index(j) * index(nu + 1) + index(i); };
    std::vector<char> near(index(nu + 1) * index(nv + 1), 0);
    std::vector<std::vector<double>> crossings(index(nv + 1));
    for (const GridDomain::Segment& s : domain.segments) {
        const Vec2& a = domain.nodes[index(s.a)].grid;
        const Vec2& b = domain.nodes[index(s.b)].grid;
        const Vec2 low = a.cwiseMin(b);
        const Vec2 high = a.cwiseMax(b);
        const auto clip = [](double value, int most) { return std::clamp(static_cast<int>(value), 0, most); };
        for (int j = clip(std::ceil(low.y() - kClearance), nv);
             j <= clip(std::floor(high.y() + kClearance), nv); ++j) {
            for (int i = clip(std::ceil(low.x() - kClearance), nu);
                 i <= clip(std::floor(high.x() + kClearance), nu); ++i) {
                if (geometry::distance_to_segment<Vec2>(Vec2(i, j), a, b) < kClearance) near[at(i, j)] = 1;
            }
            if (s.slit) continue;
            // Half-open interval, so that a corner on the line counts once.
            if ((a.y() <= j) == (b.y() <= j)) continue;
            crossings[index(j)].push_back(a.x() + (j - a.y()) / (b.y() - a.y()) * (b.x() - a.x()));
        }
    }
    for (int j = 1; j < nv; ++j) {
        std::vector<double>& cuts = crossings[index(j)];
        std::sort(cuts.begin(), cuts.end());
        for (std::size_t c = 0; c + 1 < cuts.size(); c += 2) {
            for (int i = std::max(1, static_cast<int>(std::ceil(cuts[c]))); i < nu && i <= cuts[c + 1]; ++i) {
                if (near[at(i, j)]) continue;
                const Vec2 place(i, j);
                domain.nodes.push_back({place, grid.to_uv(place), -1});
            }
        }
    }
}

/// Triangles inside the boundary; empty if boundary segments intersect.
std::vector<Triangle> triangulate(const GridDomain& domain)
{
    std::vector<Vec2> places;
    std::vector<Index> all;
    for (const GridDomain::Node& node : domain.nodes) {
        all.push_back(static_cast<Index>(places.size()));
        places.push_back(node.grid);
    }
    std::optional<geometry::DelaunayMesh> made;
    try {
        made.emplace(places, all);
        for (const GridDomain::Segment& s : domain.segments) made->fix_segment(s.a, s.b);
    } catch (const Error&) { // a boundary point coincides with another one, or lies on a segment
        return {};
    }
    geometry::DelaunayMesh& mesh = *made;
    mesh.mark_inside();
    for (const GridDomain::Segment& s : domain.segments) {
        const Index left = mesh.find_side(s.a, s.b).first;
        const Index right = mesh.find_side(s.b, s.a).first;
        if (left < 0 || right < 0) return {};
        if (!s.slit && mesh[left].inside == mesh[right].inside) return {};
    }
    std::vector<Triangle> inside;
    for (const geometry::DelaunayTriangle& t : mesh.triangles()) {
        if (t.inside) inside.push_back(t.corner);
    }
    return inside;
}

/// Whether any two facets share a side in the same direction. This happens in some files, where a surface of
/// revolution turns twice around its axis and so covers itself.
bool covers_itself(const std::vector<Triangle>& triangles)
{
    std::vector<std::pair<Index, Index>> sides;
    for (const Triangle& t : triangles) {
        for (std::size_t k = 0; k < 3; ++k) sides.emplace_back(t[k], t[(k + 1) % 3]);
    }
    std::ranges::sort(sides);
    return std::ranges::adjacent_find(sides) != sides.end();
}

/// Whether the file orients a face against the normal of its parameters. The largest facet is far from poles.
bool is_reversed(int face, const std::vector<std::array<Vec2, 3>>& facets)
{
    const auto twice_area = [](const std::array<Vec2, 3>& t) {
        return (t[1] - t[0]).x() * (t[2] - t[0]).y() - (t[1] - t[0]).y() * (t[2] - t[0]).x();
    };
    const std::array<Vec2, 3>& widest = *std::ranges::max_element(facets, {}, twice_area);
    const Vec2 middle = (widest[0] + widest[1] + widest[2]) / 3;
    const SurfaceFrame frame = surface_frames(face, {middle}).front();
    return frame.du.cross(frame.dv).dot(surface_normal(face, middle)) < 0;
}

} // namespace

std::optional<CadFacets> cut_into_facets(const CadWire& wire, const CadFaceInfo& face,
                                         const FacetOptions& options, Index first_added)
{
    const double allowed = std::max(10 * options.tolerance, 1e-3 * options.fineness.max_size);
    const std::vector<BorderChain> border = border_of(wire, face, allowed);
    if (border.empty()) {
        throw BackendError(
            Message("cad.no_border", "{} has no boundary curves", NamedEntity{"face", face.tag})
                .remedy("split it in the CAD system, or export the file again"));
    }
    CadFacets facets;
    facets.box = box_of(border, face, wire);
    facets.kind = kind_of_face(face.tag, facets.box);
    const FaceGrid grid = lay_grid(face.tag, facets.kind == "plane", facets.box, options.fineness,
                                   options.max_cells);

    DomainBuilder builder(grid);
    for (const BorderChain& chain : border) builder.add(chain);
    GridDomain domain = builder.finish();
    add_grid_points(domain, grid);
    const std::vector<Triangle> triangles = triangulate(domain);

    std::vector<Vec2> inner;
    for (GridDomain::Node& node : domain.nodes) {
        if (node.point >= 0) continue;
        node.point = first_added + static_cast<Index>(inner.size());
        inner.push_back(node.uv);
    }
    if (!inner.empty()) facets.added = surface_points(face.tag, inner);
    for (const Triangle& t : triangles) {
        Triangle corners{};
        std::array<Vec2, 3> uv;
        for (std::size_t k = 0; k < 3; ++k) {
            const GridDomain::Node& node = domain.nodes[index(t[k])];
            corners[k] = node.point;
            uv[k] = node.uv;
        }
        // At a pole a side of a triangle has zero length; skip the triangle.
        if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0]) continue;
        facets.triangles.push_back(corners);
        facets.uv.push_back(uv);
    }
    if (facets.triangles.empty() || covers_itself(facets.triangles)) return std::nullopt;
    if (is_reversed(face.tag, facets.uv)) {
        for (Triangle& t : facets.triangles) std::swap(t[1], t[2]);
        for (std::array<Vec2, 3>& uv : facets.uv) std::swap(uv[1], uv[2]);
    }
    return facets;
}

} // namespace lacuna::cad_worker
