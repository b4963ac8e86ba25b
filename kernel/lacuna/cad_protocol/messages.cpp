// SPDX-License-Identifier: MIT
#include <lacuna/cad_protocol/shared/messages.h>

#include <cmath>

namespace lacuna::cad_protocol {

namespace {

void require(bool right, const char* what)
{
    if (!right) throw ProtocolError(what);
}

/// Check that numbers used as indices are in range.
template <class Range>
void require_below(const Range& numbers, std::size_t count, const char* what)
{
    for (const Index n : numbers) require(n >= 0 && index(n) < count, what);
}

template <class Range>
void require_finite(const Range& points, const char* what)
{
    for (const auto& p : points) require(p.allFinite(), what);
}

} // namespace

void check(const Failure& m) { require(m.kind < Failure::count, "an unknown kind of error"); }

void check(const LoadReply& m)
{
    require(std::isfinite(m.diagonal), "the diagonal is not a finite number");
    require_finite(m.points, "a point is not finite");
    require(m.points.size() <= 0x7fffffff && m.vertex_tags.size() <= m.points.size(),
            "there are more vertices than points");
    for (const LoadReply::Edge& edge : m.edges) {
        require_below(std::array{edge.from, edge.to}, m.vertex_tags.size(),
                      "a vertex number of an edge is out of range");
        require_below(edge.points, m.points.size(), "a point number of an edge is out of range");
        require(edge.points.size() >= 2 && edge.points.front() == edge.from &&
                    edge.points.back() == edge.to && edge.params.size() == edge.points.size(),
                "an edge does not run between its vertices");
        for (const double t : edge.params) require(std::isfinite(t), "a curve parameter is not finite");
        require_below(edge.left_out, m.left_out.size(), "the number of a face left out is out of range");
        require(edge.form.empty() || edge.form.size() == 2 || edge.form.size() == 3,
                "a curve has an unknown form");
        require_finite(edge.form, "the form of a curve is not finite");
    }
    for (const LoadReply::Face& face : m.faces) {
        for (const Triangle& t : face.triangles) {
            require_below(t, m.points.size(), "a point number of a facet is out of range");
            require(t[0] != t[1] && t[1] != t[2] && t[2] != t[0], "a facet has the same corner twice");
        }
        require(face.uv.size() == face.triangles.size(), "facets have no surface parameters");
        for (const auto& uv : face.uv) require_finite(uv, "a surface parameter is not finite");
    }
    require(m.left_out.size() <= m.notes.size(), "faces were left out without a note");
    for (const LoadReply::Solid& solid : m.solids)
        require_below(solid.faces, m.faces.size(), "a face number of a solid is out of range");
}

void check(const ProjectRequest& m)
{
    require(m.points.size() == m.uv.size(), "points have no start parameters");
}

void check(const ProjectReply& m)
{
    require(m.points.size() == m.uv.size(), "projected points have no parameters");
    require_finite(m.points, "a projected point is not finite");
    require_finite(m.uv, "the parameters of a projected point are not finite");
}

void check(const EvaluateReply& m) { require_finite(m.points, "a point of a curve is not finite"); }

void check(const RecombineRequest& m)
{
    const SizeRaster& raster = m.size;
    require(raster.sizes.empty() || (raster.columns >= 2 && raster.step > 0 && raster.origin.allFinite() &&
                                     raster.sizes.size() % index(raster.columns) == 0 &&
                                     raster.sizes.size() / index(raster.columns) >= 2),
            "a size raster has fewer than two rows or columns");
}

void check(const RecombineReply& m)
{
    require_finite(m.points, "a node is not finite");
    for (const Quad& quad : m.quads)
        require_below(quad, m.points.size(), "a node number of a quad is out of range");
}

void check(const FillSkinRequest& m)
{
    require_finite(m.points, "a point of a skin is not finite");
    require(!m.shells.empty(), "a skin has no shells");
    for (const auto& shell : m.shells) {
        require(!shell.empty(), "a shell is empty");
        for (const Triangle& t : shell)
            require_below(t, m.points.size(), "a point number of a skin is out of range");
    }
}

void check(const FillSkinReply& m)
{
    require_finite(m.points, "a node is not finite");
    for (const Quad& tet : m.tets)
        require_below(tet, m.points.size(), "a node number of a tetrahedron is out of range");
}

void check(const BeginSolidReply& m)
{
    for (const auto& source : m.sources) {
        require(source.curves.size() == source.curve_points.size(), "curves have no points");
        for (const auto& points : source.curve_points)
            require_finite(points, "a point of a curve is not finite");
    }
}

void check(const MakeSolidRequest& m)
{
    require(m.first_tolerance > 0 && m.last_tolerance >= m.first_tolerance && std::isfinite(m.last_tolerance),
            "a tolerance is not a positive number");
}

} // namespace lacuna::cad_protocol
