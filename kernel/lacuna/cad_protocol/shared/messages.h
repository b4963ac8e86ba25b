// SPDX-License-Identifier: MIT
#pragma once

// In: requests and replies as structs; out: their bytes on the socket, and the structs again, checked.
//
// Where to change things:
//   contents of a message         messages.h
//   checks of received messages   messages.cpp
//   frames, descriptors, waiting  channel.cpp

#include <lacuna/core/message.h>
#include <lacuna/core/shared/bytes.h>

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

/// Messages between the kernel and the CAD process: plain arrays, no pointers, no callbacks.
///
/// The CAD process sends `hello` once when it starts. It answers each request with any number of `progress`
/// messages and then `done` or `failed`. Only `release` has no answer.
namespace lacuna::cad_protocol {

using lacuna::ProtocolError;

enum class Opcode : std::uint16_t {
    hello = 1,
    progress,
    done,
    failed,
    load,
    evaluate,
    project,
    recombine,
    fill_skin,
    begin_solid,
    make_solid,
    release,
};

struct Hello {
    std::string gmsh_version;
    std::string missing; ///< confinement features that this system lacks, as text; empty: none
};

struct Progress {
    double fraction = 0; ///< [0, 1]
};

/// An error in the CAD process. Its kind selects the error class that the kernel throws.
struct Failure {
    enum Kind : std::uint8_t { invalid_input, not_sweepable, backend, out_of_memory, count };
    std::uint8_t kind = backend;
    MessageParts message;
};

/// A file sent with the message as a descriptor.
struct SentFile {
    std::string name; ///< without a folder; scripts include the file by this name, and Gmsh derives the
                      ///< format from its extension
};

struct LoadFile {
    enum Format : std::uint8_t { step, iges, brep, script };
    std::uint8_t format = step;
    std::string path;               ///< path as the user gave it, for messages
    std::vector<SentFile> contents; ///< the file itself, then the files that a script includes or merges
};

struct LoadRequest {
    std::vector<LoadFile> files;
    double tolerance = 0; ///< [model length]; 0: 1e-6 × the diagonal
    double scale = 1;     ///< model length / file length
};

/// A CAD model as facets and curves. Lengths are those of the file.
struct LoadReply {
    struct Edge {
        std::int32_t tag = 0, curve = 0, from = 0, to = 0; ///< `from` and `to`: positions in `vertex_tags`
        std::vector<double> params;
        std::vector<Index> points;
        std::vector<Index> left_out = {}; ///< positions in LoadReply::left_out: faces with this edge
        std::vector<Vec3> form = {};      ///< defining points as in PlainCurve [file length]; or empty
    };
    struct Solid {
        std::int32_t tag = 0;
        std::string name; ///< empty: none, or a default label
        std::vector<Index> faces;
    };
    /// A face that could not be triangulated and is not a sliver.
    struct LeftOut {
        std::int32_t tag = 0;
        std::string why; ///< completes the sentence "face 6 …"
    };
    struct Face {
        std::int32_t tag = 0;
        std::string name;
        std::string kind;
        std::vector<Triangle> triangles;
        std::vector<std::array<Vec2, 3>> uv;
    };
    std::uint64_t model = 0; ///< handle of the model
    double diagonal = 0;     ///< diagonal of the exact bounding box [file length]
    std::vector<Vec3> points;
    std::vector<std::int32_t> vertex_tags; ///< vertex k is point k
    std::vector<Edge> edges;
    std::vector<Face> faces;
    std::vector<Solid> solids; ///< a face between two solids is in both
    std::vector<LeftOut> left_out = {};
    std::vector<MessageParts> notes; ///< one sentence for each face left out, first those in `left_out`, then
                                     ///< slivers
};

struct EvaluateRequest {
    std::uint64_t model = 0;
    std::int32_t curve = 0;
    std::vector<double> params;
};
struct EvaluateReply {
    std::vector<Vec3> points; ///< [model length]
};

struct ProjectRequest {
    std::uint64_t model = 0;
    std::int32_t face = 0;
    std::vector<Vec3> points; ///< [model length]
    std::vector<Vec2> uv;
};
struct ProjectReply {
    std::vector<Vec3> points;
    std::vector<Vec2> uv;
};

/// Target sizes at the points of a square grid, row by row; empty: Gmsh chooses the sizes.
struct SizeRaster {
    Vec2 origin = Vec2::Zero();
    double step = 1;
    std::int32_t columns = 0;
    std::vector<double> sizes;
};
struct RecombineRequest {
    std::vector<Vec2> points;
    std::vector<std::vector<Index>> loops;
    SizeRaster size;
};
struct RecombineReply {
    std::vector<Vec2> points;
    std::vector<Quad> quads;
};

/// Closed shells of triangles, oriented outward: the outer one, then cavities.
struct FillSkinRequest {
    std::vector<Vec3> points;
    std::vector<std::vector<Triangle>> shells;
};
struct FillSkinReply {
    std::vector<Vec3> points; ///< points of the request, then inner points
    std::vector<Quad> tets;   ///< the corners of each tetrahedron
};

/// Entities of a loaded model that are used to make a solid.
struct SolidSource {
    std::uint64_t model = 0;
    std::vector<std::int32_t> faces, curves;
};
/// Three files in memory are sent with this request: two for intermediate results, and one for the result.
struct BeginSolidRequest {
    std::string subject; ///< the file to be written, for messages
    std::string result;  ///< name of that file without its folder; its extension gives the format
    std::vector<SolidSource> sources;
};
/// For each source, the requested entities that exist in the CAD process, and the start, middle and end of
/// each curve [model length].
struct BeginSolidReply {
    struct Found {
        std::vector<std::int32_t> faces, curves;
        std::vector<std::array<Vec3, 3>> curve_points;
    };
    std::uint64_t solid = 0;
    std::vector<Found> sources;
};

struct SplineAxisData {
    std::int32_t degree = 1;
    std::vector<double> knots;
    std::vector<std::int32_t> multiplicities;
};
struct SplineCurveData {
    SplineAxisData axis;
    std::vector<Vec3> poles;
};
struct SplineSurfaceData {
    SplineAxisData u, v;
    std::vector<Vec3> poles; ///< u running fastest
};
/// An edge of the solid.
struct SolidEdge {
    enum Kind : std::uint8_t { exact, lines, spline };
    std::uint8_t kind = lines;
    std::int32_t source = -1, curve = 0; ///< kind exact: index of the source, and tag of its curve
    std::vector<Index> points;           ///< kind lines: indices in MakeSolidRequest::points
    SplineCurveData curve_data;          ///< kind spline
};
struct SolidFace {
    enum Kind : std::uint8_t { exact, plane, patches, filling };
    std::uint8_t kind = plane;
    NamedEntity entity;                                   ///< for messages
    std::int32_t source = -1, face = 0;                   ///< kind exact: index of the source, and its face
    std::vector<std::vector<std::array<Index, 2>>> loops; ///< edge number, and 1 if the edge is reversed
    std::vector<SplineSurfaceData> surfaces;              ///< kind patches
    std::vector<Index> leading;                           ///< kind filling: points to interpolate
    double area = 0;                                      ///< kind filling: area of its facets
};
struct MakeSolidRequest {
    enum Format : std::uint8_t { step, brep };
    std::uint64_t solid = 0;
    std::uint8_t format = step;
    std::vector<Vec3> points; ///< [model length]
    std::vector<SolidEdge> edges;
    std::vector<SolidFace> faces;
    double diagonal = 0, first_tolerance = 0, last_tolerance = 0; ///< [model length]
    double facet_volume = 0, deviation = 0;
};
struct MakeSolidReply {
    double volume = 0, tolerance = 0;
    std::uint64_t faces = 0;
};

struct ReleaseRequest {
    std::uint64_t handle = 0; ///< handle of a model or a solid under construction
};

// --- bytes --------------------------------------------------------------------------------------------

/// Check values of a decoded message. The kernel does not trust the CAD process, so numbers in replies must
/// be finite and indices in range. Values of a request are checked here only if the CAD process does not
/// check them when it uses them.
/// @throw ProtocolError
template <class T>
void check(const T&)
{
}
void check(const Failure& m);
void check(const LoadReply& m);
void check(const EvaluateReply& m);
void check(const ProjectRequest& m);
void check(const ProjectReply& m);
void check(const RecombineRequest& m);
void check(const RecombineReply& m);
void check(const FillSkinRequest& m);
void check(const FillSkinReply& m);
void check(const BeginSolidReply& m);
void check(const MakeSolidRequest& m);

template <class T>
std::string encode(const T& message)
{
    Writer writer;
    writer(message);
    return std::move(writer).take();
}
/// @throw ProtocolError  the bytes are not a message of type T, or `check()` refuses it.
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

} // namespace lacuna::cad_protocol
