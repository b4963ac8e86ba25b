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

bool is_file_name(const std::string& name)
{
    constexpr std::size_t kLongest = 255; // limit of most file systems
    return !name.empty() && name.size() <= kLongest && name.find('/') == std::string::npos;
}

template <class T>
void check(const T&)
{
}

template <>
void check(const Failure& m)
{
    require(m.kind < Failure::count, "an unknown kind of error");
}

template <>
void check(const LoadRequest& m)
{
    for (const LoadFile& file : m.files) {
        require(file.format < LoadFile::count && !file.contents.empty(),
                "a file has no format or no contents");
        for (const SentFile& sent : file.contents) {
            require(is_file_name(sent.name), "a file name contains a folder");
        }
    }
    require(m.scale > 0 && std::isfinite(m.scale) && std::isfinite(m.tolerance),
            "a scale is not a positive number");
}

template <>
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
    for (const auto& solid : m.solids)
        require_below(solid, m.faces.size(), "a face number of a solid is out of range");
}

template <>
void check(const ProjectRequest& m)
{
    require(m.points.size() == m.uv.size(), "points have no start parameters");
}

template <>
void check(const ProjectReply& m)
{
    require(m.points.size() == m.uv.size(), "projected points have no parameters");
    require_finite(m.points, "a projected point is not finite");
    require_finite(m.uv, "the parameters of a projected point are not finite");
}

template <>
void check(const EvaluateReply& m)
{
    require_finite(m.points, "a point of a curve is not finite");
}

template <>
void check(const RecombineRequest& m)
{
    require_finite(m.points, "a point is not finite");
    for (const auto& loop : m.loops)
        require_below(loop, m.points.size(), "a point number of a loop is out of range");
    const SizeRaster& raster = m.size;
    require(raster.sizes.empty() || (raster.columns >= 2 && raster.step > 0 && raster.origin.allFinite() &&
                                     raster.sizes.size() % index(raster.columns) == 0 &&
                                     raster.sizes.size() / index(raster.columns) >= 2),
            "a size raster has fewer than two rows or columns");
}

template <>
void check(const RecombineReply& m)
{
    require_finite(m.points, "a node is not finite");
    for (const Quad& quad : m.quads)
        require_below(quad, m.points.size(), "a node number of a quad is out of range");
}

template <>
void check(const BeginSolidRequest& m)
{
    require(is_file_name(m.result), "a file name contains a folder");
}

template <>
void check(const BeginSolidReply& m)
{
    for (const auto& source : m.sources)
        require(source.curves.size() == source.curve_points.size(), "curves have no points");
}

void check_axis(const SplineAxisData& axis)
{
    constexpr int kMostDegree = 25; // the limit of Open CASCADE
    require(axis.degree >= 1 && axis.degree <= kMostDegree, "the degree of a spline is out of range");
    require(axis.knots.size() >= 2 && axis.knots.size() == axis.multiplicities.size(),
            "a spline has no knots");
    for (const std::int32_t m : axis.multiplicities)
        require(m >= 1 && m <= axis.degree + 1, "the multiplicity of a knot is out of range");
}

std::size_t poles_of(const SplineAxisData& axis)
{
    std::size_t sum = 0;
    for (const std::int32_t m : axis.multiplicities) sum += index(m);
    require(sum > index(axis.degree) + 1, "a spline has too few knots");
    return sum - index(axis.degree) - 1;
}

template <>
void check(const MakeSolidRequest& m)
{
    require(m.format < MakeSolidRequest::format_count, "a file has an unknown format");
    require_finite(m.points, "a point is not finite");
    require(m.first_tolerance > 0 && m.last_tolerance >= m.first_tolerance && std::isfinite(m.last_tolerance),
            "a tolerance is not a positive number");
    for (const SolidEdge& edge : m.edges) {
        require(edge.kind < SolidEdge::count, "an edge has an unknown kind");
        require_below(edge.points, m.points.size(), "a point number of an edge is out of range");
        if (edge.kind == SolidEdge::lines)
            require(edge.points.size() >= 2, "an edge has fewer than two points");
        if (edge.kind != SolidEdge::spline) continue;
        check_axis(edge.curve_data.axis);
        require_finite(edge.curve_data.poles, "a pole is not finite");
        require(edge.curve_data.poles.size() == poles_of(edge.curve_data.axis),
                "a spline has the wrong number of poles");
    }
    for (const SolidFace& face : m.faces) {
        require(face.kind < SolidFace::count, "a face has an unknown kind");
        for (const auto& loop : face.loops) {
            for (const auto& use : loop)
                require_below(std::array{use[0]}, m.edges.size(), "an edge number of a loop is out of range");
        }
        const bool bordered = face.kind == SolidFace::plane || face.kind == SolidFace::filling;
        require(!bordered || !face.loops.empty(), "a face has no boundary");
        require_below(face.leading, m.points.size(), "a point number of a surface is out of range");
        for (const SplineSurfaceData& surface : face.surfaces) {
            check_axis(surface.u);
            check_axis(surface.v);
            require_finite(surface.poles, "a pole is not finite");
            require(surface.poles.size() == poles_of(surface.u) * poles_of(surface.v),
                    "a spline has the wrong number of poles");
        }
    }
}

} // namespace

template <class T>
std::string encode(const T& message)
{
    Writer writer;
    writer(message);
    return std::move(writer).take();
}

template <class T>
T decode(std::string_view bytes)
{
    Reader reader(bytes);
    T message;
    reader(message);
    reader.finish();
    check(message);
    return message;
}

#define LACUNA_MESSAGE(T)                                                                                    \
    template std::string encode(const T&);                                                                   \
    template T decode(std::string_view);
LACUNA_MESSAGE(Hello)
LACUNA_MESSAGE(Progress)
LACUNA_MESSAGE(Failure)
LACUNA_MESSAGE(LoadRequest)
LACUNA_MESSAGE(LoadReply)
LACUNA_MESSAGE(EvaluateRequest)
LACUNA_MESSAGE(EvaluateReply)
LACUNA_MESSAGE(ProjectRequest)
LACUNA_MESSAGE(ProjectReply)
LACUNA_MESSAGE(RecombineRequest)
LACUNA_MESSAGE(RecombineReply)
LACUNA_MESSAGE(BeginSolidRequest)
LACUNA_MESSAGE(BeginSolidReply)
LACUNA_MESSAGE(MakeSolidRequest)
LACUNA_MESSAGE(MakeSolidReply)
LACUNA_MESSAGE(ReleaseRequest)
#undef LACUNA_MESSAGE

} // namespace lacuna::cad_protocol
